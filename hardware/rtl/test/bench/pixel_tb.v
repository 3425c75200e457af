// pixel_tb: the units from vectors to a pixel (pixel.v) against the C core's values (vectors.mem of pixel_vectors.cpp), a vector
// a clock, with a clock that is disabled at random.
//
// UNITS  those of them that are compared: bit k is the k-th of pixel.v
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
`timescale 1ns / 1ns
module pixel_tb;
    parameter UNITS = 65535;
    parameter ROWS = 1;
    parameter DSP = 1;
    parameter COUNT = 64;
    wire [15:0] chosen = UNITS;
    localparam RESULTS = 16 * 48 + 16, INPUTS = 48 * 2 + 16 * 3 + 8 * 48 + 48;

    reg [INPUTS+RESULTS-1:0] vectors[0:COUNT-1];
    reg clk = 0, enable = 0;
    integer sent = 0, failures = 0, compared = 0, k;
    integer got[0:15];
    wire [INPUTS-1:0] in = vectors[sent % COUNT][RESULTS+:INPUTS];
    wire [47:0] a, b, sum, diffuse_2, diffuse_1, specular_2, specular_1, light_2, light_1, half_2, half_1;
    wire [15:0] exponent, slope;
    wire [3:0] none, lit, narrow, shift;
    assign {a, b, exponent, slope, none, lit, narrow, shift, light_2, half_2, diffuse_2, specular_2, light_1, half_1, diffuse_1,
        specular_1, sum} = in;
    wire [16*48-1:0] values;
    wire [15:0] users;
    wire [1:0] lights;
    pixel #(.ROWS(ROWS), .DSP(DSP)) unit (
        .clk(clk), .enable(enable), .user(sent < COUNT), .a(a), .b(b), .exponent(exponent[9:0]), .narrow(narrow[0]),
        .shift(shift), .slope(slope), .lit(lit[0]), .light({light_2, light_1}), .half({half_2, half_1}),
        .diffuse({diffuse_2, diffuse_1}), .specular({specular_2, specular_1}), .sum(sum), .values(values), .users(users),
        .lights(lights));

    always #5 clk = !clk;

    task compare(input integer which);
        reg [RESULTS-1:0] wanted;
        begin
            wanted = vectors[got[which]][RESULTS-1:0];
            if (wanted[16*48+which]) begin
                compared = compared + 1;
                if (values[48*which+:48] !== wanted[48*which+:48]) begin
                    failures = failures + 1;
                    if (failures < 5)
                        $display("pixel_tb: unit %0d, vector %0d: %h, the C core has %h", which, got[which],
                            values[48*which+:48], wanted[48*which+:48]);
                end
            end
            got[which] = got[which] + 1;
        end
    endtask

    initial begin
        $readmemh("vectors.mem", vectors);
        for (k = 0; k < 16; k = k + 1) got[k] = 0;
        while (sent < COUNT + 300) begin
            enable = $random;
            @(posedge clk);
            #1;
            if (enable) begin
                for (k = 0; k < 16; k = k + 1)
                    if (users[k] === 1'b1 && chosen[k]) compare(k);
                    else if (users[k] !== 1'b0 && users[k] !== 1'b1) begin
                        failures = failures + 1;
                        if (failures < 5) $display("pixel_tb: unit %0d: its user bit is unknown", k);
                    end
                sent = sent + 1;
            end
            @(negedge clk);
        end
        for (k = 0; k < 16; k = k + 1)
            if (chosen[k] && got[k] != COUNT) begin
                failures = failures + 1;
                $display("pixel_tb: unit %0d: %0d of %0d vectors came out", k, got[k], COUNT);
            end
        if (failures == 0 && compared > 0) $display("pixel_tb: passed: %0d values", compared);
        $finish;
    end
endmodule
`default_nettype wire
