// burnish_energy_slope: the slope of the lobe with the energy of cos^n.
//
//     2 zeta = 2 (n + 1) / (order + 1) = slope / 2^shift, 16 significant bits, rounded, halves up
//
// Bit for bit burnish_q15_energy_slope of include/burnish/lobe_q15.h. The divisor W = 2^s + 1 (s = SQUARINGS) needs
// neither division nor multiplier: 1/W = (2^s - 1) / 2^2s (1 + 2^-2s) (1 + 2^-4s) (1 + 2^-8s) ...
//
// Latency    8
// Throughput one per clock
// Parameters SQUARINGS  log2 of the order, 1 .. 4
// Ports      exponent   n, 1 .. 1023;  slope, shift registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_energy_slope #(
    parameter SQUARINGS = 1
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    output wire [15:0] slope,
    output wire [3:0] shift
);
    // n + 1 with its leading one at bit 10, or shifted by LIFT_MAX, where the slope's shift is at its largest.
    localparam LIFT_MAX = 11 - SQUARINGS;
    localparam SHIFT_LEAST = 4 + SQUARINGS;
    reg [10:0] next, next_kept, lifted;
    reg [3:0] lift, lift_kept;
    integer k;
    always @(posedge clk)
        if (enable) begin
            next <= {1'b0, exponent} + 11'd1;
            lift <= LIFT_MAX[3:0];
            for (k = SQUARINGS; k <= 10; k = k + 1) if (next[k]) lift <= 4'd10 - k[3:0];
            next_kept <= next;
            lifted <= next_kept << lift;
            lift_kept <= lift;
        end

    // Below W / 2^s, seen from the bits after the leading one, it is shifted once more.
    wire more = lifted[9:10-SQUARINGS] == {SQUARINGS{1'b0}} && lift_kept != LIFT_MAX[3:0];
    reg [11:0] scaled;
    reg [3:0] shift_kept;
    always @(posedge clk)
        if (enable) begin
            scaled <= more ? {lifted, 1'b0} : {1'b0, lifted};
            shift_kept <= lift_kept + SHIFT_LEAST[3:0] + {3'd0, more};
        end

    // slope = floor((2 (n + 1) 2^shift + floor(W / 2)) / W). The sum needs no adder: 2^shift leaves its lower bits 0.
    // The quotient's fraction is at most 1 - 1/W, so half a unit more doesn't change its floor, but covers what the
    // steps cut off; with two bits of fraction the slope is exact for every exponent.
    localparam FRACTION = 2;
    localparam ROOM = 5 + SQUARINGS + FRACTION;
    localparam WIDTH = 12 + ROOM;
    localparam [ROOM-1:0] HALVES = (1 << (SQUARINGS - 1 + FRACTION)) + (1 << (FRACTION - 1));
    genvar i;
    generate
        for (i = 0; i < 4; i = i + 1) begin : step
            wire [WIDTH-1:0] prior;
            reg [WIDTH-1:0] sum;
            if (i == 0) begin : first
                assign prior = {scaled, HALVES};
            end else begin : later
                assign prior = step[i-1].sum;
            end
            if (i == 0 && SQUARINGS > 1) begin : less /* times (2^s - 1) / 2^s */
                always @(posedge clk) if (enable) sum <= prior - (prior >> SQUARINGS);
            end else begin : plus /* times 1 + 2^-2s, 1 + 2^-4s ... */
                localparam PLACES = 2 * SQUARINGS << (SQUARINGS > 1 ? i - 1 : i);
                always @(posedge clk) if (enable) sum <= prior + (prior >> PLACES);
            end
        end
    endgenerate
    wire [WIDTH-1:0] quotient = step[3].sum >> (FRACTION + (SQUARINGS > 1 ? SQUARINGS : 2));
    assign slope = quotient[15:0];
    wire unused = &{1'b0, quotient};
    burnish_delay #(.WIDTH(4), .DEPTH(4)) line (
        .clk(clk), .enable(enable), .in(shift_kept), .out(shift));
endmodule
`default_nettype wire
