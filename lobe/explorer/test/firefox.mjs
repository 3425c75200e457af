// The page in Debian's Firefox through WebDriver BiDi: hashes, curves, claims, fits and formulas.
// Usage: node firefox.mjs BURNISH PAGE SERVER
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import puppeteer from "puppeteer-core";

const [burnish, folder, server] = process.argv.slice(2);
const executablePath = process.env.FIREFOX ?? "/usr/bin/firefox-esr";
if (!existsSync(executablePath)) {
  console.log("explorer in Firefox: skipped: firefox-esr is missing; scripts/install-deps browser");
  process.exit(0);
}
const PORT = 8128;
const scratch = mkdtempSync(join(tmpdir(), "burnish-"));
const served = spawn(process.execPath, [server, folder, String(PORT)], { stdio: ["ignore", "pipe", "inherit"] });
await new Promise((resolve) => served.stdout.once("data", resolve));
const browser = await puppeteer.launch({ browser: "firefox", executablePath, headless: true, env: { ...process.env, HOME: scratch } });

let failures = 0;
let checks = 0;
function check(what, found, expected) {
  ++checks;
  if (found !== expected) {
    ++failures;
    console.log(`FAILED in Firefox: ${what}\n  found    ${found}\n  expected ${expected}`);
  }
}

try {
  const page = await browser.newPage();
  await page.setViewport({ width: 1280, height: 900 });
  page.on("pageerror", (error) => check("no error of the page", error.message, ""));
  const text = (selector) => page.$eval(selector, (element) => element.textContent);
  const settled = () => page.waitForFunction(() => document.getElementById("picture").getAttribute("aria-busy") === "false" && document.getElementById("about").textContent);
  async function agrees(what) {
    await settled();
    const hash = (await text("#numbers")).match(/hash ([0-9a-f]{16})/)?.[1];
    const line = (await text("#command")).replace(/^burnish/, `'${burnish}'`);
    check(what, hash, JSON.parse(execFileSync("sh", ["-c", `${line} -o ${join(scratch, "x.png")}`], { encoding: "utf8" })).hash);
  }
  await page.goto(`http://127.0.0.1:${PORT}/`);
  await agrees("as it opens");
  await page.select("#fit", "minimax");
  await page.click("#order button[value='4']");
  await page.click("#mesh button[value=':knot']");
  await page.click("#equation button[value='phong']");
  await agrees("another lobe and mesh");
  await page.focus("#canvas");
  await page.keyboard.press("ArrowRight");
  await agrees("turned");
  check("43 claims", (await page.$$("#claims details")).length, 43);
  check("six curves", (await page.$$(".plot canvas")).length, 6);
  const threads = await page.evaluate(() => (crossOriginIsolated ? navigator.hardwareConcurrency : 0));
  check("threads", (await text("#about")).includes(threads === 1 ? "one thread" : `${threads} threads`), true);
  await page.click("#language button[value='verilog']");
  await page.waitForFunction(() => document.getElementById("code").textContent.includes("burnish_lobe #("));
  check("nothing is wider than the page", await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false);
} finally {
  await browser.close();
  served.kill();
  rmSync(scratch, { recursive: true, force: true });
}
console.log(`explorer in Firefox: ${checks} checks, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
