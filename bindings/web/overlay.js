// The overlay, from a file of the reader's: measured samples with the lobes that fit them, or a .brdf file.
import { request, latest } from "./request.js";
import { makeBrdf, parseBrdf } from "./brdf.js";
import { parseCsv } from "./csv.js";
import { at, show, state } from "./state.js";

const ENDING = /\.(csv|txt|tsv|brdf)$/i;
export const isOverlay = (name) => ENDING.test(name);

let overlay = null; // { name, isLine, curve(angles) }, of degrees
let changed = () => {};
let taken = () => {};

/** The overlay's curve at its own angles, or at the given ones, in degrees and with a peak of 1; null: no overlay. */
export const overlayCurve = (angles) => (overlay ? { ...overlay.curve(angles), isLine: overlay.isLine } : null);
export const overlayName = () => overlay?.name ?? null;

const fail = (error) => show(error.message, "overlay-error");

// ---- Samples ----

let samples = null; // { name, bytes }

async function fitNow() {
  const { name } = samples;
  const words = ["fit", name, "--format=csv", `--unit=${at("unit").value}`, ...(at("offset").checked ? ["--offset"] : [])];
  const fitted = parseCsv(await request("lobe", { words, file: samples }));
  const points = parseCsv(await request("lobe", { words: [...words, "--residuals"], file: samples }));
  const [best] = fitted;
  const [scale, offset] = [Number(best.scale), Number(best.offset)];
  const radians = { deg: (x) => (x * Math.PI) / 180, rad: (x) => x, cosine: (x) => Math.acos(x) }[at("unit").value];
  const sorted = points.map((row) => [Math.abs((radians(Number(Object.values(row)[0])) * 180) / Math.PI), (Number(row.intensity) - offset) / scale]).sort(([a], [b]) => a - b);
  // a curve has one value per angle: samples of both sides are moved apart a little
  const angles = sorted.map(([angle], i) => angle + i * 1e-9);
  overlay = { name, isLine: false, curve: () => ({ angles, values: sorted.map(([, value]) => value) }) };
  showFits(name, points.length, fitted);
  show("", "overlay-error");
  changed();
}

const fit = latest(fitNow, (message) => show(message, "overlay-error"));

// The page's state for a row: "order 4" is the fit energy with that order.
function lobeOfRow({ lobe, exponent }) {
  const order = lobe.match(/^order (\d+)$/)?.[1];
  return exponent === "" ? null : { fit: order ? "energy" : lobe, ...(order ? { order } : {}), n: String(Number(Number(exponent).toPrecision(6))) };
}

function showFits(name, count, fitted) {
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
  at("overlay-about").textContent = `${name}: ${count} samples; least squares, the best lobe first. Exponents of orders belong to the fit energy.`;
  at("samples").hidden = false;
  at("parameters").hidden = true;
}

// ---- .brdf ----

function showParameters(name, parameters) {
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
  at("overlay-about").textContent = `${name}, run by this browser's WebGL and scaled to a peak of 1.`;
}

function takeBrdf(name, text) {
  const brdf = parseBrdf(text, name);
  const evaluate = makeBrdf(brdf, name);
  overlay = {
    name, isLine: true,
    curve(angles) {
      const step = ((angles.at(-1) / (angles.length - 1)) * Math.PI) / 180;
      const values = evaluate(brdf.parameters, angles.length, step, state.equation === "phong");
      const peak = values[0] > 0 ? values[0] : Math.max(...values.filter(Number.isFinite));
      return { angles, values: values.map((value) => value / peak) };
    },
  };
  showParameters(name, brdf.parameters);
  show("", "overlay-error");
  changed();
}

// ---- Files ----

export async function openOverlay(file) {
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

/** onChange(): the curve changed; onTake({ fit, order, n }): the reader chose a fitted lobe. */
export function watchOverlay(onChange, onTake) {
  changed = onChange;
  taken = onTake;
  at("unit").addEventListener("change", fit);
  at("offset").addEventListener("change", fit);
}
