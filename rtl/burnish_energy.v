// burnish_energy: the lobe with the power's energy, zeta = (n + 1) / (order + 1).
//
//     S = max(0, 1 - (n + 1) / (order + 1) (1 - c))^order,  order = 2^SQUARINGS
//
// Bit for bit burnish_lobe_q15_fast (ROUND 1: _near; RESULT 8: _fast8) of include/burnish/lobe_q15.h with
// BURNISH_Q15_ENERGY. Where n rarely changes, burnish_zeta with a stored slope is smaller.
//
// Latency    8 + burnish_zeta
// Throughput one lobe per clock; n may change at every clock
// Parameters, ports  as burnish_taylor
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_energy #(
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
