// Draws pictures with three.js in a headless Chromium. Usage: node three.mjs MODULES JOBS
//   MODULES  the folder node_modules with three and puppeteer-core
//   JOBS     JSON: environment, strength, width, height, and pictures with file, camera, output and mask
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { extname, resolve } from "node:path";

const [modules, jobsFile] = process.argv.slice(2);
const puppeteer = createRequire(resolve(modules, "index.js"))("puppeteer-core");
const jobs = JSON.parse(readFileSync(jobsFile));
const page = `<script type="importmap">{"imports": {"three": "/three/build/three.module.js", "jsm/": "/three/examples/jsm/"}}</script>
<script type="module">import * as all from "three"; import { GLTFLoader } from "jsm/loaders/GLTFLoader.js"; import { HDRLoader } from "jsm/loaders/HDRLoader.js";
import { DRACOLoader } from "jsm/loaders/DRACOLoader.js"; import { KTX2Loader } from "jsm/loaders/KTX2Loader.js"; import { MeshoptDecoder } from "jsm/libs/meshopt_decoder.module.js";
window.all = { ...all, GLTFLoader, HDRLoader, DRACOLoader, KTX2Loader, MeshoptDecoder };</script>`;
const types = { ".js": "text/javascript", ".wasm": "application/wasm", ".html": "text/html" };
const server = createServer((request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
  try {
    const body = path === "/page.html" ? page : readFileSync(path.startsWith("/three/") ? resolve(modules, path.slice(1)) : path.slice("/file".length));
    response.writeHead(200, { "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(body);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));

// In the page: the renderer and the environment.
async function open({ environment, width, height, ratio }) {
  const renderer = new all.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
  renderer.setPixelRatio(ratio);
  renderer.setSize(width, height);
  renderer.toneMapping = all.NoToneMapping;
  const draco = new all.DRACOLoader().setDecoderPath("/three/examples/jsm/libs/draco/gltf/");
  const basis = new all.KTX2Loader().setTranscoderPath("/three/examples/jsm/libs/basis/").detectSupport(renderer);
  const loader = new all.GLTFLoader().setDRACOLoader(draco).setKTX2Loader(basis).setMeshoptDecoder(all.MeshoptDecoder);
  const texture = await new all.HDRLoader().setDataType(all.FloatType).loadAsync("/file" + environment);
  texture.mapping = all.EquirectangularReflectionMapping;
  const light = new all.PMREMGenerator(renderer).fromEquirectangular(texture).texture;
  window.state = { renderer, loader, texture, light };
}

// The picture and its mask, PNG files as data URLs.
async function draw({ file, camera }, { width, height, strength }) {
  const { renderer, loader, texture, light } = state;
  const { scene: object } = await loader.loadAsync("/file" + encodeURI(file));
  const scene = new all.Scene().add(object);
  Object.assign(scene, { environment: light, environmentIntensity: strength, background: texture, backgroundIntensity: strength });
  const lights = [], materials = new Set();
  object.traverse((node) => {
    if (node.isLight) lights.push(node);
    node.frustumCulled = false;
    [node.material ?? []].flat().forEach((material) => materials.add(material));
  });
  lights.forEach((node) => node.removeFromParent());
  // burnish draws both sides of every triangle.
  materials.forEach((material) => (material.side = all.DoubleSide));
  const distance = Math.hypot(...camera.position.map((x, i) => x - camera.focal_point[i]));
  const view = new all.PerspectiveCamera(camera.view_angle, width / height, distance / 100, distance * 100);
  view.position.set(...camera.position);
  view.up.set(...camera.view_up);
  view.lookAt(...camera.focal_point);
  renderer.render(scene, view);
  const output = renderer.domElement.toDataURL();
  scene.background = null;
  materials.forEach((material) => Object.assign(material, { transparent: false, transmission: 0, needsUpdate: true }));
  renderer.render(scene, view);
  return { output, mask: renderer.domElement.toDataURL() };
}

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: [...(process.getuid() === 0 ? ["--no-sandbox"] : []), "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
    "--disable-background-networking"],
  protocolTimeout: 600000,
});
const tab = await browser.newPage();
await tab.goto(`http://127.0.0.1:${server.address().port}/page.html`);
await tab.waitForFunction("window.all", { timeout: 60000 });
await tab.evaluate(open, jobs);
for (const picture of jobs.pictures) {
  try {
    const drawn = await tab.evaluate(draw, picture, { ...jobs, pictures: [] });
    for (const name of ["output", "mask"]) writeFileSync(picture[name], Buffer.from(drawn[name].split(",")[1], "base64"));
  } catch (error) {
    console.error(`three.mjs: ${picture.file}: ${error.message.split("\n")[0]}`);
  }
}
await browser.close();
server.close();
