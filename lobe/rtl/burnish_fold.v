// burnish_fold: a product times 1 - 2^-SHIFT, as the lobe's base.
//
//     a = floor((2^SHIFT - 1) product / 2^(SHIFT + FRACTION)),  t = over or a > 0xFFFF ? 0 : 0xFFFF - a
//
// With product = n u and SHIFT 3 this is the slope 7n/16 by one subtraction: 7n = 8n - n.
//
// Latency    1; with SEGMENT one more per segment: ceil((WIDTH + SHIFT) / SEGMENT) + 1
// Throughput one per clock
// Parameters WIDTH     bits of the product, 17 + FRACTION
//            SHIFT     2 or 3
//            FRACTION  bits of the product below 2^-16
//            SEGMENT   0, or columns between two carry registers
// Ports      over  1: the product does not fit its bits
//            t     UQ0.16, registered; 0 stands for the lobe's zero
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_fold #(
    parameter WIDTH = 17,
    parameter SHIFT = 3,
    parameter FRACTION = 0,
    parameter SEGMENT = 0
) (
    input wire clk,
    input wire enable,
    input wire [WIDTH-1:0] product,
    input wire over,
    output reg [15:0] t
);
    localparam COLUMNS = WIDTH + SHIFT;
    localparam SPAN = SEGMENT < 1 ? COLUMNS : SEGMENT;
    localparam SEGMENTS = (COLUMNS + SPAN - 1) / SPAN;
    wire [COLUMNS-1:0] whole = {product, {SHIFT{1'b0}}};
    wire [COLUMNS-1:0] part = {{SHIFT{1'b0}}, product};
    wire [COLUMNS-1:0] rest;
    wire over_kept;

    genvar s;
    generate
        if (SEGMENT < 1) begin : at_once
            assign rest = whole - part;
            assign over_kept = over;
        end else begin : split
            burnish_delay #(.WIDTH(1), .DEPTH(SEGMENTS)) over_line (
                .clk(clk), .enable(enable), .in(over), .out(over_kept));
            for (s = 0; s < SEGMENTS; s = s + 1) begin : segment
                localparam LOW = s * SPAN;
                localparam HIGH = (LOW + SPAN > COLUMNS ? COLUMNS : LOW + SPAN) - 1;
                localparam PART = HIGH - LOW + 1;
                wire [PART-1:0] a, b;
                reg [PART-1:0] difference;
                reg carry;
                burnish_delay #(.WIDTH(PART), .DEPTH(s)) line_a (
                    .clk(clk), .enable(enable), .in(whole[HIGH:LOW]), .out(a));
                burnish_delay #(.WIDTH(PART), .DEPTH(s)) line_b (
                    .clk(clk), .enable(enable), .in(~part[HIGH:LOW]), .out(b));
                wire [PART:0] total;
                wire unused = carry;
                if (s == 0) begin : first
                    assign total = {1'b0, a} + {1'b0, b} + 1'b1;
                end else begin : next
                    wire unused_low;
                    assign {total, unused_low} =
                        {1'b0, a, 1'b1} + {1'b0, b, segment[s-1].carry};
                end
                always @(posedge clk)
                    if (enable) begin
                        difference <= total[PART-1:0];
                        carry <= total[PART];
                    end
                burnish_delay #(.WIDTH(PART), .DEPTH(SEGMENTS - 1 - s)) align (
                    .clk(clk), .enable(enable), .in(difference), .out(rest[HIGH:LOW]));
            end
        end
    endgenerate

    // The zero is the register's reset, which needs no logic cell.
    wire zero = over_kept | rest[COLUMNS-1];
    always @(posedge clk)
        if (enable) t <= zero ? 16'd0 : ~rest[SHIFT+FRACTION+15:SHIFT+FRACTION];
endmodule
`default_nettype wire
