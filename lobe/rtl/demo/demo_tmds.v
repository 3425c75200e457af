// demo_tmds: a byte or two control bits as a symbol of ten bits, by the Digital Visual Interface specification 1.0, 3.2.
//
// Bits 7 .. 0 are the byte as a chain of exclusive ors, or of their complements, whichever changes less often; bit 8 says
// which. All eight are inverted, and bit 9 set, when that brings ones and zeros closer to balance.
//
// Latency    2
// Throughput one symbol per clock
// Ports      visible  1: value is sent; 0: control is, and the balance starts anew
//            symbol   bit 0 is sent first
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_tmds (
    input wire clk,
    input wire visible,
    input wire [7:0] value,
    input wire [1:0] control,
    output reg [9:0] symbol
);
    function [3:0] ones_of(input [7:0] bits);
        ones_of = {3'd0, bits[0]} + {3'd0, bits[1]} + {3'd0, bits[2]} + {3'd0, bits[3]} +
            {3'd0, bits[4]} + {3'd0, bits[5]} + {3'd0, bits[6]} + {3'd0, bits[7]};
    endfunction

    // 1: the chain. Every second of its bits is the complement where exclusive nors are chained.
    wire [3:0] ones = ones_of(value);
    wire complement = ones > 4'd4 || (ones == 4'd4 && !value[0]);
    wire [7:0] chain = {^value, ^value[6:0], ^value[5:0], ^value[4:0], ^value[3:0], ^value[2:0], ^value[1:0], value[0]};
    reg [8:0] coded;
    reg [1:0] control_1;
    reg visible_1;
    always @(posedge clk) begin
        coded <= {!complement, chain ^ (complement ? 8'hAA : 8'h00)};
        control_1 <= control;
        visible_1 <= visible;
    end

    // 2: ones minus zeros, halved: of the eight bits, -4 .. 4; of all that was sent since the last control, -4 .. 4.
    wire signed [4:0] surplus = {1'b0, ones_of(coded[7:0])} - 5'd4;
    reg signed [4:0] balance;
    initial balance = 5'd0;
    wire level = balance == 5'd0 || surplus == 5'd0;
    wire invert = level ? !coded[8] : balance[4] == surplus[4];
    // Bits 9 and 8 together: one more one, one more zero, or one of each.
    wire signed [4:0] ends = invert == coded[8] ? (invert ? 5'sd1 : -5'sd1) : 5'sd0;
    always @(posedge clk)
        if (visible_1) begin
            symbol <= {invert, coded[8], coded[7:0] ^ {8{invert}}};
            balance <= balance + ends + (invert ? -surplus : surplus);
        end else begin
            balance <= 5'd0;
            case (control_1)
                2'd0: symbol <= 10'b1101010100;
                2'd1: symbol <= 10'b0010101011;
                2'd2: symbol <= 10'b0101010100;
                default: symbol <= 10'b1010101011;
            endcase
        end
endmodule
`default_nettype wire
