// power_tables: c^n to 8 bits from interpolated tables of logarithm and exponential.
//
//     c = 2^-k (1 + f):  l = k - log2(1 + f) in UQ4.20,  x = n l in UQ14.16,
//     value = floor((2^16 2^-frac(x) / 2^int(x) + 2^7) / 2^8), at most 255
//
// Tables of 256 words of 32 bits each: log2 and exp2, 16 bits and the difference to the next entry each.
//
// Latency    10
// Throughput one lobe per clock
// Memory     2 times 256 words of 32 bits;  three multipliers
// Ports      as burnish_taylor
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module power_tables #(
    parameter LOG = "power_log.mem",
    parameter EXP = "power_exp.mem"
) (
    input wire clk,
    input wire enable,
    input wire [9:0] exponent,
    input wire [15:0] angle,
    input wire user_in,
    output wire [7:0] value,
    output wire user_out
);
    // A word: {value, difference to the next}.
    reg [31:0] log_table[0:255];
    reg [31:0] exp_table[0:255];
    initial begin
        $readmemh(LOG, log_table);
        $readmemh(EXP, exp_table);
    end

    // 1: the leading one. c = 1 and 0 are handled at the end.
    reg [15:0] c;
    reg [3:0] top;
    integer i;
    always @* begin
        top = 4'd0;
        for (i = 1; i < 15; i = i + 1) if (c[i]) top = i[3:0];
    end
    reg [9:0] n_0, n_1, n_2, n_3, n_4;
    reg [14:0] lifted;
    reg [3:0] k_2, k_3, k_4;
    reg [7:0] flags_one, flags_zero;
    reg [31:0] log_word, exp_word;
    reg [5:0] low_3;
    reg [21:0] log_step;
    reg [15:0] log_base;
    reg [19:0] l;
    reg [29:0] x;
    reg [8:0] low_7;
    reg [10:0] whole_7, whole_8, whole_9;
    reg [24:0] exp_step;
    reg [15:0] exp_base;
    reg [16:0] e;
    reg [7:0] result;
    wire [19:0] log_up = {4'd0, log_base} + {4'd0, log_step[21:6]};
    wire [16:0] e_shift = e >> whole_9[3:0];
    wire [9:0] rounded = {1'b0, e_shift[16:8]} + {9'd0, e_shift[7]};
    always @(posedge clk)
        if (enable) begin
            c <= angle;
            n_0 <= exponent;

            lifted <= c[14:0] << (4'd14 - top); /* leading one at bit 14 */
            k_2 <= 4'd15 - top;
            flags_one <= {flags_one[6:0], c[15]};
            flags_zero <= {flags_zero[6:0], c == 16'd0};
            n_1 <= n_0;

            log_word <= log_table[lifted[13:6]];
            low_3 <= lifted[5:0];
            k_3 <= k_2;
            n_2 <= n_1;

            log_step <= log_word[15:0] * low_3;
            log_base <= log_word[31:16];
            k_4 <= k_3;
            n_3 <= n_2;

            l <= {k_4, 16'd0} - log_up;
            n_4 <= n_3;

            x <= n_4 * l;

            exp_word <= exp_table[x[15:8]];
            low_7 <= {1'b0, x[7:0]};
            whole_7 <= x[26:16] | {11{|x[29:27]}};

            exp_step <= exp_word[15:0] * low_7;
            exp_base <= exp_word[31:16];
            whole_8 <= whole_7;

            e <= {1'b0, exp_base} + 17'd1 - {1'b0, exp_step[23:8]};
            whole_9 <= whole_8;

            result <= flags_one[7] ? 8'd255
                : flags_zero[7] || |whole_9[10:4] ? 8'd0
                : |rounded[9:8] ? 8'd255 : rounded[7:0];
        end
    assign value = result;
    burnish_delay #(.WIDTH(1), .DEPTH(10)) user (
        .clk(clk), .enable(enable), .in(user_in), .out(user_out));
endmodule
