// pixel_stream_tb: burnish_pixel_stream against the C core's pixels (vectors.mem of pixel_vectors.cpp), two lights: back
// to back, under random stalls on both sides, with an output that stands still until the input must, after resets. With
// HELD=1 the lights change after every pixel, which therefore passes alone.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module pixel_stream_tb;
    parameter HELD = 0;
    parameter OUTPUT = 1;
    parameter ROWS = 1;
    parameter DSP = 1;
    parameter COUNT = 64;
    localparam RESULTS = 16 * 48 + 16, INPUTS = 48 * 2 + 16 * 3 + 8 * 48 + 48;

    reg [INPUTS+RESULTS-1:0] vectors[0:COUNT-1];
    reg clk = 0, reset = 1, s_valid = 0, m_ready = 0, tried;
    wire s_ready, m_valid;
    wire [47:0] color;
    wire [7:0] user;
    integer sent = 0, got = 0, failures = 0, compared = 0, refused = 0;
    wire [INPUTS-1:0] in = vectors[(HELD != 0 ? got : sent) % COUNT][RESULTS+:INPUTS];
    wire [47:0] a, b, sum, diffuse_2, diffuse_1, specular_2, specular_1, light_2, light_1, half_2, half_1;
    wire [15:0] exponent, slope, rest;
    assign {a, b, exponent, slope, rest, light_2, half_2, diffuse_2, specular_2, light_1, half_1, diffuse_1, specular_1, sum} = in;
    burnish_pixel_stream #(.LIGHTS(2), .HELD(HELD), .ROWS(ROWS), .DSP(DSP), .OUTPUT(OUTPUT), .USER_WIDTH(8)) unit (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_normal(a), .s_exponent(exponent[9:0]),
        .s_ambient(sum), .s_user(sent[7:0]), .light({light_2, light_1}), .half({half_2, half_1}),
        .diffuse({diffuse_2, diffuse_1}), .specular({specular_2, specular_1}), .m_valid(m_valid), .m_ready(m_ready),
        .m_color(color), .m_user(user));

    always #5 clk = !clk;

    task fail(input [8*40-1:0] what);
        begin
            failures = failures + 1;
            if (failures == 5) $finish;
            if (failures < 5) $display("pixel_stream_tb: pixel %0d of %0d: %0s: %h", got, sent, what, color);
        end
    endtask

    wire [RESULTS-1:0] wanted = vectors[got % COUNT][RESULTS-1:0];
    reg offered = 0, passed = 0;
    reg [55:0] offer;
    always @(posedge clk) begin
        if (!reset && s_valid && !s_ready) refused = refused + 1;
        if (!reset && m_valid) begin
            if (got == sent) fail("a pixel that nobody sent");
            if (user !== got[7:0]) fail("another pixel's user data");
            if (wanted[16*48]) begin
                compared = compared + 1;
                if (color !== wanted[47:0]) fail("another colour");
            end
        end
        if (!reset && offered && (!m_valid || {color, user} !== offer)) fail("an offered pixel changed");
        offered <= !reset && m_valid && !m_ready;
        offer <= {color, user};
        passed <= s_valid && s_ready && !reset;
        if (reset) got <= sent;
        else begin
            if (m_valid && m_ready) got <= got + 1;
            if (s_valid && s_ready) sent <= sent + 1;
        end
    end

    // send MANY pixels: each side is free in VALID, READY of 8 clocks; a pixel that is offered stays until it is taken.
    task send(input integer many, input integer valid, input integer ready);
        integer until;
        begin
            until = sent + many;
            while (sent != until) begin
                @(negedge clk);
                if (sent == until) s_valid = 0;
                else if (!s_valid || passed) s_valid = ($random & 7) < valid && (HELD == 0 || sent == got);
                m_ready = ($random & 7) < ready;
            end
            s_valid = 0;
        end
    endtask
    task drain;
        while (got != sent) begin
            @(negedge clk);
            m_ready = 1;
        end
    endtask
    integer round, before;
    initial begin
        $readmemh("vectors.mem", vectors);
        repeat (2) @(negedge clk);
        reset = 0;
        @(negedge clk);
        send(COUNT, 8, 8);
        if (HELD == 0 && refused != 0) fail("less than a pixel a clock");
        drain;
        send(COUNT, 4, 4);
        send(HELD == 0 ? COUNT : 1, 8, 1);
        send(HELD == 0 ? COUNT : 1, 1, 8);
        drain;
        for (round = 0; HELD == 0 && round < 6; round = round + 1) begin
            send(5 + round * 13, 6, 5);
            @(negedge clk);
            reset = 1;
            repeat (1 + round % 3) @(negedge clk);
            reset = 0;
            @(negedge clk);
        end
        // The output stands still: the unit fills up, refuses and loses nothing.
        if (HELD == 0) begin
            before = sent;
            m_ready = 0;
            s_valid = 1;
            repeat (200) @(negedge clk);
            if (s_ready || got != before || sent - before < 40) fail("a unit that never fills up");
            s_valid = 0;
            drain;
        end
        send(COUNT, 5, 5);
        drain;
        if (failures == 0 && compared > COUNT) $display("pixel_stream_tb: passed: %0d pixels", got);
        $finish;
    end
    initial begin
        #1000000 $display("pixel_stream_tb: pixel %0d of %0d: the stream stands still", got, sent);
        $finish;
    end
endmodule
`default_nettype wire
