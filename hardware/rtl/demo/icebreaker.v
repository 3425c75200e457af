// icebreaker: the demonstration on an iCEBreaker (iCE40 UP5K) with the 12-bit DVI Pmod on PMOD 1A and 1B.
//
// The four single-port memories hold the teapot's map. A bitstream can't fill them, so it is read from the flash memory
// behind the bitstream at start, which takes a tenth of a second.
//
// Ports  CLK 12 MHz;  BTN1, BTN2, BTN3 (the buttons next to PMOD 2)  next lobe on the left, on the right, next exponent;
//        BTN_N  holds the light;  LEDG_N  lit when the map is there
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module icebreaker (
    input wire CLK,
    input wire BTN_N,
    input wire BTN1,
    input wire BTN2,
    input wire BTN3,
    output wire LEDG_N,
    output wire FLASH_SCK,
    output wire FLASH_SSB,
    output wire FLASH_IO0,
    input wire FLASH_IO1,
    output wire dvi_clk,
    output wire dvi_hsync,
    output wire dvi_vsync,
    output wire dvi_de,
    output wire [3:0] dvi_r,
    output wire [3:0] dvi_g,
    output wire [3:0] dvi_b
);
    // 12 MHz * 67 / 32 = 25.125 MHz
    wire clk;
    wire unused_lock;
    SB_PLL40_PAD #(
        .FEEDBACK_PATH("SIMPLE"), .DIVR(4'd0), .DIVF(7'd66), .DIVQ(3'd5), .FILTER_RANGE(3'd1)
    ) pll (
        .PACKAGEPIN(CLK), .PLLOUTGLOBAL(clk), .LOCK(unused_lock), .RESETB(1'b1), .BYPASS(1'b0));

    wire [14:0] address;
    wire [31:0] data;
    wire [7:0] red, green, blue;
    wire hsync, vsync, visible, loaded;
    wire [1:0] column, row;
    demo_flash_map map (
        .clk(clk), .address(address), .data(data), .loaded(loaded), .select_n(FLASH_SSB),
        .clock(FLASH_SCK), .to_flash(FLASH_IO0), .from_flash(FLASH_IO1));
    demo picture (
        .clk(clk), .buttons({!BTN_N, BTN3, BTN2, BTN1}), .map_address(address),
        .map_data(loaded ? data : 32'd0), .red(red), .green(green), .blue(blue), .hsync(hsync),
        .vsync(vsync), .visible(visible), .out_column(column), .out_row(row));
    assign LEDG_N = !loaded;

    wire [11:0] color;
    wire [2:0] control;
    demo_dither dither (
        .clk(clk), .red(red), .green(green), .blue(blue), .column(column), .row(row),
        .control({hsync, vsync, visible}), .color(color), .control_out(control));

    // Registers in the pins; the transmitter reads at the rising edge, so its clock is the complement.
    wire [14:0] pins;
    assign {dvi_r, dvi_g, dvi_b, dvi_hsync, dvi_vsync, dvi_de} = pins;
    wire [14:0] leaving = {color, control};
    genvar k;
    generate
        for (k = 0; k < 15; k = k + 1) begin : pin
            SB_IO #(.PIN_TYPE(6'b010101)) register (
                .PACKAGE_PIN(pins[k]), .OUTPUT_CLK(clk), .D_OUT_0(leaving[k]), .D_OUT_1(1'b0));
        end
    endgenerate
    SB_IO #(.PIN_TYPE(6'b010001)) clock_pin (
        .PACKAGE_PIN(dvi_clk), .OUTPUT_CLK(clk), .D_OUT_0(1'b0), .D_OUT_1(1'b1));
endmodule
`default_nettype wire
