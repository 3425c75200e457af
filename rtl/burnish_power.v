// burnish_power: the base to the power of the order, by squarings.
//
//     ROUND 0 (fast): x = t, then SQUARINGS times x = (x x) >> 16
//     ROUND 1 (near): x = (t t + t + 0x8000) >> 16, then x = (x x + 0x8000) >> 16
//     RESULT 8:       the last squaring from y = x >> 7 as (y (y + 1) + 511) >> 10
//
// Latency    SQUARINGS times burnish_square; RESULT 8: one more
// Throughput one per clock
// Parameters SQUARINGS log2 of the order, 1 .. 4;  RESULT 16 or 8 bits;  ROUND 0, or 1 (RESULT 16 only)
//            ROWS, SEGMENT, DSP  see burnish_square
// Ports      t  UQ0.16, registered;  value  UQ0.16 or UQ0.8, registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
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
            wire [15:0] x;
            wire [15:0] next;
            if (k == 0) begin : first
                assign x = t;
            end else begin : later
                assign x = step[k-1].next;
            end
            if (RESULT == 8 && k == SQUARINGS - 1) begin : short
                reg [8:0] y;
                reg [9:0] offset;
                wire [17:0] square;
                always @(posedge clk)
                    if (enable) begin
                        y <= x[15:7];
                        offset <= {1'b0, x[15:7]} + 10'd511;
                    end
                burnish_square #(.WIDTH(9), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) last (
                    .clk(clk), .enable(enable), .t(y), .offset(offset), .square(square));
                assign next = {8'd0, square[17:10]};
            end else begin : full
                wire [31:0] square;
                wire [16:0] offset = ROUND == 0 ? 17'd0
                    : k == 0 ? {x[15], ~x[15], x[14:0]} : 17'h08000; /* t + 0x8000 */
                burnish_square #(.WIDTH(16), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) last (
                    .clk(clk), .enable(enable), .t(x), .offset(offset), .square(square));
                assign next = square[31:16];
            end
        end
    endgenerate
    assign value = step[SQUARINGS-1].next[RESULT-1:0];
endmodule
