// demo_simulated: the demonstration with its map, for simulators.
//
// Ports  as demo
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_simulated (
    input wire clk,
    input wire [3:0] buttons,
    output wire [7:0] red,
    output wire [7:0] green,
    output wire [7:0] blue,
    output wire hsync,
    output wire vsync,
    output wire visible
);
    wire [14:0] address;
    wire [31:0] data;
    wire [1:0] unused_column, unused_row;
    demo_map map (.clk(clk), .address(address), .data(data));
    demo picture (
        .clk(clk), .buttons(buttons), .map_address(address), .map_data(data), .red(red), .green(green),
        .blue(blue), .hsync(hsync), .vsync(vsync), .visible(visible), .out_column(unused_column),
        .out_row(unused_row));
endmodule
`default_nettype wire
