// The page in Debian's Chromium, and in short in its Firefox through WebDriver BiDi.
// Usage: node explorer.mjs BURNISH PAGE SERVER DATA RTL        SCREENS=FOLDER: screenshots of the page at every width
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";
import puppeteer from "puppeteer-core";
import { layoutFaults, pictureFaults } from "./screens.mjs";

const [burnish, folder, server, data, rtl] = process.argv.slice(2);
const { SCREENS } = process.env;
const PORT = 8127;
const HOME = `http://127.0.0.1:${PORT}/`;
const scratch = mkdtempSync(join(tmpdir(), "burnish-"));
async function serve(port, ...mode) {
  const served = spawn(process.execPath, [server, folder, String(port), ...mode], { stdio: ["ignore", "pipe", "inherit"] });
  await new Promise((resolve, reject) => {
    served.stdout.once("data", resolve);
    served.once("exit", () => reject(new Error(`the server of port ${port} ended`)));
  });
  return served;
}
const served = await serve(PORT);
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update",
    "--disable-sync", "--disable-gpu", "--enable-unsafe-swiftshader"],
});

let failures = 0;
let checks = 0;
function check(what, found, expected) {
  ++checks;
  if (found !== expected) {
    ++failures;
    console.log(`FAILED ${what}\n  found    ${found}\n  expected ${expected}`);
  }
}

check("an address that can't be decoded", (await fetch(`${HOME}%`)).status, 404);
check("the server after it", (await fetch(HOME)).status, 200);

async function openPage(address = "", { width = 1280, height = 900, colorScheme = "light" } = {}, home = HOME) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  page.on("pageerror", (error) => check("no error of the page", error.message, ""));
  page.on("console", (message) => message.type() === "error" && check("no error on the console", message.text(), ""));
  await page.addInitScript(() => {
    window.shifts = 0;
    new PerformanceObserver((list) => list.getEntries().forEach((entry) => (window.shifts += entry.value))).observe({ type: "layout-shift", buffered: true });
  });
  await page.goto(home + address);
  await settled(page);
  return page;
}

// of a page of either browser
const textOf = (page, selector) => page.$eval(selector, (element) => element.textContent);

const hashOf = async (page) => (await textOf(page, "#numbers")).match(/hash ([0-9a-f]{16})/)?.[1];

const settled = (page) => page.waitForFunction(() => document.getElementById("picture").getAttribute("aria-busy") === "false" && document.getElementById("about").textContent);

// The hash of the program, run by the page's command line.
async function byProgram(page) {
  const line = (await textOf(page, "#command")).replace(/^burnish/, `'${burnish}'`);
  return JSON.parse(execFileSync("sh", ["-c", `${line} -o ${join(scratch, "x.png")}`], { encoding: "utf8", cwd: data })).hash;
}

async function agrees(page, what) {
  await settled(page);
  check(what, await hashOf(page), await byProgram(page));
}

async function countsThreads(page) {
  const threads = await page.evaluate(() => (crossOriginIsolated ? navigator.hardwareConcurrency : 0));
  check("threads", (await textOf(page, "#about")).includes(threads === 1 ? "one thread" : `${threads} threads`), true);
}

const changes = async (page, what, act) => {
  const before = await hashOf(page);
  await act();
  await settled(page);
  check(`${what} changes the picture`, (await hashOf(page)) !== before, true);
  await agrees(page, what);
};

