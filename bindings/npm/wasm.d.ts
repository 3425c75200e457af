/** The renderer of burnish in WebAssembly. */

import type { DrawFlags, LoadFlags } from "./options.js";
export type { Color, Vector, Words } from "./options.js";

/** The source of a mesh: the bytes of a file, or a built-in object. */
export type Input = BufferSource | ":teapot" | ":sphere" | ":torus" | ":knot";

/** What asynchronous functions also take. The name of a File is the default of the option `name`. */
export type AsyncInput = Input | Blob;

/** Uint8Array<ArrayBuffer> since TypeScript 5.7, Uint8Array before. */
export type Bytes = ReturnType<typeof Uint8Array.of>;

/** Options of loading: flags of `burnish render` with the same values. A list can be an array, and false switches an option off. */
export interface LoadOptions extends LoadFlags {
  /** For messages; the extension chooses the format: "part.stl". */
  name?: string;
  /** Files that the mesh refers to, by name: {"part.mtl": bytes}. */
  files?: Record<string, BufferSource>;
  /** Mesh.facts gets its values. */
  measure?: boolean;
}

/** Decodes the bytes of an image file to straight RGBA, rows from the top. */
export type Decode = (bytes: Uint8Array) => Pixels | Promise<Pixels>;
export interface Pixels {
  width: number;
  height: number;
  pixels: Uint8Array | Uint8ClampedArray;
}

export interface ReadOptions extends Omit<LoadOptions, "files"> {
  /** As in LoadOptions, and Blobs. */
  files?: Record<string, BufferSource | Blob>;
  /** Decodes the PNG, JPEG and WebP of textures. The default is the browser's decoder; in Node there is none, and textures are skipped. */
  decode?: Decode | null;
}

/** Options of drawing: flags of `burnish render`, with the same values and defaults. */
export interface DrawOptions extends DrawFlags {
  /** true: always four channels, as for ImageData. */
  rgba?: boolean;
}

/** What render() takes. */
export type RenderOptions = ReadOptions & DrawOptions;

export interface Camera {
  position: number[];
  focalPoint: number[];
  viewUp: number[];
  viewAngle: number;
  /** 0: a perspective. */
  orthographicHeight: number;
}

export interface Picture {
  width: number;
  height: number;
  /** 3: RGB; 4: RGBA with noBackground. */
  channels: 3 | 4;
  /** 8-bit sRGB values, rows from the top without gaps. */
  pixels: Bytes;
  /** XXH64 of the pixels in 16 hexadecimal digits, as in `burnish render --json`. */
  hash: string;
  coveredPixels: number;
  triangles: number;
  vertices: number;
  boundingBox: { min: number[]; max: number[] };
  /** The up axis: "+Y". */
  up: string;
  camera: Camera;
  /** Lines about ignored or repaired parts of the input. */
  warnings: string[];
}

/** A failure: one line in `message`, as printed by the program. */
export class BurnishError extends Error {
  status: "ARGUMENT" | "READ" | "FORMAT" | "LIMIT" | "MEMORY" | "CANCELLED";
}

/** Facts of the triangles as read, as `burnish info` prints them. */
export interface Facts {
  /** Closed, with consistent winding and not flat. */
  solid: boolean;
  closed: boolean;
  consistentWinding: boolean;
  triangles: number;
  /** Different positions. */
  vertices: number;
  shells: number;
  edges: number;
  openEdges: number;
  nonManifoldEdges: number;
  inconsistentEdges: number;
  flippedTriangles: number;
  unorientableParts: number;
  degenerateTriangles: number;
  duplicateTriangles: number;
  area: number;
  /** null if the mesh is not closed; negative if it is inside out. */
  volume: number | null;
  centerOfMass: number[];
}

/** How much two pictures differ, as `burnish compare` measures it. Undefined numbers are NaN. */
export interface Comparison {
  pixels: number;
  /** Pixels of which a channel differs by more than the tolerance. */
  differentPixels: number;
  /** x0, y0, x1, y1 of the different pixels, ends excluded. */
  bounds: number[] | null;
  /** Largest difference of red, green, blue and alpha. */
  largest: number[];
  meanSquaredError: number;
  /** dB; infinite for equal pictures. */
  psnr: number;
  ssim: number;
  flip: number;
  silhouetteIou: number;
}

