// demo_span_map: the teapot's normals in memory that the bitstream fills, of each row only what lies between the first and
// the last that is not 0: 18432 words instead of 32768, which an ECP5 of 12,000 or 25,000 cells has room for.
//
// Latency    2, in a row that is addressed for two clocks or more
// Parameters SPANS    per row {9 bits count, 8 bits first column, 15 bits place of the word of column 0, modulo 2^15}
//            NORMALS  the words of all rows
// Ports      as demo's map
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_span_map #(
    parameter SPANS = "spans.mem",
    parameter NORMALS = "normals.mem"
) (
    input wire clk,
    input wire [14:0] address,
    output wire [31:0] data
);
    reg [31:0] spans[0:127];
    reg [31:0] normals[0:18431];
    initial begin
        $readmemh(SPANS, spans);
        $readmemh(NORMALS, normals);
    end

    reg [31:0] span, word;
    reg [14:0] place;
    reg held, held_2;
    wire [7:0] across = address[7:0] - span[22:15];
    always @(posedge clk) begin
        span <= spans[address[14:8]];
        place <= span[14:0] + {7'd0, address[7:0]};
        held <= address[7:0] >= span[22:15] && {1'b0, across} < span[31:23];
        word <= normals[place];
        held_2 <= held;
    end
    assign data = held_2 ? word : 32'd0;
endmodule
`default_nettype wire
