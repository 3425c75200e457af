// wave: the run of burnish_stream that scripts/tables rtl-wave draws: nine words, a pause, an output that stalls twice.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module wave;
    reg clk = 0, reset = 1, s_valid = 0, m_ready = 1;
    reg [15:0] s_angle = 16'h8000;
    wire s_ready, m_valid, unused_user;
    wire [15:0] m_value;
    burnish_stream #(.DSP(1)) stream (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_exponent(10'd40), .s_angle(s_angle),
        .s_user(1'b0), .m_valid(m_valid), .m_ready(m_ready), .m_value(m_value), .m_user(unused_user));
    always #5 clk = !clk;

    integer edges = 0;
    always @(posedge clk) begin
        edges <= edges + 1;
        reset <= edges < 1;
        // A word that was taken makes room for the next; none is withdrawn, since s_ready is 1 at edges 5 and 16.
        if (s_valid && s_ready) s_angle <= s_angle - 16'h00C0;
        s_valid <= edges > 2 && edges < 16 && edges != 5;
        m_ready <= !(edges == 9 || edges == 10 || edges == 11 || edges == 15);
        if (edges == 3) begin
            $dumpfile("wave.vcd");
            $dumpvars(1, clk, s_valid, s_ready, s_angle, m_valid, m_ready, m_value);
        end
        if (edges == 22) $finish;
    end
endmodule
`default_nettype wire
