// demo_dither: 8 bits a channel to 4 by an ordered matrix of 4 x 4.
//
//     out = floor((v - floor(v / 16) + d) / 16),  d = 0 .. 15 by position: a code that 4 bits can show stays as it is
//
// Latency 1, also of control. Throughput one pixel per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_dither (
    input wire clk,
    input wire [7:0] red,
    input wire [7:0] green,
    input wire [7:0] blue,
    input wire [1:0] column,
    input wire [1:0] row,
    input wire [2:0] control,
    output reg [11:0] color,
    output reg [2:0] control_out
);
    // Bayer's matrix: the bits of column ^ row and of row, reversed and interleaved.
    wire [1:0] mixed = column ^ row;
    wire [3:0] threshold = {mixed[0], row[0], mixed[1], row[1]};
    function [3:0] short_of(input [7:0] value, input [3:0] above);
        reg [7:0] sum;
        reg [3:0] unused;
        begin
            sum = value - {4'd0, value[7:4]} + {4'd0, above};
            {short_of, unused} = sum;
        end
    endfunction
    always @(posedge clk) begin
        color <= {short_of(red, threshold), short_of(green, threshold), short_of(blue, threshold)};
        control_out <= control;
    end
endmodule
`default_nettype wire
