// burnish_axi_lite: the lobe as a peripheral of a processor, on AXI4-Lite.
//
// The registers, resets and refusals are those of burnish_wishbone, which does the work: word k is at the byte address
// 4 k. Its err becomes the response SLVERR.
//
// The two lowest address bits are not read: an unaligned access is one of its word, whose bytes a write chooses by its
// strobes and a read by the lanes that it takes. Reads and writes take turns when both wait. A response that stalls
// holds up the accesses of its own channel only. An access of burnish_wishbone ends within the unit's latency, so no
// channel can wait for the other for ever. AXI does not order a read after a write that has no response yet: a program
// takes the response of ANGLE before it reads VALUE, as device memory does.
//
// Latency    a response three clocks after its request; VALUE waits for the unit's latency + 1
// Throughput an access every three clocks, VALUE's wait aside
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_axi_lite #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor and energy
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: ANGLE is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0 // 1: multipliers of the chip; 0: rows of adders
) (
    input wire aclk, // rising edge
    input wire aresetn, // 0: drops all values inside; at least one clock after power-up
    input wire s_axi_awvalid, // a write's address comes
    output wire s_axi_awready, // it is taken, in the clock in which the data is
    input wire [3:0] s_axi_awaddr, // counts bytes
    input wire [2:0] s_axi_awprot, // not read
    input wire s_axi_wvalid, // a write's data comes
    output wire s_axi_wready, // it is taken
    input wire [31:0] s_axi_wdata, // a register's bits
    input wire [3:0] s_axi_wstrb, // its bytes that are written
    output reg s_axi_bvalid, // a write's response is there
    input wire s_axi_bready, // it is taken
    output wire [1:0] s_axi_bresp, // 0: OKAY; 2: SLVERR, the access can't be done
    input wire s_axi_arvalid, // a read's address comes
    output wire s_axi_arready, // it is taken
    input wire [3:0] s_axi_araddr, // counts bytes
    input wire [2:0] s_axi_arprot, // not read
    output reg s_axi_rvalid, // a read's response is there
    input wire s_axi_rready, // it is taken
    output reg [31:0] s_axi_rdata, // the register
    output wire [1:0] s_axi_rresp // 0: OKAY; 2: SLVERR, the access can't be done
);
    // A request stays at its channel while it is done: it is taken in the clock that ends it.
    reg writing, reading, read_last, write_failed, read_failed;
    wire ack, err;
    wire [31:0] data;
    wire ends = ack || err;
    assign s_axi_awready = writing && ends;
    assign s_axi_wready = writing && ends;
    assign s_axi_arready = reading && ends;
    assign s_axi_bresp = {write_failed, 1'b0};
    assign s_axi_rresp = {read_failed, 1'b0};

    wire can_write = s_axi_awvalid && s_axi_wvalid && (!s_axi_bvalid || s_axi_bready);
    wire can_read = s_axi_arvalid && (!s_axi_rvalid || s_axi_rready);
    wire idle = !writing && !reading;
    always @(posedge aclk)
        if (!aresetn) begin
            writing <= 1'b0;
            reading <= 1'b0;
            read_last <= 1'b0;
            s_axi_bvalid <= 1'b0;
            s_axi_rvalid <= 1'b0;
        end else begin
            if (idle) begin
                writing <= can_write && (read_last || !can_read);
                reading <= can_read && (!read_last || !can_write);
            end else if (ends) begin
                writing <= 1'b0;
                reading <= 1'b0;
                read_last <= reading;
            end
            s_axi_bvalid <= (s_axi_bvalid && !s_axi_bready) || s_axi_wready;
            s_axi_rvalid <= (s_axi_rvalid && !s_axi_rready) || s_axi_arready;
            if (s_axi_wready) write_failed <= err;
            if (s_axi_arready) begin
                read_failed <= err;
                s_axi_rdata <= data;
            end
        end

    burnish_wishbone #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) registers (
        .clk(aclk), .reset(!aresetn), .cyc(!idle), .stb(!idle), .we(writing),
        .adr(writing ? s_axi_awaddr[3:2] : s_axi_araddr[3:2]), .sel(s_axi_wstrb), .dat_w(s_axi_wdata), .dat_r(data),
        .ack(ack), .err(err));
    wire unused = &{1'b0, s_axi_awaddr, s_axi_araddr, s_axi_awprot, s_axi_arprot};

`ifdef FORMAL
    // What hardware/rtl/test/protocol proves: for any peripheral, requests by AXI's rules, stalls and resets.
    reg f_past = 1'b0;
    reg [5:0] f_write_waits = 6'd0, f_read_waits = 6'd0;
    reg [1:0] f_writes = 2'd0, f_reads = 2'd0; // requests that were taken and not yet answered
    always @(posedge aclk) begin
        f_past <= 1'b1;
        if (!f_past) assume (!aresetn);
        if (f_past) begin
            // A master keeps a request until it is taken, and offers none during a reset.
            if (!aresetn) assume (!s_axi_awvalid && !s_axi_wvalid && !s_axi_arvalid);
            if ($past(aresetn && s_axi_awvalid && !s_axi_awready) && aresetn)
                assume (s_axi_awvalid && s_axi_awaddr == $past(s_axi_awaddr));
            if ($past(aresetn && s_axi_wvalid && !s_axi_wready) && aresetn)
                assume (s_axi_wvalid && s_axi_wdata == $past(s_axi_wdata) && s_axi_wstrb == $past(s_axi_wstrb));
            if ($past(aresetn && s_axi_arvalid && !s_axi_arready) && aresetn)
                assume (s_axi_arvalid && s_axi_araddr == $past(s_axi_araddr));
            // A response stays, unchanged, until it is taken.
            if ($past(aresetn && s_axi_bvalid && !s_axi_bready))
                assert (s_axi_bvalid && s_axi_bresp == $past(s_axi_bresp));
            if ($past(aresetn && s_axi_rvalid && !s_axi_rready))
                assert (s_axi_rvalid && s_axi_rresp == $past(s_axi_rresp) && s_axi_rdata == $past(s_axi_rdata));
            // One response per request, an address with its data.
            assert (f_writes == {1'b0, s_axi_bvalid} && f_reads == {1'b0, s_axi_rvalid});
            assert (s_axi_awready == s_axi_wready);
            assert (!aresetn || !s_axi_awready || (s_axi_awvalid && s_axi_wvalid));
            assert (!aresetn || !s_axi_arready || s_axi_arvalid);
            assert (!(writing && reading));
            if ($past(!aresetn)) assert (!s_axi_bvalid && !s_axi_rvalid);
            // An access waits for its own response channel and at most two others, of six clocks each.
            assert (f_write_waits < 6'd14 && f_read_waits < 6'd14);
        end
        f_writes <= !aresetn ? 2'd0 : f_writes + {1'b0, s_axi_wready} - {1'b0, s_axi_bvalid && s_axi_bready};
        f_reads <= !aresetn ? 2'd0 : f_reads + {1'b0, s_axi_arready} - {1'b0, s_axi_rvalid && s_axi_rready};
        f_write_waits <= !aresetn || !can_write || s_axi_wready ? 6'd0 : f_write_waits + 6'd1;
        f_read_waits <= !aresetn || !can_read || s_axi_arready ? 6'd0 : f_read_waits + 6'd1;
    end
`endif
endmodule
`default_nettype wire
