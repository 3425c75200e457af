// Checks the first result of searches in a built site, with stubs instead of a browser. Usage: node docs/site/search.mjs FOLDER
import { readFileSync } from "node:fs";
import { runInNewContext } from "node:vm";

const folder = process.argv[2];
const stub = new Proxy(() => {}, { get: (_, key) => (key === Symbol.toPrimitive ? () => 0 : stub), set: () => true, apply: () => stub });
const handlers = [];
const input = { value: "", addEventListener: (type, handler) => type === "input" && handlers.push(handler), setAttribute() {}, removeAttribute() {} };
const found = { innerHTML: "", querySelectorAll: () => [] };
const context = {
  document: {
    body: { dataset: { root: "" }, classList: stub }, head: stub, addEventListener() {}, createElement: () => stub,
    getElementById: (id) => ({ search: input, found })[id] ?? stub, querySelector: () => stub, querySelectorAll: () => [],
  },
  addEventListener() {},
};
context.window = context;
for (const file of ["site.js", "index.js"]) {
  runInNewContext(readFileSync(`${folder}/${file}`, "utf8"), context);
}

let failures = 0;
for (const [query, expected] of [
  ["turntable", "--turntable=FILE"], ["thumbnail", "Pictures of meshes"], ["how do i make thumbnails", "Pictures of meshes"],
  ["teh sandbox", "--sandbox"], ["sandbx", "--sandbox"], ["samples", "--samples=N"], ["burnish_mesh_load", "burnish_mesh_load"], ["python", "Python"],
]) {
  input.value = query;
  handlers.forEach((handler) => handler());
  const title = found.innerHTML.match(/<b>(.*?)<\/b>/)?.[1].replace(/<[^>]*>/g, "");
  if (title !== expected) {
    ++failures;
    console.log(`search: "${query}": found ${title}, expected ${expected}`);
  }
}
process.exit(failures > 0 ? 1 : 0);
