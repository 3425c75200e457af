// burnish_latency.vh: the latency of every module as constant functions, so that
// user data can be delayed alike. Included inside modules.
//
// SPDX-License-Identifier: MIT
// Copyright (c) the burnish authors
// A module and its instances include the same functions, which hides nothing.
// verilator lint_off VARHIDDEN
function integer latency_rows(input integer bits, input integer columns, input integer rows,
    input integer span);
    latency_rows = (bits - 1) / (rows < 1 ? 1 : rows) + (span < 1 ? 1 : (columns + span - 1) / span);
endfunction

function integer latency_square(input integer bits, input integer rows, input integer span,
    input integer dsp);
    latency_square = dsp != 0 ? 1 : latency_rows(bits, 2 * bits, rows, span);
endfunction

function integer latency_base(input integer of_factor, input integer places, input integer by_lambda,
    input integer rows, input integer span, input integer dsp);
    integer keep;
    begin
        keep = (by_lambda != 0 ? 9 : 0) + (of_factor == 1 ? 16 + places : 17);
        latency_base = dsp != 0 ? 3
            : 1 + latency_rows(10, keep, rows, span) +
                (of_factor == 1 || span < 1 ? 1 : (keep + places + span - 1) / span + 1);
    end
endfunction

function integer latency_zeta(input integer by_lambda, input integer rows, input integer span,
    input integer dsp);
    latency_zeta = 5 + (dsp != 0 ? 1 : latency_rows(16, by_lambda != 0 ? 40 : 32, rows, span));
endfunction

function integer latency_power(input integer squarings, input integer result,
    input integer rows, input integer span, input integer dsp);
    latency_power = result < 16
        ? (squarings - 1) * latency_square(16, rows, span, dsp) + 1 +
            latency_square(result + 1, rows, span, dsp)
        : squarings * latency_square(16, rows, span, dsp);
endfunction

function integer latency_add(input integer bits, input integer span);
    latency_add = span < 1 ? 1 : (bits + span - 1) / span;
endfunction

function integer latency_times(input integer a_bits, input integer b_bits, input integer rows,
    input integer span, input integer dsp);
    latency_times = dsp != 0 ? 1 : latency_rows(a_bits, a_bits + b_bits, rows, span);
endfunction

function integer latency_composite(input integer by_lambda, input integer rows, input integer span,
    input integer dsp);
    latency_composite = 2 + latency_times(16, by_lambda != 0 ? 24 : 16, rows, span, dsp) +
        latency_add(24, span) + latency_square(16, rows, span, dsp) +
        3 * (latency_add(16, span) + latency_times(16, 16, rows, span, dsp));
endfunction

function integer latency_cosine_power(input integer rows, input integer span, input integer dsp);
    latency_cosine_power = 1 +
        3 * (latency_square(16, rows, span, dsp) + latency_times(16, 16, rows, span, dsp));
endfunction

// The products of burnish_dot, or the sum of the components that corrects them.
function integer latency_dot_wait(input integer rows, input integer span);
    latency_dot_wait = latency_times(16, 16, rows, span, 0) > 3 * latency_add(17, span)
        ? latency_times(16, 16, rows, span, 0) : 3 * latency_add(17, span);
endfunction

function integer latency_dot(input integer rows, input integer span, input integer dsp);
    latency_dot = 2 + (dsp != 0 ? 1 : latency_dot_wait(rows, span)) + 2 * latency_add(32, span);
endfunction

function integer latency_chord(input integer rows, input integer span, input integer dsp);
    latency_chord = latency_add(17, span) + latency_add(16, span) +
        latency_square(16, rows, span, dsp) + 2 * latency_add(32, span) + 1;
endfunction

function integer latency_accumulate(input integer rows, input integer span, input integer dsp);
    latency_accumulate =
        1 + latency_times(16, 16, rows, span, dsp) + latency_add(17, span) + 1;
endfunction

function integer latency_normalize(input integer rows, input integer span, input integer dsp);
    latency_normalize = 3 * latency_add(16, span) + 2 * latency_add(17, span) +
        2 * latency_add(18, span) + 3 * latency_add(32, span) + 2 +
        2 * latency_square(16, rows, span, dsp) + latency_times(16, 16, rows, span, dsp);
endfunction

// kind: 0 taylor, 1 shift7, 2 shift3, 3 energy, 4 zeta
function integer latency_lobe(input integer kind, input integer squarings, input integer result,
    input integer by_lambda, input integer rows, input integer span, input integer dsp);
    latency_lobe = latency_power(kind == 1 || kind == 2 ? 1 : squarings, result, rows, span, dsp) +
        (kind == 0 ? latency_base(1, squarings - 1, by_lambda, rows, span, dsp)
            : kind == 1 ? latency_base(7, 3, by_lambda, rows, span, dsp)
            : kind == 2 ? latency_base(3, 2, by_lambda, rows, span, dsp)
            : (kind == 3 ? 8 : 0) + latency_zeta(by_lambda, rows, span, dsp));
endfunction

// narrow: 0 by the cosine, 1 by the chord, 2 either. The angle, before the lobe.
function integer latency_angle(input integer narrow, input integer rows, input integer span,
    input integer dsp);
    latency_angle = narrow == 0 ? latency_dot(rows, span, dsp)
        : narrow == 1 ? latency_chord(rows, span, dsp)
        : 1 + (latency_dot(rows, span, dsp) + latency_add(16, span) > latency_chord(rows, span, dsp)
            ? latency_dot(rows, span, dsp) + latency_add(16, span)
            : latency_chord(rows, span, dsp));
endfunction

function integer latency_highlight(input integer kind, input integer squarings,
    input integer narrow, input integer rows, input integer span, input integer dsp);
    latency_highlight = latency_angle(narrow, rows, span, dsp) +
        latency_lobe(kind, squarings, 16, narrow != 0 ? 1 : 0, rows, span, dsp);
endfunction

// Of burnish_light: after the diffuse term, and to the specular one.
function integer latency_light_diffuse(input integer rows, input integer span, input integer dsp);
    latency_light_diffuse = latency_dot(rows, span, dsp) + latency_accumulate(rows, span, dsp);
endfunction

function integer latency_light_specular(input integer kind, input integer squarings,
    input integer narrow, input integer rows, input integer span, input integer dsp);
    latency_light_specular = latency_highlight(kind, squarings, narrow, rows, span, dsp) >
        latency_light_diffuse(rows, span, dsp)
        ? latency_highlight(kind, squarings, narrow, rows, span, dsp)
        : latency_light_diffuse(rows, span, dsp);
endfunction

function integer latency_light(input integer kind, input integer squarings,
    input integer narrow, input integer rows, input integer span, input integer dsp);
    latency_light = latency_light_specular(kind, squarings, narrow, rows, span, dsp) +
        latency_accumulate(rows, span, dsp);
endfunction

function integer latency_pixel(input integer lights, input integer normalize, input integer kind,
    input integer squarings, input integer narrow, input integer rows, input integer span,
    input integer dsp);
    latency_pixel = (normalize != 0 ? latency_normalize(rows, span, dsp) : 0) +
        lights * latency_light(kind, squarings, narrow, rows, span, dsp);
endfunction
// verilator lint_on VARHIDDEN
