// stream_lobe: any lobe, for the proof of the stream's protocol: a delay line whose value is the angle.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_lobe #(
    parameter UNIT = 1,
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
    input wire [15:0] angle,
    input wire [USER_WIDTH-1:0] user_in,
    output wire [RESULT-1:0] value,
    output wire [USER_WIDTH-1:0] user_out
);
    `include "burnish_latency.vh"
    burnish_delay #(.WIDTH(RESULT + USER_WIDTH),
        .DEPTH(latency_lobe(UNIT, SQUARINGS, RESULT, LAMBDA, ROWS, SEGMENT, DSP))) line (
        .clk(clk), .enable(enable), .in({angle[RESULT-1:0], user_in}), .out({value, user_out}));
    wire unused = &{1'b0, exponent, angle};
endmodule
`default_nettype wire
