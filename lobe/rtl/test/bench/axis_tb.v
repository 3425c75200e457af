// axis_tb: burnish_axis against the C core's values (vectors.mem of vectors.cpp): back to back, under random stalls on
// both sides, with an output that stands still until the input must, and with resets in the middle.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module axis_tb;
    parameter UNIT = 1;
    parameter SQUARINGS = 1;
    parameter RESULT = 16;
    parameter ROUND = 0;
    parameter LAMBDA = 0;
    parameter ROWS = 1;
    parameter SEGMENT = 0;
    parameter DSP = 0;
    parameter OUTPUT = 0;
    parameter COUNT = 100;
    localparam IN = (UNIT == 4 ? 40 : 32) + (LAMBDA != 0 ? 8 : 0);
    localparam OUT = RESULT == 8 ? 8 : 16;
    localparam USED = (LAMBDA != 0 ? 24 : 16) + (UNIT == 4 ? 20 : 10);

    reg [63:0] vectors[0:COUNT-1];
    reg clk = 0, aresetn = 0, s_valid = 0, m_ready = 0;
    wire s_ready, m_valid, m_last;
    wire [OUT-1:0] m_data;
    wire [7:0] m_user;
    integer sent = 0, got = 0, failures = 0, clocks = 0, refused = 0, held = 0;
    reg [IN-1:0] fill = 0;
    wire [IN-1:0] s_data = vectors[sent % COUNT][16+:IN] | (fill >> USED << USED);

    burnish_axis #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP), .OUTPUT(OUTPUT), .USER_WIDTH(8)) unit (
        .aclk(clk), .aresetn(aresetn), .s_axis_tvalid(s_valid), .s_axis_tready(s_ready), .s_axis_tdata(s_data),
        .s_axis_tlast(sent % 7 == 6), .s_axis_tuser(sent[7:0]), .m_axis_tvalid(m_valid), .m_axis_tready(m_ready),
        .m_axis_tdata(m_data), .m_axis_tlast(m_last), .m_axis_tuser(m_user));

    always #5 clk = !clk;

    task fail(input [8*40-1:0] what);
        begin
            failures = failures + 1;
            if (failures < 5) $display("axis_tb: word %0d of %0d: %0s", got, sent, what);
        end
    endtask

    wire [16:0] wanted = {got % 7 == 6, vectors[got % COUNT][15:0]};
    reg offered = 0;
    reg [OUT+8:0] offer;
    always @(posedge clk) begin
        clocks = clocks + 1;
        if (aresetn && s_valid && !s_ready) refused = refused + 1;
        if (aresetn && m_valid) begin
            if (got == sent) fail("a word that nobody sent");
            if ({m_last, {16 - OUT{1'b0}}, m_data} !== wanted) fail("wrong value or TLAST");
            if (m_user !== got[7:0]) fail("wrong TUSER");
        end
        if (aresetn && offered && (!m_valid || {m_last, m_user, m_data} !== offer)) fail("an offered word changed");
        offered <= aresetn && m_valid && !m_ready;
        offer <= {m_last, m_user, m_data};
        if (!aresetn && held > 0 && m_valid) fail("a word after a reset");
        held <= aresetn ? 0 : held + 1;
        if (aresetn && m_valid && m_ready) got <= got + 1;
        else if (!aresetn) got <= sent;
        if (aresetn && s_valid && s_ready) begin
            sent <= sent + 1;
            fill <= {$random, $random};
        end
    end

    // send MANY words: each side is free in VALID, READY of 8 clocks; a word that is offered stays until it is taken.
    task send(input integer many, input integer valid, input integer ready);
        integer until;
        begin
            until = sent + many;
            while (sent != until) begin
                @(negedge clk);
                if (sent != until) begin
                    if (!(s_valid && aresetn && !passed)) s_valid = ($random & 7) < valid;
                    m_ready = ($random & 7) < ready;
                    was_ready = s_ready;
                    m_ready = !m_ready;
                    #1 if (s_ready !== was_ready) fail("s_ready follows m_ready");
                    m_ready = !m_ready;
                end
            end
            s_valid = 0;
        end
    endtask
    reg passed = 0, was_ready = 0;
    always @(posedge clk) passed <= s_valid && s_ready;

    task drain;
        begin
            while (got != sent) begin
                @(negedge clk);
                m_ready = 1;
            end
        end
    endtask

    task reset(input integer clocks_long);
        begin
            @(negedge clk);
            aresetn = 0;
            s_valid = 0;
            repeat (clocks_long) @(negedge clk);
            aresetn = 1;
            @(negedge clk);
        end
    endtask

    integer round, before;
    initial begin
        $readmemh("vectors.mem", vectors);
        reset(2);
        // A word a clock, none refused.
        refused = 0;
        before = clocks;
        send(COUNT, 8, 8);
        if (refused != 0 || clocks - before > COUNT + 2) fail("less than a word a clock");
        drain;
        send(COUNT, 4, 4);
        send(COUNT, 8, 1);
        send(COUNT, 1, 8);
        drain;
        for (round = 0; round < 20; round = round + 1) begin
            send(5 + round * 3, 6, 5);
            reset(1 + round % 3);
        end
        if (got != sent) fail("words inside after a reset");
        // The output stands still: the unit fills up, refuses and loses nothing.
        before = sent;
        m_ready = 0;
        s_valid = 1;
        repeat (200) @(negedge clk);
        if (s_ready || got != before || sent - before < 4) fail("a unit that never fills up");
        s_valid = 0;
        drain;
        send(COUNT, 5, 5);
        drain;
        if (failures == 0) $display("axis_tb: passed: %0d words, of which a standing output holds %0d", got, sent - before - COUNT);
        $finish;
    end
    initial begin
        #300000 $display("axis_tb: word %0d of %0d: the stream stands still", got, sent);
        $finish;
    end
endmodule
`default_nettype wire
