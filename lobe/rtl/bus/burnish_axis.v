// burnish_axis: burnish_stream with AXI4-Stream's names and whole bytes.
//
//     m_axis_tdata = lobe(s_axis_tdata), in order, none lost, none repeated
//
// s_axis_tdata is the angle in its lowest 16 bits, 24 with LAMBDA 1, and above it the exponent in 10, with UNIT 4
// {shift, slope} in 20. Bits that fill up bytes are not read, and 0 in m_axis_tdata. TLAST travels with its word.
//
// Latency    the unit's + 1 + OUTPUT
// Throughput one word per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_axis #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor, energy and zeta
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: the angle is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter OUTPUT = 0, // 1: a register at the output, which alone sees m_axis_tready
    parameter USER_WIDTH = 1 // width of TUSER
) (
    input wire aclk, // rising edge
    input wire aresetn, // 0: drops all words inside; at least one clock after power-up
    input wire s_axis_tvalid, // a word comes
    output wire s_axis_tready, // it is taken; a register
    input wire [(UNIT == 4 ? 40 : 32) + (LAMBDA != 0 ? 8 : 0)-1:0] s_axis_tdata, // {exponent, angle}
    input wire s_axis_tlast, // travels with the word
    input wire [USER_WIDTH-1:0] s_axis_tuser, // travels with the word
    output wire m_axis_tvalid, // a result is there
    input wire m_axis_tready, // it is taken
    output wire [(RESULT == 8 ? 8 : 16)-1:0] m_axis_tdata, // RESULT bits of the value, 0 above them
    output wire m_axis_tlast, // the word's s_axis_tlast
    output wire [USER_WIDTH-1:0] m_axis_tuser // the word's s_axis_tuser
);
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam CONTROL = UNIT == 4 ? 20 : 10;
    localparam FILL = RESULT < 8 ? 0 : (RESULT == 8 ? 8 : 16) - RESULT;
    wire [RESULT-1:0] value;
    burnish_stream #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
        .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .OUTPUT(OUTPUT),
        .USER_WIDTH(1 + USER_WIDTH)) stream (
        .clk(aclk), .reset(!aresetn), .s_valid(s_axis_tvalid), .s_ready(s_axis_tready),
        .s_exponent(s_axis_tdata[WIDTH+CONTROL-1:WIDTH]), .s_angle(s_axis_tdata[WIDTH-1:0]),
        .s_user({s_axis_tlast, s_axis_tuser}), .m_valid(m_axis_tvalid), .m_ready(m_axis_tready),
        .m_value(value), .m_user({m_axis_tlast, m_axis_tuser}));
    generate
        if (FILL > 0) begin : filled
            assign m_axis_tdata = {{FILL{1'b0}}, value};
        end else begin : whole
            assign m_axis_tdata = value;
        end
    endgenerate
    wire unused = &{1'b0, s_axis_tdata};
endmodule
`default_nettype wire
