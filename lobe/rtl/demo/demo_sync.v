// demo_sync: counters and synchronisation of 640 x 480 at 60 Hz.
//
// Pixel p of a line enters the pipeline while column is p and leaves it LATENCY clocks later: hsync, vsync and visible
// belong to what leaves. Both synchronisations are negative. A line has 800 clocks, a frame 525 lines.
//
// Parameters LATENCY  clocks from column to the pixel's colour: at most 48
// Ports      column, row    of what enters;  frame  1 for one clock, before the first line of each picture
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_sync #(
    parameter [9:0] LATENCY = 10'd35
) (
    input wire clk,
    output reg [9:0] column,
    output reg [9:0] row,
    output reg frame,
    output reg hsync,
    output reg vsync,
    output reg visible
);
    initial begin
        column = 10'd0;
        row = 10'd0;
        frame = 1'b0;
        hsync = 1'b1;
        vsync = 1'b1;
        visible = 1'b0;
    end
    // The registers below show one clock after what they compare.
    localparam [9:0] FIRST = LATENCY - 10'd1;
    wire shown_row = row < 10'd480;
    always @(posedge clk) begin
        column <= column == 10'd799 ? 10'd0 : column + 10'd1;
        if (column == 10'd799) row <= row == 10'd524 ? 10'd0 : row + 10'd1;
        frame <= column == 10'd0 && row == 10'd500;
        hsync <= !(column >= FIRST + 10'd656 && column < FIRST + 10'd752);
        // The vertical one changes with the horizontal one.
        if (column == FIRST + 10'd656) vsync <= !(row == 10'd489 || row == 10'd490);
        visible <= shown_row && column >= FIRST && column < FIRST + 10'd640;
    end
endmodule
`default_nettype wire
