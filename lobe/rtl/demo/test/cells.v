// cells.v: models of the ECP5's cells other than logic, as far as the board's bench needs them; from the data sheets.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
// The bench clocks the pin at CLKOP's rate; CLKOS rises with every fifth of its edges.
module EHXPLLL #(
    parameter CLKI_DIV = 1,
    parameter CLKFB_DIV = 1,
    parameter FEEDBK_PATH = "CLKOP",
    parameter CLKOP_ENABLE = "ENABLED",
    parameter CLKOP_DIV = 8,
    parameter CLKOP_CPHASE = 0,
    parameter CLKOP_FPHASE = 0,
    parameter CLKOS_ENABLE = "DISABLED",
    parameter CLKOS_DIV = 8,
    parameter CLKOS_CPHASE = 0,
    parameter CLKOS_FPHASE = 0
) (
    input wire CLKI,
    input wire CLKFB,
    output wire CLKOP,
    output reg CLKOS,
    output wire LOCK,
    input wire RST,
    input wire STDBY,
    input wire PHASESEL0,
    input wire PHASESEL1,
    input wire PHASEDIR,
    input wire PHASESTEP,
    input wire PHASELOADREG,
    input wire PLLWAKESYNC,
    input wire ENCLKOP,
    input wire ENCLKOS,
    input wire ENCLKOS2,
    input wire ENCLKOS3
);
    assign CLKOP = CLKI;
    assign LOCK = 1'b1;
    reg [2:0] count;
    initial begin
        count = 3'd0;
        CLKOS = 1'b0;
    end
    always @(posedge CLKI) begin
        count <= count == 3'd4 ? 3'd0 : count + 3'd1;
        CLKOS <= count < 3'd2;
    end
endmodule

// D0 leaves at the rising edge, D1 at the falling one.
module ODDRX1F (
    input wire SCLK,
    input wire RST,
    input wire D0,
    input wire D1,
    output wire Q
);
    reg first, second;
    always @(posedge SCLK) {second, first} <= {D1, D0};
    assign Q = SCLK ? first : second;
endmodule
`default_nettype wire
