// burnish_boundary: a lobe whose registers keep still for pixels that the boundary memory marks as dark.
//
//     value = dark ? 0 : lobe
//     dark: cosine <= word, unless word is 0 (LAMBDA 0); 1 - cosine > word (LAMBDA 1)
//
// The memory has one word per exponent, written by `burnish lobe boundary --as=mem`. With --bits=0 no result changes;
// with a threshold, values below it become 0. FILE starts at exponent 1 (--exponents=1-1023); its format is
// --format-word=UQ0.15 for LAMBDA 0 and --lambda --format-word=UQ0.24 for LAMBDA 1. value passes one gate after its
// register. Bit for bit burnish_lobe_q15_fast after burnish_lobe_q15_set_boundary of include/burnish/lobe_q15.h.
//
// A dark pixel does not enter the lobe: its input registers keep the previous pixel. While every pixel inside is dark,
// the lobe's enable is 0 and none of its registers is clocked.
//
// Latency    burnish_lobe + 2
// Throughput one lobe per clock
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_boundary #(
    parameter FILE = "", // the memory's file, with words from exponent 1 on; empty: no boundary
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor and energy
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
    input wire [9:0] exponent, // n, 1 .. 1023, at orders above 2 from the order on
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle, // cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
    input wire [USER_WIDTH-1:0] user_in, // a valid bit, a tag, a pixel's address
    output wire busy, // 1: the lobe's registers are clocked
    output wire [RESULT-1:0] value, // UQ0.16, or its upper RESULT bits, rounded
    output wire [USER_WIDTH-1:0] user_out // user_in, delayed by the latency; 0 from power-up until then
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
