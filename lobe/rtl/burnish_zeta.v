// burnish_zeta: the lobe of any zeta.
//
//     S = max(0, 1 - zeta (1 - c))^order,  2 zeta = slope / 2^shift,  order = 2^SQUARINGS
//
// Bit for bit burnish_lobe_q15_fast (ROUND 1: _near; RESULT 8: _fast8) of include/burnish/lobe_q15.h,
// which also makes slope and shift from a fit or a zeta.
//
// Latency    5 + burnish_product of 16 bits (DSP: 1) + burnish_power
// Throughput one lobe per clock; slope and shift may change at every clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_zeta #(
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: angle is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [15:0] slope, // 2 zeta = slope / 2^shift
    input wire [3:0] shift, // 0 .. 15
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [RESULT-1:0] value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA),
        .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) legal ();
    localparam U_WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam KEEP = 16 + U_WIDTH;
    localparam MULTIPLY = DSP != 0 ? 1 : latency_rows(16, KEEP, ROWS, SEGMENT);

    // A cosine of 1 or more sets the slope to 0.
    reg [15:0] slope_kept;
    reg [U_WIDTH-1:0] u;
    wire [KEEP-1:0] product;
    wire [31:0] w;
    generate
        if (LAMBDA == 0) begin : cosine
            always @(posedge clk)
                if (enable) begin
                    slope_kept <= angle[15] ? 16'd0 : slope;
                    u <= 16'h8000 - {1'b0, angle[14:0]};
                end
            assign w = product;
        end else begin : lambda
            always @(posedge clk)
                if (enable) begin
                    slope_kept <= slope;
                    u <= angle;
                end
            assign w = {1'b0, product[KEEP-1:9]};
            wire unused = &{1'b0, product};
        end

        if (DSP != 0) begin : dsp
            burnish_multiplier #(.A_WIDTH(16), .B_WIDTH(U_WIDTH)) multiply (
                .clk(clk), .enable(enable), .a(slope_kept), .b(u), .addend({KEEP{1'b0}}),
                .product(product));
        end else begin : rows
            wire unused_over; /* the product is kept whole */
            burnish_product #(.SLOPE_WIDTH(16), .U_WIDTH(U_WIDTH), .KEEP(KEEP), .ROWS(ROWS),
                .SEGMENT(SEGMENT)) multiply (
                .clk(clk), .enable(enable), .slope(slope_kept), .u(u), .product(product),
                .over(unused_over));
        end
    endgenerate

    // a = w >> shift, two bits of the shift per clock; then the test for zero.
    wire [3:0] shift_now;
    burnish_delay #(.WIDTH(4), .DEPTH(1 + MULTIPLY)) shift_line (
        .clk(clk), .enable(enable), .in(shift), .out(shift_now));
    reg [31:0] coarse, fine;
    reg [1:0] shift_kept;
    reg over_kept;
    reg [15:0] near_t, t;
    wire [31:0] by_eight = shift_now[3] ? w >> 8 : w;
    wire [31:0] by_two = shift_kept[1] ? coarse >> 2 : coarse;
    always @(posedge clk)
        if (enable) begin
            coarse <= shift_now[2] ? by_eight >> 4 : by_eight;
            shift_kept <= shift_now[1:0];
            fine <= shift_kept[0] ? by_two >> 1 : by_two;
            over_kept <= |fine[31:16];
            near_t <= ~fine[15:0];
            t <= over_kept ? 16'd0 : near_t;
        end

    burnish_power #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP)) power (
        .clk(clk), .enable(enable), .t(t), .value(value));
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(latency_zeta(LAMBDA, ROWS, SEGMENT, DSP) +
        latency_power(SQUARINGS, RESULT, ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
