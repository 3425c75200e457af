// burnish_times: the product of two unsigned numbers, by rows or by the chip's multipliers.
//
//     product = a b
//
// Latency    burnish_product of A_WIDTH rows, with DSP 1; with INPUTS one more
// Throughput one product per clock
// Parameters A_WIDTH, B_WIDTH  bits of the factors;  a selects the rows
//            INPUTS            1: registers for a and b, which a multiplier contains
//            ROWS, SEGMENT     see burnish_product
//            DSP               1: burnish_multiplier
// Ports      a, b read in the same clock; product registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_times #(
    parameter A_WIDTH = 16,
    parameter B_WIDTH = 16,
    parameter INPUTS = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [A_WIDTH-1:0] a,
    input wire [B_WIDTH-1:0] b,
    output wire [A_WIDTH+B_WIDTH-1:0] product
);
    localparam KEEP = A_WIDTH + B_WIDTH;
    generate
        if (DSP != 0) begin : by_chip
            burnish_multiplier #(.A_WIDTH(A_WIDTH), .B_WIDTH(B_WIDTH), .INPUTS(INPUTS)) multiply (
                .clk(clk), .enable(enable), .a(a), .b(b), .addend({KEEP{1'b0}}),
                .product(product));
        end else begin : by_rows
            wire [A_WIDTH-1:0] a_now;
            wire [B_WIDTH-1:0] b_now;
            wire unused_over; // the product is whole
            burnish_delay #(.WIDTH(KEEP), .DEPTH(INPUTS)) line (
                .clk(clk), .enable(enable), .in({a, b}), .out({a_now, b_now}));
            burnish_product #(.SLOPE_WIDTH(A_WIDTH), .U_WIDTH(B_WIDTH), .KEEP(KEEP), .ROWS(ROWS),
                .SEGMENT(SEGMENT)) multiply (
                .clk(clk), .enable(enable), .slope(a_now), .u(b_now), .product(product),
                .over(unused_over));
        end
    endgenerate
endmodule
`default_nettype wire
