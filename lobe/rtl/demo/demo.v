// demo: two spheres and two teapots under a moving light, a lobe on the left and another on the right.
//
// One pixel a clock without a frame buffer: what is at a pixel follows from its column and row, its normal from a table
// or a map, its light from one dot product, N.H; see demo_reflect for N.L.
//
// Clock      25.175 MHz for 640 x 480 at 60 Hz; monitors take 25 to 25.2
// Latency    37 clocks from column to colour
// Parameters TABLES  prefix of the tables' files
// Ports      buttons      {hold the light, next exponent, next lobe on the right, on the left}: 1 while pressed,
//                         not synchronous; sampled 60 times a second, which hides that they bounce
//            map_address  {row, column} of the teapot's normal;  map_data  {10 bits z, 11 bits y, 11 bits x}, two
//                         clocks later, in 1024ths; 0 where there is no teapot
//            red, green, blue  sRGB codes, valid while visible is 1, else 0
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo (
    input wire clk,
    input wire [3:0] buttons,
    output reg [14:0] map_address,
    input wire [31:0] map_data,
    output wire [7:0] red,
    output wire [7:0] green,
    output wire [7:0] blue,
    output wire hsync,
    output wire vsync,
    output wire visible
);
    wire [9:0] column, row;
    wire frame;
    demo_sync #(.LATENCY(10'd37)) sync (
        .clk(clk), .column(column), .row(row), .frame(frame), .hsync(hsync), .vsync(vsync),
        .visible(visible));

    // ---- What changes with a picture ----
    wire [1:0] left, right;
    wire [3:0] exponent_index;
    wire [9:0] exponent;
    wire [47:0] half;
    demo_state state (
        .clk(clk), .frame(frame), .buttons(buttons), .left(left), .right(right),
        .exponent_index(exponent_index), .exponent(exponent), .half(half));

    // ---- What is at a pixel: column minus a constant is the pixel that a stage works on ----
    function [10:0] x_of(input [9:0] pixel); // 256ths of the sphere's radius
        x_of = {pixel, 1'b1} - (pixel < 10'd320 ? 11'd320 : 11'd960);
    endfunction

    reg [9:0] at_6, at_8, at_30, at_32;
    always @(posedge clk) begin
        at_6 <= column - 10'd5;
        at_8 <= column - 10'd7;
        at_30 <= column - 10'd29;
        at_32 <= column - 10'd31;
    end

    // 1: the sphere; 9: its normal
    reg [10:0] x_1, y_1;
    reg [8:0] x_9;
    wire [10:0] x_of_8 = x_of(at_8);
    wire [15:0] sphere_z;
    wire sphere_hit;
    always @(posedge clk) begin
        x_1 <= x_of(column);
        y_1 <= 11'd299 - {row, 1'b0};
        x_9 <= x_of_8[8:0];
    end
    wire unused = &{1'b0, x_of_8[10:9]};
    demo_sphere sphere (.clk(clk), .x(x_1), .y(y_1), .z(sphere_z), .hit(sphere_hit));

    // 7: the map's address; 9: its word
    wire [9:0] map_column = at_6 - (at_6 < 10'd320 ? 10'd32 : 10'd352);
    wire [9:0] map_row = row - 10'd312;
    reg in_map_7, in_map_8, in_map_9;
    always @(posedge clk) begin
        map_address <= {map_row[6:0], map_column[7:0]};
        in_map_7 <= map_column[9:8] == 2'd0 && map_row[9:7] == 3'd0;
        in_map_8 <= in_map_7;
        in_map_9 <= in_map_8;
    end

    // 10: the normal
    reg [47:0] normal;
    reg [1:0] object_10;
    wire map_hit = in_map_9 && map_data != 32'd0;
    always @(posedge clk) begin
        normal <= map_hit ? {1'b0, map_data[31:22], 5'd0, map_data[21:11], 5'd0, map_data[10:0], 5'd0}
            : {sphere_z, {y_1[8:0], 7'd0}, {x_9, 7'd0}};
        object_10 <= {map_hit, sphere_hit && !map_hit};
    end

    // 15: N.H; 23: N.L; 32: the lobe
    wire [15:0] n_dot_h, z_15, n_dot_l_23, n_dot_l_32;
    wire [7:0] lobe;
    wire [1:0] object_32;
    burnish_dot #(.DSP(1)) dot (
        .clk(clk), .enable(1'b1), .a(normal), .b(half), .cosine(n_dot_h));
    burnish_delay #(.WIDTH(16), .DEPTH(5)) wait_z (
        .clk(clk), .enable(1'b1), .in(normal[47:32]), .out(z_15));
    demo_reflect reflect (
        .clk(clk), .n_dot_h(n_dot_h), .h_z(half[47:32]), .n_z(z_15), .n_dot_l(n_dot_l_23));
    burnish_delay #(.WIDTH(16), .DEPTH(9)) wait_n_dot_l (
        .clk(clk), .enable(1'b1), .in(n_dot_l_23), .out(n_dot_l_32));
    burnish_delay #(.WIDTH(2), .DEPTH(22)) wait_object (
        .clk(clk), .enable(1'b1), .in(object_10), .out(object_32));
    reg [1:0] choice;
    always @(posedge clk) choice <= at_30 < 10'd320 ? left : right;
    demo_lobes lobes (
        .clk(clk), .exponent(exponent), .cosine(n_dot_h), .choice(choice), .value(lobe));

    // 37: the colour
    wire ink_36, line_36;
    demo_label label (
        .clk(clk), .pixel(at_32), .row(row), .left(left), .right(right), .exponent_index(exponent_index), .ink(ink_36), .line(line_36));
    wire [7:0] red_37, green_37, blue_37;
    demo_color shade (
        .clk(clk), .object(object_32), .n_dot_l(n_dot_l_32), .lobe(lobe), .ink(ink_36), .line(line_36),
        .red(red_37), .green(green_37), .blue(blue_37));
    assign {red, green, blue} = visible ? {red_37, green_37, blue_37} : 24'd0;
endmodule
`default_nettype wire
