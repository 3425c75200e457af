// The page: shows the state and changes it on input. Loaded after the first picture (first.js).
import { request, latest } from "./request.js";
import { overlayValues, overlayName, isOverlay, openOverlay, watchOverlay } from "./overlay.js";
import { showClaims } from "./claims.js";
import { codeOf } from "./code.js";
import { numberOf, parseCsv } from "./csv.js";
import { whole } from "./first.js";
import { FRONT, commandLine, darkScheme, divideByHand, draw, open, paint, turn, turnByHand } from "./picture.js";
import { showSoftbox, watchSoftbox } from "./softbox.js";
import { ONE_ORDER, WITHOUT_ORDER, addressOfState, at, lobeOf, mostOrder, own, settleOrder, show, state } from "./state.js";

// ---- Curves, cost, code ----

const curves = whole.then(async () => (await import("./curves.js")).makeCurves());
const POINTS = 361;

const real = (x) => (Number.isFinite(x) ? (x === 0 ? "0" : x < 0.001 ? x.toExponential(1) : x.toFixed(3)) : "–");
const degrees = (x) => (Number.isFinite(x) ? `${((x * 180) / Math.PI).toFixed(1)}°` : "–");
const ROWS = [
  ["Multiplications", (f) => f.multiplications], ["Additions", (f) => f.additions], ["Max, min", (f) => f.comparisons],
  ["Divisions", (f) => f.divisions], ["pow, exp", (f) => f.transcendentals], ["Slope zeta", (f) => (f.zeta ? real(f.zeta) : "–")],
  ["Largest error", (f) => real(f.maximumError)], ["Half width", (f) => degrees(f.halfAngle)], ["Zero from", (f) => degrees(f.zeroAngle)],
  ["Energy of cos^n", (f, power) => `${((100 * f.integral) / power.integral).toFixed(1)} %`],
];

const compute = latest(async () => {
  const exponent = Number(state.n);
  const end = Math.min(90, (4.2 * Math.acos(0.5 ** (1 / exponent)) * 180) / Math.PI);
  const steps = Array.from({ length: POINTS }, (_, i) => (i * end) / (POINTS - 1));
  const lobes = [lobeOf(state), state.against, "power"];
  const [lobe, other, power] = await request("theory", { lobes, exponent, angles: steps.map((x) => (x * Math.PI) / 180) });
  (await curves).overAngle(steps, [...lobe.values], [...other.values], [...power.values], overlayValues(steps));
  at("cost").innerHTML = ROWS.map(([name, text]) =>
    `<tr><th scope="row">${name}</th><td>${text(lobe.facts, power.facts)}</td><td>${text(other.facts, power.facts)}</td></tr>`).join("");
  showSoftbox({ zeta: lobe.facts.zeta, order: WITHOUT_ORDER.includes(state.fit) ? 2 : Number(state.order), exponent, isBlinn: state.equation === "blinn" });
  await showCode(lobe.facts);
}, show);

async function showCode(facts) {
  const { language } = state;
  const form = { memory: "c", mem: "mem" }[language];
  const words = ["boundary", `--lobe=${lobeOf(state)}`, "--exponents=1-1023", `--as=${form}`];
  const text = form ? await request("lobe", { words }) : codeOf({ ...state, order: Number(state.order), exponent: Number(state.n), ...facts }, language);
  if (at("code").textContent !== text) {
    at("code").textContent = text;
  }
}

// Rows of `burnish-lobe table`, once per lobe: they do not depend on the chosen exponent.
const EXPONENTS = "--exponents=1-4096x1.0905";
const tables = new Map();
async function tableOf(lobe) {
  if (!tables.has(lobe)) {
    const words = ["table", `--lobes=${lobe}`, EXPONENTS, "--metrics=energy,angle:1,angle:8,max-error", "--format=csv"];
    const rows = parseCsv(await request("lobe", { words }));
    const column = (key, scale = 1) => rows.map((row) => (numberOf(row[key]) === null ? null : scale * numberOf(row[key])));
    tables.set(lobe, {
      n: column("exponent"), energy: column("energy", 100), half: column("angle_deg_1"), boundary: column("angle_deg_8"), error: column("max_error"),
    });
  }
  return tables.get(lobe);
}

const tabulate = latest(async () => {
  const [lobe, other, power] = [await tableOf(lobeOf(state)), await tableOf(state.against), await tableOf("power")];
  (await curves).overExponent(power.n, lobe, other, power);
}, show);

// ---- Showing the state ----

// Orders are limited by the exponent.
function showOrder() {
  const isFixed = WITHOUT_ORDER.includes(state.fit);
  for (const button of at("order").children) {
    const isOnly = ONE_ORDER.includes(state.fit) && button.value === "2";
    button.disabled = isFixed ? !isOnly : Number(button.value) > mostOrder(state.n);
    button.setAttribute("aria-pressed", String(isFixed ? isOnly : button.value === state.order));
  }
}

const sliderOf = (n) => Math.round((1000 * Math.log2(Math.min(n, 4096))) / 12);
const exponentOf = (slider) => {
  const n = 2 ** ((12 * slider) / 1000);
  return String(n < 10 ? Math.round(n * 10) / 10 : Math.round(n));
};

const key = (color, text) => `<i style="background:var(--${color})"></i>${text.replaceAll("&", "&amp;").replaceAll("<", "&lt;")}`;

