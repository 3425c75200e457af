// burnish_register: a register of two words between two streams by the AXI4-Stream convention.
//
//     m_word = s_word, in order, none lost, none repeated
//
// All outputs are registers, so no path leads through it, neither from valid to valid nor from ready to ready. m_ready
// drives the clock enable of these two words alone.
//
// Latency    1
// Throughput one word per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_register #(
    parameter WIDTH = 16 // of a word
) (
    input wire clk, // rising edge
    input wire reset, // 1: drops both words; at least one clock after power-up
    input wire s_valid, // a word comes
    output reg s_ready, // it is taken
    input wire [WIDTH-1:0] s_word, // any bits
    output reg m_valid, // a word is there
    input wire m_ready, // it is taken
    output reg [WIDTH-1:0] m_word // the oldest word inside
);
    reg waiting; // a word that came while the output stalled; then s_ready is 0
    reg [WIDTH-1:0] waiting_word;
    wire taken = s_valid && s_ready;
    always @(posedge clk)
        if (reset) begin
            s_ready <= 1'b0;
            waiting <= 1'b0;
            m_valid <= 1'b0;
        end else if (!m_valid || m_ready) begin
            m_valid <= waiting || taken;
            m_word <= waiting ? waiting_word : s_word;
            waiting <= 1'b0;
            s_ready <= 1'b1;
        end else begin
            if (taken) begin
                waiting <= 1'b1;
                waiting_word <= s_word;
            end
            s_ready <= !(waiting || taken);
        end
`ifdef FORMAL
    // What rtl/test/protocol proves: what came in and did not go out is inside, and while a word waits, an older one is
    // at the output.
    reg f_started = 1'b0;
    reg [1:0] f_inside = 2'd0;
    always @(posedge clk) begin
        f_started <= 1'b1;
        f_inside <= reset ? 2'd0 : f_inside + {1'b0, taken} - {1'b0, m_valid && m_ready};
        if (!f_started) assume (reset);
        if (f_started) assert (f_inside == {1'b0, waiting} + {1'b0, m_valid} && (!waiting || (m_valid && !s_ready)));
    end
`endif
endmodule
`default_nettype wire
