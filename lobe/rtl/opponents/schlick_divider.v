// schlick_divider: Schlick's lobe by a pipelined divider.
//
//     value = min(floor(2^RESULT c / (n - n c + c)), 2^RESULT - 1), exact
//
// n (1 - c) + c by burnish_product, then one restoring row per bit of the result. A row is as wide as its
// remainder: 17 + row bits until the denominator's 26 are reached.
//
// Latency    2 + RESULT + the product: 1 with DSP, else 9 / ROWS + 1
// Throughput one lobe per clock
// Parameters RESULT 16 or 8 bits;  ROWS, DSP  of the product
// Ports      as burnish_taylor
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module schlick_divider #(
    parameter RESULT = 16,
    parameter ROWS = 1,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    input wire [15:0] angle,
    input wire user_in,
    output wire [RESULT-1:0] value,
    output wire user_out
);
    localparam DEPTH = DSP != 0 ? 1 : 9 / ROWS + 1;
    reg [9:0] n;
    reg [15:0] u, c;
    always @(posedge clk)
        if (enable) begin
            n <= angle[15] ? 10'd0 : exponent;
            u <= 16'h8000 - {1'b0, angle[14:0]};
            c <= angle[15] ? 16'h8000 : angle;
        end
    wire [25:0] product;
    generate
        if (DSP != 0) begin : dsp
            reg [25:0] kept;
            always @(posedge clk) if (enable) kept <= n * u;
            assign product = kept;
        end else begin : rows
            wire over;
            burnish_product #(.SLOPE_WIDTH(10), .U_WIDTH(16), .KEEP(26), .ROWS(ROWS)) multiply (
                .clk(clk), .enable(enable), .slope(n), .u(u), .product(product), .over(over));
        end
    endgenerate
    wire [15:0] c_now;
    burnish_delay #(.WIDTH(16), .DEPTH(DEPTH)) line (
        .clk(clk), .enable(enable), .in(c), .out(c_now));
    reg [25:0] divisor;
    reg [15:0] rest;
    always @(posedge clk)
        if (enable) begin
            divisor <= product + {10'd0, c_now};
            rest <= c_now;
        end

    genvar k;
    generate
        for (k = 0; k < RESULT; k = k + 1) begin : row
            localparam WIDTH = 17 + k > 27 ? 27 : 17 + k;  // of twice the remainder
            wire [26:0] twice;
            wire [25:0] divisor_now;
            wire [RESULT-1:0] quotient_now;
            if (k == 0) begin : first
                assign twice = {10'd0, rest, 1'b0};
                assign divisor_now = divisor;
                assign quotient_now = {RESULT{1'b0}};
            end else begin : next
                assign twice = {row[k-1].rest_kept, 1'b0};
                assign divisor_now = row[k-1].divisor_kept;
                assign quotient_now = row[k-1].quotient;
            end
            wire [26:0] wide = {1'b0, divisor_now};
            wire beyond;
            if (WIDTH < 26) begin : short
                assign beyond = |divisor_now[25:WIDTH];
            end else begin : full
                assign beyond = 1'b0;
            end
            wire [WIDTH:0] difference = {1'b0, twice[WIDTH-1:0]} - {1'b0, wide[WIDTH-1:0]};
            wire fits = !difference[WIDTH] && !beyond;
            wire [26+WIDTH:0] rest_next =
                {27'd0, fits ? difference[WIDTH-1:0] : twice[WIDTH-1:0]};
            reg [25:0] rest_kept, divisor_kept;
            reg [RESULT-1:0] quotient;
            always @(posedge clk)
                if (enable) begin
                    rest_kept <= rest_next[25:0];
                    divisor_kept <= divisor_now;
                    quotient <= {quotient_now[RESULT-2:0], fits};
                end
        end
    endgenerate
    assign value = row[RESULT-1].quotient;
    burnish_delay #(.WIDTH(1), .DEPTH(2 + DEPTH + RESULT)) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
