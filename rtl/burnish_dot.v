// burnish_dot: the dot product of two Q15 vectors as a cosine.
//
//     sum = x x' + y y' + z z' (Q30, modulo 2^32),
//     cosine = sum <= 0 ? 0 : sum >= 0x3FFFC000 ? 0x8000 : (sum + 0x4000) >> 15
//
// Bit for bit burnish_q15_cosine(burnish_q15_dot(a, b)) of include/burnish/shade_q15.h.
//
// Latency    5
// Throughput one per clock
// Ports      a, b   {z, y, x}, Q15 each;  cosine UQ1.15, registered
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
module burnish_dot (
    input wire clk,
    input wire enable,
    input wire [47:0] a,
    input wire [47:0] b,
    output reg [15:0] cosine
);
    reg signed [15:0] ax, ay, az, bx, by, bz;
    reg signed [31:0] x, y, z, xy, z_kept, sum;
    wire [31:0] up = sum + 32'h4000;
    always @(posedge clk)
        if (enable) begin
            {az, ay, ax} <= a;
            {bz, by, bx} <= b;
            x <= ax * bx;
            y <= ay * by;
            z <= az * bz;
            xy <= x + y;
            z_kept <= z;
            sum <= xy + z_kept;
            cosine <= sum[31] ? 16'd0 : up[31:30] != 2'd0 ? 16'h8000 : {1'b0, up[29:15]};
        end
endmodule
