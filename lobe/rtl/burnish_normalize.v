// burnish_normalize: a nearly unit vector to unit length.
//
//     e = 1 - v.v,  unit = v (1 + e/2 + 3 e^2/8)
//
// Three terms of the series of 1/sqrt: no root, no division. Bit for bit burnish_q15_normalize_near of
// include/burnish/shade_q15.h, which states the errors. Source: Lyon, Apple TR 43, 1993.
//
// Latency    with DSP 15; others in burnish_latency.vh
// Throughput one vector per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_normalize #(
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0 // 1: multipliers of the chip; 0: rows of adders
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] v, // {z, y, x}, Q15, of squared length 1/2 .. 3/2, such as a normal between vertices
    output wire [47:0] unit // {z, y, x}, Q15, registered
);
    `include "burnish_latency.vh"
    burnish_parameters #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) legal ();
    localparam SQUARE = latency_square(16, ROWS, SEGMENT, DSP);
    localparam ADD16 = latency_add(16, SEGMENT);
    localparam ADD17 = latency_add(17, SEGMENT);
    localparam ADD18 = latency_add(18, SEGMENT);
    localparam ADD32 = latency_add(32, SEGMENT);
    // From the magnitudes to the gain's, and through its product.
    localparam GAIN = 2 * SQUARE + 2 * ADD32 + 2 * ADD18 + 1 + 2 * ADD16 + ADD17;
    localparam SCALE = latency_times(16, 16, ROWS, SEGMENT, DSP) + ADD32;

    // e in 2^-16 is 0x10000 - floor((v.v + 0x1FFF) / 2^14): the rounding is the first square's offset.
    wire [15:0] magnitude[0:2];
    wire [31:0] square[0:2];
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : component
            wire sign = v[16*k+15];
            burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) absolute (
                .clk(clk), .enable(enable), .a(v[16*k+:16] ^ {16{sign}}), .b(16'd0), .carry(sign),
                .sum(magnitude[k]));
            burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) multiply (
                .clk(clk), .enable(enable), .t(magnitude[k]),
                .offset(k == 0 ? 17'h1FFF : 17'd0), .square(square[k]));
        end
    endgenerate
    wire [31:0] xy, z;
    wire [17:0] sum, e, size;
    wire [13:0] unused_low;
    wire e_sign;
    wire [15:0] e_low;
    burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_xy (
        .clk(clk), .enable(enable), .a(square[0]), .b(square[1]), .carry(1'b0), .sum(xy));
    burnish_delay #(.WIDTH(32), .DEPTH(ADD32)) line_z (
        .clk(clk), .enable(enable), .in(square[2]), .out(z));
    burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_z (
        .clk(clk), .enable(enable), .a(xy), .b(z), .carry(1'b0), .sum({sum, unused_low}));
    burnish_add #(.WIDTH(18), .SEGMENT(SEGMENT)) rest (
        .clk(clk), .enable(enable), .a(18'h10000), .b(~sum), .carry(1'b1), .sum(e));
    burnish_delay #(.WIDTH(17), .DEPTH(ADD18)) line_e (
        .clk(clk), .enable(enable), .in({e[17], e[15:0]}), .out({e_sign, e_low}));
    burnish_add #(.WIDTH(18), .SEGMENT(SEGMENT)) absolute (
        .clk(clk), .enable(enable), .a(e ^ {18{e[17]}}), .b(18'd0), .carry(e[17]), .sum(size));

    // Limited to 0x7FFF in magnitude.
    reg [15:0] limited, limited_size;
    wire beyond = size[17:15] != 3'd0;
    always @(posedge clk)
        if (enable) begin
            limited <= !beyond ? e_low : e_sign ? 16'h8001 : 16'h7FFF;
            limited_size <= {1'b0, beyond ? 15'h7FFF : size[14:0]};
        end

    // gain = (e + floor(3 e^2 / 4) + 1) / 2, floor
    wire [15:0] squared, limited_now, gain, gain_size;
    wire [13:0] part;
    wire [1:0] unused_part;
    wire [15:0] unused_square;
    wire unused_half;
    burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) second (
        .clk(clk), .enable(enable), .t(limited_size), .offset(17'd0),
        .square({squared, unused_square}));
    burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) add_twice (
        .clk(clk), .enable(enable), .a(squared), .b({squared[14:0], 1'b0}), .carry(1'b0),
        .sum({part, unused_part}));
    burnish_delay #(.WIDTH(16), .DEPTH(SQUARE + ADD16)) line_limited (
        .clk(clk), .enable(enable), .in(limited), .out(limited_now));
    burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add_gain (
        .clk(clk), .enable(enable), .a({limited_now[15], limited_now}), .b({3'd0, part}),
        .carry(1'b1), .sum({gain, unused_half}));
    burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) absolute_gain (
        .clk(clk), .enable(enable), .a(gain ^ {16{gain[15]}}), .b(16'd0), .carry(gain[15]),
        .sum(gain_size));
    wire gain_sign;
    burnish_delay #(.WIDTH(1), .DEPTH(ADD16)) line_sign (
        .clk(clk), .enable(enable), .in(gain[15]), .out(gain_sign));

    // v + floor((v gain + 0x8000) / 2^16); of a negative product that is -floor((-v gain + 0x7FFF) / 2^16).
    generate
        for (k = 0; k < 3; k = k + 1) begin : scale
            wire [15:0] size_now, v_now, v_late, change, unused_change;
            wire [31:0] product;
            wire negative, product_negative, negative_late;
            wire [16:0] scaled;
            reg [15:0] word;
            wire [15:0] v_early;
            burnish_delay #(.WIDTH(16), .DEPTH(GAIN)) line_early (
                .clk(clk), .enable(enable), .in(v[16*k+:16]), .out(v_early));
            burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) absolute_v (
                .clk(clk), .enable(enable), .a(v_early ^ {16{v_early[15]}}), .b(16'd0),
                .carry(v_early[15]), .sum(size_now));
            burnish_delay #(.WIDTH(16), .DEPTH(ADD16)) line_v (
                .clk(clk), .enable(enable), .in(v_early), .out(v_now));
            assign negative = v_now[15] != gain_sign;
            burnish_times #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) multiply (
                .clk(clk), .enable(enable), .a(gain_size), .b(size_now), .product(product));
            burnish_delay #(.WIDTH(1), .DEPTH(SCALE - ADD32)) line_negative (
                .clk(clk), .enable(enable), .in(negative), .out(product_negative));
            burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) round (
                .clk(clk), .enable(enable), .a(product), .b(32'h7FFF), .carry(!product_negative),
                .sum({change, unused_change}));
            burnish_delay #(.WIDTH(17), .DEPTH(SCALE)) line_late (
                .clk(clk), .enable(enable), .in({negative, v_now}), .out({negative_late, v_late}));
            burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) add (
                .clk(clk), .enable(enable), .a({v_late[15], v_late}),
                .b({1'b0, change} ^ {17{negative_late}}), .carry(negative_late), .sum(scaled));
            // -0x8000 and below become -0x7FFF.
            wire low = scaled[16] && (!scaled[15] || scaled[14:0] == 15'd0);
            always @(posedge clk)
                if (enable)
                    word <= low ? 16'h8001 : !scaled[16] && scaled[15] ? 16'h7FFF : scaled[15:0];
            assign unit[16*k+:16] = word;
        end
    endgenerate
endmodule
`default_nettype wire
