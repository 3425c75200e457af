// any_wishbone: any peripheral in place of burnish_wishbone, for the proof of burnish_axi_lite's protocol: it answers a cycle
// after one to four clocks with ack or err.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_wishbone #(
    parameter UNIT = 1,
    parameter SQUARINGS = 1,
    parameter RESULT = 16,
    parameter ROUND = 0,
    parameter LAMBDA = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire reset,
    input wire cyc,
    input wire stb,
    input wire we,
    input wire [1:0] adr,
    input wire [3:0] sel,
    input wire [31:0] dat_w,
    output reg [31:0] dat_r,
    output reg ack,
    output reg err
);
    (* anyseq *) wire answers, refuses;
    (* anyseq *) wire [31:0] any;
    reg [1:0] waited;
    wire begun = cyc && stb && !ack && !err;
    wire ends = begun && (answers || waited == 2'd3);
    always @(posedge clk) begin
        dat_r <= any;
        ack <= ends && !refuses && !reset;
        err <= ends && refuses && !reset;
        waited <= reset || ends ? 2'd0 : waited + {1'b0, begun};
    end
endmodule
`default_nettype wire
