// A picture in a worker, with and without SIMD.
import { load } from "/node_modules/burnish/wasm.js";

onmessage = async ({ data }) => {
  const hashes = [];
  for (const simd of [true, false]) {
    hashes.push((await load({ simd })).render(data.input, data.options).hash);
  }
  postMessage(hashes);
};
