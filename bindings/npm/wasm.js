// burnish/wasm: the renderer in WebAssembly, with the same pixels as the program `burnish`; wasm.d.ts and options.d.ts describe it.
import { BurnishError, Memory, compile } from "./module.js";

export { BurnishError };

// i8x16.popcnt of a splat: valid with SIMD128.
const SIMD_PROBE = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11,
]);

export const hasSimd = () => WebAssembly.validate(SIMD_PROBE);

const COUNTS = [
  "triangles", "vertices", "shells", "edges", "openEdges", "nonManifoldEdges", "inconsistentEdges", "flippedTriangles",
  "unorientableParts", "degenerateTriangles", "duplicateTriangles",
];
const UPS = ["", "+X", "-X", "+Y", "-Y", "+Z", "-Z"];
const NO_FLAGS = new Set(["name", "files", "decode", "rgba", "measure"]);
const [LOADS, DRAWS] = [1, 2]; // as in session.h
const [CAMEL_CASE, DASHES] = [1, 2];

const camelCase = (name) => name.replace(/[-_](.)/g, (_, letter) => letter.toUpperCase());

// A value as the module takes it: true or false, a string, or numbers; each one of a list with strings or vectors.
function values(key, value) {
  if (typeof value === "boolean" || typeof value === "string") {
    return [value];
  }
  if (typeof value === "object" && typeof value[Symbol.iterator] !== "function") {
    throw new BurnishError(`${key}: an object is not a value; expected a boolean, a number, a string or a list of these`, "ARGUMENT");
  }
  const items = typeof value === "object" ? [...value] : [value];
  if (items.some((item) => typeof item === "string" || (typeof item === "object" && item !== null))) {
    return items.flatMap((item) => values(key, item));
  }
  return [items.length > 0 ? items.map(Number) : false];
}

// { samples: 4, annotate: ["axes", "box"], shadow: true } to [["samples", [4]], ["annotate", "axes"], ["annotate", "box"], ...]
const list = (options) => Object.entries(options)
  .filter(([key, value]) => !NO_FLAGS.has(key) && value !== undefined && value !== null)
  .flatMap(([key, value]) => values(key, value).map((one) => [key, one]));

// Decodes an image in a browser: its 8-bit values, ignoring colour profiles. They are read back through WebGL,
// because a 2D canvas premultiplies alpha and loses precision.
async function decodeByBrowser(bytes) {
  const as = { colorSpaceConversion: "none", premultiplyAlpha: "none" };
  const bitmap = await createImageBitmap(new Blob([bytes]), as);
  const { width, height } = bitmap;
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  if (!gl || Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) {
    const canvas = new OffscreenCanvas(width, height).getContext("2d");
    canvas.drawImage(bitmap, 0, 0);
    return { width, height, pixels: canvas.getImageData(0, 0, width, height).data };
  }
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return { width, height, pixels };
}
const usualDecoder = typeof createImageBitmap === "function" && typeof OffscreenCanvas === "function" ? decodeByBrowser : null;

const isBlob = (input) => typeof Blob === "function" && input instanceof Blob;

// The bytes of a buffer. Another realm's ArrayBuffer is not an instance of this one's, but has its tag.
function asBytes(input, what = "input") {
  const kind = Object.prototype.toString.call(input).slice(8, -1);
  if (ArrayBuffer.isView(input)) {
    return new Uint8Array(input.buffer, input.byteOffset, input.byteLength);
  }
  if (kind === "ArrayBuffer" || kind === "SharedArrayBuffer") {
    return new Uint8Array(input);
  }
  throw new TypeError(
    isBlob(input) ? `${what}: expected bytes, found a ${kind}; use the asynchronous read() or render(), or await its arrayBuffer()`
    : typeof input === "string" ? `${what}: expected bytes, found the string "${input}"; read the file first`
    : `${what}: expected bytes (an ArrayBuffer or a typed array), found ${input?.constructor?.name ?? input}`);
}

// What read() takes, as bytes: the contents of a Blob or File, whose name is the default.
async function readBlobs(input, { files = {}, ...options }) {
  const contents = async (content) => (isBlob(content) ? content.arrayBuffer() : content);
  const read = await Promise.all(Object.entries(files).map(async ([name, content]) => [name, await contents(content)]));
  const name = options.name ?? (isBlob(input) ? input.name : undefined);
  return [await contents(input), { ...options, files: Object.fromEntries(read), ...(name !== undefined && { name }) }];
}

/** One instance of the module. It belongs to one thread: each worker loads its own. */
class Burnish {
  #exports;
  #memory;
  #reading = Promise.resolve();
  #startThreads;
  #naming;

