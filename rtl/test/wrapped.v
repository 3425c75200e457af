// wrapped: units as users instantiate them, many with constants, for pair.cpp, which compares each with its netlist.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module wrapped_dot (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(1'b1), .a(word[47:0]), .b(word[95:48]), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_dot_port (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(enable), .a(word[47:0]), .b(word[95:48]), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

// A lamp that stands still.
module wrapped_lamp (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(1'b1), .a(word[47:0]), .b(48'h49E6_49E6_B61A), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_channel (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .lit(word[106]), .color(word[159:112]), .sum_in(word[207:160]),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

module wrapped_channel_port (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(enable), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .lit(word[106]), .color(word[159:112]), .sum_in(word[207:160]),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

// One white light on one material: factors whose leading bits are all 1, or that are a power of two.
module wrapped_white (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .normal(word[47:0]), .half(48'h7FFF_0000_FFFF),
        .exponent(10'd3), .lit(1'b1), .color(48'hFFFF_8000_7FFF), .sum_in(48'd0),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

module wrapped_exponent (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire unused;
    burnish_taylor #(.LAMBDA(1), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .exponent(10'd1023), .angle({8'd0, word[15:0]}),
        .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_slope (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire unused;
    burnish_zeta #(.LAMBDA(1), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .slope(16'hFFFF), .shift(4'd15), .angle(word[23:0]),
        .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

// Products that follow each other without anything between them.
module wrapped_square (
    input wire clk,
    input wire enable,
    input wire [255:0] word,
    output wire [47:0] out
);
    wire [31:0] first;
    burnish_square #(.DSP(1)) once (
        .clk(clk), .enable(1'b1), .t(word[15:0]), .offset(17'd0), .square(first));
    burnish_square #(.DSP(1)) twice (
        .clk(clk), .enable(1'b1), .t(first[31:16]), .offset(17'd0), .square(out[31:0]));
    assign out[47:32] = 16'd0;
endmodule
`default_nettype wire
