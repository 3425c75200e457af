// demo_flash_map: the teapot's normals in the four single-port memories of an iCE40 UP5K, filled from SPI flash.
//
// After power-up the flash is woken (0xAB), then 2^17 bytes are read (0x03) from ADDRESS on, most significant byte of a
// word first; then the map can be read. The flash sees half the clock.
//
// Latency    2
// Parameters ADDRESS  of the first byte;  WORDS  of 32 bits: less in tests
// Ports      address, data  as demo's map, once loaded is 1;  the others are the flash memory's
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module demo_flash_map #(
    parameter [23:0] ADDRESS = 24'h020000,
    parameter [15:0] WORDS = 16'h8000
) (
    input wire clk,
    input wire [14:0] address,
    output reg [31:0] data,
    output wire loaded,
    output reg select_n,
    output reg clock,
    output wire to_flash,
    input wire from_flash
);
    // 0: power-up, 1: the command to wake, 2: a pause, 3: the command to read, 4: the words, 5: done
    reg [2:0] state;
    reg [9:0] count;
    reg [31:0] shift;
    reg [15:0] word;
    reg write;
    initial begin
        state = 3'd0;
        count = 10'd0;
        select_n = 1'b1;
        clock = 1'b0;
        word = 16'd0;
        write = 1'b0;
    end
    assign to_flash = shift[31];
    assign loaded = state == 3'd5;
    wire busy = !select_n;
    always @(posedge clk) begin
        write <= 1'b0;
        // The flash reads a bit as its clock rises and changes its own as it falls.
        if (busy) clock <= !clock;
        if (busy && clock) shift <= {shift[30:0], from_flash};
        if (!busy || clock) count <= count - 10'd1;
        if (write) word <= word + 16'd1;
        case (state)
            3'd0: if (count == 10'd1) begin
                state <= 3'd1;
                select_n <= 1'b0;
                shift <= {8'hAB, 24'd0};
                count <= 10'd8;
            end
            3'd1: if (clock && count == 10'd1) begin
                state <= 3'd2;
                select_n <= 1'b1;
                count <= 10'd0;
            end
            3'd2: if (count == 10'd1) begin
                state <= 3'd3;
                select_n <= 1'b0;
                shift <= {8'h03, ADDRESS};
                count <= 10'd32;
            end
            3'd3: if (clock && count == 10'd1) begin
                state <= 3'd4;
                count <= 10'd32;
            end
            3'd4: if (clock && count == 10'd1) begin
                count <= 10'd32;
                write <= 1'b1;
                if (word == WORDS - 16'd1) begin
                    state <= 3'd5;
                    select_n <= 1'b1;
                end
            end
            default: select_n <= 1'b1;
        endcase
    end

    wire [14:0] place = loaded && !write ? address : word[14:0];
    wire [31:0] low, high;
    reg upper;
    genvar k;
    generate
        for (k = 0; k < 2; k = k + 1) begin : half
            SB_SPRAM256KA lower_words (
                .ADDRESS(place[13:0]), .DATAIN(shift[16*k+:16]), .MASKWREN(4'b1111),
                .WREN(write && !place[14]), .CHIPSELECT(1'b1), .CLOCK(clk), .STANDBY(1'b0),
                .SLEEP(1'b0), .POWEROFF(1'b1), .DATAOUT(low[16*k+:16]));
            SB_SPRAM256KA upper_words (
                .ADDRESS(place[13:0]), .DATAIN(shift[16*k+:16]), .MASKWREN(4'b1111),
                .WREN(write && place[14]), .CHIPSELECT(1'b1), .CLOCK(clk), .STANDBY(1'b0),
                .SLEEP(1'b0), .POWEROFF(1'b1), .DATAOUT(high[16*k+:16]));
        end
    endgenerate
    always @(posedge clk) begin
        upper <= place[14];
        data <= upper ? high : low;
    end
endmodule
`default_nettype wire