  constructor(exports, simd, threads, startThreads, naming) {
    this.#exports = exports;
    this.#memory = new Memory(exports);
    this.#naming = naming;
    this.simd = simd;
    this.threads = threads;
    this.#startThreads = startThreads;
    this.version = this.#memory.text(exports.version());
    this.flags = this.#readFlags();
  }

  startThreads() {
    this.#startThreads();
    this.#startThreads = () => {};
  }

  // Calls use(at, count) with session_options in the module's memory.
  #withOptions(pairs, use) {
    const items = pairs.flatMap(([name, value]) =>
      [name, typeof value === "boolean" ? "" : typeof value === "string" ? value : new Uint8Array(Float64Array.from(value).buffer)]);
    this.#memory.with(items, (...at) => {
      const fields = pairs.flatMap(([, value], i) => {
        const [name, content] = [at[2 * i], at[2 * i + 1]];
        return typeof value === "boolean" ? [name, 0, 0, 0, value ? 0 : 1]
          : typeof value === "string" ? [name, content, 0, 0, 0]
          : [name, 0, content, value.length, 0];
      });
      this.#memory.with([new Uint8Array(Uint32Array.from(fields).buffer)], (optionsAt) => use(optionsAt, pairs.length));
    });
  }

  // ---- Options ----

  // The flags that are options, by each of their names.
  #readFlags() {
    const flags = {};
    for (const row of this.#memory.texts(this.#exports.flag_row)) {
      const [name, stages, kind, others, words] = row.split("\t");
      const flag = {
        name, loads: (stages & LOADS) !== 0, draws: (stages & DRAWS) !== 0, isSwitch: kind === "", isOptional: kind === "?",
        repeats: kind === "+", words: words === "" ? [] : words.split(", "),
      };
      [name, ...others.split(",").filter(Boolean)].forEach((spelling) => (flags[camelCase(spelling)] = flag));
    }
    return flags;
  }

  /** { loading, drawing }: the options of open() and of mesh.render(). Unknown ones are of drawing, which reports them. */
  split(options) {
    const pick = (isWanted) => Object.fromEntries(Object.entries(options).filter(([key]) => NO_FLAGS.has(key) || isWanted(this.flags[camelCase(key)])));
    return { loading: pick((flag) => flag?.loads), drawing: pick((flag) => !flag || flag.draws) };
  }

  // An option of the other stage ends a call.
  #refuse(options, stage, line) {
    const key = Object.keys(options).find((name) => this.flags[camelCase(name)]?.[stage] === false);
    if (key !== undefined) {
      throw new BurnishError(`${key}: ${line}`, "ARGUMENT");
    }
  }

  // ---- Meshes ----

  open(input, options = {}) {
    this.#refuse(options, "loads", "an option of drawing; pass it to the mesh's render()");
    const isBuiltIn = typeof input === "string" && input.startsWith(":");
    const bytes = isBuiltIn ? new Uint8Array(0) : asBytes(input);
    const name = isBuiltIn ? input : options.name ?? "memory";
    const files = Object.entries(options.files ?? {}).map(([file, content]) => [file, asBytes(content, `files["${file}"]`)]);
    const e = this.#exports;
    const session = e.session_create();
    const items = [name, bytes, ...files.flat()];
    if (options.measure) {
      e.session_request_facts(session);
    }
    try {
      this.#memory.with(items, (nameAt, bytesAt, ...offers) => {
        files.forEach(([, content], i) => {
          e.session_offer(session, offers[2 * i], offers[2 * i + 1], content.length);
        });
        this.#withOptions(list(options), (optionsAt, count) => {
          if (!e.session_open(session, nameAt, bytesAt, bytes.length, optionsAt, count, this.#naming)) {
            throw this.#memory.failure();
          }
        });
      });
    } catch (error) {
      e.session_destroy(session);
      throw error;
    }
    return new Mesh(session, {
      draw: (at, drawn) => this.#draw(at, drawn),
      contents: (at) => this.#contents(at),
      close: (at) => e.session_destroy(at),
    }, { ...this.#size(session), facts: options.measure ? this.#facts(session) : undefined });
  }

  // What a mesh is before it is drawn.
  #size(session) {
    const numbers = Array.from({ length: 15 }, (_, i) => this.#exports.session_number(session, i));
    return {
      triangles: numbers[6], vertices: numbers[7], boundingBox: { min: numbers.slice(8, 11), max: numbers.slice(11, 14) }, up: UPS[numbers[14]],
    };
  }

  // Parts, plates and filaments of an open session.
  #contents(session) {
    const at = this.#exports.session_contents(session);
    const { filament_lengths: lengths, ...contents } = JSON.parse(at === 0 ? "{}" : this.#memory.text(at));
    this.#exports.release(at);
    return { ...contents, filaments: contents.filaments?.map((color, i) => ({ color, length: lengths[i] })) };
  }

  // The facts of an open session; null for points and lines.
  #facts(session) {
    const numbers = Array.from({ length: 19 }, (_, i) => this.#exports.session_fact(session, i));
    if (Number.isNaN(numbers[0])) {
      return null;
    }
    return {
      solid: numbers[0] === 1,
      closed: numbers[1] === 1,
      consistentWinding: numbers[2] === 1,
      ...Object.fromEntries(COUNTS.map((key, i) => [key, numbers[3 + i]])),
      area: numbers[14],
      volume: Number.isNaN(numbers[15]) ? null : numbers[15],
      centerOfMass: numbers.slice(16),
    };
  }

  #draw(session, options) {
    const e = this.#exports;
    this.#refuse(options, "draws", "an option of loading; pass it to open()");
    this.#withOptions(list(options), (optionsAt, count) => {
      if (!e.session_draw(session, optionsAt, count, this.#naming)) {
        throw this.#memory.failure();
      }
    });
    const [width, height, channels, high, low, coveredPixels] = Array.from({ length: 6 }, (_, i) => e.session_number(session, i));
    const pixels = options.rgba ? this.#rgba(session, 4 * width * height)
      : new Uint8Array(e.memory.buffer, e.session_pixels(session), width * height * channels).slice();
    const camera = [...new Float64Array(e.memory.buffer, e.session_camera(session), 11)];
    return {
      width, height, channels: options.rgba ? 4 : channels, pixels,
      hash: [high, low].map((half) => half.toString(16).padStart(8, "0")).join(""),
      coveredPixels,
      ...this.#size(session),
      camera: {
        position: camera.slice(0, 3), focalPoint: camera.slice(3, 6), viewUp: camera.slice(6, 9), viewAngle: camera[9], orthographicHeight: camera[10],
      },
      warnings: this.#memory.texts((i) => e.session_warning(session, i)),
    };
  }

  #rgba(session, size) {
    const at = this.#memory.allocate(size);
    this.#exports.session_rgba(session, at);
    const pixels = new Uint8Array(this.#exports.memory.buffer, at, size).slice();
    this.#exports.release(at);
    return pixels;
  }

  // Decodes the images that the last mesh requested; returns the number of decoded images.
  async #decodePictures(decode) {
    const e = this.#exports;
    let decoded = 0;
    for (let at, i = 0; (at = e.picture_bytes(i)) !== 0; ++i) {
      const bytes = new Uint8Array(e.memory.buffer, at, e.picture_size(i)).slice();
      const { width, height, pixels } = await new Promise((resolve) => resolve(decode(bytes))).then((decoded) => decoded ?? {}, () => ({}));
      const room = width > 0 && pixels?.length === 4 * width * height ? e.picture_pixels(i, width, height) : 0;
      if (room !== 0) {
        new Uint8Array(e.memory.buffer).set(pixels, room);
        ++decoded;
      }
    }
    return decoded;
  }

  /** open() for Blobs and Files too, with textures decoded. */
  async read(source, { decode = usualDecoder, ...given } = {}) {
    const [input, options] = await readBlobs(source, given);
    const before = this.#reading;
    let end;
    this.#reading = new Promise((resolve) => (end = resolve));
    await before; // requested images belong to one mesh at a time
    try {
      const mesh = this.open(input, decode ? { ...options, strict: false } : options); // the missing images are requested
      if (!decode || ((await this.#decodePictures(decode)) === 0 && !options.strict)) {
        return mesh;
      }
      mesh.close();
      return this.open(input, options);
    } finally {
      this.#exports.picture_forget();
      end();
    }
  }

  render(input, options = {}) {
    const { loading, drawing } = this.split(options);
    const mesh = this.open(input, loading);
    this.#exports.picture_forget();
    try {
      return mesh.render(drawing);
    } finally {
      mesh.close();
    }
  }

  compare(a, b, { tolerance = 0 } = {}) {
    const isWhole = ({ width, height, channels, pixels }) => (channels === 3 || channels === 4) && pixels.length === width * height * channels;
    if (!isWhole(a) || !isWhole(b)) {
      throw new BurnishError("compare: pixels do not have width * height * channels bytes", "ARGUMENT");
    }
    if (a.width !== b.width || a.height !== b.height) {
      throw new BurnishError(`compare: ${a.width} x ${a.height} and ${b.width} x ${b.height} pixels; draw both in one size`, "ARGUMENT");
    }
    const e = this.#exports;
    return this.#memory.with([a, b].map(({ pixels }) => asBytes(pixels, "compare")), (aAt, bAt) => {
      if (!e.images_compare(aAt, a.channels, bAt, b.channels, a.width, a.height, tolerance)) {
        throw this.#memory.failure();
      }
      const [pixels, differentPixels, meanSquaredError, psnr, ssim, flip, silhouetteIou, ...rest] = Array.from({ length: 15 }, (_, i) => e.images_number(i));
      const bounds = differentPixels > 0 ? rest.slice(0, 4) : null;
      return { pixels, differentPixels, bounds, largest: rest.slice(4), meanSquaredError, psnr, ssim, flip, silhouetteIou };
    });
  }

  lobeValues(words, exponent, cosines) {
    return this.#memory.values(this.#exports.lobe_values, words, exponent, Float32Array.from(cosines));
  }

  get extensions() {
    return this.#memory.texts(this.#exports.format_extensions).join(" ").split(" ").filter(Boolean);
  }

  get lobes() {
    return this.#memory.texts(this.#exports.lobe_example);
  }
}

