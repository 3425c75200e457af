// demo_sphere: the normal of a sphere of radius 128 pixels.
//
//     z = sqrt(1 - x^2 - y^2) from a table of 256 words and a line between two of them
//
// Latency    8
// Throughput one pixel per clock
// Parameters TABLE  its file: {12 bits to the next word, 16 bits}, UQ1.15
// Ports      x, y   in 256ths of the radius, odd;  z  Q15;  hit  1 inside
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_sphere #(
    parameter TABLE = "sqrt.mem"
) (
    input wire clk,
    input wire signed [10:0] x,
    input wire signed [10:0] y,
    output reg [15:0] z,
    output wire hit
);
    reg [27:0] roots[0:255];
    initial $readmemh(TABLE, roots);

    // 1, 2, 3: the squares
    wire [7:0] x_size = x[10] ? ~x[7:0] + 8'd1 : x[7:0];
    wire [7:0] y_size = y[10] ? ~y[7:0] + 8'd1 : y[7:0];
    wire near = (x[10:8] == 3'b000 || x[10:8] == 3'b111) && (y[10:8] == 3'b000 || y[10:8] == 3'b111);
    reg [7:0] x_kept, y_kept;
    always @(posedge clk) begin
        x_kept <= x_size;
        y_kept <= y_size;
    end
    wire [15:0] xx, yy;
    burnish_square #(.WIDTH(8), .ROWS(4)) square_x (
        .clk(clk), .enable(1'b1), .t(x_kept), .offset(9'd0), .square(xx));
    burnish_square #(.WIDTH(8), .ROWS(4)) square_y (
        .clk(clk), .enable(1'b1), .t(y_kept), .offset(9'd0), .square(yy));
    wire near_now;
    burnish_delay #(.WIDTH(1), .DEPTH(3)) wait_near (
        .clk(clk), .enable(1'b1), .in(near), .out(near_now));

    // 4: what is left for z;  5: the table;  6 .. 8: the line
    wire [16:0] both = {1'b0, xx} + {1'b0, yy};
    reg [15:0] rest;
    reg met;
    reg [27:0] word;
    reg [7:0] low;
    always @(posedge clk) begin
        rest <= ~both[15:0] + 16'd1;
        met <= near_now && !both[16];
        word <= roots[rest[15:8]];
        low <= rest[7:0];
    end
    wire [19:0] product;
    wire [15:0] from;
    burnish_times #(.A_WIDTH(8), .B_WIDTH(12), .ROWS(4)) times (
        .clk(clk), .enable(1'b1), .a(low), .b(word[27:16]), .product(product));
    burnish_delay #(.WIDTH(16), .DEPTH(2)) wait_word (
        .clk(clk), .enable(1'b1), .in(word[15:0]), .out(from));
    always @(posedge clk) z <= from + {4'd0, product[19:8]};
    burnish_delay #(.WIDTH(1), .DEPTH(4)) wait_hit (
        .clk(clk), .enable(1'b1), .in(met), .out(hit));
    wire unused = &{1'b0, product[7:0]};
endmodule
`default_nettype wire
