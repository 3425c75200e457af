// Times of the page in Debian's Chromium, headless: first picture, pictures of 100,352 triangles, and their rate during input.
// Medians.
// Usage: node bench.mjs PAGE SERVER
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [folder, server] = process.argv.slice(2);
const [LOADS, PICTURES] = [21, 60];
const scratch = mkdtempSync(join(tmpdir(), "burnish-"));
const servers = [];

async function serve(port, ...flags) {
  const served = spawn(process.execPath, [server, folder, String(port), ...flags], { stdio: ["ignore", "pipe", "inherit"] });
  servers.push(served);
  await new Promise((resolve, reject) => {
    served.stdout.once("data", resolve);
    served.once("exit", () => reject(new Error(`the server of port ${port} ended`)));
  });
  return { served, home: `http://127.0.0.1:${port}/` };
}

function median(times) {
  const sorted = times.toSorted((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

// A torus of 224 x 224 quadrilaterals as binary STL.
function torus(n = 224) {
  const point = (i, j) => {
    const [u, v] = [(2 * Math.PI * i) / n, (2 * Math.PI * j) / n];
    const r = 1 + 0.4 * Math.cos(v);
    return [r * Math.cos(u), r * Math.sin(u), 0.4 * Math.sin(v)];
  };
  const bytes = Buffer.alloc(84 + 2 * n * n * 50);
  bytes.writeUInt32LE(2 * n * n, 80);
  let at = 84;
  for (let i = 0; i < n; ++i) {
    for (let j = 0; j < n; ++j) {
      const [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
      for (const corners of [[a, b, c], [a, c, d]]) {
        corners.flat().forEach((x, k) => bytes.writeFloatLE(x, at + 12 + 4 * k));
        at += 50;
      }
    }
  }
  return bytes;
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking"],
});
const ready = (page) => page.waitForFunction(() => document.getElementById("picture").ariaBusy === "false" && document.getElementById("about").textContent);

// From the start of the navigation, in a context of its own: nothing cached.
async function firstPicture(home) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
  const page = await context.newPage();
  await page.goto(home);
  await page.waitForTimeout(1000); // requests take the page's time
  await page.waitForFunction(() => performance.getEntriesByName("picture").length > 0);
  const time = await page.evaluate(() => performance.getEntriesByName("picture")[0].startTime);
  await context.close();
  return time;
}

async function openTorus(home, address = "") {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 } });
  await page.goto(home + address);
  await ready(page);
  await page.setInputFiles("#file", join(scratch, "torus.stl"));
  await page.waitForFunction(() => document.getElementById("file-name").textContent === "torus.stl");
  await ready(page);
  return page;
}

// Pictures one after the other, each put on a canvas.
async function pictures(home, options) {
  const page = await openTorus(home);
  const times = await page.evaluate(async ([count, given]) => {
    const { request } = await import("./request.js");
    const context = document.createElement("canvas").getContext("2d");
    const found = [];
    for (let i = 0; i < count; ++i) {
      const start = performance.now();
      const options = { resolution: "800,600", look: "lobes", exponent: 40, azimuth: 3 * i, elevation: 20, ...given };
      const { pictures: [{ rgba }], width, height } = await request("draw", { lobes: ["energy:2"], options });
      context.putImageData(new ImageData(rgba, width, height), 0, 0);
      found.push(performance.now() - start);
    }
    return found;
  }, [PICTURES, options]);
  await page.close();
  return median(times);
}

// Times between pictures on the page's canvas while an arrow key is held, and the page's own numbers.
async function orbit(home, view) {
  const page = await openTorus(home, `#view=${view}&resolution=800,600`);
  const { times, draft } = await page.evaluate(async (count) => {
    const canvas = document.getElementById("canvas");
    const numbers = document.getElementById("numbers");
    const timesOfPictures = () => performance.getEntriesByName("picture").map(({ startTime }) => startTime);
    const before = timesOfPictures().length;
    const hand = setInterval(() => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" })), 4);
    let draft = "";
    while (timesOfPictures().length < before + 20 + count) { // 20: until a size is chosen
      await new Promise((resolve) => setTimeout(resolve, 20));
      draft = numbers.textContent;
    }
    clearInterval(hand);
    const after = timesOfPictures().slice(before + 19);
    return { times: after.slice(1).map((time, i) => time - after[i]), draft };
  }, PICTURES);
  await page.close();
  return { time: median(times), draft };
}

try {
  writeFileSync(join(scratch, "torus.stl"), torus());
  console.log(`${cpus().length} processors, ${cpus()[0].model}; medians of ${LOADS} loads and ${PICTURES} pictures`);
  for (const [what, flags] of [["one thread", ["plain"]], ["threads", []]]) {
    const { served, home } = await serve(flags.length > 0 ? 8131 : 8132, ...flags);
    const loads = [];
    for (let i = 0; i < LOADS; ++i) {
      loads.push(await firstPicture(home));
    }
    console.log(`${what}: first picture after ${median(loads).toFixed(0)} ms`);
    for (const samples of [4, 1]) {
      const time = await pictures(home, { samples });
      console.log(`${what}: 100,352 triangles, 800 x 600, ${samples} sample${samples > 1 ? "s" : ""} per pixel: ${time.toFixed(1)} ms, ${(1000 / time).toFixed(0)} a second`);
    }
    for (const [name, view] of [["one lobe", "lobe"], ["both lobes", "split"]]) {
      const { time, draft } = await orbit(home, view);
      console.log(`${what}: the same, ${name}, while the page turns it: ${time.toFixed(1)} ms, ${(1000 / time).toFixed(0)} a second (${draft})`);
    }
    served.kill();
  }
} finally {
  servers.forEach((served) => served.kill());
  await browser.close();
  rmSync(scratch, { recursive: true, force: true });
}
