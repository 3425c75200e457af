/** The whole renderer of burnish in WebAssembly, and what is true of its lobes. */

/** What a mesh is read from: its bytes, or a built-in object. */
export type Input = BufferSource | ":teapot" | ":sphere" | ":torus" | ":knot";

/** How a mesh is loaded: flags of `burnish render`. Numbers and words are as there; a list may be an array. */
export interface LoadOptions {
  /** Stands in messages and tells the format by its ending: "part.stl". */
  name?: string;
  /** Files that the mesh names, by the name it uses: {"part.mtl": bytes}. */
  files?: Record<string, BufferSource>;
  /** "auto", "obj", "ply", "stl", "gltf" ...: of bytes whose name does not tell it. */
  inputFormat?: string;
  /** "+Y", "-Y", "+Z", "-Z", "+X", "-X" or "auto". By default what the format says. */
  up?: string;
  /** A plane "X,Y,Z,D" or [X, Y, Z, D]: what is beyond it is cut away. Several: an array of texts. */
  clip?: string | number[] | string[];
  /** Degrees below which edges are smooth. By default each edge is judged by what is around it. */
  creaseAngle?: number;
  /** Segments along a patch edge of a built-in object, 16. */
  tessellation?: number;
  /** Seconds after the start of the animation. By default the mesh is at rest. */
  animationTime?: number;
  /** Name or number of the animation. */
  animation?: string | number;
  /** Diameter of the points and lines of a file without faces. */
  pointSize?: number;
  /** A fault that is otherwise mended with a warning is an error. */
  strict?: boolean;
  /** Materials without their textures. */
  noTextures?: boolean;
  /** Nothing but the input is read. */
  noLibraries?: boolean;
  maxTriangles?: number;
  maxTexturePixels?: number;
  /** Bytes, or "64M". */
  maxInputBytes?: number | string;
}

/** A picture from a file's bytes: straight RGBA, rows from the top. */
export type Decode = (bytes: Uint8Array) => Pixels | Promise<Pixels>;
export interface Pixels {
  width: number;
  height: number;
  pixels: Uint8Array | Uint8ClampedArray;
}

export interface ReadOptions extends LoadOptions {
  /** Decodes the PNG, JPEG and WebP of textures. By default the browser; in Node nobody, and textures are left out. */
  decode?: Decode | null;
}

/** How a picture is drawn: flags of `burnish render`, with its defaults. */
export interface DrawOptions {
  /** true: pixels of four channels, as ImageData wants them, whether the picture has alpha or not. */
  rgba?: boolean;
  /** [width, height], [1024, 768]. */
  resolution?: [number, number] | string;
  /** Width and height in one. */
  size?: number;
  /** Coverage samples per pixel: 1, 4, 8 or 16. */
  samples?: 1 | 4 | 8 | 16;
  cullBackFaces?: boolean;
  /** A name, "#rrggbb", or three numbers in [0, 1]. */
  backgroundColor?: string | [number, number, number];
  /** The picture has alpha, four channels. */
  noBackground?: boolean;
  /** One standard view: "front", "right", "top", "iso", "back", "left" or "bottom". */
  views?: string;
  /** "axes", "box", "dimensions", "scale", "grid", between commas. */
  annotate?: string;

  /** From the camera to the object. */
  cameraDirection?: [number, number, number] | string;
  /** Degrees. */
  cameraAzimuthAngle?: number;
  /** Degrees. */
  cameraElevationAngle?: number;
  /** One of the input's own cameras, by name or number. */
  camera?: string | number;
  cameraPosition?: [number, number, number] | string;
  cameraFocalPoint?: [number, number, number] | string;
  cameraViewUp?: [number, number, number] | string;
  /** Degrees from the lower to the upper edge, 30. */
  cameraViewAngle?: number;
  cameraZoomFactor?: number;
  /** true: parallel projection; "no": perspective, also in standard views. */
  cameraOrthographic?: boolean | "no";
  /** Of the picture, in the mesh's units. */
  cameraOrthographicHeight?: number;
  /** Share of the smaller side left free on each side, 0.05. */
  margin?: number;