try {
  const page = await openPage();
  await agrees(page, "as it opens");
  await changes(page, "fit", () => page.selectOption("#fit", "minimax"));
  await changes(page, "order", () => page.click("#order button[value='8']"));
  await changes(page, "exponent", () => page.fill("#exponent", "100"));
  await changes(page, "slider", () => page.fill("#exponent-range", "300"));
  await changes(page, "mesh", () => page.click("#mesh button[value=':knot']"));
  await changes(page, "equation", () => page.click("#equation button[value='phong']"));
  await changes(page, "look", () => page.selectOption("#look", "plain"));
  await changes(page, "pixels", () => page.selectOption("#resolution", "480,360"));
  await changes(page, "against", () => page.click("#view button[value='against']"));
  await changes(page, "Schlick", () => page.selectOption("#against", "schlick"));
  await page.click("#view button[value='split']");
  await page.focus("#canvas");
  await changes(page, "arrows", () => page.keyboard.press("ArrowRight"));
  await changes(page, "plus", () => page.keyboard.press("+"));
  const box = await page.locator("#canvas").boundingBox();
  await changes(page, "a drag", async () => {
    await page.mouse.move(box.x + 0.7 * box.width, box.y + 200);
    await page.mouse.down();
    await page.mouse.move(box.x + 0.7 * box.width + 60, box.y + 230, { steps: 5 });
    await page.mouse.up();
  });
  const turned = await hashOf(page);
  const copy = await openPage(new URL(page.url()).hash);
  check("the address has it all", await hashOf(copy), turned);
  await copy.close();
  await page.focus("#divider");
  await page.keyboard.press("PageUp");
  check("the divider follows keys", await page.getAttribute("#divider", "aria-valuenow"), "41");
  await page.click("#view button[value='error']");
  await settled(page);
  check("errors are counted", /\d+ of 255 at most/.test(await page.textContent("#numbers")), true);
  check("an order that the exponent has not", await page.isDisabled("#order button[value='32']"), true);

  // ---- Files ----
  await page.click("#view button[value='lobe']");
  const hand = async (...names) => {
    await page.setInputFiles("#file", names.map((name) => join(data, name)));
    await page.waitForFunction((name) => document.getElementById("file-name").textContent === name, names[0]);
  };
  await hand("wedge.stl");
  await agrees(page, "an STL");
  await hand("textured.obj", "textured.mtl", "tiles.png", "bumps.png");
  await agrees(page, "an OBJ with its textures");
  const whole = await hashOf(page);
  const broken = join(scratch, "broken.stl");
  writeFileSync(broken, "solid x\n facet nrmal 0 0 1\n");
  await page.setInputFiles("#file", broken);
  await page.waitForFunction(() => document.getElementById("error").textContent);
  const said = spawnSync(burnish, ["render", "broken.stl", "-o", "x.png"], { cwd: scratch, encoding: "utf8" }).stderr;
  check("a broken file", `burnish: ${await page.textContent("#error")}\n`, said);
  check("the picture before it stays", await hashOf(page), whole);

  // ---- Overlays ----
  const printed = (...words) => spawnSync(burnish, ["lobe", ...words], { cwd: scratch, encoding: "utf8" });
  // cos^n as a formula, run by this browser: the difference is rounding
  const formula = join(rtl, "../test/data/power.brdf");
  await page.setInputFiles("#overlay-file", formula);
  await page.waitForFunction(() => document.querySelectorAll("#parameters input").length === 3);
  check("a formula", await page.textContent("#overlay-error"), "");
  const values = await page.evaluate(async ([text, url]) => {
    const { makeBrdf, parseBrdf } = await import(url);
    const parsed = parseBrdf(text, "power.brdf");
    const evaluate = makeBrdf(parsed, "power.brdf");
    return [false, true].map((isPhong) => {
      parsed.parameters.find(({ name }) => name === "phong").value = Number(isPhong);
      return evaluate(parsed.parameters, 91, Math.PI / 180, isPhong);
    });
  }, [readFileSync(formula, "utf8"), `${HOME}brdf.js`]);
  for (const list of values) {
    const most = Math.max(...list.map((value, degrees) => Math.abs(value / list[0] - Math.cos((degrees * Math.PI) / 180) ** 40)));
    check("cos^n as a formula", most < 1e-4 ? "the same" : most, "the same");
  }
  for (const [text, line] of [["measured\n", 'does not begin with "analytic"'], ["analytic\n", 'no "::begin shader"'],
    ["analytic\n::begin parameters\nfloat n 1 2\n::end parameters\n::begin shader\n::end shader\n", "parameter 1"],
    ["analytic\n::begin shader\nvec3 BRDF(vec3 L) { return L + 1 }\n::end shader\n", "can't be compiled"]]) {
    const file = join(scratch, `broken${text.length}.brdf`);
    writeFileSync(file, text);
    await page.setInputFiles("#overlay-file", file);
    await page.waitForFunction((part) => document.getElementById("overlay-error").textContent.includes(part), line);
  }

  // ---- Claims ----
  check("claims", (await page.locator("#claims details").count()), JSON.parse(printed("claims", "--format=json").stdout).claims.length);
  check("whose statement", (await page.locator("#claim-lyon-lengths .source").allTextContents()).join(), "Source: Lyon 1993, not the paper");
  check("statements not of the paper", await page.locator("#claims .source").count(), 1);
  check("a claim's verdict", await page.textContent("#claim-w05-large .verdict"), "does not hold");
  await page.click("#claim-core-w summary");
  check("a claim's command", await page.textContent("#claim-core-w code"), "burnish-lobe claims core-w");
  check("verdicts are counted", /43 claims, computed just now. 18 hold, 18 hold in part, 2 do not hold,/.test(await page.textContent("#claims-count")), true);

  // ---- Code ----
  await page.selectOption("#fit", "energy");
  await page.click("#language button[value='c']");
  await settled(page);
  const code = await page.textContent("#code");
  writeFileSync(join(scratch, "lobe.c"), `${code}\n#include <stdio.h>\nint main(void) { printf("%.6f", (double)lobe(0.99f)); return 0; }\n`);
  execFileSync("cc", ["-o", join(scratch, "lobe"), join(scratch, "lobe.c"), "-lm"]);
  const [fit, order, n] = ["energy", 8, Number(await page.inputValue("#exponent"))];
  const expected = (1 - ((n + 1) / (Number(await page.textContent("#order [aria-pressed='true']")) + 1)) * 0.01) ** Number(await page.textContent("#order [aria-pressed='true']"));
  check(`${fit}:${order} in C`, Math.abs(Number(execFileSync(join(scratch, "lobe"), { encoding: "utf8" })) - expected) < 1e-5, true);
  await page.click("#language button[value='memory']");
  await page.waitForFunction(() => document.getElementById("code").textContent.includes("uint16_t"));
  check("the boundary memory", await page.textContent("#code"), printed("boundary", `--lobe=energy:${await page.textContent("#order [aria-pressed='true']")}`).stdout);

  // ---- Softbox: by keys and by hand ----
  await page.locator("#softbox-canvas").scrollIntoViewIfNeeded();
  const sphere = async () => { // the metal one: no handle is over it
    const box = await page.locator("#softbox-canvas").boundingBox();
    const clip = { x: box.x + 0.64 * box.width, y: box.y + 0.55 * box.height, width: 0.2 * box.width, height: 0.2 * box.height };
    return (await page.screenshot({ clip })).toString("base64");
  };
  const relit = async (what, act, text) => {
    const before = await sphere();
    await act();
    let after = before;
    for (let tries = 0; tries < 100 && after === before; ++tries) {
      await page.waitForTimeout(100);
      after = await sphere();
    }
    check(`${what} lights the metal`, after !== before, true);
    check(what, (await page.textContent("#softbox-about")).startsWith(text), true);
  };
  await page.focus("#softbox-move");
  await relit("an arrow", () => page.keyboard.press("ArrowRight"), "Softbox 1.10 × 0.80 at -0.70, 1.50; ");
  await page.focus("#softbox-size");
  await relit("a size", () => page.keyboard.press("ArrowRight"), "Softbox 1.20 × 0.80 at -0.70, 1.50; ");
  const move = await page.locator("#softbox-move").boundingBox();
  await relit("a drag of the softbox", async () => {
    await page.mouse.move(move.x + 17, move.y + 17);
    await page.mouse.down();
    await page.mouse.move(move.x + 117, move.y + 17, { steps: 4 });
    await page.mouse.up();
  }, "Softbox 1.20 × 0.80 at -0.");
  await page.waitForFunction(() => location.hash.includes("boxw=1.2"));
  check("no error of the softbox", await page.textContent("#softbox-error"), "");

  // ---- Verilog: the displayed module in a simulator, compared with the lobe ----
  const hasSimulator = spawnSync("iverilog", ["-V"]).status === 0;
  for (const [lobe, n] of hasSimulator ? [["energy:2", 40], ["taylor:8", 100], ["shift7", 21], ["minimax:4", 33.5], ["energy:2", 300]] : []) {
    const [name, order] = lobe.split(":");
    await page.selectOption("#fit", name);
    await page.fill("#exponent", String(n));
    if (order) {
      await page.click(`#order button[value='${order}']`);
    }
    await page.click("#language button[value='verilog']");
    await page.waitForFunction((text) => document.getElementById("code").textContent.startsWith(`// ${text} for`), `${lobe} for c^${n},`.split(" for")[0]);
    await page.waitForFunction((text) => document.getElementById("code").textContent.includes(`c^${text},`), String(n));
    await settled(page);
    const verilog = await page.textContent("#code");
    const isNarrow = verilog.includes("UQ0.24");
    const lambda = 0.3 / n;
    const angle = Math.round(isNarrow ? lambda * 2 ** 24 : (1 - lambda) * 2 ** 15);
    const taken = isNarrow ? angle / 2 ** 24 : 1 - angle / 2 ** 15;
    writeFileSync(join(scratch, "lobe.v"), `${verilog}\nmodule bench;\n reg clk = 0; always #1 clk = !clk; wire [15:0] value; wire done;\n` +
      ` lobe dut (.clk(clk), .enable(1'b1), .angle(${isNarrow ? 24 : 16}'d${angle}), .valid(1'b1), .value(value), .value_valid(done));\n` +
      " initial begin #400 $display(\"%0d %b\", value, done); $finish; end\nendmodule\n");
    execFileSync("iverilog", ["-g2001", "-y", rtl, "-I", rtl, "-s", "bench", "-o", join(scratch, "lobe.vvp"), join(scratch, "lobe.v")]);
    const [value, done] = execFileSync("vvp", ["-n", join(scratch, "lobe.vvp")], { encoding: "utf8" }).trim().split(" ");
    const { stdout } = printed("table", `--lobes=${lobe}`, `--exponents=${n}`, `--metrics=value:${(Math.acos(1 - taken) * 180) / Math.PI}`, "--format=csv");
    check(`${lobe} at ${n} in Verilog`, done === "1" && Math.abs(value / 65536 - Number(stdout.split("\n")[1].split(",")[2])) < 5e-4, true);
  }
  await page.close();

  // ---- A plain server: no threads, the same pictures ----
  const other = await serve(PORT + 2, "plain");
  const [alone, shared] = [await openPage("", {}, `http://127.0.0.1:${PORT + 2}/`), await openPage()];
  check("one thread", (await alone.textContent("#about")).includes("one thread"), true);
  await countsThreads(shared);
  for (const one of [alone, shared]) {
    await agrees(one, "with and without threads");
    await one.close();
  }
  other.kill();

  // ---- The screen, byte for byte ----
  const split = await openPage("#resolution=480,360&divider=40&look=three-point&mesh=:knot");
  const line = await split.textContent("#command");
  const drawnBy = (lobe) => {
    const png = join(scratch, `${lobe}.png`);
    execFileSync("sh", ["-c", `${line.replace(/^burnish/, `'${burnish}'`).replace(/--lobe=\S+/, `--lobe=${lobe}`)} -o '${png}'`]);
    return png;
  };
  check("the screen and the program's PNG", await pictureFaults(split, drawnBy("energy:2"), drawnBy("power")), "");
  // ---- During input ----
  await split.focus("#canvas");
  await split.keyboard.press("ArrowRight");
  await split.waitForFunction(() => document.getElementById("numbers").textContent.startsWith("draft: "));
  check("a draft is not final", await split.getAttribute("#picture", "aria-busy"), "true");
  check("it says what it is", /^draft: \d+ × \d+, (one sample|4 samples) per pixel$/.test(await split.textContent("#numbers")), true);
  await agrees(split, "after drafts");
  await split.close();

  // ---- Widths, schemes, access ----
  const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
  for (const [width, height, colorScheme] of [[1440, 900, "light"], [360, 800, "dark"], [768, 1024, "light"]]) {
    const shown = await openPage("", { width, height, colorScheme });
    const name = `${width} ${colorScheme}`;
    check(`${name}: nothing moved`, await shown.evaluate(() => Math.round(window.shifts * 1000)), 0);
    const grounds = [];
    for (const scheme of ["light", "dark"]) {
      await shown.emulateMedia({ colorScheme: scheme, reducedMotion: "reduce" });
      check(`${width} ${scheme}: layout`, await layoutFaults(shown), "");
      const background = (isDark) => document.getElementById("canvas").getContext("2d").getImageData(0, 0, 1, 1).data[0] < 60 === isDark;
      const followed = shown.waitForFunction(background, scheme === "dark", { timeout: 10000 }).then(() => true, () => false);
      check(`${width} ${scheme}: the picture's background follows`, await followed, true);
      await agrees(shown, `${width} ${scheme}`);
      grounds.push(await shown.evaluate(() => Number(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0])));
      if (SCREENS) {
        await shown.screenshot({ path: join(SCREENS, `${width}-${scheme}.png`), fullPage: true });
      }
    }
    check(`${width}: light and dark`, grounds[0] > 200 && grounds[1] < 60, true);
    await shown.emulateMedia({ colorScheme });
    await shown.evaluate(axe);
    const found = await shown.evaluate(async () => (await globalThis.axe.run()).violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.target).join(" ")}`).join("; "));
    check(`${name}: axe`, found, "");
    await shown.close();
  }

  // ---- Firefox ----
  const executablePath = process.env.FIREFOX ?? "/usr/bin/firefox-esr";
  if (existsSync(executablePath)) {
    const firefox = await puppeteer.launch({ browser: "firefox", executablePath, headless: true, env: { ...process.env, HOME: scratch } });
    try {
      const page = await firefox.newPage();
      await page.setViewport({ width: 1280, height: 900 });
      page.on("pageerror", (error) => check("no error in Firefox", error.message, ""));
      await page.goto(HOME);
      await agrees(page, "as it opens in Firefox");
      await page.select("#fit", "minimax");
      for (const button of ["order button[value='4']", "mesh button[value=':knot']", "equation button[value='phong']"]) {
        await page.click(`#${button}`);
      }
      await page.focus("#canvas");
      await page.keyboard.press("ArrowRight");
      await agrees(page, "another lobe and mesh, turned, in Firefox");
      check("claims and curves in Firefox", `${(await page.$$("#claims details")).length} ${(await page.$$(".plot canvas")).length}`, "43 6");
      await countsThreads(page);
      await page.click("#language button[value='verilog']");
      await page.waitForFunction(() => document.getElementById("code").textContent.includes("burnish_lobe #("));
      check("nothing is wider than the page in Firefox", await page.evaluate(() => document.documentElement.scrollWidth > innerWidth), false);
    } finally {
      await firefox.close();
    }
  } else {
    console.log("explorer in Firefox: skipped: firefox-esr is missing; scripts/install-deps browser");
  }
} finally {
  await browser.close();
  served.kill();
  rmSync(scratch, { recursive: true, force: true });
}
console.log(`explorer: ${checks} checks, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
