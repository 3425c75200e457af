// burnish_composite: cos^n to a third of an 8-bit step, for n from 15 to 1023, by five multiplications.
//
//     v = max(0, top - ((slope (1 - c)) >> 8)),  v = (v v) >> 16,  twice v = (v (v + offset)) >> 16,
//     value = min((v (v + offset)) >> 14, 0xFFFF)
//
// Bit for bit burnish_composite_q15_at_cosine (LAMBDA 1: _at_lambda) of include/burnish/lobe_q15.h; burnish_composite_q15_create
// makes the constants. For n below 15 see burnish_cosine_power.
//
// Latency    11 with DSP; others by latency_composite in burnish_latency.vh
// Throughput one lobe per clock; with HELD 0 the constants may change at every clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_composite #(
    parameter LAMBDA = 0, // 0: angle is the cosine; 1: it is 1 - cosine
    parameter HELD = 0, // 1: slope, top and offset hold still while a value is inside: no delays for them
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [15:0] slope, // UQ8.8
    input wire [15:0] top, // UQ0.16
    input wire [47:0] offset, // {offset[2], offset[1], offset[0]}, UQ0.16 each
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [15:0] value, // UQ0.16
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
        .USER_WIDTH(USER_WIDTH)) legal ();
    localparam U_WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam PRODUCT = 1 + latency_times(16, U_WIDTH, ROWS, SEGMENT, DSP);
    localparam SQUARE = PRODUCT + latency_add(24, SEGMENT) + 1 + latency_square(16, ROWS, SEGMENT, DSP);
    localparam ADD = latency_add(16, SEGMENT);
    localparam STEP = ADD + latency_times(16, 16, ROWS, SEGMENT, DSP);

    // A cosine of 1 or more sets the slope to 0.
    reg [15:0] slope_kept;
    reg [U_WIDTH-1:0] u;
    wire [15+U_WIDTH:0] product;
    wire [23:0] a;
    generate
        if (LAMBDA == 0) begin : cosine
            always @(posedge clk)
                if (enable) begin
                    slope_kept <= angle[15] ? 16'd0 : slope;
                    u <= 16'h8000 - {1'b0, angle[14:0]};
                end
            assign a = product[31:8];
        end else begin : lambda
            always @(posedge clk)
                if (enable) begin
                    slope_kept <= slope;
                    u <= angle;
                end
            assign a = {1'b0, product[39:17]};
        end
    endgenerate
    burnish_times #(.A_WIDTH(16), .B_WIDTH(U_WIDTH), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) multiply (
        .clk(clk), .enable(enable), .a(slope_kept), .b(u), .product(product));

    wire [15:0] top_now;
    burnish_delay #(.WIDTH(16), .DEPTH(HELD != 0 ? 0 : PRODUCT)) top_line (
        .clk(clk), .enable(enable), .in(top), .out(top_now));
    wire [23:0] rest;
    burnish_add #(.WIDTH(24), .SEGMENT(SEGMENT)) subtract (
        .clk(clk), .enable(enable), .a({8'd0, top_now}), .b(~a), .carry(1'b1), .sum(rest));
    reg [15:0] v;
    always @(posedge clk) if (enable) v <= rest[23] ? 16'd0 : rest[15:0];

    wire [31:0] square;
    burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) first (
        .clk(clk), .enable(enable), .t(v), .offset(17'd0), .square(square));
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : step
            wire [15:0] x, x_late, sum, offset_now;
            wire [31:0] next;
            if (k == 0) begin : from_square
                assign x = square[31:16];
            end else begin : from_step
                assign x = step[k-1].next[31:16];
            end
            burnish_delay #(.WIDTH(16), .DEPTH(HELD != 0 ? 0 : SQUARE + k * STEP)) offset_line (
                .clk(clk), .enable(enable), .in(offset[16*k+:16]), .out(offset_now));
            burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) add (
                .clk(clk), .enable(enable), .a(x), .b(offset_now), .carry(1'b0), .sum(sum));
            burnish_delay #(.WIDTH(16), .DEPTH(ADD)) x_line (
                .clk(clk), .enable(enable), .in(x), .out(x_late));
            burnish_times #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) times (
                .clk(clk), .enable(enable), .a(sum), .b(x_late), .product(next));
        end
    endgenerate
    assign value = step[2].next[29:14] | {16{step[2].next[30]}};
    wire unused = &{1'b0, product, rest, square, step[0].next, step[1].next, step[2].next};
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(latency_composite(LAMBDA, ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