/** A part of a mesh: an object of the file, or one of its volumes, at one of its places. Only solids are drawn. */
export interface Part {
  name: string;
  role: "solid" | "negative volume" | "modifier" | "support blocker" | "support enforcer" | "support" | "not printed";
  /** Of the object in the file. */
  id: number;
  /** Of the file, that placed it: negative volumes are subtracted from solids of the same item. */
  item: number;
  plate: number | null;
  /** The number of its filament, from 1. */
  filament: number | null;
  triangles: number;
  /** Of what is drawn, along X, Y and Z. */
  size: number[] | null;
  /** The matrix from the object to the file's coordinates: three rows of four. */
  transform: number[];
}

/** A plate of a slicer's project. */
export interface Plate {
  number: number;
  name: string;
  /** Of what is drawn of it. */
  size: number[] | null;
}

/** A filament of a slicer's project or of G-code. */
export interface Filament {
  /** "#FF8000" */
  color: string;
  /** That G-code uses, in millimetres; 0 if unknown. */
  length: number;
}

/** A mesh in memory, for several pictures. */
export interface Mesh {
  readonly triangles: number;
  readonly vertices: number;
  readonly boundingBox: { min: number[]; max: number[] };
  /** The up axis: "+Y". */
  readonly up: string;
  /** Empty for formats without parts. */
  readonly parts: Part[];
  readonly plates: Plate[];
  readonly filaments: Filament[];
  /** With the option `measure`; null for a file of points or lines. */
  readonly facts?: Facts | null;
  render(options?: DrawOptions): Picture;
  /** Releases its memory at once. Without it, memory is released some time after the last reference is gone. */
  close(): void;
}

/** A flag of the program. */
export interface Flag {
  /** Without dashes at the beginning: "edge-width". */
  name: string;
  loads: boolean;
  draws: boolean;
  isSwitch: boolean;
  /** true: it can be given without its value. */
  isOptional: boolean;
  /** true: the items of a list are values of their own; else they are one value with commas. */
  repeats: boolean;
  /** The valid values, if they are words. */
  words: string[];
}

/** An instance of the module. It belongs to one thread. */
export interface Burnish {
  /** Starts the threads after load() with startThreads: false. */
  startThreads(): void;
  readonly version: string;
  /** The flags of `burnish render` that are options, by each of their names in camelCase. */
  readonly flags: Record<string, Flag>;
  /** Options of loading, for open(), and of drawing, for the mesh's render(). */
  split(options: LoadOptions & DrawOptions): { loading: LoadOptions; drawing: DrawOptions };
  /** Whether the module uses SIMD128. */
  readonly simd: boolean;
  /** Number of threads. */
  readonly threads: number;
  /** An example of each kind of lobe. */
  readonly lobes: string[];
  /** Loads a mesh without textures in PNG, JPEG and WebP. */
  open(input: Input, options?: LoadOptions): Mesh;
  /** Loads a mesh and decodes its textures. */
  read(input: AsyncInput, options?: ReadOptions): Promise<Mesh>;
  render(input: Input, options?: LoadOptions & DrawOptions): Picture;
  compare(a: Pick<Picture, "width" | "height" | "channels" | "pixels">, b: Pick<Picture, "width" | "height" | "channels" | "pixels">, options?: { tolerance?: number }): Comparison;
  /** The lobe at cosines, in single precision: the same bits as in pictures. */
  lobeValues(words: string, exponent: number, cosines: ArrayLike<number>): Float32Array;
  /** File extensions that open() reads: ".obj". */
  readonly extensions: string[];
}

/** Whether this engine supports SIMD128. */
export function hasSimd(): boolean;

/** Creates an instance. simd: by default what the engine supports; module: instead of the file of the package; threads: 1, or
 * more in a worker of a cross-origin isolated page; startThreads: false delays starting threads until startThreads() is called,
 * so the first picture does not compete with starting workers; dashes: true: messages spell options as flags, --camera-position.
 * The pixels are the same.
 */
export function load(how?: { dashes?: boolean; simd?: boolean; threads?: number; startThreads?: boolean; module?: URL | string | BufferSource | WebAssembly.Module }): Promise<Burnish>;

/** Draws one picture with an instance that all calls share: read, render, close. */
export function render(input: AsyncInput, options?: RenderOptions): Promise<Picture>;
