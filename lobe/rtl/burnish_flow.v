// burnish_flow: makes a stage between two streams of a pipeline that has a clock enable.
//
//     m_word = the pipeline's result for s_word, in order, none lost, none repeated
//
// The pipeline takes word and gives result DEPTH clocks of enable later. s_ready comes from a register, so no
// combinational path leads from m_ready to s_ready; a word that arrives while the output stalls waits in a second
// register. With OUTPUT 0 m_ready drives enable, the clock enable of every register of the pipeline, within a clock.
// With OUTPUT 1 a register of two words at the end takes m_ready, and enable comes from registers.
//
// Latency    DEPTH + 1 + OUTPUT
// Throughput one word per clock; stalls cost nothing else
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_flow #(
    parameter IN = 16, // width of a word
    parameter OUT = 16, // width of a result
    parameter DEPTH = 2, // the pipeline's latency, 2 or more
    parameter OUTPUT = 0 // 1: a register at the output
) (
    input wire clk, // rising edge
    input wire reset, // 1: drops all words inside; at least one clock after power-up
    input wire s_valid, // a word comes
    output wire s_ready, // it is taken; a register
    input wire [IN-1:0] s_word, // for the pipeline
    output wire enable, // the pipeline advances
    output wire [IN-1:0] word, // its input
    input wire [OUT-1:0] result, // its output
    output wire m_valid, // a result is there
    input wire m_ready, // it is taken
    output wire [OUT-1:0] m_word // the result
);
    wire entering, end_ready;
    burnish_register #(.WIDTH(IN)) first (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_word(s_word),
        .m_valid(entering), .m_ready(enable), .m_word(word));

    // Valid bits: only these need the reset. The pipeline advances unless a result waits at its end.
    reg [DEPTH-1:0] valid;
    always @(posedge clk)
        if (reset) valid <= {DEPTH{1'b0}};
        else if (enable) valid <= {valid[DEPTH-2:0], entering};
    assign enable = !valid[DEPTH-1] || end_ready;

    generate
        if (OUTPUT == 1) begin : last
            burnish_register #(.WIDTH(OUT)) register (
                .clk(clk), .reset(reset), .s_valid(valid[DEPTH-1]), .s_ready(end_ready), .s_word(result),
                .m_valid(m_valid), .m_ready(m_ready), .m_word(m_word));
        end else if (OUTPUT == 0) begin : direct
            assign end_ready = m_ready;
            assign m_valid = valid[DEPTH-1];
            assign m_word = result;
        end else begin : refused
            burnish_parameter_OUTPUT_must_be_0_or_1 refused ();
        end
    endgenerate

`ifdef FORMAL
    // What rtl/test/protocol proves: for any pipeline, any stalls and resets.
    wire taken = s_valid && s_ready;
    wire f_given = m_valid && m_ready;
    reg f_past = 1'b0;
    reg [7:0] f_inside = 8'd0, f_first = 8'd0, f_last = 8'd0; // of the whole, and of the registers, which conserve theirs
    reg [7:0] f_count;
    integer f_bit;
    always @* begin
        f_count = f_first + f_last;
        for (f_bit = 0; f_bit < DEPTH; f_bit = f_bit + 1) f_count = f_count + {7'd0, valid[f_bit]};
    end
    always @(posedge clk) begin
        f_first <= reset ? 8'd0 : f_first + {7'd0, taken} - {7'd0, entering && enable};
        f_last <= reset ? 8'd0 : f_last + {7'd0, valid[DEPTH-1] && end_ready} - {7'd0, f_given};
    end
    always @(posedge clk) begin
        f_past <= 1'b1;
        f_inside <= reset ? 8'd0 : f_inside + {7'd0, taken} - {7'd0, f_given};
        if (!f_past) assume (reset);
        if (f_past) begin
            // Words are neither lost nor repeated: what came in and did not go out is inside.
            assert (f_inside == f_count);
            // An offered word stays, unchanged, until it is taken.
            if ($past(m_valid && !m_ready && !reset)) begin
                assert (m_valid);
                assert (m_word == $past(m_word));
            end
            // Reset drops all words and offers none.
            if ($past(reset)) assert (!m_valid && !s_ready && f_inside == 8'd0);
            // Without a stall a word is taken every clock.
            if (OUTPUT == 0 && $past(!reset && (!m_valid || m_ready))) assert (s_ready);
        end
    end
    // Order: a word of anybody's choice leaves after exactly the words that were before it, with its own lowest bits.
    localparam F_TAG = 4;
    (* anyseq *) wire f_choice;
    reg f_watched = 1'b0;
    reg [7:0] f_ahead;
    reg [F_TAG-1:0] f_tag;
    always @(posedge clk)
        if (reset) f_watched <= 1'b0;
        else if (!f_watched) begin
            f_watched <= taken && f_choice;
            f_ahead <= f_inside - {7'd0, f_given};
            f_tag <= s_word[F_TAG-1:0];
        end else if (f_given) begin
            f_ahead <= f_ahead - 8'd1;
            if (f_ahead == 8'd0) begin
`ifndef UNORDERED
                assert (m_word[F_TAG-1:0] == f_tag);
`endif
                f_watched <= 1'b0;
            end
        end
`endif
endmodule
`default_nettype wire
