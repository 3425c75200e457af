// cells.v: what the board's bench needs of iCE40's cells that are no logic, by their data sheets.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
// The bench clocks the pin at the pixels' rate.
module SB_PLL40_PAD #(
    parameter FEEDBACK_PATH = "SIMPLE",
    parameter [3:0] DIVR = 0,
    parameter [6:0] DIVF = 0,
    parameter [2:0] DIVQ = 0,
    parameter [2:0] FILTER_RANGE = 0
) (
    input wire PACKAGEPIN,
    output wire PLLOUTGLOBAL,
    output wire LOCK,
    input wire RESETB,
    input wire BYPASS
);
    assign PLLOUTGLOBAL = PACKAGEPIN;
    assign LOCK = 1'b1;
endmodule

module SB_IO #(
    parameter [5:0] PIN_TYPE = 0
) (
    output reg PACKAGE_PIN,
    input wire OUTPUT_CLK,
    input wire CLOCK_ENABLE, // not connected in the sources, 1 in a netlist
    input wire D_OUT_0,
    input wire D_OUT_1
);
    always @(posedge OUTPUT_CLK) PACKAGE_PIN <= D_OUT_0;
endmodule

module SB_SPRAM256KA (
    input wire [13:0] ADDRESS,
    input wire [15:0] DATAIN,
    input wire [3:0] MASKWREN,
    input wire WREN,
    input wire CHIPSELECT,
    input wire CLOCK,
    input wire STANDBY,
    input wire SLEEP,
    input wire POWEROFF,
    output reg [15:0] DATAOUT
);
    reg [15:0] words[0:16383];
    always @(posedge CLOCK)
        if (CHIPSELECT && POWEROFF && !SLEEP && !STANDBY) begin
            if (WREN && MASKWREN == 4'b1111) words[ADDRESS] <= DATAIN;
            if (!WREN) DATAOUT <= words[ADDRESS];
        end
endmodule
`default_nettype wire
