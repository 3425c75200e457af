// burnish/lobe: facts of lobes, and the program `burnish-lobe`, in WebAssembly; lobe.d.ts describes it.
import { BurnishError, Memory, compile } from "./module.js";

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

  theoryValues(words, exponent, angles) {
    return this.#memory.values(this.#exports.theory_values, words, exponent, Float64Array.from(angles));
  }

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

  convert(name, value) {
    const which = CONVERSIONS.indexOf(name);
    if (which < 0) {
      throw new BurnishError(`"${name}": unknown conversion; one of ${CONVERSIONS.join(", ")}`, "ARGUMENT");
    }
    return this.#exports.theory_convert(which, value);
  }

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

  get lobes() {
    return this.#memory.texts(this.#exports.lobe_example);
  }
}

export async function load({ module = new URL("./burnish-lobe.wasm", import.meta.url) } = {}) {
  const { exports } = await WebAssembly.instantiate(await compile(module, import.meta.url), {});
  exports._initialize();
  return new Lobes(exports);
}