// Releases the memory of meshes that were not closed, some time after the last reference is gone.
const forgotten = typeof FinalizationRegistry === "function" ? new FinalizationRegistry(({ session, module }) => module.close(session)) : null;

class Mesh {
  #session;
  #module;
  #contents;

  /** `what` has triangles, vertices, boundingBox, up, and facts with the option `measure`. */
  constructor(session, module, what) {
    this.#session = session;
    this.#module = module;
    Object.assign(this, what);
    forgotten?.register(this, { session, module }, this);
  }

  #open() {
    if (this.#session === 0) {
      throw new BurnishError("mesh: it is closed; open it again", "ARGUMENT");
    }
    return this.#session;
  }

  // They are read at the first use: a file can have many.
  get #list() {
    return (this.#contents ??= this.#module.contents(this.#open()));
  }

  get parts() {
    return this.#list.parts;
  }

  get plates() {
    return this.#list.plates;
  }

  get filaments() {
    return this.#list.filaments;
  }

  render(options = {}) {
    return this.#module.draw(this.#open(), options);
  }

  close() {
    forgotten?.unregister(this);
    this.#module.close(this.#session);
    this.#session = 0;
  }
}

const usedFile = (simd, threads) =>
  threads > 1 ? new URL("./burnish-threads.wasm", import.meta.url)
  : simd ? new URL("./burnish-simd.wasm", import.meta.url)
  : new URL("./burnish.wasm", import.meta.url);

