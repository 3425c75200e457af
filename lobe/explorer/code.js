// The lobe on screen as a function to copy.
import { ONE_ORDER } from "./state.js";
import { verilogOf } from "./verilog.js";

const LANGUAGES = {
  c: { real: (x) => `${x}f`, type: "float", head: "static inline float lobe(float c) {", max: "fmaxf", min: "fminf", pow: "powf", exp: "expf" },
  glsl: { real: (x) => x, type: "float", head: "float lobe(float c) {", max: "max", min: "min", pow: "pow", exp: "exp" },
  hlsl: { real: (x) => x, type: "float", head: "float lobe(float c) {", max: "max", min: "min", pow: "pow", exp: "exp" },
  wgsl: { real: (x) => x, type: "let", head: "fn lobe(c: f32) -> f32 {", max: "max", min: "min", pow: "pow", exp: "exp" },
  msl: { real: (x) => `${x}f`, type: "float", head: "inline float lobe(float c) {", max: "max", min: "min", pow: "pow", exp: "exp" },
};

const NAMES = { schlick: "Schlick's lobe", gx: "the GameCube's lobe", gaussian: "a spherical Gaussian", power: "cos^n" };

// Enough digits to read a float back.
function digits(x) {
  const text = String(Number(Math.fround(x).toPrecision(9)));
  return /[.e]/.test(text) ? text : `${text}.0`;
}

function body({ fit, order, exponent, zeta, scale }, { real, type, max, min, pow, exp }) {
  const n = real(digits(exponent));
  const one = real("1.0");
  const zero = real("0.0");
  const clamped = `${min}(${one}, ${max}(${zero}, c))`;
  if (fit === "power") {
    return [`return ${pow}(${max}(c, ${zero}), ${n});`];
  }
  if (fit === "schlick") {
    return [`${type} x = ${clamped};`, `return x / (x + ${n} * (${one} - x));`];
  }
  if (fit === "gaussian") {
    return [`return ${exp}(${real(digits(exponent + 0.775))} * (c - ${one}));`];
  }
  if (fit === "gx") {
    return [`${type} x = ${clamped};`, `return x * x / (${real(digits(exponent / 2))} + ${real(digits(1 - exponent / 2))} * x * x);`];
  }
  const lines = [`${type} u = ${max}(${zero}, ${one} - ${real(digits(zeta))} * (${one} - c));`];
  let name = "u";
  for (let power = 2; power < order; power *= 2) {
    lines.push(`${type} u${power} = ${name} * ${name};`);
    name = `u${power}`;
  }
  return [...lines, `return ${scale === 1 ? "" : `${real(digits(scale))} * `}${name} * ${name};`];
}

/** lobe: { fit, order, exponent, zeta, scale }; c is N.H of Blinn's model, R.V of Phong's, at most 1. */
export function codeOf(lobe, language) {
  const words = LANGUAGES[language];
  const name = NAMES[lobe.fit] ?? (ONE_ORDER.includes(lobe.fit) ? lobe.fit : `${lobe.fit}:${lobe.order}`);
  if (language === "verilog") {
    return verilogOf(lobe, name);
  }
  const comment = lobe.fit === "power" ? `c^${lobe.exponent}` : `${name} for c^${lobe.exponent}; c <= 1`;
  const include = language === "c" ? ["#include <math.h>", ""] : language === "msl" ? ["using namespace metal;", ""] : [];
  return [...include, `// ${comment}`, words.head, ...body(lobe, words).map((line) => `    ${line}`), "}"].join("\n");
}
