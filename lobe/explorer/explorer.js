// Compares a lobe with cos^n: curves, cost, and a sphere under one light. burnish-lobe.wasm computes all values.
import { load } from "./lobe.js";

const at = (id) => document.getElementById(id);
const form = at("controls");
const lobes = await load();
const DEGREE = Math.PI / 180;
const POINTS = 361;

// ---- State: the form, kept in the address ----

const DEFAULTS = { lobe: "energy:2", n: "40", q: "0.5", light: "-35" };

function readAddress() {
  const given = { ...DEFAULTS, ...Object.fromEntries(new URLSearchParams(location.hash.slice(1))) };
  for (const [key, value] of Object.entries(DEFAULTS)) {
    form[key].value = given[key];
    if (form[key].value === "" || !form[key].validity.valid) {
      form[key].value = value; // not a choice of this form
    }
  }
}

function writeAddress() {
  const changed = Object.entries(DEFAULTS).filter(([key, value]) => form[key].value !== value).map(([key]) => `${key}=${form[key].value}`);
  history.replaceState(null, "", changed.length > 0 ? `#${changed.join("&")}` : location.pathname);
}

// ---- Sphere ----

const SIZE = at("lobe").width;
const RADIUS = SIZE / 2;
const SURFACE = [0.02, 0.07, 0.2]; // linear
const toCode = (x) => Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * Math.min(1, x) ** (1 / 2.4) - 0.055));

// Phong's equation with Blinn's cosine: a distant light, a viewer straight above; 8-bit sRGB.
function sphere(lobe, n, light) {
  const [lx, ly, lz] = [0.9 * Math.sin(light), Math.sqrt(0.19), 0.9 * Math.cos(light)]; // of unit length
  const length = Math.hypot(lx, ly, lz + 1);
  const points = Array.from({ length: SIZE * SIZE }, (_, i) => {
    const [x, y] = [(i % SIZE + 0.5 - RADIUS) / RADIUS, (RADIUS - 0.5 - Math.floor(i / SIZE)) / RADIUS];
    const z = Math.sqrt(Math.max(0, 1 - x * x - y * y));
    return { lit: Math.max(0, x * lx + y * ly + z * lz), half: (x * lx + y * ly + z * (lz + 1)) / length, inside: RADIUS * (1 - Math.hypot(x, y)) };
  });
  const values = lobes.theoryValues(lobe, n, points.map(({ half }) => Math.acos(Math.min(1, half))));
  const image = new ImageData(SIZE, SIZE);
  points.forEach(({ lit, inside }, i) => {
    const highlight = lit > 0 ? 0.7 * values[i] : 0;
    image.data.set(SURFACE.map((albedo) => toCode(albedo * (0.15 + 0.85 * lit) + highlight)), 4 * i);
    image.data[4 * i + 3] = 255 * Math.min(1, Math.max(0, inside + 0.5));
  });
  return image;
}

function showPictures(lobe, n, light) {
  const [image, other] = [lobe, "power"].map((words) => sphere(words, n, light));
  const difference = new ImageData(SIZE, SIZE);
  let most = 0;
  for (let i = 0; i < image.data.length; i += 4) {
    const codes = image.data[i] - other.data[i]; // red: the surface has least of it
    difference.data.set(codes > 0 ? [226, 120, 50] : [60, 140, 190], i);
    difference.data[i + 3] = Math.min(255, 8 * Math.abs(codes));
    most = Math.max(most, Math.abs(codes));
  }
  Object.entries({ lobe: image, power: other, difference }).forEach(([id, data]) => at(id).getContext("2d").putImageData(data, 0, 0));
  return most;
}

// ---- Numbers ----

const real = (x) => (x === 0 ? "0" : Math.abs(x) < 0.001 ? x.toExponential(1) : String(Number(x.toFixed(4))));
const angle = (x) => (Number.isFinite(x) ? `${(x / DEGREE).toFixed(1)}°` : "–");
const ROWS = [
  ["Multiplications", (f) => f.multiplications], ["Additions", (f) => f.additions], ["Divisions", (f) => f.divisions], ["pow or exp", (f) => f.transcendentals],
  ["Slope ζ", (f) => (f.zeta ? real(f.zeta) : "–")], ["Largest error", (f) => real(f.maximumError)], ["Half at", (f) => angle(f.halfAngle)],
  ["Zero from", (f) => angle(f.zeroAngle)], ["Energy", (f, power) => `${((100 * f.integral) / power.integral).toFixed(1)} %`],
];

