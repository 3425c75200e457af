// burnish_shift: lobes whose slope is a multiple of n by one addition: zeta = FACTOR n / 2^(SHIFT + 1).
// 7n/16 crosses cos^n at 0.50 (n = 10) to 0.58 of its height (large n); 3n/8 (FACTOR 3, SHIFT 2) has the least
// maximum error.
//
//     S = max(0, 1 - zeta (1 - c))^2
//
// Bit for bit burnish_lobe_q15_fast (ROUND 1: _near; RESULT 8: _fast8) of include/burnish/lobe_q15.h.
//
// Latency    at order 2 and 16 bits 28, with ROWS 2 15, with DSP 4; others in burnish_latency.vh
// Throughput one lobe per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_shift #(
    parameter FACTOR = 7, // 7 or 3
    parameter SHIFT = 3, // 3 or 2
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: angle is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [9:0] exponent, // n, 1 .. 1023
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [RESULT-1:0] value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    wire [15:0] t;
    burnish_base #(.FACTOR(FACTOR), .SHIFT(SHIFT), .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT),
        .DSP(DSP)) base (
        .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .t(t));
    burnish_power #(.SQUARINGS(1), .RESULT(RESULT), .ROUND(ROUND), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP)) power (
        .clk(clk), .enable(enable), .t(t), .value(value));
    burnish_delay #(.WIDTH(USER_WIDTH),
        .DEPTH(latency_base(FACTOR, SHIFT, LAMBDA, ROWS, SEGMENT, DSP) +
            latency_power(1, RESULT, ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
