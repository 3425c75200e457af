// boundary_tb: burnish_boundary with the memory of `burnish lobe boundary --bits=0` (boundary.mem) against the C core's values
// (vectors.mem of vectors.cpp), none of which it may change, and that the lobe stands still where nothing is to be seen.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module boundary_tb;
    parameter LAMBDA = 0;
    parameter DSP = 0;
    parameter COUNT = 100;
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    reg [63:0] vectors[0:COUNT-1];
    reg clk = 0, enable = 0, dark = 0;
    wire busy, valid;
    wire [15:0] value;
    integer sent = COUNT, got = 0, failures = 0, stopped = 0, gap = 0, left = 0;
    wire [63:0] now = vectors[sent % COUNT];
    wire none = dark || left != 0;
    burnish_boundary #(.FILE("boundary.mem"), .LAMBDA(LAMBDA), .DSP(DSP)) unit (
        .clk(clk), .enable(enable), .exponent(none ? 10'd1023 : now[WIDTH+16+:10]),
        .angle(none ? {WIDTH{LAMBDA != 0}} : now[16+:WIDTH]), .user_in(sent < COUNT && !none), .busy(busy), .value(value),
        .user_out(valid));

    always #5 clk = !clk;

    // run CLOCKS: enabled half of the time; gap dark pixels follow each vector.
    task run(input integer clocks);
        repeat (clocks) begin
            enable = $random;
            @(posedge clk);
            #1;
            if (enable && valid === 1'b1) begin
                if (value !== vectors[got][15:0]) begin
                    failures = failures + 1;
                    if (failures < 5) $display("boundary_tb: vector %0d: %h, the C core has %h", got, value, vectors[got][15:0]);
                end
                got = got + 1;
            end
            if (enable && left == 0) begin
                sent = sent + 1;
                left = gap;
            end else if (enable) left = left - 1;
            if (busy === 1'b0) stopped = stopped + 1;
            @(negedge clk);
        end
    endtask

    task send(input integer dark_pixels);
        begin
            gap = dark_pixels;
            left = 0;
            sent = 0;
            got = 0;
            run(COUNT * 3 * (gap + 1) + 300);
            if (got != COUNT) begin
                failures = failures + 1;
                $display("boundary_tb: %0d of %0d vectors came out", got, COUNT);
            end
        end
    endtask

    initial begin
        $readmemh("vectors.mem", vectors);
        run(300);
        send(0);
        send(50); // longer than the lobe's latency: it stops after each vector
        dark = 1;
        run(200);
        stopped = 0;
        run(100);
        if (stopped != 100) begin
            failures = failures + 1;
            $display("boundary_tb: the lobe runs while nothing is to be seen");
        end
        if (failures == 0) $display("boundary_tb: passed: %0d values twice", COUNT);
        $finish;
    end
endmodule
`default_nettype wire
