// burnish_delay: a word, DEPTH clocks later.
//
// Words are 0 at power-up, so a valid bit in user_in and user_out is right from the first clock on. FPGAs have such
// initial values; synthesis for an ASIC ignores them.
//
// Latency DEPTH, one word per clock. DEPTH 0 is a wire.
// Parameters  WIDTH bits of the word; DEPTH 0 or more clocks
// Ports       enable  1: the line advances
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_delay #(
    parameter WIDTH = 1,
    parameter DEPTH = 1
) (
    input wire clk,
    input wire enable,
    input wire [WIDTH-1:0] in,
    output wire [WIDTH-1:0] out
);
    genvar i;
    generate
        if (DEPTH == 0) begin : none
            assign out = in;
            wire unused = &{1'b0, clk, enable};
        end else begin : line
            for (i = 0; i < DEPTH; i = i + 1) begin : step
                reg [WIDTH-1:0] word;
                initial word = {WIDTH{1'b0}};
                if (i == 0) begin : first
                    always @(posedge clk) if (enable) word <= in;
                end else begin : next
                    always @(posedge clk) if (enable) word <= step[i-1].word;
                end
            end
            assign out = step[DEPTH-1].word;
        end
    endgenerate
endmodule
`default_nettype wire
