// What the package's modules share: their files, their memory, errors.

/** A failure: one line in `message`, a word such as "FORMAT" in `status`. */
export class BurnishError extends Error {
  constructor(message, status) {
    super(message);
    this.name = "BurnishError";
    this.status = status;
  }
}

// The name is an argument because bundlers for browsers try to resolve literal ones.
const importModule = (name) => import(/* webpackIgnore: true */ /* @vite-ignore */ name);

/** The module of an address, of bytes, or compiled before; an address is relative to `base`. */
export async function compile(source, base) {
  if (typeof source !== "string" && !(source instanceof URL)) {
    return source instanceof WebAssembly.Module ? source : WebAssembly.compile(source);
  }
  const url = new URL(source, base);
  if (url.protocol === "file:" && globalThis.process?.versions?.node) {
    const { readFile } = await importModule("node:fs/promises");
    return WebAssembly.compile(await readFile(url));
  }
  const response = await fetch(url);
  if (!response.ok) {
    throw new BurnishError(`${url}: can't be fetched: ${response.status} ${response.statusText}`, "READ");
  }
  // streaming, which browsers cache, needs the server to send the right type
  const isNamed = response.headers.get("content-type")?.trim().toLowerCase() === "application/wasm";
  return isNamed ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

/** Strings and bytes in the memory of an instance. */
export class Memory {
  #exports;
  #encoder = new TextEncoder();
  #decoder = new TextDecoder();

  constructor(exports) {
    this.#exports = exports;
  }

  allocate(size) {
    const at = this.#exports.allocate(size);
    if (at === 0) {
      throw new BurnishError(`out of memory: ${size} bytes; draw a smaller mesh or picture`, "MEMORY");
    }
    return at;
  }

  put(bytes) {
    const at = this.allocate(bytes.length);
    new Uint8Array(this.#exports.memory.buffer).set(bytes, at);
    return at;
  }

  // Calls use(pointers) with strings and bytes in the module's memory, which are released afterwards.
  with(items, use) {
    const pointers = [];
    try {
      for (const item of items) {
        pointers.push(this.put(typeof item === "string" ? this.#encoder.encode(item + "\0") : item));
      }
      return use(...pointers);
    } finally {
      pointers.forEach((at) => this.#exports.release(at));
    }
  }

  text(at) {
    const bytes = new Uint8Array(this.#exports.memory.buffer, at);
    return this.#decoder.decode(bytes.slice(0, bytes.indexOf(0)));
  }

  // The texts 0, 1, ... of a function, up to the first that is missing.
  texts(at) {
    const found = [];
    for (let text; (text = at(found.length)) !== 0; ) {
      found.push(this.text(text));
    }
    return found;
  }

  // A lobe's values by call(words, exponent, count, from, to) at `input`, a typed array, and in its type.
  values(call, words, exponent, input) {
    return this.with([words, new Uint8Array(input.buffer), new Uint8Array(input.byteLength)], (text, from, to) => {
      if (!call(text, exponent, input.length, from, to)) {
        throw this.failure();
      }
      return new input.constructor(this.#exports.memory.buffer, to, input.length).slice();
    });
  }

  failure() {
    return new BurnishError(this.text(this.#exports.failure_text()), this.text(this.#exports.failure_status()));
  }
}
