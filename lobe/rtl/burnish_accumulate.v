// burnish_accumulate: one term of a pixel's sum, for one colour.
//
//     total = sum + floor(factor weight / 2^16), limited to 0xFFFF
//
// Bit for bit burnish_q15_accumulate of include/burnish/shade_q15.h.
//
// Latency    with DSP 4; by rows 3 + burnish_times; others in burnish_latency.vh
// Throughput one per clock
// Parameters ROWS, SEGMENT, DSP  as burnish_times
// Ports      factor  UQ1.15: the light's intensity times the surface's
//            weight  UQ0.16: a lobe or a cosine
//            sum, total  UQ1.15; total registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_accumulate #(
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [15:0] factor,
    input wire [15:0] weight,
    input wire [15:0] sum,
    output reg [15:0] total
);
    `include "burnish_latency.vh"
    burnish_parameters #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) legal ();
    wire [15:0] term, prior, unused_fraction;
    wire [16:0] whole;
    burnish_times #(.INPUTS(1), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) multiply (
        .clk(clk), .enable(enable), .a(weight), .b(factor), .product({term, unused_fraction}));
    burnish_delay #(.WIDTH(16), .DEPTH(1 + latency_times(16, 16, ROWS, SEGMENT, DSP))) line (
        .clk(clk), .enable(enable), .in(sum), .out(prior));
    burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add (
        .clk(clk), .enable(enable), .a({1'b0, prior}), .b({1'b0, term}), .carry(1'b0),
        .sum(whole));
    always @(posedge clk) if (enable) total <= whole[16] ? 16'hFFFF : whole[15:0];
endmodule
`default_nettype wire
