// burnish_power: the base to the power of the order, by squarings.
//
//     ROUND 0 (fast): x = t, then SQUARINGS times x = (x x) >> 16
//     ROUND 1 (near): x = (t t + t + 0x8000) >> 16, then x = (x x + 0x8000) >> 16
//     RESULT R < 16:  the last squaring from y = x >> (15 - R), R + 1 bits: (y (y + 1) + 2^(R+1) - 1) >> (R + 2),
//                     the middle of y's interval squared and rounded to R bits
//
// Latency    SQUARINGS times burnish_square; RESULT below 16: one more
// Throughput one per clock
// Parameters SQUARINGS log2 of the order, 1 .. 4;  RESULT 8, 10, 12 or 16 bits;  ROUND 0, or 1 (RESULT 16 only)
//            ROWS, SEGMENT, DSP  see burnish_square
// Ports      t  UQ0.16, registered;  value  UQ0.16 or UQ0.8, registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_power #(
    parameter SQUARINGS = 1,
    parameter RESULT = 16,
    parameter ROUND = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [15:0] t,
    output wire [RESULT-1:0] value
);
    genvar k;
    generate
        for (k = 0; k < SQUARINGS; k = k + 1) begin : step
            wire [15:0] x, next;
            if (k == 0) begin : first
                assign x = t;
            end else begin : later
                assign x = step[k-1].next;
            end
            if (RESULT < 16 && k == SQUARINGS - 1) begin : short
                reg [RESULT:0] y;
                reg [RESULT+1:0] offset;
                wire [RESULT+1:0] unused_square;
                wire unused = &{1'b0, x, next};
                always @(posedge clk)
                    if (enable) begin
                        y <= x[15:15-RESULT];
                        offset <= {1'b0, x[15:15-RESULT]} + {1'b0, {RESULT + 1{1'b1}}};
                    end
                burnish_square #(.WIDTH(RESULT + 1), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) last (
                    .clk(clk), .enable(enable), .t(y), .offset(offset), .square({value, unused_square}));
                assign next = 16'd0;
            end else begin : full
                wire [15:0] unused_square;
                wire [16:0] offset = ROUND == 0 ? 17'd0
                    : k == 0 ? {x[15], ~x[15], x[14:0]} : 17'h08000; /* t + 0x8000 */
                burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) last (
                    .clk(clk), .enable(enable), .t(x), .offset(offset), .square({next, unused_square}));
                if (k == SQUARINGS - 1) begin : last_step
                    assign value = next;
                end
            end
        end
    endgenerate
endmodule
`default_nettype wire
