// demo_map: the teapot's normals in memory that the bitstream fills, for chips that have 128 KiB of it.
//
// Latency 2. Ports  as demo's map
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_map #(
    parameter FILE = "teapot.mem"
) (
    input wire clk,
    input wire [14:0] address,
    output reg [31:0] data
);
    reg [31:0] normals[0:32767];
    reg [31:0] word;
    initial $readmemh(FILE, normals);
    always @(posedge clk) begin
        word <= normals[address];
        data <= word;
    end
endmodule
`default_nettype wire
