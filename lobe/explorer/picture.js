// The picture: drawn by the worker, put side by side here, turned by hands.
import { request, latest } from "./request.js";
import { NUMBERS, at, clamp, lobeOf, own, show, state } from "./state.js";

const canvas = at("canvas");
const context = canvas.getContext("2d", { alpha: false });
let drawn = null; // what the worker sent last
let shown = null; // its pictures, to be put side by side

// Drafts, from the whole picture down: what its sides are divided by, and samples per pixel.
const DRAFTS = [[1, 4], [1, 1], [1.5, 1], [2, 1], [3, 1], [5, 1]];
const FRAME = 1000 / 30; // milliseconds that a draft may take
let draft = 3;
let slow = 0; // drafts in a row that took longer: one alone is the machine's other work
let held = 0; // drafts until a finer one is tried again

function chooseDraft(milliseconds) {
  slow = milliseconds > FRAME ? slow + 1 : 0;
  if (slow > 1 && draft < DRAFTS.length - 1) {
    ++draft;
    slow = 0;
    held = 15;
  } else if (milliseconds < FRAME / 2 && draft > 0 && --held < 0) {
    --draft;
  }
}

/** Pictures have a dark background in the dark scheme. */
export const darkScheme = matchMedia("(prefers-color-scheme: dark)");
const DARK_GROUND = "#35322e"; // lighter than the page: surfaces are darker still

function options(size) {
  return {
    ...(darkScheme.matches && { backgroundColor: DARK_GROUND }),
    resolution: size.join(","), look: state.look, equation: state.equation, exponent: Number(state.n),
    azimuth: Number(state.azimuth), elevation: Number(state.elevation), zoom: Number(state.zoom),
  };
}

