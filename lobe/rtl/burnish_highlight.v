// burnish_highlight: the highlight's lobe at N.H, from vectors.
//
//     value = S(N.H), the angle from the dot product, or for narrow lobes from the chord
//
// Bit for bit burnish_q15_highlight of include/burnish/shade_q15.h, which takes the chord from exponent 32 on, for
// exponents from the order on. C refuses smaller ones above order 2.
//
// The lobe takes 1 - cosine in 24 bits. A cosine of 0 does not fit, so it becomes 1/2 with zeta doubled. That is exact
// from the order on; below, the slope of UNIT 3 can lose a bit, and results differ by a few steps of 2^-16.
//
// Latency    burnish_dot or burnish_chord, burnish_lobe, with NARROW 2 two more; see burnish_latency.vh
// Throughput one per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_highlight #(
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
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [15:0] value, // UQ0.16
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    `include "burnish_latency.vh"
    burnish_parameters #(.SQUARINGS(SQUARINGS), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
        .USER_WIDTH(USER_WIDTH)) legal ();
    localparam CONTROL = UNIT == 4 ? 20 : 10;
    localparam LAMBDA = NARROW != 0 ? 1 : 0;
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam DOT = latency_dot(ROWS, SEGMENT, DSP);
    localparam CHORD = latency_chord(ROWS, SEGMENT, DSP);
    localparam ANGLE = latency_angle(NARROW, ROWS, SEGMENT, DSP);

    wire [WIDTH-1:0] angle;
    wire [CONTROL-1:0] exponent_now;
    wire [USER_WIDTH-1:0] user_now;
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(ANGLE)) user_line (
        .clk(clk), .enable(enable), .in(user_in), .out(user_now));

    generate
        if (NARROW == 0) begin : by_cosine
            burnish_dot #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) dot (
                .clk(clk), .enable(enable), .a(normal), .b(half), .cosine(angle));
            burnish_delay #(.WIDTH(CONTROL), .DEPTH(ANGLE)) line (
                .clk(clk), .enable(enable), .in(exponent[CONTROL-1:0]), .out(exponent_now));
        end else if (NARROW == 1) begin : by_chord
            burnish_chord #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) chord (
                .clk(clk), .enable(enable), .a(normal), .b(half), .lambda(angle));
            burnish_delay #(.WIDTH(CONTROL), .DEPTH(ANGLE)) line (
                .clk(clk), .enable(enable), .in(exponent[CONTROL-1:0]), .out(exponent_now));
        end else if (NARROW == 2) begin : by_either
            wire [15:0] cosine, u, u_now;
            wire [23:0] lambda, lambda_now;
            wire narrow_now;
            wire [CONTROL-1:0] exponent_late, doubled;
            burnish_dot #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) dot (
                .clk(clk), .enable(enable), .a(normal), .b(half), .cosine(cosine));
            burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) subtract (
                .clk(clk), .enable(enable), .a(16'h8000), .b(~cosine), .carry(1'b1), .sum(u));
            burnish_delay #(.WIDTH(16), .DEPTH(ANGLE - 1 - DOT - latency_add(16, SEGMENT))) line_u (
                .clk(clk), .enable(enable), .in(u), .out(u_now));
            burnish_chord #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) chord (
                .clk(clk), .enable(enable), .a(normal), .b(half), .lambda(lambda));
            burnish_delay #(.WIDTH(24), .DEPTH(ANGLE - 1 - CHORD)) line_lambda (
                .clk(clk), .enable(enable), .in(lambda), .out(lambda_now));
            burnish_delay #(.WIDTH(CONTROL), .DEPTH(ANGLE - 1)) line (
                .clk(clk), .enable(enable), .in(exponent[CONTROL-1:0]), .out(exponent_late));
            if (UNIT == 4) begin : slope
                burnish_delay #(.WIDTH(1), .DEPTH(ANGLE - 1)) line_narrow (
                    .clk(clk), .enable(enable), .in(exponent[20]), .out(narrow_now));
                // Half the shift's power, or else twice the slope, limited: a slope above 1 is 0 at a cosine of 0.
                assign doubled = exponent_late[19:16] != 4'd0
                    ? {exponent_late[19:16] - 4'd1, exponent_late[15:0]}
                    : {4'd0, exponent_late[14:0] | {15{exponent_late[15]}}, exponent_late[15]};
            end else begin : n
                assign narrow_now = exponent_late[9:5] != 5'd0;
                // 2 (n + 1) = (2n + 1) + 1
                assign doubled = {exponent_late[8:0], UNIT == 3 ? 1'b1 : 1'b0};
            end
            reg [23:0] angle_kept;
            reg [CONTROL-1:0] exponent_kept;
            always @(posedge clk)
                if (enable) begin
                    angle_kept <= narrow_now ? lambda_now
                        : {u_now[15] | u_now[14], u_now[13:0], 9'd0};
                    exponent_kept <= !narrow_now && u_now[15] ? doubled : exponent_late;
                end
            assign angle = angle_kept;
            assign exponent_now = exponent_kept;
        end else begin : refused
            burnish_parameter_NARROW_must_be_0_1_or_2 refused ();
        end
    endgenerate

    burnish_lobe #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .LAMBDA(LAMBDA), .ROWS(ROWS),
        .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) lobe (
        .clk(clk), .enable(enable), .exponent(exponent_now), .angle(angle), .user_in(user_now),
        .value(value), .user_out(user_out));
endmodule
`default_nettype wire
