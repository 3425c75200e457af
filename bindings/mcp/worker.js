// Draws and measures what server.js requests.
import { readFileSync } from "node:fs";
import { basename, extname } from "node:path";
import { parentPort } from "node:worker_threads";
import { load } from "burnish";
import { companions, encodePng, findDecoder, readPngSize } from "burnish/node";
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

async function render({ input, views, width, height, azimuth, elevation, zoom, look, annotate, options = {} }) {
  const { loading, drawing } = burnish.split(options);
  const mesh = await open(input, loading);
  try {
    const pictures = (views.length > 0 ? views : [undefined]).map((view) =>
      mesh.render({ azimuth, elevation, zoom, look, annotate, ...drawing, views: view, width, height })); // these replace other sizes
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

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / Math.hypot(...a));
/** The middle of an interval that is common to, or holds, intervals around the coordinates `x`. */
const middleOf = (x, sizes, isCommon) => {
  const [low, high] = [x.map((v, i) => v - sizes[i]), x.map((v, i) => v + sizes[i])];
  return 0.5 * (isCommon ? Math.max(...low) + Math.min(...high) : Math.min(...low) + Math.max(...high));
};

/** The camera that shows what two cameras with one direction show, in pictures of the same proportions. */
function cameraOfBoth(cameras, aspect) {
  const { position, focalPoint, viewUp, viewAngle, orthographicHeight } = cameras[0];
  const away = unit(position.map((p, k) => p - focalPoint[k])), right = unit(cross(viewUp, away)), up = cross(away, right);
  const [x, y, z] = [right, up, away].map((axis) => cameras.map((camera) => dot(camera.position, axis)));
  const isParallel = orthographicHeight > 0, half = cameras.map((camera) => camera.orthographicHeight / 2);
  const slope = Math.tan((viewAngle * Math.PI) / 360);
  // a perspective moves back until its pyramid holds both positions
  const back = isParallel ? Math.max(...z)
    : Math.max(...z, 0.5 * (z[0] + z[1] + Math.max(Math.abs(x[0] - x[1]) / aspect, Math.abs(y[0] - y[1])) / slope));
  const height = isParallel ? half : z.map((v) => slope * (back - v)), width = height.map((h) => aspect * h);
  const at = [middleOf(x, width, !isParallel), middleOf(y, height, !isParallel), back];
  const eye = [0, 1, 2].map((k) => right[k] * at[0] + up[k] * at[1] + away[k] * at[2]);
  const reach = (v, sizes) => Math.max(...v.map((c, i) => c + sizes[i])) - Math.min(...v.map((c, i) => c - sizes[i]));
  return {
    cameraPosition: eye,
    cameraFocalPoint: eye.map((e, k) => e - away[k]),
    cameraViewUp: viewUp,
    ...(isParallel ? { cameraOrthographicHeight: Math.max(reach(y, height), reach(x, width) / aspect) } : { cameraViewAngle: viewAngle }),
  };
}

async function drawBoth(inputs, view, width, height) {
  const meshes = [];
  try {
    for (const input of inputs) {
      meshes.push(await open(input, meshes[0] && { up: meshes[0].up }));
    }
    const direction = view ? { views: view } : { elevation: 0 }; // the same for flat objects and others
    const framed = meshes.map((mesh) => mesh.render({ resolution: [width, height], samples: 1, look: "plain", ...direction }).camera);
    const camera = cameraOfBoth(framed, width / height);
    return meshes.map((mesh) => mesh.render({ ...camera, resolution: [width, height], ground: false }));
  } finally {
    meshes.forEach((mesh) => mesh.close());
  }
}

function readPicture(path) {
  const bytes = readFileSync(path);
  if (Math.max(...readPngSize(bytes)) > MOST_SIDE) {
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
