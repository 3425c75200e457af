// burnish_square: t t + offset by a folded squarer.
//
//     square = t^2 + offset
//
// One row per bit of t, lowest first: t_i ? prior + 4^i (4 (t >> (i+1)) + 1) : prior. Each product of two
// different bits appears once, at twice its weight, which halves a multiplier.
//
//     clock    upper segment        lower segment      with ROWS 1 and two segments: rows of one
//       1                           row 0              sum, the carry into a row's upper half coming
//       2      row 0 and carry      row 1              from its lower half, one clock earlier. At the
//       3      row 1 and carry      row 2              end the lower half waits for the upper one.
//      ...
//
// Latency    (WIDTH - 1) / ROWS + SEGMENTS, SEGMENTS = ceil(2 WIDTH / SEGMENT) or 1; with DSP 1
// Throughput one square per clock
// Parameters WIDTH    bits of t
//            ROWS     adder rows between two registers
//            SEGMENT  0, or columns between two carry registers; see burnish_product
//            DSP      1: burnish_multiplier, for chips with multipliers
// Ports      offset   WIDTH + 1 bits, at most 2^(WIDTH + 1) - 2; for rounding; 0 costs nothing
//            square   registered; bits that are not read cost little
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_square #(
    parameter WIDTH = 16,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0
) (
    input wire clk,
    input wire enable,
    input wire [WIDTH-1:0] t,
    input wire [WIDTH:0] offset,
    output wire [2*WIDTH-1:0] square
);
    localparam COLUMNS = 2 * WIDTH;
    localparam STEP = ROWS < 1 ? 1 : ROWS;  // burnish_parameters refuses what is illegal, with a name
    localparam SPAN = SEGMENT < 1 ? COLUMNS : SEGMENT;
    localparam SEGMENTS = (COLUMNS + SPAN - 1) / SPAN;
    localparam CLOCKS = (WIDTH - 1) / STEP + SEGMENTS;

    genvar k, i, s;
    generate
        if (DSP != 0) begin : multiplier
            burnish_multiplier #(.A_WIDTH(WIDTH), .B_WIDTH(WIDTH), .ADD(1)) multiply (
                .clk(clk), .enable(enable), .a(t), .b(t),
                .addend({{WIDTH - 1{1'b0}}, offset}), .product(square));
        end else begin : rows
        for (k = 0; k < CLOCKS; k = k + 1) begin : at
            wire [WIDTH-1:0] t_now;
            wire [COLUMNS-1:0] offset_now;
            if (k == 0) begin : first
                assign t_now = t;
                assign offset_now = {{WIDTH - 1{1'b0}}, offset};
            end else begin : next
                reg [WIDTH-1:0] t_kept;
                reg [COLUMNS-1:0] offset_kept;
                always @(posedge clk)
                    if (enable) begin
                        t_kept <= at[k-1].t_now;
                        offset_kept <= at[k-1].offset_now;
                    end
                assign t_now = t_kept;
                assign offset_now = offset_kept;
            end
            wire unused = &{1'b0, t_now, offset_now};
        end

        for (s = 0; s < SEGMENTS; s = s + 1) begin : segment
            localparam LOW = s * SPAN;
            localparam HIGH = (LOW + SPAN > COLUMNS ? COLUMNS : LOW + SPAN) - 1;
            localparam PARTS = HIGH - LOW + 1;

            for (i = 0; i < WIDTH; i = i + 1) begin : row
                localparam NOW = i / STEP + s;
                localparam REGISTERED = (i + 1) % STEP == 0 || i == WIDTH - 1;
                // The row's columns: from 2i to the one after t's top bit, for the carry.
                localparam FIRST = 2 * i;
                localparam LAST = WIDTH + 1 + i > COLUMNS - 1 ? COLUMNS - 1 : WIDTH + 1 + i;
                localparam FROM = FIRST > LOW ? FIRST : LOW;
                localparam TO = LAST < HIGH ? LAST : HIGH;
                wire bit_now = at[NOW].t_now[i];
                wire [WIDTH-1:0] others = at[NOW].t_now >> (i + 1);
                wire [2*COLUMNS+1:0] placed =
                    {{2 * COLUMNS - WIDTH{1'b0}}, others, 2'b01} << FIRST;
                wire [PARTS-1:0] prior, after;
                wire carry;

                if (i == 0) begin : start
                    assign prior = at[NOW].offset_now[HIGH:LOW];
                end else begin : more
                    assign prior = row[i-1].kept;
                end
                if (FROM > TO) begin : finished
                    assign after = prior;
                    assign carry = 1'b0;
                end else begin : sum
                    localparam PART = TO - FROM + 1;
                    wire [PART-1:0] a = prior[TO-LOW:FROM-LOW];
                    wire [PART-1:0] b = placed[TO:FROM];
                    wire [PART:0] total;
                    wire unused_b = b[0]; /* where it is the carry in */
                    if (FIRST >= LOW) begin : fresh
                        // The lowest column's 1 is the carry in.
                        if (PART > 1) begin : wide
                            wire unused_low;
                            assign {total, unused_low} =
                                {1'b0, a, 1'b1} + {1'b0, b[PART-1:1], 2'b01};
                        end else begin : narrow
                            assign total = {1'b0, a} + {1'b0, b};
                        end
                    end else begin : carried
                        wire unused_low;
                        assign {total, unused_low} = {1'b0, a, 1'b1} +
                            {1'b0, b, segment[s-1].row[i].carry_kept};
                    end
                    assign carry = total[PART];
                    assign after[TO-LOW:FROM-LOW] = bit_now ? total[PART-1:0] : a;
                    if (FROM > LOW) begin : low
                        assign after[FROM-LOW-1:0] = prior[FROM-LOW-1:0];
                    end
                    if (TO < HIGH) begin : high
                        assign after[PARTS-1:TO-LOW+1] = prior[PARTS-1:TO-LOW+1];
                    end
                end

                reg carry_kept;
                always @(posedge clk) if (enable) carry_kept <= carry;
                wire [PARTS-1:0] kept;
                if (REGISTERED) begin : registered
                    reg [PARTS-1:0] sum_register;
                    always @(posedge clk) if (enable) sum_register <= after;
                    assign kept = sum_register;
                end else begin : passed
                    assign kept = after;
                end
                wire unused = &{1'b0, bit_now, placed, prior, carry_kept};
            end
            burnish_delay #(.WIDTH(PARTS), .DEPTH(SEGMENTS - 1 - s)) align (
                .clk(clk), .enable(enable), .in(row[WIDTH-1].kept), .out(square[HIGH:LOW]));
        end
        end
    endgenerate
endmodule
`default_nettype wire
