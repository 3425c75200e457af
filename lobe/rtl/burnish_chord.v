// burnish_chord: 1 - a.b of two unit vectors as half the square of their distance.
//
//     lambda = |a - b|^2 / 2 = (sum of floor((a_i - b_i)^2 / 4) + 16) >> 5, limited to 0xFFFFFF
//
// The angle of narrow lobes: unlike a dot product it hardly depends on the rounding of the vectors' lengths. Bit for
// bit burnish_q15_chord of include/burnish/shade_q15.h. Source: Lyon, Apple TR 43, 1993.
//
// Latency    with DSP 6; by rows 5 + burnish_square of 16 bits; others in burnish_latency.vh
// Throughput one per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_chord #(
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0 // 1: multipliers of the chip; 0: rows of adders
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [47:0] a, // {z, y, x}, Q15, unit vector
    input wire [47:0] b, // {z, y, x}, Q15, unit vector
    output reg [23:0] lambda // 1 - cosine, UQ0.24, registered
);
    `include "burnish_latency.vh"
    burnish_parameters #(.ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) legal ();
    localparam ADD = latency_add(32, SEGMENT);

    // The rounding, 16 after the shift by 2, is the first square's offset.
    wire [29:0] quarter[0:2];
    genvar k;
    generate
        for (k = 0; k < 3; k = k + 1) begin : component
            wire [15:0] one = a[16*k+:16], other = b[16*k+:16];
            wire [16:0] difference;
            wire [15:0] magnitude;
            wire [1:0] unused_low;
            burnish_add #(.WIDTH(17), .SEGMENT(SEGMENT)) subtract (
                .clk(clk), .enable(enable), .a({one[15], one}), .b(~{other[15], other}),
                .carry(1'b1), .sum(difference));
            burnish_add #(.WIDTH(16), .SEGMENT(SEGMENT)) absolute (
                .clk(clk), .enable(enable), .a(difference[15:0] ^ {16{difference[16]}}),
                .b(16'd0), .carry(difference[16]), .sum(magnitude));
            burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) squarer (
                .clk(clk), .enable(enable), .t(magnitude), .offset(k == 0 ? 17'd64 : 17'd0),
                .square({quarter[k], unused_low}));
        end
    endgenerate

    wire [31:0] xy, z;
    wire [26:0] sum;
    wire [4:0] unused_fraction;
    burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_xy (
        .clk(clk), .enable(enable), .a({2'd0, quarter[0]}), .b({2'd0, quarter[1]}), .carry(1'b0),
        .sum(xy));
    burnish_delay #(.WIDTH(32), .DEPTH(ADD)) line (
        .clk(clk), .enable(enable), .in({2'd0, quarter[2]}), .out(z));
    burnish_add #(.WIDTH(32), .SEGMENT(SEGMENT)) add_z (
        .clk(clk), .enable(enable), .a(xy), .b(z), .carry(1'b0), .sum({sum, unused_fraction}));
    always @(posedge clk) if (enable) lambda <= sum[26:24] != 3'd0 ? 24'hFFFFFF : sum[23:0];
endmodule
`default_nettype wire
