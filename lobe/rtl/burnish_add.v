// burnish_add: a sum in segments of the carry chain.
//
//     sum = (a + b + carry) mod 2^WIDTH
//
// Latency    1; with SEGMENT ceil(WIDTH / SEGMENT)
// Throughput one sum per clock
// Parameters WIDTH    bits of the operands and of the sum
//            SEGMENT  0, or columns between two carry registers: a segment is summed one clock after the one below it
// Ports      a, b, carry read in the same clock; sum registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_add #(
    parameter WIDTH = 32,
    parameter SEGMENT = 0
) (
    input wire clk,
    input wire enable,
    input wire [WIDTH-1:0] a,
    input wire [WIDTH-1:0] b,
    input wire carry,
    output wire [WIDTH-1:0] sum
);
    localparam SPAN = SEGMENT < 1 ? WIDTH : SEGMENT;
    localparam SEGMENTS = (WIDTH + SPAN - 1) / SPAN;

    genvar s;
    generate
        for (s = 0; s < SEGMENTS; s = s + 1) begin : segment
            localparam LOW = s * SPAN;
            localparam HIGH = (LOW + SPAN > WIDTH ? WIDTH : LOW + SPAN) - 1;
            localparam PART = HIGH - LOW + 1;
            wire [PART-1:0] a_now, b_now;
            wire [PART:0] total;
            wire unused_low;
            reg [PART-1:0] kept;
            burnish_delay #(.WIDTH(2 * PART), .DEPTH(s)) line (
                .clk(clk), .enable(enable), .in({a[HIGH:LOW], b[HIGH:LOW]}), .out({a_now, b_now}));
            if (s == 0) begin : first
                assign {total, unused_low} = {1'b0, a_now, 1'b1} + {1'b0, b_now, carry};
            end else begin : next
                assign {total, unused_low} =
                    {1'b0, a_now, 1'b1} + {1'b0, b_now, segment[s-1].more.carry_kept};
            end
            always @(posedge clk) if (enable) kept <= total[PART-1:0];
            if (s < SEGMENTS - 1) begin : more
                reg carry_kept;
                always @(posedge clk) if (enable) carry_kept <= total[PART];
            end else begin : last
                wire unused_carry = total[PART];
            end
            burnish_delay #(.WIDTH(PART), .DEPTH(SEGMENTS - 1 - s)) align (
                .clk(clk), .enable(enable), .in(kept), .out(sum[HIGH:LOW]));
        end
    endgenerate
endmodule
`default_nettype wire
