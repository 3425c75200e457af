// demo_label: the names of the lobes and the exponent as bitmaps, and the line between the halves.
//
// Latency    4
// Ports      pixel, row  position;  left, right  names of the halves, 0 .. 3;  ink, line  1 where they are
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_label #(
    parameter NAMES = "names.mem",
    parameter EXPONENTS = "exponents.mem"
) (
    input wire clk,
    input wire [9:0] pixel,
    input wire [9:0] row,
    input wire [1:0] left,
    input wire [1:0] right,
    input wire [3:0] exponent_index,
    output reg ink,
    output reg line
);
    // 128 x 16 pixels a name, 64 x 16 an exponent, 16 pixels a word, the left one on top.
    reg [15:0] names[0:511];
    reg [15:0] exponents[0:1023];
    initial begin
        $readmemh(NAMES, names);
        $readmemh(EXPONENTS, exponents);
    end
    reg [9:0] across, from_top;
    reg [1:0] name_1, name_2;
    reg in_label_2, in_label_3, line_1, line_2, line_3, right_2, is_exponent;
    reg [6:0] across_2;
    reg [3:0] bit_3;
    reg [15:0] name_word, exponent_word;
    wire [15:0] word = is_exponent ? exponent_word : name_word;
    always @(posedge clk) begin
        across <= pixel - (pixel < 10'd320 ? 10'd56 : 10'd376);
        from_top <= row - 10'd452;
        name_1 <= pixel < 10'd320 ? left : right;
        line_1 <= pixel == 10'd319 || pixel == 10'd320;

        in_label_2 <= across < 10'd192 && from_top < 10'd16;
        across_2 <= across[6:0];
        name_2 <= name_1;
        right_2 <= across[7];
        line_2 <= line_1;

        name_word <= names[{name_2, from_top[3:0], across_2[6:4]}];
        exponent_word <= exponents[{exponent_index, from_top[3:0], across_2[5:4]}];
        is_exponent <= right_2;
        bit_3 <= ~across_2[3:0];
        in_label_3 <= in_label_2;
        line_3 <= line_2;

        ink <= in_label_3 && word[bit_3];
        line <= line_3;
    end
endmodule
`default_nettype wire
