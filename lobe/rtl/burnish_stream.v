// burnish_stream: a lobe between two streams by the AXI4-Stream convention.
//
//     m_value = lobe(s_exponent, s_angle), in order, none lost, none repeated
//
// A word passes when valid and ready are both 1. s_ready comes from a register, so no combinational path leads from
// m_ready to s_ready. With OUTPUT 0 m_ready drives the clock enable of every register of the unit: give it most of a
// clock period to settle. With OUTPUT 1 it drives a register of two words at the output alone.
//
// Latency    the unit's + 1 + OUTPUT
// Throughput one word per clock; stalls cost nothing else
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_stream #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor, energy and zeta
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: angle is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter OUTPUT = 0, // 1: a register at the output, which alone sees m_ready
    parameter USER_WIDTH = 1 // width of the user data: TLAST, TUSER, TID ...
) (
    input wire clk, // rising edge
    input wire reset, // 1: drops all words inside; at least one clock after power-up
    input wire s_valid, // a word comes
    output wire s_ready, // it is taken; a register
    input wire [(UNIT == 4 ? 20 : 10)-1:0] s_exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {shift, slope}, 4 and 16 bits
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] s_angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] s_user, // travels with the word
    output wire m_valid, // a result is there
    input wire m_ready, // it is taken
    output wire [RESULT-1:0] m_value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] m_user // the word's s_user
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam WORD = (UNIT == 4 ? 20 : 10) + WIDTH + USER_WIDTH;
    localparam DEPTH =
        latency_lobe(UNIT, SQUARINGS, RESULT, LAMBDA, ROWS, SEGMENT, DSP);
    wire enable;
    wire [WORD-1:0] word;
    wire [RESULT+USER_WIDTH-1:0] result;
    burnish_flow #(.IN(WORD), .OUT(RESULT + USER_WIDTH), .DEPTH(DEPTH), .OUTPUT(OUTPUT)) flow (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_word({s_exponent, s_angle, s_user}),
        .enable(enable), .word(word), .result(result), .m_valid(m_valid), .m_ready(m_ready),
        .m_word({m_value, m_user}));
    burnish_lobe #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
        .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) lobe (
        .clk(clk), .enable(enable), .exponent(word[WORD-1:WIDTH+USER_WIDTH]),
        .angle(word[WIDTH+USER_WIDTH-1:USER_WIDTH]), .user_in(word[USER_WIDTH-1:0]),
        .value(result[RESULT+USER_WIDTH-1:USER_WIDTH]), .user_out(result[USER_WIDTH-1:0]));
endmodule
`default_nettype wire
