// demo_state: lobes, exponent and light, which change between two pictures.
//
// Parameters TABLE    256 half vectors, {z, y, x} in Q15, by which the light goes round once
// Ports      frame    1 for a clock between two pictures;  buttons  see demo;  the others hold during a picture
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_state #(
    parameter TABLE = "light.mem"
) (
    input wire clk,
    input wire frame,
    input wire [3:0] buttons,
    output reg [1:0] left,
    output reg [1:0] right,
    output reg [3:0] exponent_index,
    output reg [9:0] exponent,
    output reg [47:0] half
);
    reg [47:0] halves[0:255];
    reg [7:0] phase;
    reg [3:0] first, now;
    reg [2:0] earlier;
    initial begin
        $readmemh(TABLE, halves);
        left = 2'd0;
        right = 2'd1;
        exponent_index = 4'd6;
        phase = 8'd0;
        now = 4'd0;
        earlier = 3'd0;
    end
    wire [2:0] pressed = now[2:0] & ~earlier;
    always @(posedge clk) begin
        first <= buttons; // which are not synchronous
        if (frame) begin
            now <= first;
            earlier <= now[2:0];
            if (pressed[0]) left <= left + 2'd1;
            if (pressed[1]) right <= right + 2'd1;
            if (pressed[2]) exponent_index <= exponent_index + 4'd1;
            if (!now[3]) phase <= phase + 8'd1;
        end
        half <= halves[phase];
        case (exponent_index)
            4'd0: exponent <= 10'd4;
            4'd1: exponent <= 10'd6;
            4'd2: exponent <= 10'd8;
            4'd3: exponent <= 10'd12;
            4'd4: exponent <= 10'd16;
            4'd5: exponent <= 10'd24;
            4'd6: exponent <= 10'd32;
            4'd7: exponent <= 10'd48;
            4'd8: exponent <= 10'd64;
            4'd9: exponent <= 10'd96;
            4'd10: exponent <= 10'd128;
            4'd11: exponent <= 10'd192;
            4'd12: exponent <= 10'd256;
            4'd13: exponent <= 10'd384;
            4'd14: exponent <= 10'd512;
            default: exponent <= 10'd1023;
        endcase
    end
endmodule
`default_nettype wire