/** The same picture by the program. */
export function commandLine() {
  const flags = Object.entries(options(state.resolution.split(",")))
    .filter(([key, value]) => !(/^camera/.test(key) && value === (key === "zoom" ? 1 : 0)))
    .map(([key, value]) => `--${key.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`)}=${value}`);
  const input = own.mesh ?? state.mesh;
  const quoted = /^[\w:./+-]+$/.test(input) ? input : `'${input.replaceAll("'", "'\\''")}'`;
  return `burnish render ${quoted} --lobe=${state.view === "against" ? state.against : lobeOf(state)} ${flags.join(" ")} --json`;
}

export function paint() {
  if (!shown) {
    return;
  }
  const { width, height, pictures, difference } = shown;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const isSplit = state.view === "split";
  if (state.view === "error" && difference) {
    context.putImageData(difference, 0, 0);
    return;
  }
  const x = isSplit ? Math.round((width * Number(state.divider)) / 100) : 0;
  const last = pictures.length - 1;
  if (x < width) {
    context.putImageData(pictures[isSplit || state.view === "against" ? last : 0], 0, 0, x, 0, width - x, height);
  }
  if (x > 0) {
    context.putImageData(pictures[0], 0, 0, 0, 0, x, height);
  }
}

const grouped = (x) => x.toLocaleString("en").replaceAll(",", "\u202f");

function showNumbers() {
  const { pictures, milliseconds, difference } = drawn;
  const items = [`hash <b>${(pictures[state.view === "against" ? pictures.length - 1 : 0]).hash}</b>`];
  if (difference) {
    items.push(`<b>${difference.most}</b> of 255 at most`, `<b>${(100 * difference.share).toFixed(1)}</b> % of pixels differ`);
    at("legend-most").textContent = `${Math.max(difference.most, 8)} of 255`;
  } else {
    items.push(`<b>${grouped(pictures[0].triangles)}</b> triangles`, `<b>${milliseconds.toFixed(0)}</b> ms`);
  }
  at("numbers").innerHTML = items.join(" &nbsp; ");
  const { warnings } = pictures[0];
  at("numbers").title = warnings.join("\n");
  if (warnings.length > 0) {
    at("numbers").append(` \u2003${warnings.length === 1 ? warnings[0] : `${warnings.length} warnings`}`);
  }
}

// Set only on change: a screen reader need not repeat it for each picture.
function showDraft(samples) {
  const text = `draft: ${drawn.width} × ${drawn.height}, ${samples === 1 ? "one sample" : `${samples} samples`} per pixel`;
  if (at("numbers").textContent !== text) {
    at("numbers").textContent = text;
    at("numbers").title = "";
  }
}

// aria-busy from an input until the final picture of the last request is drawn, and while a mesh is opened.
let asked = 0;
let isDrawing = false;
let opening = 0;
const showBusy = () => at("picture").setAttribute("aria-busy", String(isDrawing || opening > 0));

/** Returns when the picture is drawn, or at once if another one is being drawn. */
export function draw(isDraft) {
  isDrawing = true;
  showBusy();
  return drawNumber(isDraft, ++asked);
}

const drawNumber = latest(async (isDraft, number) => {
  try {
    await drawNow(isDraft);
  } finally {
    isDrawing = isDraft || number !== asked;
    showBusy();
  }
}, show);

async function drawNow(isDraft) {
  const full = state.resolution.split(",").map(Number);
  const [share, samples] = DRAFTS[isDraft ? draft : 0];
  const size = full.map((side) => Math.round(side / share));
  const lobes = { lobe: [lobeOf(state)], against: [state.against] }[state.view] ?? [lobeOf(state), state.against];
  const start = performance.now();
  drawn = await request("draw", { lobes, options: { ...options(size), ...(isDraft && { samples }) }, map: state.view === "error" });
  const image = (pixels) => new ImageData(pixels, drawn.width, drawn.height);
  shown = {
    width: drawn.width, height: drawn.height, pictures: drawn.pictures.map((picture) => image(picture.rgba)),
    difference: drawn.difference && image(drawn.difference.rgba),
  };
  show("");
  paint();
  if (!isDraft) {
    showNumbers();
    return;
  }
  showDraft(samples);
  if (rest !== 0) {
    chooseDraft(performance.now() - start);
  }
}

/** Opens a mesh, then calls `opened`, which changes the state and draws. */
export async function open(input, loading, opened) {
  ++opening;
  showBusy();
  try {
    await request("open", { input, options: loading });
    await opened();
  } catch (error) {
    show(error.message);
    at("error").scrollIntoView({ block: "nearest" });
  } finally {
    --opening;
    showBusy();
  }
}

// ---- Input ----

// Drafts while the input changes, the final picture when it rests.
let rest = 0; // the timer; 0: the input rests
let rested = () => {};
export function turn() {
  if (rest === 0) {
    held = 0;
  }
  draw(true); // aria-busy stays until the input rests
  clearTimeout(rest);
  rest = setTimeout(() => {
    rest = 0;
    draw(false);
    rested();
  }, 160);
}

const fixed = (x) => String(Number(x.toFixed(2)));

function orbit(right, up) {
  state.azimuth = fixed(((Number(state.azimuth) - right + 540) % 360) - 180);
  state.elevation = fixed(clamp(Number(state.elevation) + up, NUMBERS.elevation));
  turn();
}

function zoom(factor) {
  state.zoom = fixed(clamp(Number(state.zoom) * factor, NUMBERS.zoom));
  turn();
}

export const FRONT = { azimuth: "0", elevation: "0", zoom: "1" };

const KEYS = {
  ArrowLeft: () => orbit(-6, 0), ArrowRight: () => orbit(6, 0), ArrowUp: () => orbit(0, -6), ArrowDown: () => orbit(0, 6),
  "+": () => zoom(1.1), "=": () => zoom(1.1), "-": () => zoom(1 / 1.1),
  0: () => {
    Object.assign(state, FRONT);
    turn();
  },
};

/** Calls drag(now, before, other) while a pointer moves, with positions, `other` that of a second one; actOf(key) has what a key does. */
export function byHand(element, drag, actOf) {
  const pointers = new Map();
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  element.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (before) {
      const now = [event.clientX, event.clientY];
      pointers.set(event.pointerId, now);
      drag(now, before, [...pointers].find(([id]) => id !== event.pointerId)?.[1]);
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    element.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  element.addEventListener("keydown", (event) => {
    const act = actOf(event.key);
    if (act && !event.ctrlKey && !event.metaKey) {
      event.preventDefault();
      act();
    }
  });
}

/** Pointer, wheel and keys turn the picture; calls onRest when they rest. */
export function turnByHand(onRest) {
  rested = onRest;
  const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
  byHand(canvas, (now, before, other) => (other ? zoom(apart(now, other) / Math.max(1, apart(before, other)))
    : orbit((now[0] - before[0]) * 0.45, (now[1] - before[1]) * 0.45)), (key) => KEYS[key]);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(2 ** (-event.deltaY / 500));
  }, { passive: false });
}

/** Pointer and keys move the divider; calls onMove with its position in per cent. */
export function divideByHand(onMove) {
  const divide = (percent) => onMove(fixed(clamp(percent, NUMBERS.divider)));
  const steps = { ArrowLeft: -2, ArrowDown: -2, ArrowRight: 2, ArrowUp: 2, PageDown: -10, PageUp: 10, Home: -100, End: 100 };
  byHand(at("divider"), ([x]) => {
    const box = at("picture").getBoundingClientRect();
    divide((100 * (x - box.left)) / box.width);
  }, (key) => steps[key] && (() => divide(Number(state.divider) + steps[key])));
}
