// Both renderers of three.js in Debian's Chromium, compared with the package's own lobes.
// Usage: node run.mjs, in a folder with page.html where burnish, three and playwright-core are installed
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

// The files of this folder answer for an address of this machine, isolated from other origins, for threads.
const HOME = "http://127.0.0.1:8129";
const headers = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };
const folder = mkdtempSync(join(tmpdir(), "burnish-"));
const browser = await chromium.launchPersistentContext(folder, {
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", "--use-vulkan=swiftshader",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
let failures = 0;
const fail = (line) => {
  ++failures;
  console.log(`FAILED ${line}`);
};
try {
  const page = await browser.newPage();
  await browser.route(`${HOME}/**`, (route) => route.fulfill({ path: `.${new URL(route.request().url()).pathname}`, headers }));
  page.on("pageerror", (error) => fail(error.message));
  page.on("console", (message) => message.type() === "error" && fail(message.text()));
  await page.goto(`${HOME}/page.html`);
  await page.waitForFunction("window.results");
  const results = await page.evaluate("window.results");
  for (const [name, value] of Object.entries(results)) {
    console.log(`${name}: ${value}`);
    if (name.startsWith("WebG") && !(value <= 0.6)) { // half a code for rounding, the rest for normals between vertices
      fail(`${name}: pixels differ by ${value}`);
    }
  }
  const count = Object.keys(results).filter((name) => name.startsWith("WebG")).length;
  if (results.error || count !== 22 || results.worker?.[0] !== "fcaa6cc10a88e4b5" || results.worker?.[1] !== results.worker?.[0]) {
    fail(results.error ?? `${count} pictures, in a worker ${results.worker}; expected 22 and fcaa6cc10a88e4b5`);
  }
  const dark = results["standard: dark pixels of three.js and of the lobe"] ?? [0, 0];
  if (!(dark[1] > dark[0])) {
    fail("the lobe of MeshStandardMaterial has no edge");
  }
  for (const { roughness, rms, most } of await page.evaluate("window.area([0.2, 0.5, 1], 60, 40)")) {
    console.log(`area light, roughness ${roughness}: lobes and LTC differ by ${rms.toFixed(4)}, at most ${most.toFixed(3)}`);
    if (!(rms < 0.025)) {
      fail(`area light, roughness ${roughness}: ${rms}`);
    }
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
console.log(`browser: ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
