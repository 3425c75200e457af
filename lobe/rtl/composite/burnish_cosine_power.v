// burnish_cosine_power: cos^n for n from 1 to 15, by squarings and products with the cosine.
//
//     x = n[3] ? c : 1,  then for n[2], n[1] and n[0]: x = (x x) >> 15,  x = (x (bit ? c : 1)) >> 15
//
// Bit for bit burnish_cosine_power_q15 of include/burnish/lobe_q15.h. An exponent of 0 gives 0xFFFF.
//
// Latency    7 with DSP; others by latency_cosine_power in burnish_latency.vh
// Throughput one power per clock; the exponent may change at every clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_cosine_power #(
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [3:0] exponent, // n, 1 .. 15
    input wire [15:0] angle, // cosine UQ1.15, above 0x8000 is 1
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [15:0] value, // UQ0.16
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    localparam SQUARE = latency_square(16, ROWS, SEGMENT, DSP);
    localparam TIMES = latency_times(16, 16, ROWS, SEGMENT, DSP);

    wire [15:0] cosine = angle[15] ? 16'h8000 : angle;
    reg [15:0] start;
    reg [18:0] rest; // the bits of n that are left, and c
    always @(posedge clk)
        if (enable) begin
            start <= exponent[3] ? cosine : 16'h8000;
            rest <= {exponent[2:0], cosine};
        end
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : step
            wire [15:0] x;
            wire [18:0] rest_now, rest_late, rest_next;
            wire [31:0] square, next;
            if (k == 0) begin : first
                assign x = start;
                assign rest_now = rest;
            end else begin : later
                assign x = step[k-1].next[30:15];
                assign rest_now = step[k-1].rest_next;
            end
            burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) squarer (
                .clk(clk), .enable(enable), .t(x), .offset(17'd0), .square(square));
            burnish_delay #(.WIDTH(19), .DEPTH(SQUARE)) line (
                .clk(clk), .enable(enable), .in(rest_now), .out(rest_late));
            burnish_times #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) times (
                .clk(clk), .enable(enable), .a(rest_late[18] ? rest_late[15:0] : 16'h8000), .b(square[30:15]), .product(next));
            burnish_delay #(.WIDTH(19), .DEPTH(TIMES)) line_next (
                .clk(clk), .enable(enable), .in({rest_late[17:16], 1'b0, rest_late[15:0]}), .out(rest_next));
            wire unused = &{1'b0, square, next, rest_next};
        end
    endgenerate
    assign value = {step[2].next[29:15], 1'b0} | {16{step[2].next[30]}};
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(latency_cosine_power(ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
