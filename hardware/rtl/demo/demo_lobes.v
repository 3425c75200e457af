// demo_lobes: five highlights side by side, of which one is shown.
//
//     0 burnish_shift7, W_0.5    1 cos^n by tables    2 Schlick by reciprocals    3 burnish_taylor, W    4 order 4
//
// burnish's lobes are built from rows; the other two take five multipliers and five memories. RESULT 8 of all.
//
// Latency    17: order 4 and one clock
// Throughput one pixel per clock
// Ports      exponent  n, 1 .. 1023;  choice  0 .. 4, may change with every pixel and is read with the value
//            cosine    UQ1.15;  value  UQ0.8
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_lobes (
    input wire clk,
    input wire [9:0] exponent,
    input wire [15:0] cosine,
    input wire [2:0] choice,
    output reg [7:0] value
);
    `include "burnish_latency.vh"
    localparam ROWS = 3;
    localparam DEPTH = latency_lobe(0, 2, 8, 0, ROWS, 0, 0);
    localparam ORDER2 = latency_lobe(1, 1, 8, 0, ROWS, 0, 0);
    wire [7:0] shift7, taylor, taylor4, schlick, power;
    wire [7:0] shift7_now, taylor_now, schlick_now, power_now;
    wire [4:0] unused_user;
    burnish_shift7 #(.RESULT(8), .ROWS(ROWS)) lobe_shift7 (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(shift7), .user_out(unused_user[0]));
    power_tables lobe_power (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(power), .user_out(unused_user[1]));
    schlick_rom lobe_schlick (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(schlick), .user_out(unused_user[2]));
    burnish_taylor #(.RESULT(8), .ROWS(ROWS)) lobe_taylor (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(taylor), .user_out(unused_user[3]));
    burnish_taylor #(.SQUARINGS(2), .RESULT(8), .ROWS(ROWS)) lobe_taylor4 (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(1'b0),
        .value(taylor4), .user_out(unused_user[4]));
    burnish_delay #(.WIDTH(16), .DEPTH(DEPTH - ORDER2)) wait_order2 (
        .clk(clk), .enable(1'b1), .in({shift7, taylor}), .out({shift7_now, taylor_now}));
    burnish_delay #(.WIDTH(8), .DEPTH(DEPTH - 10)) wait_power (
        .clk(clk), .enable(1'b1), .in(power), .out(power_now));
    burnish_delay #(.WIDTH(8), .DEPTH(DEPTH - 9)) wait_schlick (
        .clk(clk), .enable(1'b1), .in(schlick), .out(schlick_now));
    always @(posedge clk)
        case (choice)
            3'd0: value <= shift7_now;
            3'd1: value <= power_now;
            3'd2: value <= schlick_now;
            3'd3: value <= taylor_now;
            default: value <= taylor4;
        endcase
endmodule
`default_nettype wire
