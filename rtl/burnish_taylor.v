// burnish_taylor: the lobe with the power's curvature at the peak, zeta = n / order.
//
//     S = max(0, 1 - (n / order) (1 - c))^order,  order = 2^SQUARINGS
//
// Bit for bit burnish_lobe_q15_fast (ROUND 1: _near; RESULT 8: _fast8) of include/burnish/lobe_q15.h.
//
// Latency    at order 2 and 16 bits 28, with ROWS 2 15, with DSP 4; others in burnish_latency.vh
// Throughput one lobe per clock
// Parameters SQUARINGS  log2 of the order: 1 .. 4
//            RESULT     16, 12, 10 or 8 bits; see burnish_power
//            ROUND      0: fast; 1: near, half the error for one more adder (RESULT 16)
//            LAMBDA     0: angle is the cosine; 1: 1 - cosine
//            ROWS       adder rows between two registers
//            SEGMENT    0, or the longest carry chain in columns
//            DSP        1: multipliers of the chip
//            USER_WIDTH width of user_in and user_out
// Ports      enable     1: the pipeline advances
//            exponent   n, 1 .. 1023
//            angle      cosine UQ1.15, above 0x8000 counts as 1; or 1 - cosine UQ0.24
//            value      UQ0.16 or UQ0.8
//            user_in, user_out   a valid bit, a tag, a pixel's address; delayed by the latency
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_taylor #(
    parameter SQUARINGS = 1,
    parameter RESULT = 16,
    parameter ROUND = 0,
    parameter LAMBDA = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0,
    parameter USER_WIDTH = 1
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle,
    input wire [USER_WIDTH-1:0] user_in,
    output wire [RESULT-1:0] value,
    output wire [USER_WIDTH-1:0] user_out
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    wire [15:0] t;
    burnish_base #(.FACTOR(1), .SHIFT(SQUARINGS - 1), .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT),
        .DSP(DSP)) base (
        .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .t(t));
    burnish_power #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP)) power (
        .clk(clk), .enable(enable), .t(t), .value(value));
    burnish_delay #(.WIDTH(USER_WIDTH),
        .DEPTH(latency_base(1, SQUARINGS - 1, LAMBDA, ROWS, SEGMENT, DSP) +
            latency_power(SQUARINGS, RESULT, ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
