// burnish_base: the lobe's base for slopes that are n, 3n or 7n, shifted.
//
//     t = max(0, 1 - zeta (1 - c)),  2 zeta = FACTOR n / 2^SHIFT
//
// in the form of lobe_q15.h: a = (FACTOR n u) >> SHIFT, t = a > 0xFFFF ? 0 : 0xFFFF - a. The units
// burnish_taylor and burnish_shift are this module followed by a burnish_power.
//
// Latency    rows: 1 + burnish_product + (FACTOR 1: 1, else burnish_fold)
//            DSP: 3
// Throughput one per clock
// Parameters FACTOR   1; 2^SHIFT - 1 for SHIFT 2 or 3
//            SHIFT    0 .. 3
//            LAMBDA   0: angle is the cosine, UQ1.15, above 0x8000 counts as 1
//                     1: angle is 1 - cosine, UQ0.24
//            ROWS, SEGMENT  see burnish_product
//            DSP      1: multipliers
// Ports      exponent n, 0 .. 1023;  t  UQ0.16, registered, 0 at the lobe's zero
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_base #(
    parameter FACTOR = 7,
    parameter SHIFT = 3,
    parameter LAMBDA = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    input wire [(LAMBDA != 0 ? 24 : 16)-1:0] angle,
    output wire [15:0] t
);
    localparam FRACTION = LAMBDA != 0 ? 9 : 0;
    localparam U_WIDTH = LAMBDA != 0 ? 24 : 16;
    localparam KEEP = FRACTION + (FACTOR == 1 ? 16 + SHIFT : 17);

    generate
        if (DSP != 0) begin : dsp
            // -w - 1 = slope (c - 1) - 1 is the complement of w, and c - 1 is c with its top bit set.
            reg [12:0] slope;
            wire [12:0] scaled = FACTOR == 7 ? {exponent, 3'b0} - {3'b0, exponent}
                : FACTOR == 3 ? {2'b0, exponent, 1'b0} + {3'b0, exponent} : {3'b0, exponent};
            if (LAMBDA == 0) begin : cosine
                wire one = angle[15];
                reg [15:0] kept;
                always @(posedge clk)
                    if (enable) begin
                        slope <= one ? 13'd0 : scaled;
                        kept <= {1'b1, angle[14:0]};
                    end
                wire [31:0] complement;
                burnish_multiplier #(.SIGNED(1), .ADD(1)) multiply (
                    .clk(clk), .enable(enable), .a({3'b0, slope}), .b(kept),
                    .addend(32'hFFFFFFFF), .product(complement));
                reg [15:0] kept_t;
                wire lit = &complement[29:16+SHIFT]; /* w < 2^29 */
                always @(posedge clk)
                    if (enable) kept_t <= lit ? complement[15+SHIFT:SHIFT] : 16'd0;
                assign t = kept_t;
                wire unused = &{1'b0, complement};
            end else begin : lambda
                reg [23:0] wide;
                always @(posedge clk)
                    if (enable) begin
                        slope <= scaled;
                        wide <= angle;
                    end
                wire [36:0] product;
                burnish_multiplier #(.A_WIDTH(13), .B_WIDTH(24)) multiply (
                    .clk(clk), .enable(enable), .a(slope), .b(wide), .addend(37'd0),
                    .product(product));
                reg [15:0] kept_t;
                wire zero = |product[36:25+SHIFT];
                always @(posedge clk)
                    if (enable) kept_t <= zero ? 16'd0 : ~product[24+SHIFT:9+SHIFT];
                assign t = kept_t;
                wire unused = &{1'b0, product};
            end
        end else begin : rows
            wire [9:0] slope;
            wire [U_WIDTH-1:0] u;
            reg [9:0] slope_kept;
            reg [U_WIDTH-1:0] u_kept;
            if (LAMBDA == 0) begin : cosine
                // A cosine of 1 or more sets n to 0 by the register's reset.
                always @(posedge clk)
                    if (enable) begin
                        slope_kept <= angle[15] ? 10'd0 : exponent;
                        u_kept <= 16'h8000 - {1'b0, angle[14:0]};
                    end
            end else begin : lambda
                always @(posedge clk)
                    if (enable) begin
                        slope_kept <= exponent;
                        u_kept <= angle;
                    end
            end
            assign slope = slope_kept;
            assign u = u_kept;

            wire [KEEP-1:0] product;
            wire over;
            burnish_product #(.SLOPE_WIDTH(10), .U_WIDTH(U_WIDTH), .KEEP(KEEP), .ROWS(ROWS),
                .SEGMENT(SEGMENT)) multiply (
                .clk(clk), .enable(enable), .slope(slope), .u(u), .product(product),
                .over(over));
            if (FACTOR == 1) begin : plain
                reg [15:0] kept_t;
                always @(posedge clk)
                    if (enable) kept_t <= over ? 16'd0 : ~product[KEEP-1:KEEP-16];
                assign t = kept_t;
                wire unused = &{1'b0, product};
            end else begin : folded
                burnish_fold #(.WIDTH(KEEP), .SHIFT(SHIFT), .FRACTION(FRACTION),
                    .SEGMENT(SEGMENT)) fold (
                    .clk(clk), .enable(enable), .product(product), .over(over), .t(t));
            end
        end
    endgenerate
endmodule
`default_nettype wire
