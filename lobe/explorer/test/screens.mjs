// Compares the canvas and its screenshot with the program's picture, and finds faults of the layout.
import { readFileSync } from "node:fs";
import { decodePng } from "./png.mjs";

/** What the canvas holds, and what a screenshot shows, unlike the program's PNG of the picture's left part and of the rest. */
export async function pictureFaults(page, png, otherPng) {
  const [left, right] = [png, otherPng].map((file) => decodePng(readFileSync(file)));
  const { width, height } = left;
  const middle = Math.round((width * Number(await page.getAttribute("#divider", "aria-valuenow"))) / 100);
  const expected = { width, height, pixels: right.pixels.slice() };
  for (let at = 0; at < expected.pixels.length; at += 4) {
    if ((at / 4) % width < middle) {
      expected.pixels.set(left.pixels.subarray(at, at + 4), at);
    }
  }
  const canvas = await page.evaluate(() => {
    const { width, height } = document.getElementById("canvas");
    return { width, height, pixels: [...document.getElementById("canvas").getContext("2d").getImageData(0, 0, width, height).data] };
  });
  // a pixel of the picture is a pixel of the screen, and nothing covers it
  const style = await page.addStyleTag({ content:
    `.picture { position: fixed; left: 0; top: 0; z-index: 9; width: ${width}px; height: ${height}px; border-radius: 0; margin: 0 !important } .picture > :not(canvas) { visibility: hidden }` });
  const screenshot = decodePng(await page.locator("#canvas").screenshot());
  await style.evaluate((element) => element.remove());
  const isSame = (found) => found.width === width && found.height === height && found.pixels.every((code, i) => code === expected.pixels[i]);
  return Object.entries({ canvas, screenshot }).filter(([, found]) => !isSame(found)).map(([what, found]) => `${what} of ${found.width} x ${found.height}`).join("; ");
}

/** What is wider than the page, cut off, or lies over something else; one line each. */
export const layoutFaults = (page) => page.evaluate(() => {
  const faults = [];
  const nameOf = (element) => element.tagName.toLowerCase() + (element.id ? `#${element.id}` : element.className ? `.${String(element.className).split(" ")[0]}` : "") +
    ` "${(element.textContent ?? "").trim().slice(0, 20)}"`;
  if (document.documentElement.scrollWidth > innerWidth) {
    faults.push(`the page is ${document.documentElement.scrollWidth} wide, the window ${innerWidth}`);
  }
  // Exceptions: intentional overlays of the picture, uPlot's drawings, and elements off screen until focused.
  const isOver = (element) => element.closest(".tag, .divider, .handle, .legend, .drop, .plot, .skip") || element.matches("input[type='file']");
  const isVisible = (element) => element.checkVisibility({ visibilityProperty: true }) && element.getClientRects().length > 0;
  const isText = (element) => [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
  const all = [...document.body.querySelectorAll("*")].filter((element) => isVisible(element) && !isOver(element));
  for (const element of all) {
    const { overflowX, textOverflow } = getComputedStyle(element);
    const isCut = element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0 && !["auto", "scroll"].includes(overflowX) && textOverflow !== "ellipsis";
    if (isText(element) && isCut && !element.matches("option, select")) {
      faults.push(`${nameOf(element)} is ${element.scrollWidth} wide in ${element.clientWidth}`);
    }
  }
  const items = all.filter((element) => element.matches("button, select, input, canvas, pre") || (isText(element) && !element.closest("button, select, pre, option")));
  // the lines of a text, not the box around them, as far as what scrolls shows them
  const clipOf = (element) => (getComputedStyle(element).overflowX === "visible" ? [0, innerWidth] : [element.getBoundingClientRect().left, element.getBoundingClientRect().right]);
  const boxesOf = (element) => [...(element.matches("button, select, input, canvas, pre, summary") ? element.getClientRects() : (() => {
    const range = document.createRange();
    range.selectNodeContents(element);
    return range.getClientRects();
  })())].map((box) => ({ left: Math.max(box.left, clipOf(element)[0]) + 1, right: Math.min(box.right, clipOf(element)[1]) - 1, top: box.top + 2, bottom: box.bottom - 2 })).filter((box) => box.right > box.left && box.bottom > box.top);
  const boxes = items.map(boxesOf);
  const meet = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  for (let i = 0; i < items.length; ++i) {
    for (let k = i + 1; k < items.length; ++k) {
      if (!items[i].contains(items[k]) && boxes[i].some((a) => boxes[k].some((b) => meet(a, b)))) {
        faults.push(`${nameOf(items[k])} lies over ${nameOf(items[i])}`);
      }
    }
  }
  return faults.slice(0, 8).join("\n           ");
});
