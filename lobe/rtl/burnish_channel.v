// burnish_channel: a highlight from vectors to the three sums of a pixel.
//
//     out = in + color S(N.H) for red, green and blue where lit, else in; limited to 0xFFFF
//
// color is the light's colour times ks. The bits of burnish_q15_highlight and _accumulate of
// include/burnish/shade_q15.h. burnish_light adds N.L and the diffuse term; this is for a chip with few multipliers
// (with NARROW 0 eight), or for designs that compute them elsewhere. Chain one per light.
//
// Latency    burnish_highlight + burnish_accumulate
// Throughput one pixel per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_channel #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
    parameter NARROW = 2, // 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] normal, // {z, y, x}, Q15, unit vector
    input wire [47:0] half, // {z, y, x}, Q15, unit vector halfway to the viewer
    input wire [(UNIT == 4 ? 21 : 10)-1:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
    input wire lit, // 1 where N.L > 0
    input wire [47:0] color, // {blue, green, red}, UQ1.15: light's colour times surface's
    input wire [47:0] sum_in, // {blue, green, red}, UQ1.15 each
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [47:0] sum_out, // {blue, green, red}, UQ1.15 each, limited to 0xFFFF
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
        .USER_WIDTH(USER_WIDTH)) legal ();
    wire [15:0] value;
    wire lit_now;
    wire [47:0] color_now, sum_now;
    wire [USER_WIDTH-1:0] user_now;
    burnish_highlight #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .NARROW(NARROW), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(97 + USER_WIDTH)) highlight (
        .clk(clk), .enable(enable), .normal(normal), .half(half), .exponent(exponent),
        .user_in({lit, color, sum_in, user_in}), .value(value),
        .user_out({lit_now, color_now, sum_now, user_now}));

    wire [15:0] weight = lit_now ? value : 16'd0;
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : channel
            burnish_accumulate #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) add (
                .clk(clk), .enable(enable), .factor(color_now[16*k+:16]), .weight(weight),
                .sum(sum_now[16*k+:16]), .total(sum_out[16*k+:16]));
        end
    endgenerate
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(latency_accumulate(ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_now), .out(user_out));
endmodule
`default_nettype wire