function settle() {
  settleOrder(state);
  showOrder();
  for (const id of ["fit", "against", "look", "resolution"]) {
    at(id).value = state[id];
  }
  for (const id of ["view", "equation", "language", "mesh"]) {
    for (const button of at(id).children) {
      button.setAttribute("aria-pressed", String(button.value === state[id] && !(id === "mesh" && own.mesh)));
    }
  }
  at("file-name").textContent = own.mesh ?? at("file-name").dataset.empty;
  if (document.activeElement !== at("exponent")) {
    at("exponent").value = state.n;
  }
  at("exponent-range").value = sliderOf(Number(state.n));
  at("divider").hidden = state.view !== "split";
  at("divider").style.left = `${state.divider}%`;
  at("divider").setAttribute("aria-valuenow", Math.round(Number(state.divider)));
  at("tag-left").textContent = state.view === "against" ? state.against : lobeOf(state);
  at("tag-right").textContent = state.against;
  at("tag-right").hidden = state.view !== "split";
  at("tag-left").hidden = state.view === "error";
  at("legend").hidden = state.view !== "error";
  at("cost-left").textContent = lobeOf(state);
  at("cost-right").textContent = state.against;
  at("key").innerHTML = key("lobe", lobeOf(state)) + key("other", state.against) + (overlayName() ? key("overlay", overlayName()) : "");
  at("command").textContent = commandLine();
  const exponent = Number(state.n);
  curves.then((made) => made.setExponent(exponent));
  history.replaceState(null, "", addressOfState());
}

const DRAWN = ["mesh", "fit", "order", "n", "against", "look", "equation", "resolution", "view"];

function change(key, value, isMoving = false) {
  state[key] = value;
  settle();
  if (["fit", "order", "n", "against", "language", "equation"].includes(key)) {
    compute();
  }
  if (["fit", "order", "against"].includes(key)) {
    tabulate();
  }
  if (key === "divider") {
    paint();
  } else if (isMoving) {
    turn();
  } else if (DRAWN.includes(key)) {
    draw(false);
  }
}

// ---- Input ----

for (const id of ["fit", "against", "look", "resolution"]) {
  at(id).addEventListener("change", () => change(id, at(id).value));
}
for (const id of ["view", "order", "equation", "language"]) {
  at(id).addEventListener("click", ({ target }) => target.value && !target.disabled && change(id, target.value));
}
at("exponent-range").addEventListener("input", () => change("n", exponentOf(Number(at("exponent-range").value)), true));
at("exponent").addEventListener("input", () => {
  if (at("exponent").value !== "" && at("exponent").validity.valid) {
    change("n", at("exponent").value, true);
  }
});
at("exponent").addEventListener("blur", settle);
turnByHand(settle);
darkScheme.addEventListener("change", () => {
  settle();
  draw(false);
});
watchSoftbox(settle);
divideByHand((percent) => change("divider", percent));
watchOverlay(() => {
  settle();
  compute();
});

// ---- Files ----

at("mesh").addEventListener("click", ({ target }) => {
  if (target.value) {
    open(target.value, {}, () => {
      own.mesh = null;
      change("mesh", target.value);
    });
  }
});

let extensions = []; // of meshes, from the module
const isMesh = (name) => extensions.some((extension) => name.toLowerCase().replace(/\.gz$/, "").endsWith(extension));

// .brdf files are overlays; otherwise one file is the mesh and the others are its references.
async function openFiles(list) {
  const files = [...list];
  const overlay = files.find(({ name }) => isOverlay(name));
  if (overlay && !files.some(({ name }) => isMesh(name))) {
    show("");
    openOverlay(overlay);
    at("overlay").scrollIntoView({ block: "nearest" });
    return;
  }
  const given = await Promise.all(files.map(async (file) => [file.name, new Uint8Array(await file.arrayBuffer())]));
  const [name, bytes] = given.find(([file]) => isMesh(file)) ?? given[0] ?? [];
  if (!bytes) {
    return;
  }
  const others = Object.fromEntries(given.filter(([file]) => file !== name));
  await open(bytes, { name, files: others }, () => {
    own.mesh = name;
    Object.assign(state, FRONT);
    settle();
    draw(false);
  });
}

// Emptied: a changed file can be chosen again.
for (const id of ["file", "overlay-file"]) {
  at(id).addEventListener("change", async () => {
    const files = [...at(id).files];
    at(id).value = "";
    await openFiles(files);
  });
}
let over = 0;
for (const [type, step] of [["dragenter", 1], ["dragleave", -1]]) {
  addEventListener(type, () => {
    over += step;
    document.body.classList.toggle("is-over", over > 0);
  });
}
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
  event.preventDefault();
  over = 0;
  document.body.classList.remove("is-over");
  openFiles(event.dataTransfer.files);
});

// ---- Copying ----

async function copy(button, text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch { // not a secure page
    const area = document.body.appendChild(document.createElement("textarea"));
    area.value = text;
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  const before = button.textContent;
  button.style.minWidth = `${button.offsetWidth}px`;
  button.textContent = "Copied";
  setTimeout(() => (button.textContent = before), 1200);
}

for (const button of document.querySelectorAll("[data-copy]")) {
  button.addEventListener("click", () => copy(button, at(button.dataset.copy).textContent));
}
at("share").addEventListener("click", () => {
  show(own.mesh ? "The link has everything but the mesh, which stays on this machine." : "");
  copy(at("share"), location.href);
});
addEventListener("hashchange", () => location.reload());

// ---- After the picture (first.js) ----

settle();
await whole;
compute();
tabulate();
const about = await request("about");
extensions = about.extensions;
at("file").title = `Reads ${extensions.join(", ")}, each also as .gz`;
await showClaims();
at("about").textContent = `burnish ${about.version}, ${about.simd ? "with" : "without"} SIMD, ${about.threads === 1 ? "one thread" : `${about.threads} threads`}.`;
