// burnish_parameters: rejects illegal parameters when a design is elaborated.
//
// Verilog-2001 has no $error outside simulation. An illegal value therefore instantiates a module that does not exist;
// every tool stops and prints its name, which is the rule.
//
// No ports, no cells. Parameters: the units', with a legal value for each that a unit lacks
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
`default_nettype none
module burnish_parameters #(
    parameter SQUARINGS = 1,
    parameter RESULT = 16,
    parameter ROUND = 0,
    parameter LAMBDA = 0,
    parameter ROWS = 1,
    parameter SEGMENT = 0,
    parameter DSP = 0,
    parameter USER_WIDTH = 1
);
    generate
        if (SQUARINGS < 1 || SQUARINGS > 4) begin : squarings
            burnish_parameter_SQUARINGS_must_be_1_to_4 refused ();
        end
        if (RESULT != 8 && RESULT != 10 && RESULT != 12 && RESULT != 16) begin : result
            burnish_parameter_RESULT_must_be_8_10_12_or_16 refused ();
        end
        if (ROUND != 0 && ROUND != 1) begin : round
            burnish_parameter_ROUND_must_be_0_or_1 refused ();
        end
        if (ROUND == 1 && RESULT != 16) begin : round_short
            burnish_parameter_ROUND_must_be_0_where_RESULT_is_below_16 refused ();
        end
        if (LAMBDA != 0 && LAMBDA != 1) begin : lambda
            burnish_parameter_LAMBDA_must_be_0_or_1 refused ();
        end
        if (ROWS < 1) begin : rows
            burnish_parameter_ROWS_must_be_at_least_1 refused ();
        end
        if (SEGMENT < 0) begin : segment
            burnish_parameter_SEGMENT_must_be_at_least_0 refused ();
        end
        if (DSP != 0 && DSP != 1) begin : dsp
            burnish_parameter_DSP_must_be_0_or_1 refused ();
        end
        if (USER_WIDTH < 1) begin : user_width
            burnish_parameter_USER_WIDTH_must_be_at_least_1 refused ();
        end
    endgenerate
endmodule
`default_nettype wire
