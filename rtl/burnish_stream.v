// burnish_stream: a lobe between two streams by the AXI4-Stream convention.
//
//     m_value = lobe(s_exponent, s_angle), in order, none lost, none repeated
//
// A word passes when valid and ready are both 1. s_ready comes from a register, so there is no combinational path
// from m_ready to s_ready: a word that arrives while the output stalls waits in a second register.
//
// Latency    the unit's + 1
// Throughput one word per clock; stalls cost nothing else
// Parameters UNIT       0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
//            SQUARINGS  for taylor, energy and zeta;  RESULT .. DSP  as burnish_taylor
//            USER_WIDTH width of the user data: TLAST, TUSER, TID ...
// Ports      reset      1: drops all words inside; at least one clock after power-up
//            s_*, m_*   the two streams; {s_exponent, s_angle} and m_value are their TDATA
//            s_exponent n, 1 .. 1023; with UNIT 4 {shift, slope}: 4 and 16 bits
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_stream #(
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
    input wire reset,
    input wire s_valid,
    output reg s_ready,
    input wire [(UNIT == 4 ? 20 : 10)-1:0] s_exponent,
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] s_angle,
    input wire [USER_WIDTH-1:0] s_user,
    output wire m_valid,
    input wire m_ready,
    output wire [RESULT-1:0] m_value,
    output wire [USER_WIDTH-1:0] m_user
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam WORD = (UNIT == 4 ? 20 : 10) + WIDTH + USER_WIDTH;
    localparam DEPTH =
        latency_lobe(UNIT, SQUARINGS, RESULT, LAMBDA, ROWS, SEGMENT, DSP);

    // The unit advances unless a result waits at its end.
    wire enable = !m_valid || m_ready;

    // The next word in: from the waiting register first.
    reg waiting;
    reg [WORD-1:0] waiting_word;
    reg entering;
    reg [WORD-1:0] entering_word;
    wire [WORD-1:0] arriving = {s_exponent, s_angle, s_user};
    wire taken = s_valid && s_ready;
    always @(posedge clk)
        if (reset) begin
            s_ready <= 1'b0;
            waiting <= 1'b0;
            entering <= 1'b0;
        end else if (enable) begin
            // A waiting word implies s_ready = 0: no other arrives.
            entering <= waiting || taken;
            entering_word <= waiting ? waiting_word : arriving;
            waiting <= 1'b0;
            s_ready <= 1'b1;
        end else begin
            if (taken) begin
                waiting <= 1'b1;
                waiting_word <= arriving;
            end
            s_ready <= !(waiting || taken);
        end

    // Valid bits: only these need the reset.
    reg [DEPTH-1:0] valid;
    always @(posedge clk)
        if (reset) valid <= {DEPTH{1'b0}};
        else if (enable) valid <= {valid[DEPTH-2:0], entering};
    assign m_valid = valid[DEPTH-1];

    burnish_lobe #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
        .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) lobe (
        .clk(clk), .enable(enable), .exponent(entering_word[WORD-1:WIDTH+USER_WIDTH]),
        .angle(entering_word[WIDTH+USER_WIDTH-1:USER_WIDTH]),
        .user_in(entering_word[USER_WIDTH-1:0]), .value(m_value), .user_out(m_user));
endmodule
`default_nettype wire
