// ulx3s: the demonstration on a ULX3S (Lattice ECP5), by the pins of its digital video connector.
//
// Ports  clk_25mhz;  btn  1 while pressed: 3 (up) next exponent, 5 (left) next lobe on the left, 6 (right) next on the
//        right, 1 (fire 1) holds the light;  led  0: the PLL is locked;  gpdi_dp  {clock, red, green, blue}, of which the
//        pins' drivers make differential pairs;  wifi_gpio0  1: the board's ESP32 leaves the bitstream alone
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module ulx3s (
    input wire clk_25mhz,
    input wire [6:0] btn,
    output wire [7:0] led,
    output wire [3:0] gpdi_dp,
    output wire wifi_gpio0
);
    assign wifi_gpio0 = 1'b1;

    // 25 MHz * 25 = 625 MHz, within the oscillator's 400 .. 800 MHz; a fifth of it for bits, two per clock, and a 25th for
    // pixels. A phase of one period less a step shifts nothing: both rise together. nextpnr takes charge pump and
    // filter as 0 unless they are given; these values are from Project Trellis' ecppll.
    wire clk, fast, locked;
    (* ICP_CURRENT = "12", LPF_RESISTOR = "8", MFG_ENABLE_FILTEROPAMP = "1", MFG_GMCREF_SEL = "2" *)
    EHXPLLL #(
        .CLKI_DIV(1), .CLKFB_DIV(5), .FEEDBK_PATH("CLKOP"),
        .CLKOP_ENABLE("ENABLED"), .CLKOP_DIV(5), .CLKOP_CPHASE(4), .CLKOP_FPHASE(0),
        .CLKOS_ENABLE("ENABLED"), .CLKOS_DIV(25), .CLKOS_CPHASE(24), .CLKOS_FPHASE(0)
    ) pll (
        .CLKI(clk_25mhz), .CLKFB(fast), .CLKOP(fast), .CLKOS(clk), .LOCK(locked), .RST(1'b0), .STDBY(1'b0),
        .PHASESEL0(1'b0), .PHASESEL1(1'b0), .PHASEDIR(1'b0), .PHASESTEP(1'b0), .PHASELOADREG(1'b0),
        .PLLWAKESYNC(1'b0), .ENCLKOP(1'b0), .ENCLKOS(1'b0), .ENCLKOS2(1'b0), .ENCLKOS3(1'b0));
    assign led = {7'd0, locked};

    wire [14:0] address;
    wire [31:0] data;
    wire [7:0] red, green, blue;
    wire hsync, vsync, visible;
    demo_span_map map (.clk(clk), .address(address), .data(data));
    demo picture (
        .clk(clk), .buttons({btn[1], btn[3], btn[6], btn[5]}), .map_address(address), .map_data(data),
        .red(red), .green(green), .blue(blue), .hsync(hsync), .vsync(vsync), .visible(visible));
    wire unused = &{1'b0, btn[0], btn[2], btn[4]};

    // The synchronisation goes with blue. The clock's symbol rises as the others begin.
    wire [39:0] symbol;
    assign symbol[39:30] = 10'b0000011111;
    demo_tmds channel_2 (.clk(clk), .visible(visible), .value(red), .control(2'b00), .symbol(symbol[29:20]));
    demo_tmds channel_1 (.clk(clk), .visible(visible), .value(green), .control(2'b00), .symbol(symbol[19:10]));
    demo_tmds channel_0 (
        .clk(clk), .visible(visible), .value(blue), .control({vsync, hsync}), .symbol(symbol[9:0]));
    wire [7:0] pairs;
    demo_serial #(.LANES(4)) serial (.clk(clk), .fast(fast), .symbol(symbol), .pairs(pairs));
    genvar k;
    generate
        for (k = 0; k < 4; k = k + 1) begin : lane
            ODDRX1F pin (.SCLK(fast), .RST(1'b0), .D0(pairs[2*k]), .D1(pairs[2*k+1]), .Q(gpdi_dp[k]));
        end
    endgenerate
endmodule
`default_nettype wire
