// burnish_stream: a lobe between two streams by the AXI4-Stream convention.
//
//     m_value = lobe(s_exponent, s_angle), in order, none lost, none repeated
//
// A word passes when valid and ready are both 1. s_ready comes from a register, so no combinational path leads from
// m_ready to s_ready; a word that arrives while the output stalls waits in a second register. m_ready itself drives the
// clock enable of every register of the unit: give it most of a clock period to settle. Drive it from a register, or put
// a register slice behind the output.
//
// Latency    the unit's + 1
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
    parameter USER_WIDTH = 1 // width of the user data: TLAST, TUSER, TID ...
) (
    input wire clk, // rising edge
    input wire reset, // 1: drops all words inside; at least one clock after power-up
    input wire s_valid, // a word comes
    output reg s_ready, // it is taken; a register
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

`ifdef FORMAL
    // What hardware/rtl/test/stream.sby proves: for any lobe, any stalls and resets.
    reg f_past = 1'b0;
    reg [7:0] f_inside = 8'd0;
    wire f_given = m_valid && m_ready;
    reg [7:0] f_count;
    integer f_bit;
    always @* begin
        f_count = {7'd0, waiting} + {7'd0, entering};
        for (f_bit = 0; f_bit < DEPTH; f_bit = f_bit + 1) f_count = f_count + {7'd0, valid[f_bit]};
    end
    always @(posedge clk) begin
        f_past <= 1'b1;
        f_inside <= reset ? 8'd0 : f_inside + {7'd0, taken} - {7'd0, f_given};
        if (!f_past) assume (reset);
        if (f_past) begin
            // Words are neither lost nor repeated: what came in and did not go out is inside.
            assert (f_inside == f_count);
            // While a word waits, no other is accepted: nothing overwrites it.
            assert (!(waiting && s_ready));
            // An offered word stays, unchanged, until it is taken.
            if ($past(m_valid && !m_ready && !reset)) begin
                assert (m_valid);
                assert (m_value == $past(m_value));
                assert (m_user == $past(m_user));
            end
            // Reset drops all words and offers none.
            if ($past(reset)) assert (!m_valid && !s_ready && f_inside == 8'd0);
            // Without a stall the stream takes a word every clock.
            if ($past(!reset && (!m_valid || m_ready))) assert (s_ready);
        end
    end
    // Order: a word of anybody's choice leaves after exactly the words that were before it, with its own user data.
    (* anyseq *) wire f_choice;
    reg f_watched = 1'b0;
    reg [7:0] f_ahead;
    reg [USER_WIDTH-1:0] f_user;
    always @(posedge clk)
        if (reset) f_watched <= 1'b0;
        else if (!f_watched) begin
            f_watched <= taken && f_choice;
            f_ahead <= f_inside - {7'd0, f_given};
            f_user <= s_user;
        end else if (f_given) begin
            f_ahead <= f_ahead - 8'd1;
            if (f_ahead == 8'd0) begin
`ifndef UNORDERED
                assert (m_user == f_user);
`endif
                f_watched <= 1'b0;
            end
        end
`endif
endmodule
`default_nettype wire
