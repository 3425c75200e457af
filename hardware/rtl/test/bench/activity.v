// activity: a lobe, and the same lobe behind the boundary memory, side by side for activity.cpp.
// Memories of the current folder: zero.mem (--bits=0), level.mem (--bits=8), both --lambda; cosine.mem (--bits=8).
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module activity #(
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire [9:0] exponent,
    input wire [15:0] cosine,
    input wire [23:0] lambda,
    input wire user,
    output wire [2:0] busy, // zero, level, by_cosine
    output wire [63:0] values,
    output wire [3:0] users
);
    burnish_lobe #(.LAMBDA(1), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) plain (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(lambda), .user_in(user),
        .value(values[15:0]), .user_out(users[0]));
    burnish_boundary #(.FILE("zero.mem"), .LAMBDA(1), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) zero (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(lambda), .user_in(user),
        .busy(busy[0]), .value(values[31:16]), .user_out(users[1]));
    burnish_boundary #(.FILE("level.mem"), .LAMBDA(1), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) level (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(lambda), .user_in(user),
        .busy(busy[1]), .value(values[47:32]), .user_out(users[2]));
    burnish_boundary #(.FILE("cosine.mem"), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) by_cosine (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(cosine), .user_in(user),
        .busy(busy[2]), .value(values[63:48]), .user_out(users[3]));
endmodule
