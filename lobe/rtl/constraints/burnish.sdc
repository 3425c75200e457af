# burnish.sdc: clock and I/O constraints for a module of rtl/ that is the top of a design. Inside of your design its clock
# and its neighbours are constrained by yours; what stays is the false path at the end.
#
#     set burnish_period 8.0        ;# before this file is read; what isn't set has the values below
#
# Times are in ns.
#
# SPDX-License-Identifier: MIT
# Copyright (c) the burnish authors

# 100 MHz. docs/hardware.md tells what each unit reaches on which chip.
if {![info exists burnish_period]} {set burnish_period 10.0}

# The share of the period that is used outside, from the register before an input and to the one behind an output. enable
# and m_ready are the critical inputs: each reaches all registers of a pipeline by its clock enable.
if {![info exists burnish_outside]} {set burnish_outside 0.3}

# One clock for everything, clk, or aclk of burnish_axis: no other domain, no latch, no asynchronous reset. reset and
# aresetn are sampled like any input and need no exception.
create_clock -name burnish -period $burnish_period [get_ports -quiet {clk aclk}]
set_clock_uncertainty [expr {0.02 * $burnish_period}] [get_clocks burnish]

# The clock's port is among all_inputs: a tool may say that it takes no delay, which is right.
set_input_delay -clock burnish [expr {$burnish_outside * $burnish_period}] [all_inputs]
set_output_delay -clock burnish [expr {$burnish_outside * $burnish_period}] [all_outputs]

# burnish_light and burnish_pixel with HELD=1: light, half, diffuse and specular hold still while a pixel is inside, so
# that they may take any time. Set burnish_held to 1 there; it is wrong where they change while pixels pass.
if {[info exists burnish_held] && $burnish_held} {
    set_false_path -from [get_ports {light* half* diffuse* specular*}]
}
