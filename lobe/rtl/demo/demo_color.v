// demo_color: the lighting equation of a pixel's three channels, and its sRGB codes.
//
//     color = ambient + diffuse (N.L) + 3/4 lobe where N.L > 0
//
// Bit for bit burnish_q15_accumulate of include/burnish/shade_q15.h with factors of few bits, where a product is an
// adder or two: diffuse is a multiple of 1/8, ambient an eighth of it. Codes come from a table of the top 10 bits.
//
// Latency    5
// Throughput one pixel per clock
// Parameters TABLE    the sRGB codes of 1024 intensities
// Ports      object   0: none, 1: sphere, 2: teapot; ink: a label; line: between the halves
//            n_dot_l  UQ1.15;  lobe  UQ0.8;  ink and line belong to the pixel that leaves
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_color #(
    parameter TABLE = "srgb.mem"
) (
    input wire clk,
    input wire [1:0] object,
    input wire [15:0] n_dot_l,
    input wire [7:0] lobe,
    input wire ink,
    input wire line,
    output wire [7:0] red,
    output wire [7:0] green,
    output wire [7:0] blue
);
    // Eighths: {blue, green, red}.
    localparam [8:0] SPHERE = {3'd1, 3'd1, 3'd5};
    localparam [8:0] TEAPOT = {3'd4, 3'd3, 3'd1};
    wire [8:0] diffuse = object[1] ? TEAPOT : SPHERE;
    // A cosine as a weight; 1 is limited.
    wire [15:0] weight = n_dot_l[15] ? 16'hFFFF : {n_dot_l[14:0], 1'b0};
    wire lit = n_dot_l != 16'd0;
    wire [17:0] triple = {1'b0, lobe, lobe, 1'b0} + {2'b0, lobe, lobe};
    reg [15:0] highlight, highlight_now;
    reg [1:0] object_1, object_2, object_3, object_4;
    always @(posedge clk) begin
        highlight <= lit ? {1'b0, triple[17:3]} : 16'd0;
        highlight_now <= highlight;
        object_1 <= object;
        object_2 <= object_1;
        object_3 <= object_2;
        object_4 <= object_3;
    end
    wire [23:0] color;
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : channel
            wire [2:0] eighths = diffuse[3*k+:3];
            wire [18:0] product = (eighths[0] ? {3'd0, weight} : 19'd0) +
                (eighths[1] ? {2'd0, weight, 1'b0} : 19'd0) + (eighths[2] ? {1'b0, weight, 2'd0} : 19'd0);
            reg [2:0] eighths_kept;
            reg [15:0] term, first;
            reg [16:0] sum;
            reg [7:0] codes[0:1023];
            reg [7:0] code, shown;
            initial $readmemh(TABLE, codes);
            always @(posedge clk) begin
                term <= {1'b0, product[18:4]};
                eighths_kept <= eighths;
                first <= term + {4'd0, eighths_kept, 9'd0};
                sum <= {1'b0, first} + {1'b0, highlight_now};
                code <= codes[sum[16:15] != 2'd0 ? 10'h3FF : sum[14:5]];
                shown <= object_4 != 2'd0 ? code : ink ? 8'hEE : line ? 8'h44 : 8'h11;
            end
            assign color[8*k+:8] = shown;
            wire unused = &{1'b0, product[3:0], sum[4:0]};
        end
    endgenerate
    assign {blue, green, red} = color;
    wire unused = &{1'b0, triple[2:0]};
endmodule
`default_nettype wire
