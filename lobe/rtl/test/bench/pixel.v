// pixel: the units from vectors to a pixel side by side, for pixel.cpp. Every result on 48 bits, every unit's user bit,
// or, for units without one, a delay by the latency of burnish_latency.vh.
// ALL 0 leaves out all but burnish_pixel, which then simulates ten times as fast. FREE 0 ties every unit's enable to 1. LIGHTS is
// burnish_pixel's, 1 or 2.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module pixel #(
    parameter ALL = 1,
    parameter FREE = 1,
    parameter LIGHTS = 2,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire user,
    input wire [47:0] a,
    input wire [47:0] b,
    input wire [9:0] exponent,
    input wire narrow,
    input wire [3:0] shift,
    input wire [15:0] slope,
    input wire lit,
    input wire [95:0] light,
    input wire [95:0] half,
    input wire [95:0] diffuse,
    input wire [95:0] specular,
    input wire [47:0] sum,
    output wire [16*48-1:0] values,
    output wire [15:0] users,
    output wire [1:0] lights
);
    `include "burnish_latency.vh"
    wire advance = FREE != 0 ? enable : 1'b1;
    assign lights = LIGHTS;
    burnish_pixel #(.LIGHTS(LIGHTS), .HELD(0), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) whole (
        .clk(clk), .enable(advance), .normal(a), .exponent(exponent), .ambient(sum), 
        .light(light[48*LIGHTS-1:0]), .half(half[48*LIGHTS-1:0]),
        .diffuse(diffuse[48*LIGHTS-1:0]), .specular(specular[48*LIGHTS-1:0]), .user_in(user),
        .color(values[47:0]), .user_out(users[0]));

    genvar k;
    generate
        if (ALL == 0) begin : alone
            assign values[16*48-1:48] = {15 * 48{1'b0}};
            assign users[15:1] = 15'd0;
        end else begin : units
            burnish_dot #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) dot (
                .clk(clk), .enable(advance), .a(a), .b(b), .cosine(values[48+:16]));
            assign values[64+:32] = 32'd0;
            burnish_delay #(.DEPTH(latency_dot(ROWS, SEGMENT, DSP))) user_dot (
                .clk(clk), .enable(advance), .in(user), .out(users[1]));

            burnish_chord #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) chord (
                .clk(clk), .enable(advance), .a(a), .b(b), .lambda(values[96+:24]));
            assign values[120+:24] = 24'd0;
            burnish_delay #(.DEPTH(latency_chord(ROWS, SEGMENT, DSP))) user_chord (
                .clk(clk), .enable(advance), .in(user), .out(users[2]));

            burnish_normalize #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) normalize (
                .clk(clk), .enable(advance), .v(a), .unit(values[144+:48]));
            burnish_delay #(.DEPTH(latency_normalize(ROWS, SEGMENT, DSP))) user_normalize (
                .clk(clk), .enable(advance), .in(user), .out(users[3]));

            burnish_accumulate #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) accumulate (
                .clk(clk), .enable(advance), .factor(diffuse[15:0]), .weight(slope), .sum(sum[15:0]),
                .total(values[192+:16]));
            assign values[208+:32] = 32'd0;
            burnish_delay #(.DEPTH(latency_accumulate(ROWS, SEGMENT, DSP))) user_accumulate (
                .clk(clk), .enable(advance), .in(user), .out(users[4]));

            // taylor, shift7, shift3, energy, then taylor of order 4, energy of 16, cosine only, chord only
            for (k = 0; k < 8; k = k + 1) begin : highlight
                burnish_highlight #(.UNIT(k < 4 ? k : k == 5 ? 3 : 0), .NARROW(k < 6 ? 2 : k - 6),
                    .SQUARINGS(k == 4 ? 2 : k == 5 ? 4 : 1), .ROWS(ROWS), .SEGMENT(SEGMENT),
                    .DSP(DSP)) unit (
                    .clk(clk), .enable(advance), .normal(a), .half(b), .exponent(exponent),
                    .user_in(user), .value(values[48*(5+k)+:16]), .user_out(users[5+k]));
                assign values[48*(5+k)+16+:32] = 32'd0;
            end
            burnish_highlight #(.UNIT(4), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) zeta (
                .clk(clk), .enable(advance), .normal(a), .half(b),
                .exponent({narrow, shift, slope}), .user_in(user), .value(values[48*13+:16]),
                .user_out(users[13]));
            assign values[48*13+16+:32] = 32'd0;

            burnish_channel #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) channel (
                .clk(clk), .enable(advance), .normal(a), .half(b), .exponent(exponent), .lit(lit),
                .color(specular[47:0]), .sum_in(sum), .user_in(user), .sum_out(values[48*14+:48]),
                .user_out(users[14]));
            burnish_light #(.UNIT(4), .SQUARINGS(2), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP))
                one (
                .clk(clk), .enable(advance), .normal(a), .light(light[47:0]), .half(b),
                .exponent({narrow, shift, slope}), .diffuse(diffuse[47:0]),
                .specular(specular[47:0]), .sum_in(sum), .user_in(user),
                .sum_out(values[48*15+:48]), .user_out(users[15]));
        end
    endgenerate
endmodule
