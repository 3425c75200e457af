// Draws and computes off the page's thread.
import { load as loadLobes } from "./burnish/lobe.js";
import { load } from "./burnish/wasm.js";

const computing = loadLobes();

let mesh = null;

// With the module that the page compiled, if that succeeded. Threads start later: they would compete with the first picture.
async function start(module) {
  const how = { threads: navigator.hardwareConcurrency, startThreads: false };
  return load({ ...how, module }).catch(() => load(how));
}
let begin;
const instance = new Promise((resolve) => (begin = resolve));

const calls = {
  startThreads: (burnish) => burnish.startThreads(),

  about: ({ version, simd, threads, extensions }) => ({ version, simd, threads, extensions }),

  async open(burnish, { input, options }) {
    const opened = await burnish.read(input, options); // on an error the previous mesh stays
    mesh?.close();
    mesh = opened;
  },

  // Pictures of the lobes and, for two of them, their difference.
  async draw(burnish, { lobes, options, map }) {
    const { heat } = map ? await import("./heat.js") : {};
    const start = performance.now();
    const pictures = lobes.map((lobe) => mesh.render({ ...options, lobe, rgba: true }));
    const milliseconds = (performance.now() - start) / lobes.length;
    const { width, height } = pictures[0];
    return {
      width, height, milliseconds,
      pictures: pictures.map(({ hash, warnings, triangles, pixels }) => ({ hash, warnings, triangles, rgba: new Uint8ClampedArray(pixels.buffer) })),
      difference: map ? heat(pictures[0], pictures[1]) : null,
    };
  },

  // The output of `burnish-lobe`.
  lobe: async (burnish, { words }) => (await computing).lobe(words),

  // Values at angles in radians, and the facts of each lobe at the exponent.
  async theory(burnish, { lobes, exponent, angles }) {
    const facts = await computing;
    return lobes.map((lobe) => ({ values: facts.theoryValues(lobe, exponent, angles), facts: facts.theory(lobe, exponent) }));
  },
};

onmessage = async ({ data: { module, id, call, argument } }) => {
  if (!call) {
    begin(start(module));
    return;
  }
  try {
    const result = await calls[call](await instance, argument);
    const buffers = call === "draw" ? result.pictures.map((picture) => picture.rgba.buffer) : [];
    if (result?.difference) {
      buffers.push(result.difference.rgba.buffer);
    }
    postMessage({ id, result }, buffers);
  } catch (error) {
    postMessage({ id, error: error.message });
  }
};
