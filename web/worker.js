// Draws and computes, so that the page stays at hand.
import { load } from "./burnish/wasm.js";
import { heat } from "./heat.js";

const instance = load({ threads: navigator.hardwareConcurrency });
let mesh = null;

const rgba = ({ pixels, width, height, channels }) => {
  const to = new Uint32Array(width * height);
  for (let i = 0, at = 0; i < to.length; ++i, at += channels) {
    to[i] = 0xff000000 | (pixels[at + 2] << 16) | (pixels[at + 1] << 8) | pixels[at];
  }
  return new Uint8ClampedArray(to.buffer);
};

const calls = {
  about: ({ version, simd, threads, endings }) => ({ version, simd, threads, endings }),

  async open(burnish, { input, options }) {
    const opened = await burnish.read(input, options); // an error leaves the mesh that is there
    mesh?.close();
    mesh = opened;
  },

  // Pictures of the lobes, and with both of them how they differ.
  draw(burnish, { lobes, options, map }) {
    const start = performance.now();
    const pictures = lobes.map((lobe) => mesh.render({ ...options, lobe }));
    const milliseconds = (performance.now() - start) / lobes.length;
    const { width, height } = pictures[0];
    return {
      width, height, milliseconds,
      pictures: pictures.map((picture) => ({ hash: picture.hash, warnings: picture.warnings, triangles: picture.triangles, rgba: rgba(picture) })),
      difference: map ? heat(pictures[0], pictures[1]) : null,
    };
  },

  // What `burnish lobe` prints.
  lobe: (burnish, { words, file }) => burnish.lobe(words, file),

  // Values over angles in radians, and the facts of each lobe: those that exist at the exponent.
  theory(burnish, { lobes, exponent, angles }) {
    return lobes.map((lobe) => ({ values: burnish.theoryValues(lobe, exponent, angles), facts: burnish.theory(lobe, exponent) }));
  },
};

onmessage = async ({ data: { id, call, argument } }) => {
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
