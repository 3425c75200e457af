// burnish_product: slope times u by conditional additions, limited to KEEP bits.
//
//     product = (slope u) mod 2^KEEP,  over = slope u >= 2^KEEP
//
// One row per bit of the slope, lowest first: prior + (u << i) where the bit is 1, else prior. Selecting
// after the sum, instead of masking u before it, lets one adder cell do both. Columns from KEEP up are
// never summed: over follows from the bits of u in those columns, or a carry.
//
//     clock    upper segment        lower segment      with ROWS 1 and two segments: rows of one
//       1                           row 0              sum, the carry into a row's upper half coming
//       2      row 0 and carry      row 1              from its lower half, one clock earlier. At the
//       3      row 1 and carry      row 2              end the lower half waits for the upper one.
//      ...
//
// Latency    (SLOPE_WIDTH - 1) / ROWS + SEGMENTS, SEGMENTS = ceil(KEEP / SEGMENT) or 1
// Throughput one product per clock
// Parameters SLOPE_WIDTH, U_WIDTH  bits of the factors
//            KEEP     bits of the product, at least U_WIDTH
//            ROWS     adder rows between two registers: 1 gives the highest clock, 2 saves flip-flops
//            SEGMENT  0, or columns between two carry registers: a row's upper part is computed one
//                     clock after its lower part, so no carry chain is longer than this
// Ports      slope, u read in the same clock; product, over registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_product #(
    parameter SLOPE_WIDTH = 10,
    parameter U_WIDTH = 16,
    parameter KEEP = 17,
    parameter ROWS = 1,
    parameter SEGMENT = 0
) (
    input wire clk,
    input wire enable,
    input wire [SLOPE_WIDTH-1:0] slope,
    input wire [U_WIDTH-1:0] u,
    output wire [KEEP-1:0] product,
    output wire over
);
    localparam STEP = ROWS < 1 ? 1 : ROWS;  // burnish_parameters refuses what is illegal, with a name
    localparam SPAN = SEGMENT < 1 ? KEEP : SEGMENT;
    localparam SEGMENTS = (KEEP + SPAN - 1) / SPAN;
    localparam CLOCKS = (SLOPE_WIDTH - 1) / STEP + SEGMENTS;  // of the last row's last segment

    // The factors of every clock; synthesis removes what no row reads.
    genvar t, r, s;
    generate
        for (t = 0; t < CLOCKS; t = t + 1) begin : at
            wire [SLOPE_WIDTH-1:0] slope_now;
            wire [U_WIDTH-1:0] u_now;
            if (t == 0) begin : first
                assign slope_now = slope;
                assign u_now = u;
            end else begin : next
                reg [SLOPE_WIDTH-1:0] slope_kept;
                reg [U_WIDTH-1:0] u_kept;
                always @(posedge clk)
                    if (enable) begin
                        slope_kept <= at[t-1].slope_now;
                        u_kept <= at[t-1].u_now;
                    end
                assign slope_now = slope_kept;
                assign u_now = u_kept;
            end
            wire unused = &{1'b0, slope_now, u_now};
        end

        for (s = 0; s < SEGMENTS; s = s + 1) begin : segment
            localparam LOW = s * SPAN;
            localparam HIGH = (LOW + SPAN > KEEP ? KEEP : LOW + SPAN) - 1;
            localparam WIDTH = HIGH - LOW + 1;
            localparam TOP = s == SEGMENTS - 1;

            for (r = 0; r < SLOPE_WIDTH; r = r + 1) begin : row
                localparam NOW = r / STEP + s;
                localparam FROM = r > LOW ? r : LOW;  // the lowest column that changes
                localparam REGISTERED = (r + 1) % STEP == 0 || r == SLOPE_WIDTH - 1;
                wire bit_now = at[NOW].slope_now[r];
                // u in this row's columns, and whether it exceeds the last.
                wire [KEEP+SLOPE_WIDTH+U_WIDTH-1:0] placed =
                    {{KEEP + SLOPE_WIDTH{1'b0}}, at[NOW].u_now} << r;
                wire [WIDTH-1:0] prior, after;
                wire carry;  // out of the segment, whatever the bit
                wire over_prior, over_after, beyond;

                if (r == 0) begin : start
                    assign prior = {WIDTH{1'b0}};
                    assign over_prior = 1'b0;
                    assign carry = 1'b0;
                    assign after = bit_now ? placed[HIGH:LOW] : {WIDTH{1'b0}};
                    assign beyond = 1'b0;
                end else begin : add
                    assign prior = row[r-1].kept;
                    assign over_prior = row[r-1].over_kept;
                    if (FROM > HIGH) begin : finished
                        assign after = prior;
                        assign carry = 1'b0;
                    end else begin : sum
                        localparam PART = HIGH - FROM + 1;
                        wire [PART-1:0] a = prior[WIDTH-1:FROM-LOW];
                        wire [PART-1:0] b = placed[HIGH:FROM];
                        wire [PART:0] total;
                        if (s > 0 && r < LOW) begin : carried
                            wire unused_low;
                            assign {total, unused_low} = {1'b0, a, 1'b1} +
                                {1'b0, b, segment[s-1].row[r].carry_kept};
                        end else begin : fresh
                            assign total = {1'b0, a} + {1'b0, b};
                        end
                        assign carry = total[PART];
                        assign after[WIDTH-1:FROM-LOW] =
                            bit_now ? total[PART-1:0] : a;
                        if (FROM > LOW) begin : low
                            assign after[FROM-LOW-1:0] = prior[FROM-LOW-1:0];
                        end
                    end
                    // Grows by one bit of u per row.
                    if (r > KEEP - U_WIDTH) begin : reaches
                        assign beyond = row[r-1].beyond_kept | at[NOW].u_now[KEEP-r];
                    end else begin : no_reach
                        assign beyond = 1'b0;
                    end
                end
                assign over_after = TOP != 0 && (over_prior | (bit_now & (beyond | carry)));

                reg carry_kept;
                always @(posedge clk) if (enable) carry_kept <= carry;
                wire [WIDTH-1:0] kept;
                wire over_kept, beyond_kept;
                if (REGISTERED) begin : registered
                    reg [WIDTH-1:0] sum_register;
                    reg over_register, beyond_register;
                    always @(posedge clk)
                        if (enable) begin
                            sum_register <= after;
                            over_register <= over_after;
                            beyond_register <= beyond;
                        end
                    assign kept = sum_register;
                    assign over_kept = over_register;
                    assign beyond_kept = beyond_register;
                end else begin : passed
                    assign kept = after;
                    assign over_kept = over_after;
                    assign beyond_kept = beyond;
                end
                wire unused = &{1'b0, bit_now, placed, prior, carry_kept, over_kept, beyond_kept};
            end
            burnish_delay #(.WIDTH(WIDTH), .DEPTH(SEGMENTS - 1 - s)) align (
                .clk(clk), .enable(enable), .in(row[SLOPE_WIDTH-1].kept), .out(product[HIGH:LOW]));
        end
    endgenerate
    assign over = segment[SEGMENTS-1].row[SLOPE_WIDTH-1].over_kept;
endmodule
`default_nettype wire