  /** "studio", "plain", "clay", "technical", "drawing" or "lobes". */
  look?: string;
  /** Of all surfaces. */
  color?: string | [number, number, number];
  /** "matte", "satin", "plastic", "polished" or "metal". */
  material?: string;
  /** [0, 1] */
  opacity?: number;
  /** Strength of highlights, [0, 1]. */
  specular?: number;
  /** Exponent of highlights, [1, 65536]. */
  exponent?: number;
  /** "energy:2", "minimax:4", "power", "schlick" ... */
  lobe?: string;
  equation?: "blinn" | "phong";
  viewer?: "local" | "distant";
  /** "directional:X,Y,Z[:INTENSITY[:COLOR]]" and the like, one or several; "none". */
  light?: string | string[];
  /** A number, or a colour. */
  ambient?: number | string;
  /** Directions that ambient occlusion is found from, 0 to 256, or "auto". */
  occlusion?: number | "auto" | boolean;
  ground?: boolean;
  shadow?: boolean;
  /** "silhouettes", "creases", "boundaries", "materials" between commas, true for all, or "none". */
  edges?: boolean | string;
  wireframe?: boolean;
  edgeWidth?: number;
  edgeColor?: string | [number, number, number];
  /** How often large triangles may cover the picture, 1000. */
  maxOverdraw?: number;
  /** "auto", or what the module has: "wasm" with SIMD128, "scalar" without. Never changes the pixels. */
  isa?: string;
}

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
  /** sRGB codes, rows from the top without gaps. */
  pixels: Uint8Array;
  /** XXH64 of the pixels in 16 hexadecimal digits: what `burnish render --json` says. */
  hash: string;
  coveredPixels: number;
  triangles: number;
  vertices: number;
  boundingBox: { min: number[]; max: number[] };
  /** The axis that points up: "+Y". */
  up: string;
  camera: Camera;
  /** Lines about ignored or repaired parts of the input. */
  warnings: string[];
}

/** What a failure is: one line in `message`, as the program prints it. */
export class BurnishError extends Error {
  status: "ARGUMENT" | "READ" | "FORMAT" | "LIMIT" | "MEMORY" | "CANCELLED";
}

/** A mesh in memory, for several pictures. */
export interface Mesh {
  render(options?: DrawOptions): Picture;
  /** Gives its memory back. */
  close(): void;
}

/** Facts of a lobe at an exponent. Angles are radians; NaN where there is none. */
export interface Theory {
  /** Slope of the family, else 0. */
  zeta: number;
  /** Value at the peak. */
  scale: number;
  /** Cosine from which downward the lobe is 0. */
  cutoffCosine: number;
  zeroAngle: number;
  /** Where the lobe is 1/2. */
  halfAngle: number;
  /** Largest absolute difference from cos^n over cosines in [0, 1]. */
  maximumError: number;
  /** Over the hemisphere, in steradians; then weighted by the cosine. */
  integral: number;
  cosineIntegral: number;
  /** Operations of one evaluation from a cosine. */
  multiplications: number;
  additions: number;
  comparisons: number;
  divisions: number;
  transcendentals: number;
  lookups: number;
}

export type Conversion =
  | "exponentFromRoughness" | "roughnessFromExponent" | "exponentFromAlpha" | "alphaFromExponent"
  | "phongFromBlinn" | "blinnFromPhong";

/** An instance of the module. It belongs to one thread. */
export interface Burnish {
  /** Starts the threads that load() was told not to start. */
  startThreads(): void;
  readonly version: string;
  /** Whether the module uses SIMD128. */
  readonly simd: boolean;
  /** How many threads draw. */
  readonly threads: number;
  /** Words of one lobe of each sort. */
  readonly lobes: string[];
  /** Decodes no texture. */
  open(input: Input, options?: LoadOptions): Mesh;
  /** The same with both. */
  read(input: Input, options?: ReadOptions): Promise<Mesh>;
  render(input: Input, options?: LoadOptions & DrawOptions): Picture;
  /** The lobe at cosines, in single precision: the bits that pictures have. */
  lobeValues(words: string, exponent: number, cosines: ArrayLike<number>): Float32Array;
  /** The lobe at angles, in double precision. */
  theoryValues(words: string, exponent: number, angles: ArrayLike<number>): Float64Array;
  theory(words: string, exponent: number): Theory;
  convert(name: Conversion, value: number): number;
  /** What `burnish lobe` prints for ["claims", "--format=csv"] and the like: table, claims, choose, fit, boundary; not as JSON. */
  lobe(words: (string | number)[], file?: { name: string; bytes: BufferSource }): string;
  /** Endings of the files that open() reads: ".obj". */
  readonly endings: string[];
}

/** Whether this engine runs SIMD128. */
export function hasSimd(): boolean;

/**
 * Makes an instance. simd: by default what the engine runs; module: instead of the file of the package; threads: 1, or
 * more in a worker of a page that is cross-origin isolated; startThreads: false has one draw until startThreads() is called, so that
 * a first picture need not wait beside workers that start. The pixels are the same.
 */
export function load(how?: { simd?: boolean; threads?: number; startThreads?: boolean; module?: URL | string | BufferSource | WebAssembly.Module }): Promise<Burnish>;

/** One picture, by an instance that all calls share: read, render, close. */
export function render(input: Input, options?: ReadOptions & DrawOptions): Promise<Picture>;
