// burnish_energy_slope: the slope of the lobe with the power's energy.
//
//     2 zeta = 2 (n + 1) / (order + 1) = slope / 2^shift, 16 significant bits, rounded, halves up
//
// Bit for bit burnish_q15_energy_slope of include/burnish/lobe_q15.h. The division is by a constant: a
// product with its reciprocal, exact over n = 1 .. 1023 and every order.
//
// Latency    4
// Throughput one per clock
// Parameters SQUARINGS  log2 of the order, 1 .. 4
// Ports      exponent   n, 1 .. 1023;  slope, shift registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module burnish_energy_slope #(
    parameter SQUARINGS = 1
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    output reg [15:0] slope,
    output reg [3:0] shift
);
    localparam [19:0] WHOLE = (1 << SQUARINGS) + 1;
    localparam [20:0] LEAST = 20'h8000 * WHOLE;  // scaled is at least this, except at shift 15
    localparam PLACES = 18 + SQUARINGS + 4;
    localparam [22:0] RECIPROCAL = ((1 << PLACES) + WHOLE - 1) / WHOLE;

    // Shift 2 (n + 1) until its leading one is at a fixed bit, then once more where the result is below LEAST.
    // SQUARINGS + 15 is the highest bit of LEAST.
    integer k;
    reg [10:0] next;
    reg [4:0] lift;
    reg [20:0] scaled, lifted, sum;
    reg [4:0] lift_kept;
    reg [3:0] shift_kept;
    reg [43:0] quotient;
    reg [4:0] place;
    always @* begin
        place = 5'd0;
        for (k = 1; k <= 10; k = k + 1) if (next[k]) place = k;
    end
    wire [4:0] wanted = 5'd14 + SQUARINGS - place;
    wire [20:0] doubled = {9'd0, next, 1'b0};
    wire [4:0] limited = wanted > 5'd15 ? 5'd15 : wanted;
    wire more = lifted < LEAST && lift_kept < 5'd15;
    always @(posedge clk)
        if (enable) begin
            next <= {1'b0, exponent} + 11'd1;
            lifted <= doubled << limited;
            lift_kept <= limited;
            sum <= (more ? lifted << 1 : lifted) + (WHOLE >> 1);
            shift_kept <= more ? lift_kept[3:0] + 4'd1 : lift_kept[3:0];
            slope <= quotient[15:0];
            shift <= shift_kept;
        end
    always @* quotient = (sum * RECIPROCAL) >> PLACES;
endmodule
