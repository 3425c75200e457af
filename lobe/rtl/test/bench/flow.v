// flow: burnish_flow around any pipeline, for the proof of its protocol: a delay line.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module flow #(
    parameter OUTPUT = 0
) (
    input wire clk,
    input wire reset,
    input wire s_valid,
    input wire [5:0] s_word,
    input wire m_ready,
    output wire s_ready,
    output wire m_valid,
    output wire [5:0] m_word
);
    wire enable;
    wire [5:0] word, result;
    burnish_flow #(.IN(6), .OUT(6), .DEPTH(3), .OUTPUT(OUTPUT)) unit (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_word(s_word), .enable(enable), .word(word),
        .result(result), .m_valid(m_valid), .m_ready(m_ready), .m_word(m_word));
    burnish_delay #(.WIDTH(6), .DEPTH(3)) line (.clk(clk), .enable(enable), .in(word), .out(result));
endmodule
`default_nettype wire
