-- burnish_components: the modules of rtl/ for VHDL, as scripts/tables rtl-ports reads them from the Verilog.
--
-- Compile it with the Verilog in a tool that takes both languages.
--
-- SPDX-License-Identifier: MIT
-- Copyright (c) the burnish authors
library ieee;
use ieee.std_logic_1164.all;

package burnish_components is
    -- Widths that a parameter chooses.
    function choose(condition : boolean; yes, no : natural) return natural;

    component burnish_taylor is
        generic (
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(9 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_shift7 is
        generic (
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(9 downto 0);  -- n, 1 .. 1023
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_shift3 is
        generic (
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(9 downto 0);  -- n, 1 .. 1023
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_energy is
        generic (
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(9 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_zeta is
        generic (
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            slope : in std_logic_vector(15 downto 0);  -- 2 zeta = slope / 2^shift
            shift : in std_logic_vector(3 downto 0);  -- 0 .. 15
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_lobe is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor, energy and zeta
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(choose(UNIT = 4, 20, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {shift, slope}, 4 and 16 bits
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_boundary is
        generic (
            \FILE\ : string := "";  -- the memory's file, with words from exponent 1 on; empty: no boundary
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor and energy
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            exponent : in std_logic_vector(9 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on
            angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            busy : out std_logic;  -- 1: the lobe's registers are clocked
            value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_stream is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor, energy and zeta
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            OUTPUT : integer := 0;  -- 1: a register at the output, which alone sees m_ready
            USER_WIDTH : integer := 1  -- width of the user data: TLAST, TUSER, TID ...
        );
        port (
            clk : in std_logic;  -- rising edge
            reset : in std_logic;  -- 1: drops all words inside; at least one clock after power-up
            s_valid : in std_logic;  -- a word comes
            s_ready : out std_logic;  -- it is taken; a register
            s_exponent : in std_logic_vector(choose(UNIT = 4, 20, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {shift, slope}, 4 and 16 bits
            s_angle : in std_logic_vector(choose(LAMBDA /= 0, 24, 16) - 1 downto 0);  -- cosine UQ1.15, above 0x8000 is 1; LAMBDA 1: 1 - cosine UQ0.24
            s_user : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- travels with the word
            m_valid : out std_logic;  -- a result is there
            m_ready : in std_logic;  -- it is taken
            m_value : out std_logic_vector(RESULT - 1 downto 0);  -- UQ0.16, or its upper RESULT bits, rounded
            m_user : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- the word's s_user
        );
    end component;

    component burnish_axis is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor, energy and zeta
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: the angle is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            OUTPUT : integer := 0;  -- 1: a register at the output, which alone sees m_axis_tready
            USER_WIDTH : integer := 1  -- width of TUSER
        );
        port (
            aclk : in std_logic;  -- rising edge
            aresetn : in std_logic;  -- 0: drops all words inside; at least one clock after power-up
            s_axis_tvalid : in std_logic;  -- a word comes
            s_axis_tready : out std_logic;  -- it is taken; a register
            s_axis_tdata : in std_logic_vector(choose(UNIT = 4, 40, 32) + choose(LAMBDA /= 0, 8, 0) - 1 downto 0);  -- {exponent, angle}
            s_axis_tlast : in std_logic;  -- travels with the word
            s_axis_tuser : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- travels with the word
            m_axis_tvalid : out std_logic;  -- a result is there
            m_axis_tready : in std_logic;  -- it is taken
            m_axis_tdata : out std_logic_vector(choose(RESULT = 8, 8, 16) - 1 downto 0);  -- RESULT bits of the value, 0 above them
            m_axis_tlast : out std_logic;  -- the word's s_axis_tlast
            m_axis_tuser : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- the word's s_axis_tuser
        );
    end component;

    component burnish_register is
        generic (
            WIDTH : integer := 16  -- of a word
        );
        port (
            clk : in std_logic;  -- rising edge
            reset : in std_logic;  -- 1: drops both words; at least one clock after power-up
            s_valid : in std_logic;  -- a word comes
            s_ready : out std_logic;  -- it is taken
            s_word : in std_logic_vector(WIDTH - 1 downto 0);  -- any bits
            m_valid : out std_logic;  -- a word is there
            m_ready : in std_logic;  -- it is taken
            m_word : out std_logic_vector(WIDTH - 1 downto 0)  -- the oldest word inside
        );
    end component;

    component burnish_wishbone is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor and energy
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: ANGLE is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0  -- 1: multipliers of the chip; 0: rows of adders
        );
        port (
            clk : in std_logic;  -- CLK_I, rising edge
            reset : in std_logic;  -- RST_I; at least one clock after power-up
            cyc : in std_logic;  -- CYC_I
            stb : in std_logic;  -- STB_I
            we : in std_logic;  -- WE_I
            adr : in std_logic_vector(1 downto 0);  -- ADR_I, counts words
            sel : in std_logic_vector(3 downto 0);  -- SEL_I, for writes
            dat_w : in std_logic_vector(31 downto 0);  -- DAT_I
            dat_r : out std_logic_vector(31 downto 0);  -- DAT_O
            ack : out std_logic;  -- ACK_O, one clock
            err : out std_logic  -- ERR_O, one clock: the access can't be done
        );
    end component;

    component burnish_axi_lite is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4; for taylor and energy
            RESULT : integer := 16;  -- bits of the value: 16, 12, 10 or 8
            ROUND : integer := 0;  -- 0: fast; 1: near, half the error for one more adder (RESULT 16)
            LAMBDA : integer := 0;  -- 0: ANGLE is the cosine; 1: it is 1 - cosine
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0  -- 1: multipliers of the chip; 0: rows of adders
        );
        port (
            aclk : in std_logic;  -- rising edge
            aresetn : in std_logic;  -- 0: drops all values inside; at least one clock after power-up
            s_axi_awvalid : in std_logic;  -- a write's address comes
            s_axi_awready : out std_logic;  -- it is taken, in the clock in which the data is
            s_axi_awaddr : in std_logic_vector(3 downto 0);  -- counts bytes
            s_axi_awprot : in std_logic_vector(2 downto 0);  -- not read
            s_axi_wvalid : in std_logic;  -- a write's data comes
            s_axi_wready : out std_logic;  -- it is taken
            s_axi_wdata : in std_logic_vector(31 downto 0);  -- a register's bits
            s_axi_wstrb : in std_logic_vector(3 downto 0);  -- its bytes that are written
            s_axi_bvalid : out std_logic;  -- a write's response is there
            s_axi_bready : in std_logic;  -- it is taken
            s_axi_bresp : out std_logic_vector(1 downto 0);  -- 0: OKAY; 2: SLVERR, the access can't be done
            s_axi_arvalid : in std_logic;  -- a read's address comes
            s_axi_arready : out std_logic;  -- it is taken
            s_axi_araddr : in std_logic_vector(3 downto 0);  -- counts bytes
            s_axi_arprot : in std_logic_vector(2 downto 0);  -- not read
            s_axi_rvalid : out std_logic;  -- a read's response is there
            s_axi_rready : in std_logic;  -- it is taken
            s_axi_rdata : out std_logic_vector(31 downto 0);  -- the register
            s_axi_rresp : out std_logic_vector(1 downto 0)  -- 0: OKAY; 2: SLVERR, the access can't be done
        );
    end component;

    component burnish_pixel is
        generic (
            LIGHTS : integer := 1;  -- number of lights, 1 or more
            NORMALIZE : integer := 1;  -- 1: normal is nearly of unit length; 0: it is of unit length
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            NARROW : integer := 2;  -- 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
            HELD : integer := 1;  -- 1: light, half, diffuse and specular hold still while a pixel is inside: no delays for them
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            normal : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, as NORMALIZE says
            exponent : in std_logic_vector(choose(UNIT = 4, 21, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
            ambient : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each
            light : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light, the first lowest: {z, y, x}, Q15, unit vector to the light
            half : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {z, y, x}, Q15, unit vector halfway to the viewer
            diffuse : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {blue, green, red}, UQ1.15: light times surface
            specular : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {blue, green, red}, UQ1.15: light times surface
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            color : out std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each, limited to 0xFFFF
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_pixel_stream is
        generic (
            LIGHTS : integer := 1;  -- number of lights, 1 or more
            NORMALIZE : integer := 1;  -- 1: normal is nearly of unit length; 0: it is of unit length
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            NARROW : integer := 2;  -- 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
            HELD : integer := 1;  -- 1: light, half, diffuse and specular hold still while a pixel is inside; 0: they belong to the word
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            OUTPUT : integer := 1;  -- 1: a register at the output, which alone sees m_ready
            USER_WIDTH : integer := 1  -- width of the user data: a pixel's address, TLAST, TUSER ...
        );
        port (
            clk : in std_logic;  -- rising edge
            reset : in std_logic;  -- 1: drops all pixels inside; at least one clock after power-up
            s_valid : in std_logic;  -- a pixel comes
            s_ready : out std_logic;  -- it is taken; a register
            s_normal : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, as NORMALIZE says
            s_exponent : in std_logic_vector(choose(UNIT = 4, 21, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
            s_ambient : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each
            s_user : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- travels with the pixel
            light : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light, the first lowest: {z, y, x}, Q15, unit vector to the light
            half : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {z, y, x}, Q15, unit vector halfway to the viewer
            diffuse : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {blue, green, red}, UQ1.15: light times surface
            specular : in std_logic_vector(48*LIGHTS - 1 downto 0);  -- per light: {blue, green, red}, UQ1.15: light times surface
            m_valid : out std_logic;  -- a colour is there
            m_ready : in std_logic;  -- it is taken
            m_color : out std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each, limited to 0xFFFF
            m_user : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- the pixel's s_user
        );
    end component;

    component burnish_light is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            NARROW : integer := 2;  -- 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
            HELD : integer := 0;  -- 1: light, half, diffuse and specular hold still while a pixel is inside: no delays for them
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            normal : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector
            light : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector to the light
            half : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector halfway to the viewer
            exponent : in std_logic_vector(choose(UNIT = 4, 21, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
            diffuse : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15: light's colour times surface's
            specular : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15: light's colour times surface's
            sum_in : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            sum_out : out std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each, limited to 0xFFFF
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_channel is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            NARROW : integer := 2;  -- 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            normal : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector
            half : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector halfway to the viewer
            exponent : in std_logic_vector(choose(UNIT = 4, 21, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
            lit : in std_logic;  -- 1 where N.L > 0
            color : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15: light's colour times surface's
            sum_in : in std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            sum_out : out std_logic_vector(47 downto 0);  -- {blue, green, red}, UQ1.15 each, limited to 0xFFFF
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_highlight is
        generic (
            UNIT : integer := 1;  -- 0: taylor, 1: shift7, 2: shift3, 3: energy, 4: zeta
            SQUARINGS : integer := 1;  -- log2 of the order, 1 .. 4
            NARROW : integer := 2;  -- 0: cosine; 1: chord; 2: chord from exponent 32 on, as the C core
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0;  -- 1: multipliers of the chip; 0: rows of adders
            USER_WIDTH : integer := 1  -- width of user_in and user_out
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            normal : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector
            half : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector halfway to the viewer
            exponent : in std_logic_vector(choose(UNIT = 4, 21, 10) - 1 downto 0);  -- n, 1 .. 1023, at orders above 2 from the order on; UNIT 4: {chord, shift, slope}, 1, 4, 16 bits
            user_in : in std_logic_vector(USER_WIDTH - 1 downto 0);  -- a valid bit, a tag, a pixel's address
            value : out std_logic_vector(15 downto 0);  -- UQ0.16
            user_out : out std_logic_vector(USER_WIDTH - 1 downto 0)  -- user_in, delayed by the latency; 0 from power-up until then
        );
    end component;

    component burnish_dot is
        generic (
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0  -- 1: multipliers of the chip; 0: rows of adders
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            a : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15 each
            b : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15 each
            cosine : out std_logic_vector(15 downto 0)  -- UQ1.15, registered
        );
    end component;

    component burnish_chord is
        generic (
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0  -- 1: multipliers of the chip; 0: rows of adders
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            a : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector
            b : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, unit vector
            lambda : out std_logic_vector(23 downto 0)  -- 1 - cosine, UQ0.24, registered
        );
    end component;

    component burnish_normalize is
        generic (
            ROWS : integer := 1;  -- adder rows between two registers, 1 or more
            SEGMENT : integer := 0;  -- 0, or the longest carry chain in columns
            DSP : integer := 0  -- 1: multipliers of the chip; 0: rows of adders
        );
        port (
            clk : in std_logic;  -- rising edge
            enable : in std_logic;  -- 1: the pipeline advances; 0: nothing changes
            v : in std_logic_vector(47 downto 0);  -- {z, y, x}, Q15, of squared length 1/2 .. 3/2, such as a normal between vertices
            unit : out std_logic_vector(47 downto 0)  -- {z, y, x}, Q15, registered
        );
    end component;

end package;

package body burnish_components is
    function choose(condition : boolean; yes, no : natural) return natural is
    begin
        if condition then
            return yes;
        end if;
        return no;
    end function;
end package body;
