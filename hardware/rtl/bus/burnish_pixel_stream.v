// burnish_pixel_stream: burnish_pixel between two streams by the AXI4-Stream convention.
//
//     m_color = burnish_pixel(s_normal, s_exponent, s_ambient and the lights), in order, none lost, none repeated
//
// A pixel passes when valid and ready are both 1. s_ready comes from a register, so no combinational path leads from
// m_ready to s_ready. With OUTPUT 0 m_ready drives the clock enable of the whole pixel, thousands of registers; with
// OUTPUT 1 it drives a register of two words at the output alone.
//
// Latency    burnish_pixel's + 1 + OUTPUT
// Throughput one pixel per clock; stalls cost nothing else
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_pixel_stream #(
    parameter LIGHTS = 1, // number of lights, 1 or more
    parameter NORMALIZE = 1, // 1: normal is nearly of unit length; 0: it is of unit length
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
    parameter NARROW = 2, // 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
    parameter HELD = 1, // 1: light, half, diffuse and specular hold still while a pixel is inside; 0: they belong to the word
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter OUTPUT = 1, // 1: a register at the output, which alone sees m_ready
    parameter USER_WIDTH = 1 // width of the user data: a pixel's address, TLAST, TUSER ...
) (
    input wire clk, // rising edge
    input wire reset, // 1: drops all pixels inside; at least one clock after power-up
    input wire s_valid, // a pixel comes
    output wire s_ready, // it is taken; a register
    input wire [47:0] s_normal, // {z, y, x}, Q15, as NORMALIZE says
    input wire [(UNIT == 4 ? 21 : 10)-1:0] s_exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
    input wire [47:0] s_ambient, // {blue, green, red}, UQ1.15 each
    input wire [USER_WIDTH-1:0] s_user, // travels with the pixel
    input wire [48*LIGHTS-1:0] light, // per light, the first lowest: {z, y, x}, Q15, unit vector to the light
    input wire [48*LIGHTS-1:0] half, // per light: {z, y, x}, Q15, unit vector halfway to the viewer
    input wire [48*LIGHTS-1:0] diffuse, // per light: {blue, green, red}, UQ1.15: light times surface
    input wire [48*LIGHTS-1:0] specular, // per light: {blue, green, red}, UQ1.15: light times surface
    output wire m_valid, // a colour is there
    input wire m_ready, // it is taken
    output wire [47:0] m_color, // {blue, green, red}, UQ1.15 each, limited to 0xFFFF
    output wire [USER_WIDTH-1:0] m_user // the pixel's s_user
);
    `include "burnish_latency.vh"
    localparam CONTROL = UNIT == 4 ? 21 : 10;
    localparam LAMPS = HELD != 0 ? 0 : 192 * LIGHTS;
    localparam WORD = 96 + CONTROL + USER_WIDTH;
    wire enable;
    wire [WORD+LAMPS-1:0] arriving, word;
    wire [192*LIGHTS-1:0] lamps;
    wire [47:0] color;
    wire [USER_WIDTH-1:0] user;
    burnish_flow #(.IN(WORD + LAMPS), .OUT(48 + USER_WIDTH), .OUTPUT(OUTPUT),
        .DEPTH(latency_pixel(LIGHTS, NORMALIZE, UNIT, SQUARINGS, NARROW, ROWS, SEGMENT, DSP))) flow (
        .clk(clk), .reset(reset), .s_valid(s_valid), .s_ready(s_ready), .s_word(arriving), .enable(enable),
        .word(word), .result({color, user}), .m_valid(m_valid), .m_ready(m_ready), .m_word({m_color, m_user}));
    generate
        if (HELD != 0) begin : held
            assign arriving = {s_normal, s_exponent, s_ambient, s_user};
            assign lamps = {light, half, diffuse, specular};
        end else begin : moving
            assign arriving = {light, half, diffuse, specular, s_normal, s_exponent, s_ambient, s_user};
            assign lamps = word[WORD+LAMPS-1:WORD];
        end
    endgenerate
    burnish_pixel #(.LIGHTS(LIGHTS), .NORMALIZE(NORMALIZE), .UNIT(UNIT), .SQUARINGS(SQUARINGS), .NARROW(NARROW),
        .HELD(HELD), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) pixel (
        .clk(clk), .enable(enable), .normal(word[WORD-1:WORD-48]), .exponent(word[USER_WIDTH+48+:CONTROL]),
        .ambient(word[USER_WIDTH+:48]), .light(lamps[144*LIGHTS+:48*LIGHTS]), .half(lamps[96*LIGHTS+:48*LIGHTS]),
        .diffuse(lamps[48*LIGHTS+:48*LIGHTS]), .specular(lamps[0+:48*LIGHTS]), .user_in(word[USER_WIDTH-1:0]),
        .color(color), .user_out(user));
endmodule
`default_nettype wire
