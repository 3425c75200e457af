// demo_lobes: four highlights side by side, of which one is shown.
//
//     0 burnish_shift7, W_0.5    1 Schlick by reciprocals    2 burnish_taylor, W    3 order 4
//
// burnish's lobes are built from rows; Schlick's takes two multipliers and a memory. RESULT 8 of all.
//
// Latency    17: order 4 and one clock
// Throughput one pixel per clock
// Ports      exponent  n, 1 .. 1023;  choice  0 .. 3, may change with every pixel and is read with the value
//            cosine    UQ1.15;  value  UQ0.8
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_lobes (
    input wire clk,
    input wire [9:0] exponent,
    input wire [15:0] cosine,
    input wire [1:0] choice,
    output reg [7:0] value
);
    `include "burnish_latency.vh"
    localparam ROWS = 3;
    localparam DEPTH = latency_lobe(0, 2, 8, 0, ROWS, 0, 0);
    localparam ORDER2 = latency_lobe(1, 1, 8, 0, ROWS, 0, 0);
    wire [7:0] shift7, taylor, taylor4, schlick;
    wire [7:0] shift7_now, taylor_now, schlick_now;
    wire [3:0] unused_user;
    burnish_shift7 #(.RESULT(8), .ROWS(ROWS)) lobe_shift7 (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(shift7), .user_out(unused_user[0]));
    schlick_rom lobe_schlick (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(schlick), .user_out(unused_user[1]));
    burnish_taylor #(.RESULT(8), .ROWS(ROWS)) lobe_taylor (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(taylor), .user_out(unused_user[2]));
    burnish_taylor #(.SQUARINGS(2), .RESULT(8), .ROWS(ROWS)) lobe_taylor4 (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(taylor4), .user_out(unused_user[3]));
    burnish_delay #(.WIDTH(16), .DEPTH(DEPTH - ORDER2)) wait_order2 (
        .clk(clk), .enable(1'b1), .in({shift7, taylor}), .out({shift7_now, taylor_now}));
    burnish_delay #(.WIDTH(8), .DEPTH(DEPTH - 9)) wait_schlick (
        .clk(clk), .enable(1'b1), .in(schlick), .out(schlick_now));
    always @(posedge clk)
        case (choice)
            2'd0: value <= shift7_now;
            2'd1: value <= schlick_now;
            2'd2: value <= taylor_now;
            default: value <= taylor4;
        endcase
endmodule
`default_nettype wire
