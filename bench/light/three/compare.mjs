// Pictures of burnish and three.js under the same room (half as bright, so nothing is saturated), without ambient occlusion.
// Usage: node compare.mjs BURNISH SCRATCH [FILE.glb ...]; see run.
import { execFileSync } from "node:child_process";
import { createReadStream, existsSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { basename, join, normalize, resolve } from "node:path";
import { chromium } from "playwright-core";

const [burnish, scratch, ...files] = process.argv.slice(2);
const ROWS = [["white metal", [0.95, 0.95, 0.95], 1], ["gold", [1, 0.71, 0.29], 1], ["white dielectric", [0.8, 0.8, 0.8], 0],
  ["red dielectric", [0.6, 0.03, 0.03], 0], ["black dielectric", [0.02, 0.02, 0.02], 0]];
const SEGMENTS = 128, COLUMNS = 11;
const centers = ROWS.flatMap((_, row) => Array.from({ length: COLUMNS }, (_, column) => [2.3 * column, -2.3 * row, 0]));

// A material per row, a roughness per column.
function writeSpheres(file) {
  const positions = [], indices = [];
  for (let i = 0; i <= SEGMENTS / 2; ++i) {
    for (let j = 0; j <= SEGMENTS; ++j) {
      const theta = 2 * Math.PI * i / SEGMENTS, phi = 2 * Math.PI * j / SEGMENTS;
      positions.push(Math.sin(theta) * Math.cos(phi), Math.cos(theta), -Math.sin(theta) * Math.sin(phi));
      const a = i * (SEGMENTS + 1) + j, b = a + SEGMENTS + 1;
      if (i < SEGMENTS / 2 && j < SEGMENTS) indices.push(a, b, b + 1, a, b + 1, a + 1);
    }
  }
  const bytes = Buffer.concat([Buffer.from(new Float32Array(positions).buffer), Buffer.from(new Uint32Array(indices).buffer)]);
  const primitive = (material) => ({ primitives: [{ attributes: { POSITION: 0, NORMAL: 0 }, indices: 1, material }] });
  writeFileSync(file, JSON.stringify({
    asset: { version: "2.0" },
    scenes: [{ nodes: centers.map((_, i) => i) }],
    nodes: centers.map((translation, mesh) => ({ mesh, translation })),
    meshes: centers.map((_, i) => primitive(i)),
    materials: centers.map((_, i) => {
      const [, color, metallicFactor] = ROWS[Math.floor(i / COLUMNS)];
      return { pbrMetallicRoughness: { baseColorFactor: [...color, 1], metallicFactor, roughnessFactor: i % COLUMNS / 10 } };
    }),
    buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
    bufferViews: [{ buffer: 0, byteLength: 4 * positions.length }, { buffer: 0, byteOffset: 4 * positions.length, byteLength: 4 * indices.length }],
    accessors: [{ bufferView: 0, componentType: 5126, count: positions.length / 3, type: "VEC3", min: [-1, -1, -1], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5125, count: indices.length, type: "SCALAR" }],
  }));
}

// Radiance HDR without runs.
function writeEnvironment(file, width, rgb) {
  const texels = Buffer.alloc(4 * rgb.length / 3);
  for (let i = 0; i < rgb.length / 3; ++i) {
    const color = rgb.slice(3 * i, 3 * i + 3), most = Math.max(...color);
    if (most < 1e-32) continue;
    const exponent = Math.floor(Math.log2(most)) + 1;
    color.forEach((x, k) => { texels[4 * i + k] = Math.min(255, Math.floor(x * 256 / 2 ** exponent)); });
    texels[4 * i + 3] = exponent + 128;
  }
  const head = `#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y ${rgb.length / 3 / width} +X ${width}\n`;
  writeFileSync(file, Buffer.concat([Buffer.from(head), texels]));
}

const server = createServer((request, response) => { // /files/N/NAME is next to the N-th file, the rest in the scratch folder
  const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname));
  const [, number, rest] = path.match(/^\/files\/(\d+)\/(.*)$/) ?? [];
  const found = number ? join(resolve(inputs[number]), "..", rest) : join(scratch, path);
  response.writeHead(existsSync(found) ? 200 : 404, { "content-type": /js$/.test(found) ? "text/javascript" : /html$/.test(found) ? "text/html" : "application/octet-stream" });
  existsSync(found) ? createReadStream(found).pipe(response) : response.end();
});
const spheres = join(scratch, "spheres.gltf"), inputs = [spheres, ...files];
writeSpheres(spheres);
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
try {
  const page = await browser.newPage();
  page.setDefaultTimeout(300000);
  page.on("pageerror", (error) => console.log(error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/page.html`);
  await page.waitForFunction("window.compare");
  const all = [], room = join(scratch, "room.hdr");
  writeEnvironment(room, 512, await page.evaluate("window.environment(512, 256)"));
  for (const [i, file] of inputs.entries()) {
    const png = join(scratch, "picture.png"), size = i === 0 ? ["--camera-direction=0,0,-1", "--resolution=1100,520"] : ["--size=400"];
    const flags = [`--environment=${room}`, "--environment-strength=0.5", "--light=none", "--occlusion=none", "--no-background", "--quiet", "--json"];
    const report = JSON.parse(execFileSync(burnish, ["render", file, ...size, ...flags, "--overwrite", "-o", png], { encoding: "utf8" }));
    const picture = `data:image/png;base64,${readFileSync(png).toString("base64")}`;
    const result = await page.evaluate(([...a]) => window.compare(...a), [`/files/${i}/${basename(file)}`, picture, report, i === 0 ? centers : []]);
    all.push(result.all);
    console.log(`${i === 0 ? `spheres, three.js r${result.revision}` : basename(file)}: ${result.all.toFixed(1)} dB`);
    for (let row = 0; i === 0 && row < ROWS.length; ++row) {
      console.log(`| ${[ROWS[row][0], ...result.each.slice(row * COLUMNS, (row + 1) * COLUMNS).map((x) => x.toFixed(1))].join(" | ")} |`);
    }
  }
  const sorted = all.toSorted((a, b) => a - b), middle = sorted.length / 2;
  const median = (sorted[Math.ceil(middle) - 1] + sorted[Math.floor(middle)]) / 2;
  console.log(`${all.length} pictures: mean ${(all.reduce((a, b) => a + b) / all.length).toFixed(1)} dB, median ${median.toFixed(1)}, worst ${sorted[0].toFixed(1)}`);
} finally {
  await browser.close();
  server.close();
}
