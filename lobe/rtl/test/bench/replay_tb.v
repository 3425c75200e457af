// replay_tb: the replay bench for event-driven simulators: reads vectors and the C core's results from
// the files of `replay --vectors`. Prints "replay_tb: passed" or the first difference.
// Defines: COUNT; SOME, if units may be missing from the bench. Files input.mem, expected.mem, latency.mem of the current folder.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`timescale 1ns / 1ps
module replay_tb;
    `include "units.vh"
    reg clk;
    reg [16*UNITS-1:0] answers[0:`COUNT-1];
    reg [15:0] latency[0:UNITS-1];
    reg [231:0] word;
    reg [16*UNITS-1:0] answer;
    wire [16*UNITS-1:0] values;
    wire [UNITS-1:0] users;
    integer i, k, wrong, longest;
    reg [UNITS-1:0] missing;

    replay units (
        .clk(clk), .clk_on(clk), .enable(1'b1), .cosine(word[15:0]), .lambda(word[39:16]),
        .exponent(word[49:40]), .slope(word[67:52]), .shift(word[71:68]), .constants(word[151:72]),
        .held(word[231:152]), .user(1'b1), .values(values), .users(users));

    // The words are {held, constants, shift, slope, exponent of 3 digits, lambda, cosine}.
    reg [231:0] wide[0:`COUNT-1];
    initial begin
        $readmemh("input.mem", wide);
        $readmemh("expected.mem", answers);
        $readmemh("latency.mem", latency);
        wrong = 0;
        longest = 0;
        missing = 0;
`ifdef SOME
        #1 for (k = 0; k < UNITS; k = k + 1) missing[k] = users[k] === 1'bz;
`endif
        for (k = 0; k < UNITS; k = k + 1) if (latency[k] > longest) longest = latency[k];
        clk = 0;
        for (i = 0; i < `COUNT + longest && wrong == 0; i = i + 1) begin
            if (i < `COUNT) begin
                word = wide[i];
            end
            #1 clk = 1;
            #1;
            // user_in is 1 from the first clock on; before that comes out, user_out is 0 from power-up.
            for (k = 0; k < UNITS; k = k + 1)
                if (!missing[k] && users[k] !== (i + 1 >= latency[k]) && wrong == 0) begin
                    $display("replay_tb: unit %0d, clock %0d: user_out is %b", k, i, users[k]);
                    wrong = 1;
                end
            for (k = 0; k < UNITS; k = k + 1)
                if (!missing[k] && i + 1 >= latency[k] && i + 1 - latency[k] < `COUNT && wrong == 0) begin
                    answer = answers[i+1-latency[k]] >> (16 * k);
                    if (values[16*k+:16] !== answer[15:0]) begin
                        $display("replay_tb: unit %0d, vector %0d: %0d, the C core has %0d", k,
                            i + 1 - latency[k], values[16*k+:16], answer[15:0]);
                        wrong = 1;
                    end
                end
            clk = 0;
        end
        if (wrong == 0) $display("replay_tb: passed, %0d vectors, %0d units", `COUNT, UNITS);
        $finish;
    end
endmodule
