// burnish_boundary: a lobe that stands still where the boundary memory says that nothing is to be seen.
//
//     value = dark ? 0 : lobe
//     dark: cosine <= word, unless word is 0 (LAMBDA 0); 1 - cosine > word (LAMBDA 1)
//
// The memory has a word per exponent, as `burnish lobe boundary --as=mem` writes it: with --bits=0 no result changes,
// with a threshold values below it become 0. Bit for bit burnish_lobe_q15_fast after burnish_lobe_q15_set_boundary of
// include/burnish/lobe_q15.h.
//
// A dark pixel doesn't enter the lobe: the registers at its input keep the pixel before. While no pixel inside is lit
// the lobe's enable is 0, so that none of its registers is clocked.
//
// Latency    burnish_lobe + 2
// Throughput one lobe per clock
// Parameters FILE       the memory's file, with words from exponent 1 on; empty: no boundary
//                       LAMBDA 0: --exponents=1-1023 --format-word=UQ0.15
//                       LAMBDA 1: --exponents=1-1023 --lambda --format-word=UQ0.24
//            UNIT       0 .. 3, see burnish_lobe;  the others as burnish_lobe
// Ports      busy  1: the lobe's registers are clocked;  value passes one gate after its register
//            the others as burnish_lobe
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_boundary #(
    parameter FILE = "",
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
    input wire [9:0] exponent,
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle,
    input wire [USER_WIDTH-1:0] user_in,
    output wire busy,
    output wire [RESULT-1:0] value,
    output wire [USER_WIDTH-1:0] user_out
);
    `include "burnish_latency.vh"
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam WORD = LAMBDA != 0 ? 24 : 15;
    localparam DEPTH = latency_lobe(UNIT, SQUARINGS, RESULT, LAMBDA, ROWS, SEGMENT, DSP);
    generate
        if (UNIT > 3) begin : refused
            burnish_parameter_UNIT_must_be_0_to_3 refused ();
        end
    endgenerate

    // The word of exponent 1 is the first.
    reg [WORD-1:0] memory[0:1023];
    reg [WORD-1:0] word;
    reg [9:0] exponent_now;
    reg [WIDTH-1:0] angle_now;
    wire [9:0] address = exponent - 10'd1;
    generate
        if (FILE != "") begin : file
            initial $readmemh(FILE, memory, 0, 1022);
        end else begin : nothing
            integer i;
            initial for (i = 0; i < 1024; i = i + 1) memory[i] = LAMBDA != 0 ? ~{WORD{1'b0}} : {WORD{1'b0}};
        end
    endgenerate
    always @(posedge clk)
        if (enable) begin
            word <= memory[address];
            exponent_now <= exponent;
            angle_now <= angle;
        end
    wire dark;
    generate
        if (LAMBDA != 0) begin : by_lambda
            assign dark = angle_now > word;
        end else begin : by_cosine
            assign dark = angle_now <= {1'b0, word} && word != 15'd0;
        end
    endgenerate

    // lit[k]: the pixel k clocks after the lobe's input is lit.
    reg [9:0] exponent_kept;
    reg [WIDTH-1:0] angle_kept;
    reg [DEPTH:0] lit;
    always @(posedge clk)
        if (enable) begin
            lit <= {lit[DEPTH-1:0], !dark};
            if (!dark) begin
                exponent_kept <= exponent_now;
                angle_kept <= angle_now;
            end
        end
    assign busy = lit[DEPTH-1:0] != {DEPTH{1'b0}};
    wire [RESULT-1:0] lobe_value;
    wire unused_user;
    burnish_lobe #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
        .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) lobe (
        .clk(clk), .enable(enable && busy), .exponent(exponent_kept),
        .angle(angle_kept), .user_in(1'b0), .value(lobe_value), .user_out(unused_user));
    assign value = lit[DEPTH] ? lobe_value : {RESULT{1'b0}};
    burnish_delay #(.WIDTH(USER_WIDTH), .DEPTH(DEPTH + 2)) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
`default_nettype wire
