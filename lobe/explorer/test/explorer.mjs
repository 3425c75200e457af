// The page in Debian's Chromium: its numbers are the program's, the address restores it, and it fits phones and dark screens.
// Usage: node explorer.mjs BURNISH-LOBE PAGE [SCREENS]
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [program, folder, screens] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
let failures = 0;
function check(what, found, expected) {
  if (found !== expected) {
    ++failures;
    console.log(`FAILED ${what}\n  found    ${found}\n  expected ${expected}`);
  }
}

// The files of the folder answer, without a server.
async function openPage(address, { width = 1280, colorScheme = "light" } = {}) {
  const page = await browser.newPage({ viewport: { width, height: 900 }, colorScheme });
  page.on("pageerror", (error) => check("no error of the page", error.message, ""));
  page.on("console", (message) => message.type() === "error" && check("no error on the console", message.text(), ""));
  await page.route("**/*", (route) => route.fulfill({ path: join(folder, new URL(route.request().url()).pathname.replace(/\/$/, "/index.html")) }));
  await page.goto(`http://burnish/${address}`);
  await page.waitForSelector("main[aria-busy='false']");
  return page;
}

const fact = (page, name) => page.locator(`#facts tr:has(th:text-is("${name}")) td`).first().textContent();
const pixels = (page, id) => page.$eval(`#${id}`, (canvas) => canvas.toDataURL());
const hash = (page) => page.evaluate(() => location.hash);

try {
  const page = await openPage("");
  check("nothing in the address at first", await hash(page), "");
  for (const [choice, n, command] of [["taylor:2", "100", "taylor:2"], ["schlick", "21.5", "schlick"], ["level:2", "40", "level0.5:2"], ["composite:5", "64", "composite:5"]]) {
    await page.selectOption("[name=lobe]", choice);
    await page.fill("[name=n]", n);
    const line = (await page.textContent("#command")).split(" ").slice(1);
    check("the command's lobe", line[1], `--lobes=${command}`);
    const row = execFileSync(program, [...line, "--format=csv"], { encoding: "utf8" }).trim().split("\n")[1].split(",");
    const [error, half, zero, energy] = row.slice(2).map(Number);
    for (const [name, value, tolerance] of [["Largest error", error, Math.max(5e-5, error / 20)], ["Half at", half, 0.06], ["Energy", 100 * energy, 0.06], ["Zero from", zero, 0.06]]) {
      const found = parseFloat(await fact(page, name));
      check(`${command}: ${name} of ${found}, ${value} by the program`, Math.abs(found - value) <= tolerance || (Number.isNaN(found) && !(value <= 90)), true);
    }
  }
  check("the address", await hash(page), "#lobe=composite:5&n=64");
  const most = async () => Number(await fact(page, "Codes apart, at most"));
  check("five multiplications differ by one code at most", (await most()) <= 1, true);
  await page.selectOption("[name=lobe]", "schlick");
  check("Schlick's tail shows", (await most()) > 20, true);
  const before = await Promise.all(["lobe", "power", "difference"].map((id) => pixels(page, id)));
  await page.fill("[name=light]", "20");
  const after = await Promise.all(["lobe", "power", "difference"].map((id) => pixels(page, id)));
  check("the light moves on every sphere", before.some((image, i) => image === after[i]), false);
  const copy = await openPage(await hash(page));
  check("the address restores the picture", await pixels(copy, "lobe"), after[0]);
  await page.fill("#slider", "2");
  check("the slider sets the exponent", await page.inputValue("[name=n]"), "4.0");
  await page.selectOption("[name=lobe]", "minimax:32");
  check("an order above the exponent", (await page.textContent("#error")).includes("32"), true);
  const odd = await openPage("#lobe=nonsense&n=0&light=500");
  check("an address with bad values", await odd.inputValue("[name=lobe]") + (await odd.inputValue("[name=n]")), "energy:240");
  for (const width of [1280, 390]) {
    for (const colorScheme of ["light", "dark"]) {
      const shown = await openPage("#lobe=level:2&n=30", { width, colorScheme });
      check(`${width}: nothing is wider than the page`, await shown.evaluate(() => document.documentElement.scrollWidth - innerWidth <= 0), true);
      check(`${width}: the background of ${colorScheme}`, await shown.evaluate(() => Number(getComputedStyle(document.body).backgroundColor.match(/\d+/)[0]) > 128), colorScheme === "light");
      if (screens) {
        await shown.screenshot({ path: join(screens, `${width}-${colorScheme}.png`), fullPage: true });
      }
    }
  }
} finally {
  await browser.close();
}
console.log(`explorer: ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
