// Draws and measures what server.js requests.
import { readFileSync } from "node:fs";
import { basename, extname } from "node:path";
import { parentPort } from "node:worker_threads";
import { load } from "burnish";
import { companions, encodePng, findDecoder } from "burnish/node";
import pngjs from "pngjs";

const [burnish, decode] = await Promise.all([load(), findDecoder()]);
const MOST_SIDE = 4096; // of a picture to compare
const isPng = (path) => extname(path).toLowerCase() === ".png";

async function open(input, options = {}) {
  if (input.startsWith(":")) {
    return burnish.open(input, options);
  }
  const bytes = readFileSync(input);
  return burnish.read(bytes, { ...options, name: basename(input), files: companions(input, bytes), decode });
}

const shown = ({ triangles, vertices, boundingBox, up, warnings }) => ({ triangles, vertices, boundingBox, up, warnings });

// The options of loading; open() takes these, and mesh.render() the others.
const LOADING = ["inputFormat", "clip", "normals", "creaseAngle", "animationTime", "animation", "pointSize", "noTextures", "up"];

async function render({ input, views, width, height, azimuth, elevation, zoom, look, annotate, options = {} }) {
  const loading = Object.fromEntries(LOADING.filter((key) => key in options).map((key) => [key, options[key]]));
  const others = Object.fromEntries(Object.entries(options).filter(([key]) => !LOADING.includes(key)));
  const mesh = await open(input, loading);
  try {
    const pictures = (views.length > 0 ? views : [undefined]).map((view) =>
      mesh.render({ azimuth, elevation, zoom, look, annotate: annotate?.join(), ...others, views: view, resolution: [width, height] }));
    return { text: { views, ...shown(pictures[0]) }, images: pictures.map(encodePng) };
  } finally {
    mesh.close();
  }
}

async function info({ input }) {
  const mesh = await open(input, { measure: true });
  try {
    const { boundingBox, up, warnings } = mesh.render({ size: 16, look: "plain" });
    const size = boundingBox.max.map((most, i) => most - boundingBox.min[i]);
    return { text: { boundingBox: { ...boundingBox, size }, up, ...mesh.facts, warnings } };
  } finally {
    mesh.close();
  }
}

/** The camera that shows both boxes from the direction of a picture. */
function cameraOfBoth(pictures) {
  const { position, focalPoint, viewUp, viewAngle, orthographicHeight } = pictures[0].camera;
  const low = [0, 1, 2].map((k) => Math.min(...pictures.map(({ boundingBox }) => boundingBox.min[k])));
  const high = [0, 1, 2].map((k) => Math.max(...pictures.map(({ boundingBox }) => boundingBox.max[k])));
  const radius = 0.5 * Math.hypot(...high.map((most, k) => most - low[k])) * 1.05;
  const away = position.map((p, k) => p - focalPoint[k]), length = Math.hypot(...away);
  const distance = orthographicHeight > 0 ? length : radius / Math.sin((viewAngle * Math.PI) / 360);
  const middle = low.map((least, k) => 0.5 * (least + high[k]));
  return {
    cameraFocalPoint: middle,
    cameraPosition: middle.map((m, k) => m + (away[k] / length) * distance),
    cameraViewUp: viewUp,
    ...(orthographicHeight > 0 ? { cameraOrthographicHeight: 2 * radius } : { cameraViewAngle: viewAngle }),
  };
}

async function drawBoth(inputs, view, width, height) {
  const meshes = [];
  try {
    for (const input of inputs) {
      meshes.push(await open(input));
    }
    const first = meshes.map((mesh) => mesh.render({ size: 32, look: "plain", views: view }));
    const camera = cameraOfBoth(first);
    return meshes.map((mesh) => mesh.render({ ...camera, resolution: [width, height] }));
  } finally {
    meshes.forEach((mesh) => mesh.close());
  }
}

function readPicture(path) {
  const bytes = readFileSync(path);
  if (bytes.length < 24 || bytes.readUInt32BE(16) > MOST_SIDE || bytes.readUInt32BE(20) > MOST_SIDE) {
    throw new Error(`${basename(path)}: not a PNG file of at most ${MOST_SIDE} x ${MOST_SIDE} pixels`);
  }
  const { width, height, data } = pngjs.PNG.sync.read(bytes);
  return { width, height, channels: 4, pixels: new Uint8Array(data.buffer, data.byteOffset, data.length), warnings: [] };
}

/** Before, after, and their difference: blue where it became darker, orange where it became lighter. */
function panels(a, b) {
  const { width, height } = a, pixels = new Uint8Array(9 * width * height);
  for (let i = 0; i < width * height; ++i) {
    const x = i % width, row = 9 * width * ((i - x) / width), from = [a.channels * i, b.channels * i];
    let most = 0;
    for (let k = 0; k < 3; ++k) {
      const before = a.pixels[from[0] + k], after = b.pixels[from[1] + k];
      pixels[row + 3 * x + k] = before;
      pixels[row + 3 * (width + x) + k] = after;
      most = Math.abs(after - before) > Math.abs(most) ? after - before : most;
    }
    const share = Math.sqrt(Math.abs(most) / 255), color = most < 0 ? [17, 85, 170] : [204, 85, 0];
    color.forEach((c, k) => (pixels[row + 3 * (2 * width + x) + k] = Math.round(245 + share * (c - 245))));
  }
  return { width: 3 * width, height, channels: 3, pixels };
}

async function compare({ inputs, view, width, height, tolerance }) {
  const kinds = inputs.map(isPng);
  if (kinds[0] !== kinds[1]) {
    throw new Error("compare: one is a PNG file and one a model; name two of the same kind");
  }
  const [before, after] = kinds[0] ? inputs.map(readPicture) : await drawBoth(inputs, view, width, height);
  const { pixels, ...numbers } = burnish.compare(before, after, { tolerance });
  const models = kinds[0] ? {} : { before: shown(before), after: shown(after) };
  return { text: { same: numbers.differentPixels === 0, pixels, ...numbers, ...models }, images: [encodePng(panels(before, after))] };
}

const TOOLS = { render, info, compare };
parentPort.on("message", async (request) => {
  try {
    parentPort.postMessage(await TOOLS[request.tool](request));
  } catch (error) {
    parentPort.postMessage({ error: error.message });
  }
});
