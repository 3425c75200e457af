// burnish_dot: the dot product of two Q15 vectors as a cosine.
//
//     sum = x x' + y y' + z z' (Q30, modulo 2^32),
//     cosine = sum <= 0 ? 0 : sum >= 0x3FFFC000 ? 0x8000 : (sum + 0x4000) >> 15
//
// Bit for bit burnish_q15_cosine(burnish_q15_dot(a, b)) of include/burnish/shade_q15.h.
//
// Latency    5
// Throughput one per clock. Three multipliers add up their products, so no adder is needed beside them
// Ports      a, b   {z, y, x}, Q15 each;  cosine UQ1.15, registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module burnish_dot (
    input wire clk,
    input wire enable,
    input wire [47:0] a,
    input wire [47:0] b,
    output reg [15:0] cosine
);
    // Each multiplier adds the sum of those before it, so the factors of y wait one clock, those of z two.
    wire [31:0] pair_y, pair_z, x, xy, sum;
    wire [31:0] up = sum + 32'h4000;
    burnish_delay #(.WIDTH(32), .DEPTH(1)) wait_y (
        .clk(clk), .enable(enable), .in({a[31:16], b[31:16]}), .out(pair_y));
    burnish_delay #(.WIDTH(32), .DEPTH(2)) wait_z (
        .clk(clk), .enable(enable), .in({a[47:32], b[47:32]}), .out(pair_z));
    burnish_multiplier #(.SIGNED(1), .INPUTS(1)) multiply_x (
        .clk(clk), .enable(enable), .a(a[15:0]), .b(b[15:0]), .addend(32'd0), .product(x));
    burnish_multiplier #(.SIGNED(1), .INPUTS(1), .ADD(1)) multiply_y (
        .clk(clk), .enable(enable), .a(pair_y[31:16]), .b(pair_y[15:0]), .addend(x), .product(xy));
    burnish_multiplier #(.SIGNED(1), .INPUTS(1), .ADD(1)) multiply_z (
        .clk(clk), .enable(enable), .a(pair_z[31:16]), .b(pair_z[15:0]), .addend(xy), .product(sum));
    always @(posedge clk)
        if (enable)
            cosine <= sum[31] ? 16'd0 : up[31:30] != 2'd0 ? 16'h8000 : {1'b0, up[29:15]};
endmodule
