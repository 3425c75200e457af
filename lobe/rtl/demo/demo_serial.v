// demo_serial: symbols of ten bits as two bits per clock of five times the rate, bit 0 first.
//
// Both clocks come from one PLL. A bit that changes with every symbol is sampled at the fast clock's falling edge, 4 ns
// from the edges of both, and signals when to take the symbols: two fast clocks after they changed and three before they
// change again.
//
// Latency    two symbols at most
// Parameters LANES  symbols side by side
// Ports      symbol   changes with clk;  pairs  per lane: {second bit, first bit}, changes with fast
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_serial #(
    parameter LANES = 4
) (
    input wire clk,
    input wire fast,
    input wire [10*LANES-1:0] symbol,
    output wire [2*LANES-1:0] pairs
);
    reg even, sampled, now, earlier;
    initial begin
        even = 1'b0;
        sampled = 1'b0;
        now = 1'b0;
        earlier = 1'b0;
    end
    always @(posedge clk) even <= !even;
    always @(negedge fast) sampled <= even;
    always @(posedge fast) begin
        now <= sampled;
        earlier <= now;
    end
    wire take = now != earlier;
    genvar k;
    generate
        for (k = 0; k < LANES; k = k + 1) begin : lane
            reg [9:0] shift;
            always @(posedge fast) shift <= take ? symbol[10*k+:10] : {2'd0, shift[9:2]};
            assign pairs[2*k+:2] = shift[1:0];
        end
    endgenerate
endmodule
`default_nettype wire
