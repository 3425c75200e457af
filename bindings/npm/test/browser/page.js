// A dome of normals under one light by three.js' renderers, with three.js' highlights and with burnish's.
import * as GL from "three";
import * as GPU from "three/webgpu";
import { load } from "burnish/wasm";
import { useBurnish } from "burnish/three";
import { BurnishPhongMaterial } from "burnish/three/tsl";
import { compareAreaLights } from "./area.js";

const SIZE = 128;
const SHININESS = 30;
const INTENSITY = 0.7;
const LIGHT = [0.4, 0, Math.sqrt(1 - 0.16)]; // pictures are the same upside down: renderers differ in which row is first

const normalAt = (x, y) => [x, y, Math.sqrt(Math.max(0.05, 1.2 - x * x - y * y))];
const unit = (v) => v.map((c) => c / Math.hypot(...v));
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

function scene({ PlaneGeometry, Float32BufferAttribute, Scene, Mesh, DirectionalLight }, material) {
  const plane = new PlaneGeometry(2, 2, SIZE, SIZE);
  const { array, count } = plane.attributes.position;
  const normals = [];
  for (let i = 0; i < count; ++i) {
    normals.push(...unit(normalAt(array[3 * i], array[3 * i + 1])));
  }
  plane.setAttribute("normal", new Float32BufferAttribute(normals, 3));
  const light = new DirectionalLight("white", INTENSITY);
  light.position.set(...LIGHT);
  return new Scene().add(new Mesh(plane, material), light);
}

const camera = ({ OrthographicCamera }) => {
  const made = new OrthographicCamera(-1, 1, 1, -1, 0, 2);
  made.position.z = 1;
  return made;
};

// Channel 0 of the picture, into a target of linear light.
async function picture(three, renderer, material) {
  const target = renderer.isWebGLRenderer ? new three.WebGLRenderTarget(SIZE, SIZE) : new three.RenderTarget(SIZE, SIZE);
  renderer.setRenderTarget(target);
  renderer.render(scene(three, material), camera(three));
  const pixels = renderer.isWebGLRenderer
    ? await renderer.readRenderTargetPixelsAsync(target, 0, 0, SIZE, SIZE, new Uint8Array(4 * SIZE * SIZE))
    : await renderer.readRenderTargetPixelsAsync(target, 0, 0, SIZE, SIZE);
  return Uint8Array.from({ length: SIZE * SIZE }, (_, i) => pixels[4 * i]);
}

// three.js' Phong model: N.L intensity (n / 2 + 1) / (4 pi) lobe(N.H), at the middles of pixels.
function expected(values) {
  const half = unit([LIGHT[0], LIGHT[1], LIGHT[2] + 1]);
  const normals = Array.from({ length: SIZE * SIZE }, (_, i) =>
    unit(normalAt(((i % SIZE) + 0.5) * (2 / SIZE) - 1, (Math.floor(i / SIZE) + 0.5) * (2 / SIZE) - 1)));
  const lobe = values(normals.map((n) => dot(n, half)));
  return normals.map((n, i) => 255 * Math.min(1, Math.max(0, dot(n, LIGHT)) * INTENSITY * ((SHININESS / 2 + 1) / Math.PI) * 0.25 * lobe[i]));
}

const difference = (a, b) => a.reduce((most, value, i) => Math.max(most, Math.abs(value - b[i])), 0);

const PHONG = { color: "black", specular: "white", shininess: SHININESS };
const LOBES = [{ fit: "energy", order: 2 }, { fit: "minimax", order: 4 }, { fit: "projected", order: 8 }, { fit: "taylor", order: 16 },
  { fit: "shift7", order: 2 }, { fit: "zeta", order: 2, zeta: 6.645 }];
const words = ({ fit, order, zeta }) => (fit === "zeta" ? `zeta${zeta}:${order}` : `${fit}:${order}`);

const results = {};

async function compare(name, three, renderer, make) {
  const burnish = await load();
  for (const lobe of LOBES) {
    const want = expected((cosines) => burnish.lobeValues(words(lobe), SHININESS, cosines));
    results[`${name} ${words(lobe)}`] = difference(await picture(three, renderer, make(lobe)), want);
  }
  const power = expected((cosines) => burnish.lobeValues("power", SHININESS, cosines));
  const plain = await picture(three, renderer, new (three.MeshPhongNodeMaterial ?? three.MeshPhongMaterial)(PHONG));
  results[`${name} power`] = difference(plain, power);
}

async function run() {
  const gl = new GL.WebGLRenderer({ canvas: document.createElement("canvas") });
  await compare("WebGLRenderer", GL, gl, (lobe) => useBurnish(new GL.MeshPhongMaterial(PHONG), lobe));
  const original = useBurnish(new GL.MeshPhongMaterial(PHONG), LOBES[1]);
  results["WebGLRenderer: a clone"] = difference(await picture(GL, gl, original), await picture(GL, gl, original.clone()));
  const metal = { color: "white", metalness: 1, roughness: 0.5 };
  const stock = await picture(GL, gl, new GL.MeshStandardMaterial(metal));
  const standard = await picture(GL, gl, useBurnish(new GL.MeshStandardMaterial(metal)));
  results["standard: brightest of three.js and of the lobe"] = [Math.max(...stock), Math.max(...standard)];
  results["standard: dark pixels of three.js and of the lobe"] = [stock, standard].map((p) => p.filter((c) => c === 0).length);
  for (const forceWebGL of [true, false]) {
    const renderer = new GPU.WebGPURenderer({ canvas: document.createElement("canvas"), forceWebGL });
    await renderer.init();
    const backend = renderer.backend.isWebGPUBackend ? "WebGPU" : "WebGL";
    await compare(`WebGPURenderer ${backend}`, GPU, renderer, (lobe) => new BurnishPhongMaterial(PHONG, lobe));
  }
  const worker = new Worker("worker.js", { type: "module" });
  worker.postMessage({ input: ":teapot", options: { look: "plain" } });
  results.worker = await new Promise((resolve) => (worker.onmessage = ({ data }) => resolve(data)));
  return results;
}

// Called by run.mjs.
window.area = compareAreaLights;

window.results = run().catch((error) => ({ error: String(error?.stack ?? error) }));
