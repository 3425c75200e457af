// What stands beside the lobe from a file of the reader's: measured samples with the lobes that fit them, or a .brdf file.
import { ask, latest } from "./ask.js";
import { makeBrdf, parseBrdf } from "./brdf.js";
import { parseCsv } from "./csv.js";
import { at, show, state } from "./state.js";

const ENDING = /\.(csv|txt|tsv|brdf)$/i;
export const isBeside = (name) => ENDING.test(name);

let beside = null; // { name, isLine, curve(angles) }, of degrees
let changed = () => {};
let taken = () => {};

/** Curve of what stands beside, at its own angles or at those given, in degrees and with a peak of 1; null: nothing. */
export const besideCurve = (angles) => (beside ? { ...beside.curve(angles), isLine: beside.isLine } : null);
export const besideName = () => beside?.name ?? null;

const fail = (error) => show(error.message, "beside-error");

// ---- Samples ----

let samples = null; // { name, bytes }

async function fitNow() {
  const { name } = samples;
  const words = ["fit", name, "--format=csv", `--unit=${at("unit").value}`, ...(at("offset").checked ? ["--offset"] : [])];
  const fitted = parseCsv(await ask("lobe", { words, file: samples }));
  const points = parseCsv(await ask("lobe", { words: [...words, "--residuals"], file: samples }));
  const [best] = fitted;
  const [scale, offset] = [Number(best.scale), Number(best.offset)];
  const radians = { deg: (x) => (x * Math.PI) / 180, rad: (x) => x, cosine: (x) => Math.acos(x) }[at("unit").value];
  const sorted = points.map((row) => [Math.abs((radians(Number(Object.values(row)[0])) * 180) / Math.PI), (Number(row.intensity) - offset) / scale]).sort(([a], [b]) => a - b);
  // curves have one value at an angle: samples of both sides stand a hair apart
  const angles = sorted.map(([angle], i) => angle + i * 1e-9);
  beside = { name, isLine: false, curve: () => ({ angles, values: sorted.map(([, value]) => value) }) };
  tellFits(name, points.length, fitted);
  show("", "beside-error");
  changed();
}

const fit = latest(fitNow, (message) => show(message, "beside-error"));

// The page's words for a row: order 4 by its exponent with the fit energy.
function lobeOfRow({ lobe, exponent }) {
  const order = lobe.match(/^order (\d+)$/)?.[1];
  return exponent === "" ? null : { fit: order ? "energy" : lobe, ...(order ? { order } : {}), n: String(Number(Number(exponent).toPrecision(6))) };
}

function tellFits(name, count, fitted) {
  const rows = fitted.map((row) => {
    const lobe = lobeOfRow(row);
    const tr = document.createElement("tr");
    const text = [row.lobe, row.exponent === "" ? "–" : Number(row.exponent).toFixed(2), Number(row.rms).toPrecision(3), `${Number(row.explained_percent).toFixed(2)} %`];
    tr.append(...text.map((t, i) => Object.assign(document.createElement(i === 0 ? "th" : "td"), { textContent: t, ...(i === 0 ? { scope: "row" } : {}) })));
    const button = Object.assign(document.createElement("button"), { type: "button", className: "quiet", textContent: "Take", disabled: !lobe });
    button.setAttribute("aria-label", `Take ${row.lobe}`);
    button.addEventListener("click", () => taken(lobe));
    const cell = document.createElement("td");
    cell.append(button);
    tr.append(cell);
    return tr;
  });
  at("fits").replaceChildren(...rows);
  at("beside-about").textContent = `${name}: ${count} samples; their least squares, the best lobe first. Exponents of orders are those of the fit energy.`;
  at("samples").hidden = false;
  at("parameters").hidden = true;
}

// ---- .brdf ----

function tellParameters(name, parameters) {
  const rows = parameters.filter(({ type }) => type !== "color").map((parameter) => {
    const label = Object.assign(document.createElement("label"), { className: "row" });
    const isBool = parameter.type === "bool";
    const input = Object.assign(document.createElement("input"), isBool ? { type: "checkbox", checked: parameter.value > 0 }
      : { type: "range", min: parameter.low, max: parameter.high, step: "any", value: parameter.value });
    const output = Object.assign(document.createElement("output"), { textContent: isBool ? "" : parameter.value });
    input.addEventListener("input", () => {
      parameter.value = isBool ? Number(input.checked) : Number(input.value);
      output.textContent = isBool ? "" : Number(parameter.value.toPrecision(4));
      changed();
    });
    label.append(Object.assign(document.createElement("span"), { textContent: parameter.name }), input, output);
    return label;
  });
  at("parameters").replaceChildren(...rows);
  at("parameters").hidden = rows.length === 0;
  at("samples").hidden = true;
  at("beside-about").textContent = `${name}, run by this browser's WebGL and scaled to a peak of 1.`;
}

function takeBrdf(name, text) {
  const brdf = parseBrdf(text, name);
  const evaluate = makeBrdf(brdf, name);
  beside = {
    name, isLine: true,
    curve(angles) {
      const step = ((angles.at(-1) / (angles.length - 1)) * Math.PI) / 180;
      const values = evaluate(brdf.parameters, angles.length, step, state.equation === "phong");
      const peak = values[0] > 0 ? values[0] : Math.max(...values.filter(Number.isFinite));
      return { angles, values: values.map((value) => value / peak) };
    },
  };
  tellParameters(name, brdf.parameters);
  show("", "beside-error");
  changed();
}

// ---- Files ----

export async function openBeside(file) {
  try {
    if (/\.brdf$/i.test(file.name)) {
      takeBrdf(file.name, await file.text());
    } else {
      samples = { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
      fit();
    }
  } catch (error) {
    fail(error);
  }
}

/** onChange: the curve is another one; onTake: the reader takes a lobe that fits, { fit, order, n }. */
export function watchBeside(onChange, onTake) {
  changed = onChange;
  taken = onTake;
  at("unit").addEventListener("change", fit);
  at("offset").addEventListener("change", fit);
}