// Shared memory for threads, or null if the engine does not support it. The numbers of pages are in bindings/wasm/CMakeLists.txt.
function sharedMemory() {
  try {
    return new WebAssembly.Memory({ initial: 256, maximum: 32768, shared: true });
  } catch {
    return null;
  }
}

export async function load({ simd = hasSimd(), threads = 1, startThreads = true, module, dashes = false } = {}) {
  const mayShare = simd && globalThis.crossOriginIsolated && typeof WorkerGlobalScope === "function";
  const isForThreads = module instanceof WebAssembly.Module ? WebAssembly.Module.imports(module).some(({ kind }) => kind === "memory") : !module && threads > 1;
  const memory = mayShare && isForThreads ? sharedMemory() : null;
  const count = memory ? Math.min(threads, 64) : 1;
  const compiled = await compile(module ?? usedFile(simd, count), import.meta.url);
  const instance = await WebAssembly.instantiate(compiled, memory ? { env: { memory } } : {});
  const exports = memory ? { ...instance.exports, memory } : instance.exports;
  exports._initialize();
  const startWorkers = () => { // they share the module's memory; calls do not wait for them
    for (let i = 1; i < count; ++i) {
      const worker = new Worker(new URL("./wasm-thread.js", import.meta.url), { type: "module" });
      worker.postMessage({ module: compiled, memory, stack: exports.threads_add() });
    }
  };
  const burnish = new Burnish(exports, simd, count, startWorkers, dashes ? DASHES : CAMEL_CASE);
  if (startThreads) {
    burnish.startThreads();
  }
  return burnish;
}

let shared;

export async function render(input, options = {}) {
  const burnish = await (shared ??= load());
  const { loading, drawing } = burnish.split(options);
  const mesh = await burnish.read(input, loading);
  try {
    return mesh.render(drawing);
  } finally {
    mesh.close();
  }
}
