// burnish_dot: the dot product of two Q15 vectors as a cosine.
//
//     sum = x x' + y y' + z z' (Q30, modulo 2^32),
//     cosine = sum <= 0 ? 0 : sum >= 0x3FFFC000 ? 0x8000 : (sum + 0x4000) >> 15
//
// Bit for bit burnish_q15_cosine(burnish_q15_dot(a, b)) of include/burnish/shade_q15.h.
//
// Rows multiply unsigned numbers: with A = a + 2^15, B = b + 2^15 a product is A B - 2^15 (a + b) - 2^30, and the six
// components are summed while the rows work.
//
// Latency    with DSP 5; by rows 4 + burnish_times, or 7 if that takes less than 3; others in burnish_latency.vh
// Throughput one per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_dot #(
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0 // 1: multipliers of the chip; 0: rows of adders
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] a, // {z, y, x}, Q15 each
    input wire [47:0] b, // {z, y, x}, Q15 each
    output reg [15:0] cosine // UQ1.15, registered
);
    `include "burnish_latency.vh"
    burnish_parameters #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) legal ();
    wire [17:0] sum; // rounded, from 2^14 up
    wire [13:0] unused_fraction;
    genvar k;
    generate
        if (DSP != 0) begin : by_chip
            // Each product is added to the one before it: the factors of y wait one clock, those of z two.
            wire [31:0] y_now, z_now, x, xy;
            burnish_delay #(.WIDTH(32), .DEPTH(1)) wait_y (
                .clk(clk), .enable(enable), .in({a[31:16], b[31:16]}), .out(y_now));
            burnish_delay #(.WIDTH(32), .DEPTH(2)) wait_z (
                .clk(clk), .enable(enable), .in({a[47:32], b[47:32]}), .out(z_now));
            burnish_multiplier #(.SIGNED(1), .INPUTS(1), .ADD(1)) multiply_x (
                .clk(clk), .enable(enable), .a(a[15:0]), .b(b[15:0]), .addend(32'h4000),
                .product(x));
            burnish_multiplier #(.SIGNED(1), .INPUTS(1), .ADD(1)) multiply_y (
                .clk(clk), .enable(enable), .a(y_now[31:16]), .b(y_now[15:0]), .addend(x),
                .product(xy));
            burnish_multiplier #(.SIGNED(1), .INPUTS(1), .ADD(1)) multiply_z (
                .clk(clk), .enable(enable), .a(z_now[31:16]), .b(z_now[15:0]), .addend(xy),
                .product({sum, unused_fraction}));
        end else begin : by_rows
            localparam WAIT = latency_dot_wait(ROWS, SEGMENT);
            localparam ADD = latency_add(17, SEGMENT);
            wire [47:0] a_now, b_now;
            wire [31:0] product[0:2];
            wire [16:0] pair[0:2];
            wire [16:0] pair_xy, pair_z, all, correction;
            wire [31:0] xy, z;
            burnish_delay #(.WIDTH(96), .DEPTH(1)) inputs (
                .clk(clk), .enable(enable), .in({a, b}), .out({a_now, b_now}));
            for (k = 0; k < 3; k = k + 1) begin : component
                wire [15:0] one = a_now[16*k+:16], other = b_now[16*k+:16];
                wire [31:0] whole;
                burnish_times #(.ROWS(ROWS), .SEGMENT(SEGMENT)) multiply (
                    .clk(clk), .enable(enable), .a({~one[15], one[14:0]}),
                    .b({~other[15], other[14:0]}), .product(whole));
                burnish_delay #(.WIDTH(32),
                    .DEPTH(WAIT - latency_times(16, 16, ROWS, SEGMENT, 0))) line (
                    .clk(clk), .enable(enable), .in(whole), .out(product[k]));
                burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add (
                    .clk(clk), .enable(enable), .a(~{one[15], one}), .b(~{other[15], other}),
                    .carry(1'b1), .sum(pair[k]));
            end
            // Minus six numbers is their complements' sum and six carries; -3 2^30 is 2^15 2^15 modulo 2^32.
            burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add_pairs (
                .clk(clk), .enable(enable), .a(pair[0]), .b(pair[1]), .carry(1'b1), .sum(pair_xy));
            burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add_constant (
                .clk(clk), .enable(enable), .a(pair[2]), .b(17'h08000), .carry(1'b1),
                .sum(pair_z));
            burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add_all (
                .clk(clk), .enable(enable), .a(pair_xy), .b(pair_z), .carry(1'b1), .sum(all));
            burnish_delay #(.WIDTH(17), .DEPTH(WAIT - 3 * ADD)) line_all (
                .clk(clk), .enable(enable), .in(all), .out(correction));
            burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_xy (
                .clk(clk), .enable(enable), .a(product[0]), .b(product[1]), .carry(1'b0), .sum(xy));
            burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_z (
                .clk(clk), .enable(enable), .a(product[2]), .b({correction, 15'h4000}),
                .carry(1'b0), .sum(z));
            burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add (
                .clk(clk), .enable(enable), .a(xy), .b(z), .carry(1'b0),
                .sum({sum, unused_fraction}));
        end
    endgenerate

    // Rounding wraps a sum from 0x7FFFC000 on, which only vectors longer than 1.4 reach.
    wire wrapped = sum[17] && sum[16:0] == 17'd0;
    always @(posedge clk)
        if (enable)
            cosine <= wrapped || (!sum[17] && sum[16]) ? 16'h8000
                : sum[17] ? 16'd0 : {1'b0, sum[15:1]};
endmodule
`default_nettype wire
