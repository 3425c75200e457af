// burnish_latency.vh: the latency of every module as constant functions, so that
// user data can be delayed alike. Included inside modules.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
function integer latency_rows(input integer bits, input integer columns, input integer rows,
    input integer span);
    latency_rows = (bits - 1) / rows + (span == 0 ? 1 : (columns + span - 1) / span);
endfunction

function integer latency_square(input integer bits, input integer rows, input integer span,
    input integer dsp);
    latency_square = dsp != 0 ? 1 : latency_rows(bits, 2 * bits, rows, span);
endfunction

function integer latency_base(input integer factor, input integer places, input integer lambda,
    input integer rows, input integer span, input integer dsp);
    integer keep;
    begin
        keep = (lambda != 0 ? 9 : 0) + (factor == 1 ? 16 + places : 17);
        latency_base = dsp != 0 ? 3
            : 1 + latency_rows(10, keep, rows, span) +
                (factor == 1 || span == 0 ? 1 : (keep + places + span - 1) / span + 1);
    end
endfunction

function integer latency_zeta(input integer lambda, input integer rows, input integer span,
    input integer dsp);
    latency_zeta = 5 + (dsp != 0 ? 1 : latency_rows(16, lambda != 0 ? 40 : 32, rows, span));
endfunction

function integer latency_power(input integer squarings, input integer result,
    input integer rows, input integer span, input integer dsp);
    latency_power = result == 8
        ? (squarings - 1) * latency_square(16, rows, span, dsp) + 1 +
            latency_square(9, rows, span, dsp)
        : squarings * latency_square(16, rows, span, dsp);
endfunction