function showFacts(facts, power, most) {
  const rows = ROWS.map(([name, text]) => [name, text(facts, power), text(power, power)]);
  rows.push(["Codes apart, at most", most, "0"]);
  at("facts").innerHTML = rows.map(([name, ...cells]) => `<tr><th scope="row">${name}</th>${cells.map((cell) => `<td>${cell}</td>`).join("")}</tr>`).join("");
}

// ---- Curves ----

const [LEFT, RIGHT, TOP, BOTTOM] = [58, 466, 14, 228]; // of the drawing area in an SVG of 480 by 260

// A step of 1, 2 or 5 times a power of ten that divides the length into about `count`.
function stepOf(length, count) {
  const power = 10 ** Math.floor(Math.log10(length / count));
  return power * [1, 2, 5, 10].find((digit) => digit * power * count >= length);
}

function plot(svg, angles, curves) {
  const all = Object.values(curves).flatMap((values) => [...values]);
  const [low, high] = [Math.min(0, ...all), Math.max(1e-9, ...all)];
  const end = angles.at(-1);
  const x = (value) => LEFT + ((RIGHT - LEFT) * value) / end;
  const y = (value) => BOTTOM - ((BOTTOM - TOP) * (value - low)) / (high - low);
  const ticks = (from, to, step) => Array.from({ length: Math.floor(to / step + 1e-9) - Math.ceil(from / step - 1e-9) + 1 }, (_, i) => (Math.ceil(from / step - 1e-9) + i) * step);
  const name = (value) => String(Number(value.toPrecision(3)));
  svg.innerHTML = [
    ...ticks(low, high, stepOf(high - low, 5)).map((value) => `<path d="M${LEFT} ${y(value)}H${RIGHT}"/><text x="${LEFT - 8}" y="${y(value) + 5}" text-anchor="end">${name(value)}</text>`),
    ...ticks(0, end, stepOf(end, 6)).map((value) => `<path d="M${x(value)} ${BOTTOM}v6"/><text x="${x(value)}" y="${BOTTOM + 22}" text-anchor="middle">${name(value)}°</text>`),
    ...Object.entries(curves).map(([kind, values]) => `<path class="${kind}" d="M${Array.from(values, (value, i) => `${x(angles[i]).toFixed(1)} ${y(value).toFixed(1)}`).join("L")}"/>`),
  ].join("");
}

// ---- Everything ----

function update() {
  const lobe = form.lobe.value.replace("level", `level${form.q.value}`);
  const [n, light] = [Number(form.n.value), Number(form.light.value) * DEGREE];
  if (!form.n.validity.valid) {
    return;
  }
  writeAddress();
  at("level").hidden = !form.lobe.value.startsWith("level");
  at("slider").value = Math.log2(n);
  at("exponent").value = form.n.value;
  at("name").textContent = lobe;
  at("command").textContent = `burnish-lobe table --lobes=${lobe} --exponents=${form.n.value} --metrics=max-error,angle:1,zero-angle,energy`;
  try {
    const [facts, power] = [lobes.theory(lobe, n), lobes.theory("power", n)];
    const end = Math.min(90, (4.2 * power.halfAngle) / DEGREE);
    const angles = Array.from({ length: POINTS }, (_, i) => (i * end) / (POINTS - 1));
    const [values, powers] = [lobe, "power"].map((words) => lobes.theoryValues(words, n, angles.map((x) => x * DEGREE)));
    plot(at("values"), angles, { lobe: values, power: powers });
    plot(at("errors"), angles, { lobe: values.map((value, i) => value - powers[i]) });
    showFacts(facts, power, showPictures(lobe, n, light));
    at("error").textContent = "";
  } catch (error) {
    at("error").textContent = error.message; // an order above the exponent
  }
}

form.addEventListener("submit", (event) => event.preventDefault());
form.addEventListener("input", ({ target }) => {
  if (target === at("slider")) {
    const n = 2 ** Number(target.value);
    form.n.value = n < 10 ? n.toFixed(1) : Math.round(n);
  }
  update();
});
addEventListener("hashchange", () => {
  readAddress();
  update();
});
readAddress();
update();
document.querySelector("main").ariaBusy = "false";
