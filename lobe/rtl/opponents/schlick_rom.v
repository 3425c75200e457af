// schlick_rom: Schlick's lobe to 8 bits from a memory of reciprocals.
//
//     D = n (1 - c) + c = 2^e (1 + f),  r = ROM[256 f] = floor(2^25 / (512 + 2 floor(256 f) + 1)),
//     value = min(floor((c r + 2^(e+7)) / 2^(e+8)), 255),  e counted in D's bits
//
// Latency    9
// Throughput one lobe per clock
// Memory     256 words of 16 bits;  two multipliers
// Ports      as burnish_taylor
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module schlick_rom (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    input wire [15:0] angle,
    input wire user_in,
    output wire [7:0] value,
    output wire user_out
);
    reg [15:0] memory[0:255];
    integer i, word;
    initial
        for (i = 0; i < 256; i = i + 1) begin
            word = 33554432 / (512 + 2 * i + 1);
            memory[i] = word[15:0];
        end

    reg [9:0] n;
    reg [15:0] u, c, c_1, c_2, c_3, c_4, reciprocal;
    reg [25:0] product, divisor, coarse;
    reg [4:0] e_3, e_4;
    reg [2:0] fine_by;
    reg [7:0] index;
    reg [31:0] scaled;
    reg [4:0] e_5, e_6;
    reg [16:0] shifted;
    reg [2:0] last_by;
    reg [7:0] result;
    wire [25:0] place_of = divisor;
    reg [4:0] top;
    integer k;
    always @* begin
        top = 5'd0;
        for (k = 1; k < 26; k = k + 1) if (place_of[k]) top = k[4:0];
    end
    wire [4:0] up = 5'd25 - top;
    wire [25:0] fine = coarse << fine_by;
    // c r < 2^32: shifted to bits 0 .. 8 in two steps, with one more bit for the rounding.
    wire [24:0] shifted_wide = scaled[31:7] >> {e_6[4:3], 3'b000};
    wire [16:0] final_shift = shifted >> last_by;
    always @(posedge clk)
        if (enable) begin
            n <= angle[15] ? 10'd0 : exponent;
            u <= 16'h8000 - {1'b0, angle[14:0]};
            c <= angle[15] ? 16'h8000 : angle;

            product <= n * u;
            c_1 <= c;

            divisor <= product + {10'd0, c_1};
            c_2 <= c_1;

            coarse <= divisor << {up[4:3], 3'b000};
            fine_by <= up[2:0];
            e_3 <= top;
            c_3 <= c_2;

            index <= fine[24:17];
            e_4 <= e_3;
            c_4 <= c_3;
        end

    reg [15:0] c_5;
    always @(posedge clk)
        if (enable) begin
            reciprocal <= memory[index];
            c_5 <= c_4;
            e_5 <= e_4;

            scaled <= c_5 * reciprocal;
            e_6 <= e_5;

            shifted <= shifted_wide[16:0]; /* c <= D: at most 514 << 7 */
            last_by <= e_6[2:0];

            result <= rounded[8] ? 8'd255 : rounded[7:0];
        end
    wire [9:0] halves = final_shift[9:0];
    wire [9:0] rounded_wide = halves + 10'd1;
    wire [8:0] rounded = rounded_wide[9:1];
    assign value = result;
    burnish_delay #(.WIDTH(1), .DEPTH(9)) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
