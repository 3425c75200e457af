// burnish_lobe: one of the lobes, chosen by a parameter.
//
// Latency    that of the unit
// Throughput one lobe per clock
// Parameters UNIT       0: burnish_taylor, 1: _shift7, 2: _shift3, 3: _energy, 4: _zeta
//            SQUARINGS  for taylor, energy and zeta;  RESULT .. USER_WIDTH  as burnish_taylor
// Ports      exponent   n, 1 .. 1023; with UNIT 4 {shift, slope}: 4 and 16 bits
//            the others as burnish_taylor
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_lobe #(
    parameter UNIT = 1,
    parameter SQUARINGS = 1,
    parameter RESULT = 16,
    parameter ROUND = 0,
    parameter LAMBDA = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0,
    parameter USER_WIDTH = 1
) (
    input wire clk,
    input wire enable,
    input wire [(UNIT == 4 ? 20 : 10)-1:0] exponent,
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle,
    input wire [USER_WIDTH-1:0] user_in,
    output wire [RESULT-1:0] value,
    output wire [USER_WIDTH-1:0] user_out
);
    generate
        if (UNIT == 0) begin : taylor
            burnish_taylor #(.SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
                .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP),
                .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .user_in(user_in),
                .value(value), .user_out(user_out));
        end else if (UNIT == 1) begin : shift7
            burnish_shift7 #(.RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA), .ROWS(ROWS),
                .SEGMENT(SEGMENT), .DSP(DSP), .USER_WIDTH(USER_WIDTH)) unit (
                .clk(clk), .enable(enable), .exponent(exponent), .angle(angle), .user_in(user_in),
                .value(value), .user_out(user_out));
        end else if (UNIT == 2) begin : shift3
            burnish_shift3 #(.RESULT(RESULT), .ROUND(ROUND), .LAMBDA(LAMBDA), .ROWS(ROWS),
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
