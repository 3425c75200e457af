// burnish_wishbone: the lobe as a peripheral of a processor, on Wishbone B4 (classic cycles) or a similar bus.
//
// A program writes the exponent once and then angles; values are read back in the order of the angles.
//
//     word  name      access
//     0     EXPONENT  read, write  n, 1 .. 1023, at orders above 2 from the order on; by bytes; 16 after reset
//     1     ANGLE     write        starts a lobe; all bytes of the angle must be selected
//     2     VALUE     read         takes the next value, with no ack until it is there
//     3     STATUS    read         bit 0: a value is there, bit 1: an angle is taken, bits 15 .. 4: values not yet
//                                  read, bits 31 .. 16: 0xB115
//
// Invalid accesses end with err instead of ack, so no cycle hangs: VALUE without an angle before it, ANGLE while the
// unit is full (until VALUE is read), and any access that the table lacks. The unit always accepts three angles before a
// VALUE must be read, and more if they arrive faster than its latency.
//
// Latency    ack one clock after stb; VALUE waits for the unit's latency + 1
// Throughput an access every two clocks
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_wishbone #(
    parameter UNIT = 1, // 0: taylor, 1: shift7, 2: shift3, 3: energy
    parameter SQUARINGS = 1, // log2 of the order, 1 .. 4; for taylor and energy
    parameter RESULT = 16, // bits of the value: 16, 12, 10 or 8
    parameter ROUND = 0, // 0: fast; 1: near, half the error for one more adder (RESULT 16)
    parameter LAMBDA = 0, // 0: ANGLE is the cosine; 1: it is 1 - cosine
    parameter ROWS = 1, // adder rows between two registers, 1 or more
    parameter SEGMENT = 0, // 0, or the longest carry chain in columns
    parameter DSP = 0 // 1: multipliers of the chip; 0: rows of adders
) (
    input wire clk, // CLK_I, rising edge
    input wire reset, // RST_I; at least one clock after power-up
    input wire cyc, // CYC_I
    input wire stb, // STB_I
    input wire we, // WE_I
    input wire [1:0] adr, // ADR_I, counts words
    input wire [3:0] sel, // SEL_I, for writes
    input wire [31:0] dat_w, // DAT_I
    output reg [31:0] dat_r, // DAT_O
    output reg ack, // ACK_O, one clock
    output reg err // ERR_O, one clock: the access can't be done
);
    localparam WIDTH = LAMBDA != 0 ? 24 : 16;
    generate
        if (UNIT > 3) begin : refused_unit
            burnish_parameter_UNIT_must_be_0_to_3 refused ();
        end
    endgenerate
    reg [9:0] exponent;
    reg [11:0] unread;
    wire s_ready, m_valid, unused_user;
    wire [RESULT-1:0] value;
    // ack and err are registers: the clock in which one is 1 ends a cycle and begins none.
    wire begun = cyc && stb && !ack && !err;
    wire starts = begun && we && adr == 2'd1 && sel[1:0] == 2'd3 && (LAMBDA == 0 || sel[2]);
    wire reads = begun && !we && adr == 2'd2;
    // With a value waiting, the stream rejects a word only while it is full.
    wire full = m_valid && !s_ready;
    wire refused = begun && (we ? (adr == 2'd1 ? !starts || full : adr != 2'd0)
                                : (adr == 2'd1 || (adr == 2'd2 && unread == 12'd0)));
    wire waits = (starts && !s_ready) || (reads && !m_valid);
    wire taken = starts && s_ready;
    wire given = reads && m_valid;
    burnish_stream #(.UNIT(UNIT), .SQUARINGS(SQUARINGS), .RESULT(RESULT), .ROUND(ROUND),
        .LAMBDA(LAMBDA), .ROWS(ROWS), .SEGMENT(SEGMENT), .DSP(DSP)) stream (
        .clk(clk), .reset(reset), .s_valid(starts), .s_ready(s_ready), .s_exponent(exponent),
        .s_angle(dat_w[WIDTH-1:0]), .s_user(1'b0), .m_valid(m_valid), .m_ready(reads), .m_value(value),
        .m_user(unused_user));
    always @(posedge clk)
        if (reset) begin
            exponent <= 10'd16;
            unread <= 12'd0;
            ack <= 1'b0;
            err <= 1'b0;
        end else begin
            ack <= begun && !refused && !waits;
            err <= refused;
            unread <= unread + {11'd0, taken} - {11'd0, given};
            if (begun && we && adr == 2'd0) begin
                if (sel[0]) exponent[7:0] <= dat_w[7:0];
                if (sel[1]) exponent[9:8] <= dat_w[9:8];
            end
            case (adr)
                2'd0: dat_r <= {22'd0, exponent};
                2'd2: dat_r <= {{32 - RESULT{1'b0}}, value};
                2'd3: dat_r <= {16'hB115, unread, 2'd0, s_ready, m_valid};
                default: dat_r <= 32'd0;
            endcase
        end
    wire unused = &{1'b0, dat_w, sel};
endmodule
`default_nettype wire
