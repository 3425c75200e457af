// burnish_channel: a highlight from vectors to the three sums of a pixel.
//
//     out = in + color S(N.H) for red, green and blue where lit, else in; limited to 0xFFFF
//
// S is shift7, fast. color is the light's colour times ks. Chain one channel per light, or feed a channel
// its own result for the next light. The bits of burnish_q15_dot, _cosine, burnish_shift7_q15 and
// _accumulate of include/burnish/lobe_q15.h and shade_q15.h.
//
// Latency    5 (burnish_dot) + burnish_shift7 + 3
// Throughput one pixel per clock
// Parameters ROWS, SEGMENT, DSP  as burnish_shift7
//            USER_WIDTH  width of user_in and user_out
// Ports      normal, half  {z, y, x}, Q15, unit vectors
//            exponent      n, 1 .. 1023
//            lit           1 where N.L > 0
//            color, sum_in, sum_out  {blue, green, red}, UQ1.15 each
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module burnish_channel #(
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0,
    parameter USER_WIDTH = 1
) (
    input wire clk,
    input wire enable,
    input wire [47:0] normal,
    input wire [47:0] half,
    input wire [9:0] exponent,
    input wire lit,
    input wire [47:0] color,
    input wire [47:0] sum_in,
    input wire [USER_WIDTH-1:0] user_in,
    output wire [47:0] sum_out,
    output wire [USER_WIDTH-1:0] user_out
);
    wire [15:0] cosine, value;
    wire [9:0] exponent_now;
    wire lit_now, lit_late;
    wire [47:0] color_now, color_late, sum_now, sum_late;
    wire [USER_WIDTH-1:0] user_now, user_late;
    burnish_dot dot (
        .clk(clk), .enable(enable), .a(normal), .b(half), .cosine(cosine));
    burnish_delay #(.WIDTH(107 + USER_WIDTH), .DEPTH(5)) ahead (
        .clk(clk), .enable(enable), .in({exponent, lit, color, sum_in, user_in}),
        .out({exponent_now, lit_now, color_now, sum_now, user_now}));
    burnish_shift7 #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(97 + USER_WIDTH))
        lobe (
        .clk(clk), .enable(enable), .exponent(exponent_now), .angle(cosine),
        .user_in({lit_now, color_now, sum_now, user_now}), .value(value),
        .user_out({lit_late, color_late, sum_late, user_late}));

    wire [15:0] weight = lit_late ? value : 16'd0;
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : channel
            wire [31:0] term;
            burnish_multiplier #(.INPUTS(1)) multiply (
                .clk(clk), .enable(enable), .a(color_late[16*k+:16]), .b(weight),
                .addend(32'd0), .product(term));
            reg [15:0] sum;
            wire [15:0] prior;
            burnish_delay #(.WIDTH(16), .DEPTH(2)) line (
                .clk(clk), .enable(enable), .in(sum_late[16*k+:16]), .out(prior));
            wire [16:0] total = {1'b0, prior} + {1'b0, term[31:16]};
            always @(posedge clk)
                if (enable) sum <= total[16] ? 16'hFFFF : total[15:0];
            assign sum_out[16*k+:16] = sum;
        end
    endgenerate
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(3)) user (
        .clk(clk), .enable(enable), .in(user_late), .out(user_out));
endmodule
