// burnish_light: what one light adds to a pixel.
//
//     out = in + diffuse (N.L) + specular S(N.H) where N.L > 0, else in; limited to 0xFFFF at every term
//
// Bit for bit one turn of the loop in burnish_q15_shade of include/burnish/shade_q15.h, for the exponents that it takes.
//
// Latency    with DSP, UNIT 1 and NARROW 2 15; others in burnish_latency.vh
// Throughput one pixel per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_light #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4
    parameter NARROW = 2, // 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
    parameter HELD = 0, // 1: light, half, diffuse and specular hold still while a pixel is inside: no delays for them
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] normal, // {z, y, x}, Q15, unit vector
    input wire [47:0] light, // {z, y, x}, Q15, unit vector to the light
    input wire [47:0] half, // {z, y, x}, Q15, unit vector halfway to the viewer
    input wire [(UNIT == 4 ? 21 : 10)-1:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
    input wire [47:0] diffuse, // {blue, green, red}, UQ1.15: light's colour times surface's
    input wire [47:0] specular, // {blue, green, red}, UQ1.15: light's colour times surface's
    input wire [47:0] sum_in, // {blue, green, red}, UQ1.15 each
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [47:0] sum_out, // {blue, green, red}, UQ1.15 each, limited to 0xFFFF
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
        .USER_WIDTH(USER_WIDTH)) legal ();
    localparam DOT = latency_dot(ROWS, SEGMENT, DSP);
    localparam HIGHLIGHT = latency_highlight(UNIT, SQUARINGS, NARROW, ROWS, SEGMENT, DSP);
    localparam DIFFUSE = latency_light_diffuse(ROWS, SEGMENT, DSP);
    localparam SPECULAR = latency_light_specular(UNIT, SQUARINGS, NARROW, ROWS, SEGMENT, DSP);

    // The weights: N.L in UQ0.16, 1 limited to 0xFFFF; the lobe where N.L > 0.
    wire [15:0] n_dot_l, value, lobe;
    wire [15:0] weight = n_dot_l[15] ? 16'hFFFF : {n_dot_l[14:0], 1'b0};
    wire lit;
    wire [USER_WIDTH-1:0] user_now;
    burnish_dot #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) dot (
        .clk(clk), .enable(enable), .a(normal), .b(light), .cosine(n_dot_l));
    burnish_delay #(.WIDTH(1), .DEPTH(HIGHLIGHT - DOT)) line_lit (
        .clk(clk), .enable(enable), .in(n_dot_l != 16'd0), .out(lit));
    burnish_highlight #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .NARROW(NARROW), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) highlight (
        .clk(clk), .enable(enable), .normal(normal), .half(half), .exponent(exponent),
        .user_in(user_in), .value(value), .user_out(user_now));
    burnish_delay #(.WIDTH(16), .DEPTH(SPECULAR - HIGHLIGHT)) line_lobe (
        .clk(clk), .enable(enable), .in(lit ? value : 16'd0), .out(lobe));

    wire [47:0] diffuse_now, specular_now, sum_now, sum_lit, sum_late;
    burnish_delay #(.WIDTH(48), .DEPTH(HELD != 0 ? 0 : DOT)) line_diffuse (
        .clk(clk), .enable(enable), .in(diffuse), .out(diffuse_now));
    burnish_delay #(.WIDTH(48), .DEPTH(DOT)) line_sum (
        .clk(clk), .enable(enable), .in(sum_in), .out(sum_now));
    burnish_delay #(.WIDTH(48), .DEPTH(HELD != 0 ? 0 : SPECULAR)) line_specular (
        .clk(clk), .enable(enable), .in(specular), .out(specular_now));
    burnish_delay #(.WIDTH(48), .DEPTH(SPECULAR - DIFFUSE)) line_late (
        .clk(clk), .enable(enable), .in(sum_lit), .out(sum_late));
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : channel
            burnish_accumulate #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) add_diffuse (
                .clk(clk), .enable(enable), .factor(diffuse_now[16*k+:16]), .weight(weight),
                .sum(sum_now[16*k+:16]), .total(sum_lit[16*k+:16]));
            burnish_accumulate #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) add_specular (
                .clk(clk), .enable(enable), .factor(specular_now[16*k+:16]), .weight(lobe),
                .sum(sum_late[16*k+:16]), .total(sum_out[16*k+:16]));
        end
    endgenerate
    burnish_delay #(.WIDTH(USER_WIDTH),
        .DEPTH(SPECULAR - HIGHLIGHT + latency_accumulate(ROWS, SEGMENT, DSP))) user (
        .clk(clk), .enable(enable), .in(user_now), .out(user_out));
endmodule
`default_nettype wire
