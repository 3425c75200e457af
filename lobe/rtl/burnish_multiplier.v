// burnish_multiplier: a multiplier of the chip, for DSP=1.
//
//     product = a b + addend, modulo 2^(A_WIDTH + B_WIDTH)
//
// yosys synthesises it on its own (keep_hierarchy), so it never sees two multipliers at once, or a constant factor. Otherwise
// `synth_ice40 -dsp` (0.23 and 0.55 were tried) makes wrong circuits: it takes a register between two multipliers as the
// first one's output and again as the second one's input, and cuts the leading ones of a constant. On other chips this costs
// cells, since constant addends and unread bits stay: define BURNISH_NOT_ICE40 for them. Other tools do not need it.
//
// There is no register between the product and the sum, so the pipeline registers inside the multipliers of xc7 and ECP5
// are not used, and their clock is lower than it could be.
//
// Latency    1, with INPUTS 2
// Throughput one product per clock
// Parameters A_WIDTH, B_WIDTH  bits of the factors
//            SIGNED   1: a and b are signed
//            INPUTS   1: registers for a and b, which the multiplier contains
//            ADD      0: addend is not read
// Ports      addend   read one clock after a and b with INPUTS, else with them;  product registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`ifdef YOSYS
`ifndef BURNISH_NOT_ICE40
(* keep_hierarchy *)
`endif
`endif
module burnish_multiplier #(
    parameter A_WIDTH = 16,
    parameter B_WIDTH = 16,
    parameter SIGNED = 0,
    parameter INPUTS = 0,
    parameter ADD = 0
) (
    input wire clk,
    input wire enable,
    input wire [A_WIDTH-1:0] a,
    input wire [B_WIDTH-1:0] b,
    input wire [A_WIDTH+B_WIDTH-1:0] addend,
    output reg [A_WIDTH+B_WIDTH-1:0] product
);
    localparam WIDTH = A_WIDTH + B_WIDTH;
    wire [A_WIDTH-1:0] a_now;
    wire [B_WIDTH-1:0] b_now;
    wire [WIDTH-1:0] whole;
    generate
        if (INPUTS != 0) begin : inputs
            reg [A_WIDTH-1:0] a_kept;
            reg [B_WIDTH-1:0] b_kept;
            always @(posedge clk)
                if (enable) begin
                    a_kept <= a;
                    b_kept <= b;
                end
            assign a_now = a_kept;
            assign b_now = b_kept;
        end else begin : direct
            assign a_now = a;
            assign b_now = b;
        end
        if (SIGNED != 0) begin : signed_factors
            wire signed [WIDTH-1:0] a_wide = {{B_WIDTH{a_now[A_WIDTH-1]}}, a_now};
            wire signed [WIDTH-1:0] b_wide = {{A_WIDTH{b_now[B_WIDTH-1]}}, b_now};
            assign whole = a_wide * b_wide;
        end else begin : unsigned_factors
            assign whole = {{B_WIDTH{1'b0}}, a_now} * {{A_WIDTH{1'b0}}, b_now};
        end
        if (ADD != 0) begin : sum
            always @(posedge clk) if (enable) product <= whole + addend;
        end else begin : plain
            always @(posedge clk) if (enable) product <= whole;
            wire unused = &{1'b0, addend};
        end
    endgenerate
endmodule
`default_nettype wire
