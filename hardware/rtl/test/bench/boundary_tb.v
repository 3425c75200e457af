// boundary_tb: burnish_boundary with the memory of `burnish lobe boundary --bits=0` (boundary.mem) against the C core's values
// (vectors.mem of wrappers.cpp), none of which it may change, and that the lobe stands still where nothing is to be seen.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module boundary_tb;
    parameter COUNT = 100;
    reg [63:0] vectors[0:COUNT-1];
    reg clk = 0, enable = 0, dark = 0;
    wire busy, valid;
    wire [15:0] value;
    integer sent = COUNT, got = 0, failures = 0, stopped = 0;
    wire [63:0] now = vectors[sent % COUNT];
    burnish_boundary #(.FILE("boundary.mem")) unit (
        .clk(clk), .enable(enable), .exponent(dark ? 10'd1023 : now[41:32]), .angle(dark ? 16'd0 : now[31:16]),
        .user_in(sent < COUNT), .busy(busy), .value(value), .user_out(valid));

    always #5 clk = !clk;

    // run CLOCKS: enabled half of the time.
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
            if (enable) sent = sent + 1;
            if (busy === 1'b0) stopped = stopped + 1;
            @(negedge clk);
        end
    endtask

    initial begin
        $readmemh("vectors.mem", vectors);
        run(300);
        sent = 0;
        run(COUNT * 3 + 300);
        if (got != COUNT) begin
            failures = failures + 1;
            $display("boundary_tb: %0d of %0d vectors came out", got, COUNT);
        end
        dark = 1;
        run(200);
        stopped = 0;
        run(100);
        if (stopped != 100) begin
            failures = failures + 1;
            $display("boundary_tb: the lobe runs while nothing is to be seen");
        end
        if (failures == 0) $display("boundary_tb: passed: %0d values", got);
        $finish;
    end
endmodule
`default_nettype wire
