// burnish_energy: the lobe with the energy of cos^n, zeta = (n + 1) / (order + 1).
//
//     S = max(0, 1 - (n + 1) / (order + 1) (1 - c))^order,  order = 2^SQUARINGS
//
// Bit for bit burnish_lobe_q15_fast (ROUND 1: _near; RESULT 8: _fast8) of include/burnish/lobe_q15.h with
// BURNISH_Q15_ENERGY. C rejects an exponent below an order above 2; this module computes the formula there, which is
// above 0 at a cosine of 0. If n rarely changes, burnish_zeta with a stored slope is smaller.
//
// Latency    8 + burnish_zeta
// Throughput one lobe per clock; n may change at every clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_energy #(
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
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
    input wire [9:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [RESULT-1:0] value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    wire [15:0] slope;
    wire [3:0] shift;
    wire [WIDTH-1:0] angle_now;
    wire [USER_WIDTH-1:0] user_now;
    burnish_energy_slope #(.SQUARINGS(SQUARINGS)) make (
        .clk(clk), .enable(enable), .exponent(exponent), .slope(slope), .shift(shift));
    burnish_delay #(.WIDTH(WIDTH + USER_WIDTH), .DEPTH(8)) line (
        .clk(clk), .enable(enable), .in({angle, user_in}), .out({angle_now, user_now}));
    burnish_zeta #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) lobe (
        .clk(clk), .enable(enable), .slope(slope), .shift(shift), .angle(angle_now),
        .user_in(user_now), .value(value), .user_out(user_out));
endmodule
`default_nettype wire
