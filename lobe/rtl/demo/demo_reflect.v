// demo_reflect: N.L from N.H, with one product.
//
//     L is the viewer's V, mirrored by H:  N.L = 2 (N.H) (H.V) - N.V;  with V along z  2 (N.H) h_z - n_z
//
// Bit for bit burnish_q15_reflect_cosine(n_dot_h, h_z, n_z << 15) of include/burnish/shade_q15.h.
//
// Latency    8
// Throughput one per clock
// Ports      n_dot_h  UQ1.15;  h_z, n_z  Q15, not negative;  n_dot_l  UQ1.15, 0 where it is negative
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_reflect (
    input wire clk,
    input wire [15:0] n_dot_h,
    input wire [15:0] h_z,
    input wire [15:0] n_z,
    output reg [15:0] n_dot_l
);
    wire [31:0] both;
    wire [15:0] n_z_now;
    burnish_times #(.A_WIDTH(16), .B_WIDTH(16), .ROWS(3)) times (
        .clk(clk), .enable(1'b1), .a(n_dot_h), .b(h_z), .product(both));
    burnish_delay #(.WIDTH(16), .DEPTH(6)) wait_z (
        .clk(clk), .enable(1'b1), .in(n_z), .out(n_z_now));
    // Half of N.L in units of 2^14; n_z has no bits below them, so rounding looks at one bit of the product.
    reg [17:0] half;
    reg above;
    always @(posedge clk) begin
        half <= {1'b0, both[30:14]} - {2'b0, n_z_now};
        above <= both[13];
        n_dot_l <= half[17] ? 16'd0 : half[16:15] != 2'd0 ? 16'h8000 : half[15:0] + {15'd0, above};
    end
    wire unused = &{1'b0, both[31], both[12:0]};
endmodule
`default_nettype wire
