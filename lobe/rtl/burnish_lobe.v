// burnish_lobe: one of the lobes, chosen by a parameter.
//
// Latency    the unit's
// Throughput one lobe per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_lobe #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor, energy and zeta
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: angle is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0, // 1: multipliers of the chip; 0: rows of adders
    parameter USER_WIDTH = 1 // width of user_in and user_out
) (
    input wire clk, // rising edge
    input wire enable, // 1: the pipeline advances; 0: nothing changes
    input wire [(UNIT == 4 ? 20 : 10)-1:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {shift, slope}, 4 and 16 bits
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire [RESULT-1:0] value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
);
    generate
        if (UNIT == 0) begin : taylor
            burnish_taylor #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
                .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
                .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .user_in(user_in),
                .value(value), .user_out(user_out));
        end else if (UNIT == 1 || UNIT == 2) begin : multiple
            burnish_shift #(.FACTOR(UNIT == 1 ? 7 : 3), .SHIFT(UNIT == 1 ? 3 : 2),
                .RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA), .ROWS(ROWS),
                .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .user_in(user_in),
                .value(value), .user_out(user_out));
        end else if (UNIT == 3) begin : energy
            burnish_energy #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
                .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
                .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .user_in(user_in),
                .value(value), .user_out(user_out));
        end else if (UNIT == 4) begin : zeta
            burnish_zeta #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
                .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
                .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .slope(exponent[15:0]), .shift(exponent[19:16]),
                .angle(angle), .user_in(user_in), .value(value), .user_out(user_out));
        end else begin : refused
            burnish_parameter_UNIT_must_be_0_to_4 refused ();
        end
    endgenerate
endmodule
`default_nettype wire
