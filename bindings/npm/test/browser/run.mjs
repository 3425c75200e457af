// Both renderers of three.js in Debian's Chromium, compared with the package's own lobes.
// Usage: node run.mjs SERVER, where burnish, three and playwright-core are installed, and page.html
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const PORT = 8129;
const served = spawn(process.execPath, [process.argv[2], ".", String(PORT)], { stdio: ["ignore", "pipe", "inherit"] });
await new Promise((resolve, reject) => {
  served.stdout.once("data", resolve);
  served.once("exit", () => reject(new Error(`the server of port ${PORT} ended`)));
});
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
  page.on("pageerror", (error) => fail(error.message));
  page.on("console", (message) => message.type() === "error" && fail(message.text()));
  await page.goto(`http://127.0.0.1:${PORT}/page.html`);
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
  served.kill();
  rmSync(folder, { recursive: true, force: true });
}
console.log(`browser: ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
