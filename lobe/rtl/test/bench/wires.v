// wires: registers as wires, a techmap for yosys. A pipeline without feedback becomes its function.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
(* techmap_celltype = "$dff $dffe" *)
module registers_are_wires (CLK, EN, D, Q);
    parameter WIDTH = 1;
    parameter CLK_POLARITY = 1;
    parameter EN_POLARITY = 1;
    input CLK, EN;
    input [WIDTH-1:0] D;
    output [WIDTH-1:0] Q;
    assign Q = D;
endmodule
