// properties: each property is one bit that must be 0 for every input. For the SAT solver the units'
// registers become wires (see prove): without feedback a pipeline is a function of its inputs.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors

// For a cosine of 1 and above a lobe is 0xFFFE; where zeta (1 - c) reaches 1 it is 0.
module property_taylor (
    input wire clk,
    input wire [9:0] exponent,
    input wire [15:0] angle,
    output wire bad
);
    wire [15:0] value;
    wire user;
    burnish_taylor unit (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(angle), .user_in(1'b0),
        .value(value), .user_out(user));
    wire one = angle >= 16'h8000;
    // zeta (1 - c) >= 1 for every exponent from 2 on where c = 0, and for 1023 where 1 - c >= 65.
    wire far = (angle == 16'h0000 && exponent >= 10'd2) ||
        (exponent == 10'd1023 && angle <= 16'h8000 - 16'd65) ||
        (exponent[9] && angle <= 16'h8000 - 16'd128) || (exponent[9:4] != 0 && angle <= 16'h7000);
    assign bad = (one && value != 16'hFFFE) || (far && value != 16'd0);
endmodule

module property_shift7 (
    input wire clk,
    input wire [9:0] exponent,
    input wire [15:0] angle,
    output wire bad
);
    wire [15:0] value;
    wire user;
    burnish_shift unit (
        .clk(clk), .enable(1'b1), .exponent(exponent), .angle(angle), .user_in(1'b0),
        .value(value), .user_out(user));
    wire one = angle >= 16'h8000;
    // 7 n (1 - c) / 16 >= 1
    wire far = (angle == 16'h0000 && exponent >= 10'd3) ||
        (exponent == 10'd1023 && angle <= 16'h8000 - 16'd74) ||
        (exponent[9] && angle <= 16'h8000 - 16'd147) || (exponent[9:4] != 0 && angle <= 16'h6DB0);
    assign bad = (one && value != 16'hFFFE) || (far && value != 16'd0);
endmodule

// The folded squarer is t t, whatever its registers and segments.
module property_square (
    input wire clk,
    input wire [15:0] t,
    output wire bad
);
    wire [31:0] square;
    burnish_square unit (
        .clk(clk), .enable(1'b1), .t(t), .offset(17'd0), .square(square));
    wire [31:0] product = t * t;
    assign bad = square != product;
endmodule

module property_square_segments (
    input wire clk,
    input wire [15:0] t,
    output wire bad
);
    wire [31:0] square, other;
    burnish_square #(.SEGMENT(6)) unit (
        .clk(clk), .enable(1'b1), .t(t), .offset(17'd0), .square(square));
    burnish_square #(.ROWS(2)) same (
        .clk(clk), .enable(1'b1), .t(t), .offset(17'd0), .square(other));
    assign bad = square != other;
endmodule

// The energy slope's reciprocal is the rounded division, for every exponent.
module property_energy_slope (
    input wire clk,
    input wire [9:0] exponent,
    output wire bad
);
    wire [15:0] slope;
    wire [3:0] shift;
    burnish_energy_slope unit (
        .clk(clk), .enable(1'b1), .exponent(exponent), .slope(slope), .shift(shift));
    // |3 slope - 2 (n + 1) 2^shift| <= 1, the nearest, and 16 significant bits.
    wire signed [31:0] left = 3 * {16'd0, slope};
    wire signed [31:0] right = {20'd0, {1'b0, exponent} + 11'd1, 1'b0} << shift;
    wire signed [31:0] rest = left - right;
    assign bad = exponent != 0 && (rest > 1 || rest < -1 || !slope[15]);
endmodule

// The dark composite, whose top is 0, is 0 for every other constant and angle.
module property_composite (
    input wire clk,
    input wire [15:0] slope,
    input wire [47:0] offset,
    input wire [15:0] angle,
    output wire bad
);
    wire [15:0] value;
    wire user;
    burnish_composite unit (
        .clk(clk), .enable(1'b1), .slope(slope), .top(16'd0), .offset(offset), .angle(angle), .user_in(1'b0),
        .value(value), .user_out(user));
    assign bad = value != 16'd0;
endmodule
