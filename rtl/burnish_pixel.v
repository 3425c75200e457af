// burnish_pixel: the whole lighting equation, from an interpolated normal to a pixel's colour.
//
//     color = ambient + sum over lights of diffuse (N.L) + specular S(N.H) where N.L > 0
//
// Bit for bit burnish_q15_shade of include/burnish/shade_q15.h with LIGHTS lights, with NORMALIZE 1 after
// burnish_q15_normalize_near. Half vectors and products of colours are made once per light, by
// burnish_q15_light_create.
//
// Latency    NORMALIZE times burnish_normalize, LIGHTS times burnish_light: with DSP and UNIT 1 15 each
// Throughput one pixel per clock
// Parameters LIGHTS     1 or more
//            NORMALIZE  1: normal is nearly of unit length, 0: it is of unit length
//            UNIT, SQUARINGS, NARROW  as burnish_highlight;  HELD  as burnish_light
//            ROWS, SEGMENT, DSP, USER_WIDTH  as burnish_taylor
// Ports      normal, ambient, color, exponent  as burnish_light's normal, sum_in, sum_out, exponent
//            light, half, diffuse, specular    as burnish_light's, the first light in the lowest 48 bits
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_pixel #(
    parameter LIGHTS = 1,
    parameter NORMALIZE = 1,
    parameter UNIT = 1,
    parameter SQUARINGS = 1,
    parameter NARROW = 2,
    parameter HELD = 1,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0,
    parameter USER_WIDTH = 1
) (
    input wire clk,
    input wire enable,
    input wire [47:0] normal,
    input wire [(UNIT == 4 ? 21 : 10)-1:0] exponent,
    input wire [47:0] ambient,
    input wire [48*LIGHTS-1:0] light,
    input wire [48*LIGHTS-1:0] half,
    input wire [48*LIGHTS-1:0] diffuse,
    input wire [48*LIGHTS-1:0] specular,
    input wire [USER_WIDTH-1:0] user_in,
    output wire [47:0] color,
    output wire [USER_WIDTH-1:0] user_out
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
