// The overlay, from a .brdf file of the reader's.
import { makeBrdf, parseBrdf } from "./brdf.js";
import { at, show, state } from "./state.js";

export const isOverlay = (name) => /\.brdf$/i.test(name);

let overlay = null; // { name, values(angles) }, of degrees
let changed = () => {};

/** The overlay's values at angles in degrees, with a peak of 1; null: no overlay. */
export const overlayValues = (angles) => overlay && overlay.values(angles);
export const overlayName = () => overlay?.name ?? null;

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
  at("overlay-about").textContent = `${name}, run by this browser's WebGL and scaled to a peak of 1.`;
}

export async function openOverlay(file) {
  const { name } = file;
  try {
    const brdf = parseBrdf(await file.text(), name);
    const evaluate = makeBrdf(brdf, name);
    overlay = {
      name,
      values(angles) {
        const step = ((angles.at(-1) / (angles.length - 1)) * Math.PI) / 180;
        const values = evaluate(brdf.parameters, angles.length, step, state.equation === "phong");
        const peak = values[0] > 0 ? values[0] : Math.max(...values.filter(Number.isFinite));
        return values.map((value) => value / peak);
      },
    };
    showParameters(name, brdf.parameters);
    show("", "overlay-error");
    changed();
  } catch (error) {
    show(error.message, "overlay-error");
  }
}

/** onChange(): the curve changed. */
export function watchOverlay(onChange) {
  changed = onChange;
}
