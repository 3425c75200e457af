// wrapped: units as users instantiate them, many with constants, for pair.cpp, which compares each with its netlist.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`define PORTS (input wire clk, input wire enable, input wire [255:0] word, output wire [47:0] out);

module wrapped_dot `PORTS
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(1'b1), .a(word[47:0]), .b(word[95:48]), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_dot_port `PORTS
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(enable), .a(word[47:0]), .b(word[95:48]), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

// A constant vector.
module wrapped_lamp `PORTS
    burnish_dot #(.DSP(1)) unit (
        .clk(clk), .enable(1'b1), .a(word[47:0]), .b(48'h49E6_49E6_B61A), .cosine(out[15:0]));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_channel `PORTS
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .lit(word[106]), .color(word[159:112]), .sum_in(word[207:160]),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

module wrapped_channel_port `PORTS
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(enable), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .lit(word[106]), .color(word[159:112]), .sum_in(word[207:160]),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

// One white light on one material: factors whose leading bits are all 1, or that are a power of two.
module wrapped_white `PORTS
    wire unused;
    burnish_channel #(.NARROW(0), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .normal(word[47:0]), .half(48'h7FFF_0000_FFFF),
        .exponent(10'd3), .lit(1'b1), .color(48'hFFFF_8000_7FFF), .sum_in(48'd0),
        .user_in(1'b0), .sum_out(out), .user_out(unused));
endmodule

module wrapped_exponent `PORTS
    wire unused;
    burnish_taylor #(.LAMBDA(1), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .exponent(10'd1023), .angle({8'd0, word[15:0]}),
        .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_slope `PORTS
    wire unused;
    burnish_zeta #(.LAMBDA(1), .DSP(1)) unit (
        .clk(clk), .enable(1'b1), .slope(16'hFFFF), .shift(4'd15), .angle(word[23:0]),
        .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

// Order 4: one squaring after the other.
module wrapped_order `PORTS
    wire unused;
    burnish_taylor #(.SQUARINGS(2), .DSP(1)) unit (
        .clk(clk), .enable(enable), .exponent(word[105:96]), .angle({1'b0, word[14:0]}),
        .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_chord `PORTS
    burnish_chord #(.DSP(1)) unit (
        .clk(clk), .enable(enable), .a(word[47:0]), .b(word[95:48]), .lambda(out[23:0]));
    assign out[47:24] = 24'd0;
endmodule

module wrapped_normalize `PORTS
    burnish_normalize #(.DSP(1)) unit (.clk(clk), .enable(enable), .v(word[47:0]), .unit(out));
endmodule

module wrapped_highlight `PORTS
    wire unused;
    burnish_highlight #(.UNIT(3), .SQUARINGS(3), .NARROW(1), .DSP(1)) unit (
        .clk(clk), .enable(enable), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .user_in(1'b0), .value(out[15:0]), .user_out(unused));
    assign out[47:16] = 32'd0;
endmodule

module wrapped_light `PORTS
    wire unused;
    burnish_light #(.UNIT(0), .DSP(1)) unit (
        .clk(clk), .enable(enable), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .light(word[153:106]), .diffuse(word[201:154]),
        .specular(word[249:202]), .sum_in(48'h0100_0200_0400), .user_in(1'b0), .sum_out(out),
        .user_out(unused));
endmodule

module wrapped_pixel `PORTS
    wire unused;
    burnish_pixel #(.UNIT(2), .DSP(1)) unit (
        .clk(clk), .enable(enable), .normal(word[47:0]), .half(word[95:48]),
        .exponent(word[105:96]), .light(word[153:106]), .diffuse(word[201:154]),
        .specular(word[249:202]), .ambient(48'h0100_0200_0400), .user_in(1'b0), .color(out),
        .user_out(unused));
endmodule

// Two products without logic between them.
module wrapped_square `PORTS
    wire [31:0] first;
    burnish_square #(.DSP(1)) once (
        .clk(clk), .enable(1'b1), .t(word[15:0]), .offset(17'd0), .square(first));
    burnish_square #(.DSP(1)) twice (
        .clk(clk), .enable(1'b1), .t(first[31:16]), .offset(17'd0), .square(out[31:0]));
    assign out[47:32] = 16'd0;
endmodule
`default_nettype wire
