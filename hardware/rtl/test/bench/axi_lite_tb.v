// axi_lite_tb: burnish_axi_lite against the C core's values (vectors.mem of wrappers.cpp): the register map, strobes,
// unaligned addresses, accesses that must be refused, address and data in any order, responses that stall on each
// channel, reads and writes at the same time, a reset in the middle.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module axi_lite_tb;
    parameter UNIT = 1;
    parameter SQUARINGS = 1;
    parameter RESULT = 16;
    parameter LAMBDA = 0;
    parameter ROWS = 1;
    parameter DSP = 0;
    parameter COUNT = 100;
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam [3:0] EXPONENT = 0, ANGLE = 4, VALUE = 8, STATUS = 12, BYTES = LAMBDA != 0 ? 7 : 3;

    reg [63:0] vectors[0:COUNT-1];
    reg clk = 0, aresetn = 0, awvalid = 0, wvalid = 0, bready = 0, arvalid = 0, rready = 0;
    reg [3:0] awaddr = 0, wstrb = 0, araddr = 0;
    reg [31:0] wdata = 0;
    wire awready, wready, bvalid, arready, rvalid;
    wire [1:0] bresp, rresp;
    wire [31:0] rdata;
    integer failures = 0, writes = 0, reads = 0;

    burnish_axi_lite #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .LAMBDA(LAMBDA), .ROWS(ROWS), .DSP(DSP)) unit (
        .aclk(clk), .aresetn(aresetn), .s_axi_awvalid(awvalid), .s_axi_awready(awready), .s_axi_awaddr(awaddr),
        .s_axi_awprot(3'd0), .s_axi_wvalid(wvalid), .s_axi_wready(wready), .s_axi_wdata(wdata), .s_axi_wstrb(wstrb),
        .s_axi_bvalid(bvalid), .s_axi_bready(bready), .s_axi_bresp(bresp), .s_axi_arvalid(arvalid),
        .s_axi_arready(arready), .s_axi_araddr(araddr), .s_axi_arprot(3'd0), .s_axi_rvalid(rvalid),
        .s_axi_rready(rready), .s_axi_rdata(rdata), .s_axi_rresp(rresp));

    always #5 clk = !clk;

    task fail(input [8*48-1:0] what);
        begin
            failures = failures + 1;
            if (failures == 5) $finish;
            if (failures < 5) $display("axi_lite_tb: write %0d, read %0d: %0s", writes, reads, what);
        end
    endtask

    // What passed at the last edge, and that a response comes after its request and stays until it is taken.
    reg aw_taken = 0, w_taken = 0, b_taken = 0, ar_taken = 0, r_taken = 0, b_held = 0, r_held = 0;
    reg [1:0] b_seen, r_seen;
    reg [31:0] data_seen;
    integer owed_b = 0, owed_r = 0, b_count = 0, r_count = 0;
    always @(posedge clk) begin
        aw_taken <= awvalid && awready;
        w_taken <= wvalid && wready;
        b_taken <= bvalid && bready;
        ar_taken <= arvalid && arready;
        r_taken <= rvalid && rready;
        if (aresetn && b_held && (!bvalid || bresp !== b_seen)) fail("a write's response changed while it waited");
        if (aresetn && r_held && (!rvalid || rresp !== r_seen || rdata !== data_seen)) fail("a read's response changed while it waited");
        b_held <= aresetn && bvalid && !bready;
        r_held <= aresetn && rvalid && !rready;
        if (bvalid) b_seen <= bresp;
        if (rvalid) {r_seen, data_seen} <= {rresp, rdata};
        if (aresetn && bvalid && owed_b == 0) fail("a response to no write");
        if (aresetn && rvalid && owed_r == 0) fail("a response to no read");
        owed_b = aresetn ? owed_b + (wvalid && wready) - (bvalid && bready) : 0;
        owed_r = aresetn ? owed_r + (arvalid && arready) - (rvalid && rready) : 0;
        if (bvalid && bready) b_count = b_count + 1;
        if (rvalid && rready) r_count = r_count + 1;
    end

    // Each side is ready in so many of 8 clocks; requests come up to SKEW - 1 clocks late.
    integer b_rate = 8, r_rate = 8, skew = 1;
    always @(negedge clk) begin
        bready = ($random & 7) < b_rate;
        rready = ($random & 7) < r_rate;
    end

    reg [1:0] write_response, read_response;
    task write(input [3:0] address, input [31:0] data, input [3:0] bytes);
        begin
            fork
                begin
                    repeat ({$random} % skew) @(negedge clk);
                    awvalid = 1;
                    awaddr = address;
                    @(negedge clk);
                    while (!aw_taken) @(negedge clk);
                    awvalid = 0;
                    awaddr = $random;
                end
                begin
                    repeat ({$random} % skew) @(negedge clk);
                    wvalid = 1;
                    wdata = data;
                    wstrb = bytes;
                    @(negedge clk);
                    while (!w_taken) @(negedge clk);
                    wvalid = 0;
                    wdata = $random;
                    wstrb = $random;
                end
            join
            while (!b_taken) @(negedge clk);
            write_response = b_seen;
            writes = writes + 1;
        end
    endtask
    task read(input [3:0] address);
        begin
            repeat ({$random} % skew) @(negedge clk);
            arvalid = 1;
            araddr = address;
            @(negedge clk);
            while (!ar_taken) @(negedge clk);
            arvalid = 0;
            araddr = $random;
            while (!r_taken) @(negedge clk);
            read_response = r_seen;
            reads = reads + 1;
        end
    endtask
    task written(input [3:0] address, input [31:0] data, input [3:0] bytes);
        begin
            write(address, data, bytes);
            if (write_response !== 2'd0) fail("a write is refused");
        end
    endtask
    task unwritten(input [3:0] address, input [31:0] data, input [3:0] bytes);
        begin
            write(address, data, bytes);
            if (write_response !== 2'd2) fail("a write is not refused");
        end
    endtask
    task unread(input [3:0] address);
        begin
            read(address);
            if (read_response !== 2'd2) fail("a read is not refused");
        end
    endtask
    task wanted(input [3:0] address, input [31:0] data);
        begin
            read(address);
            if (read_response !== 2'd0) fail("a read is refused");
            if (data_seen !== data) begin
                fail("another value");
                if (failures < 5) $display("    at %h: expected %h, got %h", address, data, data_seen);
            end
        end
    endtask
    // Bits that the angle lacks are not read.
    task angle(input integer index);
        written(ANGLE, vectors[index][16+:WIDTH] | 32'hA5000000, BYTES);
    endtask
    task exponent(input integer index);
        written(EXPONENT, {22'h2AAAAA, vectors[index][16+WIDTH+:10]}, 15);
    endtask
    task reset(input integer clocks);
        begin
            aresetn = 0;
            repeat (clocks) @(negedge clk);
            aresetn = 1;
            if (bvalid || rvalid) fail("a response after a reset");
        end
    endtask

    integer i, k, round, before, refused;
    reg writer_done;
    initial begin
        $readmemh("vectors.mem", vectors);
        repeat (2) @(negedge clk);
        reset(1);
        for (round = 0; round < 4; round = round + 1) begin
            skew = round == 0 ? 1 : 4;
            b_rate = round == 2 ? 1 : round == 3 ? 4 : 8;
            r_rate = round == 2 ? 1 : round == 3 ? 5 : 8;
            wanted(EXPONENT, 16);
            wanted(STATUS, 32'hB1150002);
            // Accesses that the map lacks are refused and change nothing.
            unread(VALUE);
            unread(ANGLE);
            unwritten(VALUE, 7, 15);
            unwritten(STATUS, 7, 15);
            unwritten(ANGLE, 7, 4'b1101);
            unwritten(ANGLE, 7, 4'b1110);
            if (LAMBDA != 0) unwritten(ANGLE, 7, 4'b1011);
            wanted(STATUS, 32'hB1150002);
            wanted(EXPONENT, 16);
            // Strobes, also at unaligned addresses, whose lowest bits are not read.
            written(EXPONENT, 32'hFFFFFFFF, 4'b1101);
            wanted(EXPONENT, 32'h0FF);
            written(EXPONENT + 1, 32'h0000_0200, 4'b0010);
            wanted(EXPONENT + 1, 32'h2FF);
            written(EXPONENT + 3, 0, 4'b1100);
            wanted(EXPONENT + 2, 32'h2FF);
            written(EXPONENT, 0, 4'b0000);
            wanted(EXPONENT + 3, 32'h2FF);
            wanted(STATUS + 3, 32'hB1150002);
            unread(VALUE + 1);
            written(EXPONENT, 16, 15);
            // One by one; ANGLE at an unaligned address.
            for (i = 0; i < COUNT; i = i + 1) begin
                exponent(i);
                if (i % 2) angle(i);
                else written(ANGLE + 3, vectors[i][16+:WIDTH], BYTES);
                wanted(VALUE + i % 4, {16'd0, vectors[i][15:0]});
            end
            // A writer that is refused while the unit is full, and a reader at the same time that is refused while it is empty.
            refused = 0;
            writer_done = 0;
            fork
                begin
                    for (i = 0; i < COUNT; i = i + 1) begin
                        exponent(i);
                        write(ANGLE, vectors[i][16+:WIDTH], BYTES);
                        while (write_response !== 2'd0) begin
                            refused = refused + 1;
                            write(ANGLE, vectors[i][16+:WIDTH], BYTES);
                        end
                    end
                    writer_done = 1;
                end
                begin
                    repeat (400) @(negedge clk); // until the unit is full
                    k = 0;
                    while (k < COUNT) begin
                        read(VALUE);
                        if (read_response === 2'd0) begin
                            if (data_seen !== {16'd0, vectors[k][15:0]}) fail("a value out of order");
                            k = k + 1;
                        end else if (read_response !== 2'd2) fail("another response");
                    end
                end
            join
            if (refused == 0) fail("a unit that is never full");
            unread(VALUE);
            wanted(STATUS, 32'hB1150002);
            reset(1 + round);
        end
        skew = 1;
        b_rate = 8;
        r_rate = 8;
        two_writes;
        two_reads;
        // Both at once take turns: neither waits for more than one access of the other.
        before = b_count;
        k = r_count;
        fork
            for (i = 0; i < 40; i = i + 1) written(EXPONENT, i + 1, 15);
            repeat (40) begin
                read(EXPONENT);
                if (data_seen !== i && data_seen !== i + 1 && data_seen !== i + 2 && data_seen !== 32'h3FF) fail("neither the old value nor the new");
                if (b_count - before > r_count - k + 2 || r_count - k > b_count - before + 2) fail("one side is preferred");
            end
        join
        // A reset drops what is inside, early and late.
        for (round = 0; round < 40; round = round + 3) begin
            exponent(0);
            angle(0);
            angle(0);
            repeat (round) @(negedge clk);
            reset(1);
            wanted(STATUS, 32'hB1150002);
            wanted(EXPONENT, 16);
            repeat (30) @(negedge clk);
            unread(VALUE);
            exponent(5);
            angle(5);
            wanted(VALUE, {16'd0, vectors[5][15:0]});
        end
        if (failures == 0) $display("axi_lite_tb: passed: %0d writes and %0d reads in %0d ns", writes, reads, $time);
        $finish;
    end
    // Two writes whose responses nobody takes: the second one waits, reads pass. Then both are done.
    task two_writes;
        begin
            b_rate = 0;
            awaddr = EXPONENT;
            wdata = 32'h123;
            wstrb = 15;
            awvalid = 1;
            wvalid = 1;
            @(negedge clk);
            while (!aw_taken) @(negedge clk);
            wdata = 32'h077;
            repeat (20) begin
                wanted(EXPONENT, 32'h123);
                if (!bvalid || !awvalid || awready) fail("a write passes one without a response");
            end
            b_rate = 8;
            while (!aw_taken) @(negedge clk);
            awvalid = 0;
            wvalid = 0;
            while (owed_b != 0) @(negedge clk);
            writes = writes + 2;
        end
    endtask
    // The same for reads: the second one sees what was written while it waited.
    task two_reads;
        begin
            r_rate = 0;
            araddr = EXPONENT;
            arvalid = 1;
            @(negedge clk);
            while (!ar_taken) @(negedge clk);
            repeat (20) begin
                written(EXPONENT, 32'h3FF, 15);
                if (!rvalid || arready || rdata !== 32'h77) fail("a read passes one without a response");
            end
            r_rate = 8;
            while (!ar_taken) @(negedge clk);
            arvalid = 0;
            while (owed_r != 0) @(negedge clk);
            if (data_seen !== 32'h3FF) fail("a read that waited has an old value");
            reads = reads + 2;
        end
    endtask
    initial begin
        #500000 $display("axi_lite_tb: write %0d, read %0d: hangs", writes, reads);
        $finish;
    end
endmodule
`default_nettype wire
