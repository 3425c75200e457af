// wishbone_tb: burnish_wishbone against the C core's values (vectors.mem of wrappers.cpp): the register map, byte
// selects, values one by one and by the fill of the unit, accesses that must be refused, cycles with and without a
// pause, a reset in the middle.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module wishbone_tb;
    parameter UNIT = 1;
    parameter SQUARINGS = 1;
    parameter RESULT = 16;
    parameter LAMBDA = 0;
    parameter ROWS = 1;
    parameter DSP = 0;
    parameter COUNT = 100;
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam [1:0] EXPONENT = 0, ANGLE = 1, VALUE = 2, STATUS = 3;

    reg [63:0] vectors[0:COUNT-1];
    reg clk = 0, reset = 1, cyc = 0, stb = 0, we = 0;
    reg [1:0] adr = 0;
    reg [3:0] sel = 15;
    reg [31:0] dat_w = 0;
    wire [31:0] dat_r;
    wire ack, err;
    integer failures = 0, cycles = 0;

    burnish_wishbone #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .LAMBDA(LAMBDA), .ROWS(ROWS), .DSP(DSP)) unit (
        .clk(clk), .reset(reset), .cyc(cyc), .stb(stb), .we(we), .adr(adr), .sel(sel), .dat_w(dat_w), .dat_r(dat_r),
        .ack(ack), .err(err));

    always #5 clk = !clk;

    task fail(input [8*48-1:0] what);
        begin
            failures = failures + 1;
            if (failures < 5) $display("wishbone_tb: cycle %0d: %0s: word %0d, read %h", cycles, what, adr, dat_r);
        end
    endtask

    // An answer belongs to a cycle of the clock before and lasts one clock.
    reg asked = 0, answered = 0;
    always @(posedge clk) begin
        if (!reset && (ack || err) && (!asked || answered)) fail("an answer that nobody asked for");
        if (!reset && ack && err) fail("both answers");
        asked <= !reset && cyc && stb;
        answered <= !reset && (ack || err);
    end

    // One cycle, with or without a pause after it; it must end as REFUSED says.
    reg pause = 1;
    task cycle(input writes, input [1:0] word, input [31:0] data, input [3:0] bytes, input refused);
        begin
            cyc = 1;
            stb = 1;
            we = writes;
            adr = word;
            dat_w = data;
            sel = bytes;
            @(negedge clk);
            while (!ack && !err) @(negedge clk);
            if (err !== refused) fail(refused ? "ack instead of err" : "err instead of ack");
            cycles = cycles + 1;
            if (pause) begin
                cyc = 0;
                stb = cycles[0]; // stb without cyc starts no cycle
            end
            @(negedge clk);
        end
    endtask
    reg [31:0] seen;
    always @(negedge clk) if (ack) seen = dat_r;
    task wanted(input [1:0] word, input [31:0] data);
        begin
            cycle(0, word, 32'hDEADBEEF, 15, 0);
            if (seen !== data) begin
                fail("another value");
                if (failures < 5) $display("    expected %h, got %h", data, seen);
            end
        end
    endtask
    // Bits that the angle lacks are not read.
    task angle(input integer index, input refused);
        begin
            cycle(1, ANGLE, vectors[index][16+:WIDTH] | 32'hA5000000, LAMBDA != 0 ? 7 : 3, refused);
        end
    endtask
    task exponent(input integer index);
        cycle(1, EXPONENT, {22'h2AAAAA, vectors[index][16+WIDTH+:10]}, 15, 0);
    endtask

    integer i, first, inside, round;
    initial begin
        $readmemh("vectors.mem", vectors);
        repeat (2) @(negedge clk);
        reset = 0;
        @(negedge clk);
        wanted(EXPONENT, 16);
        wanted(STATUS, 32'hB1150002);
        // Invalid accesses are rejected and change nothing.
        cycle(0, VALUE, 0, 15, 1);
        cycle(0, ANGLE, 0, 15, 1);
        cycle(1, VALUE, 7, 15, 1);
        cycle(1, STATUS, 7, 15, 1);
        cycle(1, ANGLE, 7, 4'b1101, 1);
        cycle(1, ANGLE, 7, 4'b1110, 1);
        if (LAMBDA != 0) cycle(1, ANGLE, 7, 4'b1011, 1);
        wanted(STATUS, 32'hB1150002);
        wanted(EXPONENT, 16);
        // Bytes.
        cycle(1, EXPONENT, 32'hFFFFFFFF, 4'b1101, 0);
        wanted(EXPONENT, 32'h0FF);
        cycle(1, EXPONENT, 32'h0000_0200, 4'b0010, 0);
        wanted(EXPONENT, 32'h2FF);
        cycle(1, EXPONENT, 0, 4'b1100, 0);
        wanted(EXPONENT, 32'h2FF);
        for (round = 0; round < 2; round = round + 1) begin
            pause = round == 0;
            for (i = 0; i < COUNT; i = i + 1) begin
                exponent(i);
                angle(i, 0);
                wanted(VALUE, {16'd0, vectors[i][15:0]});
            end
            cycle(0, VALUE, 0, 15, 1);
            // As many as the unit takes, each with its exponent: three if every word has time to reach its place.
            for (first = 0; first < 4; first = first + 1) begin
                inside = 0;
                seen = 2;
                while (seen[1]) begin
                    exponent(first + inside);
                    angle(first + inside, 0);
                    inside = inside + 1;
                    if (first % 2 == 0) begin
                        repeat (30) wanted(EXPONENT, {22'd0, vectors[first + inside - 1][16+WIDTH+:10]});
                        wanted(STATUS, {16'hB115, inside[11:0], 2'd0, inside < 3, 1'b1});
                    end else cycle(0, STATUS, 0, 15, 0);
                    if (seen[15:4] != inside) fail("a wrong count");
                end
                angle(0, 1);
                angle(0, 1);
                if (first % 2 == 0 ? inside != 3 : inside < 3) fail("a unit that takes another number of angles");
                for (i = 0; i < inside; i = i + 1) wanted(VALUE, {16'd0, vectors[first + i][15:0]});
                cycle(0, VALUE, 0, 15, 1);
                wanted(STATUS, 32'hB1150002);
            end
        end
        cyc = 0;
        stb = 0;
        @(negedge clk);
        // A reset drops what is inside, early and late.
        for (round = 0; round < 40; round = round + 3) begin
            exponent(0);
            angle(0, 0);
            angle(0, 0);
            cyc = 0;
            repeat (round) @(negedge clk);
            reset = 1;
            @(negedge clk);
            reset = 0;
            @(negedge clk);
            wanted(STATUS, 32'hB1150002);
            wanted(EXPONENT, 16);
            repeat (30) @(negedge clk);
            cycle(0, VALUE, 0, 15, 1);
            exponent(5);
            angle(5, 0);
            wanted(VALUE, {16'd0, vectors[5][15:0]});
        end
        if (failures == 0) $display("wishbone_tb: passed: %0d cycles, a unit that takes %0d angles at once", cycles, inside);
        $finish;
    end
    initial begin
        #300000 $display("wishbone_tb: cycle %0d hangs: word %0d", cycles, adr);
        $finish;
    end
endmodule
`default_nettype wire
