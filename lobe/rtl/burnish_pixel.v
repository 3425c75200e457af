// burnish_pixel: the whole lighting equation, from an interpolated normal to a pixel's colour.
//
//     color = ambient + sum over lights of diffuse (N.L) + specular S(N.H) where N.L > 0
//
// Bit for bit burnish_q15_shade of include/burnish/shade_q15.h with LIGHTS lights, with NORMALIZE 1 after
// burnish_q15_normalize_near, for exponents that C takes: above order 2 from the order on. Half vectors and products of
// colours are made once per light, by burnish_q15_light_create.
//
// Latency    NORMALIZE times burnish_normalize, LIGHTS times burnish_light: with DSP and UNIT 1 15 each
// Throughput one pixel per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_pixel #(
    parameter LIGHTS = 1, // number of lights, 1 or more
    parameter NORMALIZE = 1, // 1: normal is nearly of unit length; 0: it is of unit length
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
    parameter NARROW = 2, // 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
    parameter HELD = 1, // 1: light, half, diffuse and specular hold still while a pixel is inside: no delays for them
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] normal, // {z, y, x}, Q15, as NORMALIZE says
    input wire [(UNIT == 4 ? 21 : 10)-1:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
    input wire [47:0] ambient, // {blue, green, red}, UQ1.15 each
    input wire [48*LIGHTS-1:0] light, // per light, the first lowest: {z, y, x}, Q15, unit vector to the light
    input wire [48*LIGHTS-1:0] half, // per light: {z, y, x}, Q15, unit vector halfway to the viewer
    input wire [48*LIGHTS-1:0] diffuse, // per light: {blue, green, red}, UQ1.15: light times surface
    input wire [48*LIGHTS-1:0] specular, // per light: {blue, green, red}, UQ1.15: light times surface
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [47:0] color, // {blue, green, red}, UQ1.15 each, limited to 0xFFFF
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
        .USER_WIDTH(USER_WIDTH)) legal ();
    localparam CONTROL = UNIT == 4 ? 21 : 10;
    localparam LAST = LIGHTS < 1 ? 0 : LIGHTS - 1;
    localparam AHEAD = NORMALIZE != 0 ? latency_normalize(ROWS, SEGMENT, DSP) : 0;
    localparam LIGHT = latency_light(UNIT, SQUARINGS, NARROW, ROWS, SEGMENT, DSP);

    genvar k;
    generate
        if (LIGHTS < 1) begin : refused
            burnish_parameter_LIGHTS_must_be_1_or_more refused ();
        end
        for (k = 0; k <= LAST; k = k + 1) begin : at
            wire [47:0] normal_now, sum_now, sum;
            wire [CONTROL-1:0] exponent_now;
            wire [USER_WIDTH-1:0] user_now, user;
            if (k == 0) begin : first
                if (NORMALIZE != 0) begin : nearly
                    burnish_normalize #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) normalize (
                        .clk(clk), .enable(enable), .v(normal), .unit(normal_now));
                end else begin : unit
                    assign normal_now = normal;
                end
                burnish_delay #(.WIDTH(CONTROL + 48 + USER_WIDTH), .DEPTH(AHEAD)) line (
                    .clk(clk), .enable(enable), .in({exponent, ambient, user_in}),
                    .out({exponent_now, sum_now, user_now}));
            end else begin : next
                burnish_delay #(.WIDTH(48 + CONTROL), .DEPTH(LIGHT)) line (
                    .clk(clk), .enable(enable),
                    .in({at[k-1].normal_now, at[k-1].exponent_now}),
                    .out({normal_now, exponent_now}));
                assign sum_now = at[k-1].sum;
                assign user_now = at[k-1].user;
            end
            wire [191:0] lamp;
            burnish_delay #(.WIDTH(192), .DEPTH(HELD != 0 ? 0 : AHEAD + k * LIGHT)) wait_here (
                .clk(clk), .enable(enable),
                .in({light[48*k+:48], half[48*k+:48], diffuse[48*k+:48], specular[48*k+:48]}),
                .out(lamp));
            burnish_light #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .NARROW(NARROW), .HELD(HELD),
                .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) add (
                .clk(clk), .enable(enable), .normal(normal_now), .light(lamp[191:144]),
                .half(lamp[143:96]), .exponent(exponent_now), .diffuse(lamp[95:48]),
                .specular(lamp[47:0]), .sum_in(sum_now), .user_in(user_now), .sum_out(sum),
                .user_out(user));
        end
    endgenerate
    assign color = at[LAST].sum;
    assign user_out = at[LAST].user;
endmodule
`default_nettype wire
