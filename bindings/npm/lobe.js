// burnish/lobe: facts of lobes, and the program `burnish-lobe`, in WebAssembly.
//
//   import { load } from "burnish/lobe";
//   const lobes = await load();
//   lobes.theory("energy:2", 64).maximumError

import { BurnishError, Memory, compileFile } from "./module.js";

export { BurnishError };

// In the order of theory_number and theory_convert.
const FACTS = [
  "zeta", "scale", "cutoffCosine", "zeroAngle", "halfAngle", "maximumError", "integral", "cosineIntegral",
  "multiplications", "additions", "comparisons", "divisions", "transcendentals", "lookups",
];
const CONVERSIONS = [
  "exponentFromRoughness", "roughnessFromExponent", "exponentFromAlpha", "alphaFromExponent", "phongFromBlinn",
  "blinnFromPhong",
];

/** One instance of the module. It belongs to one thread. */
class Lobes {
  #exports;
  #memory;

  constructor(exports) {
    this.#exports = exports;
    this.#memory = new Memory(exports);
    this.version = this.#memory.text(exports.version());
  }

  /** Values of a lobe at angles in radians, in double precision. */
  theoryValues(words, exponent, angles) {
    const e = this.#exports;
    const input = Float64Array.from(angles);
    return this.#memory.with([words, new Uint8Array(input.buffer), new Uint8Array(input.byteLength)], (text, from, to) => {
      if (!e.theory_values(text, exponent, input.length, from, to)) {
        throw this.#memory.failure();
      }
      return new Float64Array(e.memory.buffer, to, input.length).slice();
    });
  }

  /** Facts of a lobe at an exponent. */
  theory(words, exponent) {
    const e = this.#exports;
    return this.#memory.with([words], (text) => {
      const values = FACTS.map((_, i) => e.theory_number(text, exponent, i));
      if (this.#memory.text(e.failure_text())) {
        throw this.#memory.failure();
      }
      return Object.fromEntries(FACTS.map((key, i) => [key, values[i]]));
    });
  }

  /** Exponents and roughness: exponentFromRoughness and the like. */
  convert(name, value) {
    const which = CONVERSIONS.indexOf(name);
    if (which < 0) {
      throw new BurnishError(`"${name}": unknown conversion; one of ${CONVERSIONS.join(", ")}`, "ARGUMENT");
    }
    return this.#exports.theory_convert(which, value);
  }

  /** The output of `burnish lobe`: ["claims", "--format=csv"], or table, choose, boundary. */
  lobe(words) {
    const e = this.#exports;
    const texts = words.map(String);
    if (texts.some((word) => /^(--format=)?json$/.test(word))) {
      throw new BurnishError("--format: JSON is not available here; use csv", "ARGUMENT");
    }
    return this.#memory.with([texts.join("\0")], (wordsAt) => {
      const text = e.lobe_command(wordsAt, texts.length);
      if (text === 0) {
        throw this.#memory.failure();
      }
      return this.#memory.text(text);
    });
  }

  /** An example of each kind of lobe. */
  get lobes() {
    const words = [];
    for (let at; (at = this.#exports.lobe_example(words.length)) !== 0; ) {
      words.push(this.#memory.text(at));
    }
    return words;
  }
}

/**
 * Makes an instance of the module.
 * @param {object} [how]
 * @param {URL|string|BufferSource|WebAssembly.Module} [how.module]  instead of the file next to this one
 */
export async function load({ module = new URL("./burnish-lobe.wasm", import.meta.url) } = {}) {
  const source = typeof module === "string" || module instanceof URL ? await compileFile(new URL(module, import.meta.url)) : module;
  const compiled = source instanceof WebAssembly.Module ? source : await WebAssembly.compile(source);
  const { exports } = await WebAssembly.instantiate(compiled, {});
  exports._initialize();
  return new Lobes(exports);
}
