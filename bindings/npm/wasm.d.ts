/** The renderer of burnish in WebAssembly, and facts of its lobes. */

/** The source of a mesh: the bytes of a file, or a built-in object. */
export type Input = BufferSource | ":teapot" | ":sphere" | ":torus" | ":knot";

/** What asynchronous functions also take. The name of a File is the default of the option `name`. */
export type AsyncInput = Input | Blob;

/** Uint8Array<ArrayBuffer> since TypeScript 5.7, Uint8Array before. */
export type Bytes = ReturnType<typeof Uint8Array.of>;

/** One word, or several: an array, or with commas between them. */
export type Words<Word extends string> = Word | `${Word},${string}` | readonly Word[];
export type Vector = readonly number[] | string;
/** A name, "#rrggbb", or three numbers in [0, 1]. */
export type Color = string | readonly number[];
export type View = "front" | "right" | "top" | "iso" | "back" | "left" | "bottom";
export type Annotation = "axes" | "box" | "dimensions" | "scale" | "grid" | "none";
export type Edge = "silhouettes" | "creases" | "boundaries" | "materials" | "none";

/** Options of loading: flags of `burnish render` with the same values. A list can be an array, and false switches an option off. */
export interface LoadOptions {
  /** For messages; the extension chooses the format: "part.stl". */
  name?: string;
  /** Files that the mesh refers to, by name: {"part.mtl": bytes}. */
  files?: Record<string, BufferSource>;
  /** If the name does not have the right extension. */
  inputFormat?: "auto" | "gltf" | "obj" | "off" | "ply" | "stl" | "3mf" | "bms";
  /** The default depends on the format. */
  up?: "+Y" | "-Y" | "+Z" | "-Z" | "+X" | "-X" | "auto" | "format";
  /** A plane "X,Y,Z,D" or [X, Y, Z, D]: everything beyond it is cut away. Several planes: an array of planes. */
  clip?: Vector | readonly Vector[] | false;
  /** "height", "normal" or a scalar property of a PLY file: colours by these values. */
  colorBy?: string;
  /** Default: "viridis". */
  colorMap?: "viridis" | "coolwarm" | "grey";
  /** "LO:HI": values with the first and the last colour. By default the range of the values. */
  colorRange?: string;
  /** "auto" (default), "file" or "own": whether the normals of the file are used. */
  normals?: "auto" | "file" | "own";
  /** Degrees below which edges are smooth. By default each edge depends on its surroundings. */
  creaseAngle?: number;
  /** Segments along a patch edge of a built-in object; default 16. */
  tessellation?: number;
  /** Seconds after the start of the animation. By default the mesh is in its rest pose. */
  animationTime?: number;
  /** Name or number of the animation. */
  animation?: string | number;
  /** Diameter of the points and lines of a file without faces. */
  pointSize?: number;
  /** Faults that are otherwise repaired with a warning are errors. */
  strict?: boolean;
  /** Ignores textures. */
  noTextures?: boolean;
  /** Ignores files that the input refers to. */
  noLibraries?: boolean;
  /** Mesh.facts gets its values. */
  measure?: boolean;
  maxTriangles?: number;
  maxTexturePixels?: number;
  /** Bytes, or "64M". */
  maxInputBytes?: number | string;
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

/** Options of drawing: flags of `burnish render`, with the same defaults. */
export interface DrawOptions {
  /** true: always four channels, as for ImageData. */
  rgba?: boolean;
  /** [width, height]; default [1024, 768]. */
  resolution?: readonly [number, number] | string;
  /** Width and height of a square picture, or both. */
  size?: number | readonly [number, number] | string;
  /** The height keeps the proportions, unless it is given. */
  width?: number;
  height?: number;
  /** Coverage samples per pixel: 1, 4, 8 or 16. */
  samples?: 1 | 4 | 8 | 16;
  cullBackFaces?: boolean;
  /** A name, "#rrggbb", three numbers in [0, 1], "none", or "environment". */
  backgroundColor?: Color | false;
  /** The same. */
  background?: Color | false;
  /** The picture has alpha, four channels. */
  noBackground?: boolean;
  /** No legend of colorBy. */
  noLegend?: boolean;
  /** A standard view. */
  views?: View | readonly [View];
  /** Lines and numbers around the object. */
  annotate?: Words<Annotation> | false;

  /** From the camera to the object. */
  cameraDirection?: Vector;
  /** Degrees. */
  azimuth?: number;
  /** The same. */
  cameraAzimuthAngle?: number;
  /** Degrees. */
  elevation?: number;
  /** The same. */
  cameraElevationAngle?: number;
  /** A camera of the input, by name or number. */
  camera?: string | number;
  cameraPosition?: Vector;
  cameraFocalPoint?: Vector;
  cameraViewUp?: Vector;
  /** Vertical field of view in degrees; default 30. */
  cameraViewAngle?: number;
  zoom?: number;
  /** The same. */
  cameraZoomFactor?: number;
  /** true: parallel projection; false or "no": perspective, also in standard views. */
  cameraOrthographic?: boolean | "no";
  /** Height of the picture in units of the mesh. */
  cameraOrthographicHeight?: number;
  /** Free share of the shorter side at each side; default 0.05. */
  margin?: number;

  look?: "studio" | "three-point" | "plain" | "clay" | "technical" | "drawing" | "lobes";
  /** Of all surfaces. */
  color?: Color;
  /** Ignores colours, materials and textures of the mesh, but not its opacity. */
  noColors?: boolean;
  material?: "matte" | "satin" | "plastic" | "polished" | "metal";
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
  /** One or several lights such as "directional:X,Y,Z[:INTENSITY[:COLOR]]", or "none". */
  light?: string | readonly string[] | false;
  /** "sky" or "room": light from all directions. */
  environment?: "sky" | "room";
  /** Factor of its light; default 1. */
  environmentStrength?: number;
  /** Turn about the up axis in degrees. */
  environmentTurn?: number;
  /** A number, or a colour. */
  ambient?: number | Color;
  /** Number of directions of ambient occlusion, or "none". */
  occlusion?: number | "none" | false;
  ground?: boolean;
  shadow?: boolean;
  /** true: all kinds. */
  edges?: boolean | Words<Edge>;
  wireframe?: boolean;
  /** Hidden edges as dashed lines. */
  hiddenLines?: boolean;
  /** Axes of holes and cylinders as chain lines. */
  centerLines?: boolean;
  edgeWidth?: number;
  edgeColor?: Color;
  /** Least contrast of the outline to the background, 0 to 255; 0: no hairline. */
  outlineContrast?: number;
  /** Limit on how often large triangles cover the picture; default 1000. */
  maxOverdraw?: number;
  /** "auto", or the module's instruction set: "wasm" with SIMD128, "scalar" without. The pixels are the same. */
  isa?: string;
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

/** A mesh in memory, for several pictures. */
export interface Mesh {
  readonly triangles: number;
  readonly vertices: number;
  readonly boundingBox: { min: number[]; max: number[] };
  /** The up axis: "+Y". */
  readonly up: string;
  /** With the option `measure`; null for a file of points or lines. */
  readonly facts?: Facts | null;
  render(options?: DrawOptions): Picture;
  /** Releases its memory at once. Without it, memory is released some time after the last reference is gone. */
  close(): void;
}

/** Facts of a lobe at an exponent. Angles are in radians; undefined values are NaN. */
export interface Theory {
  /** Slope of the family, else 0. */
  zeta: number;
  /** Value at the peak. */
  scale: number;
  /** The lobe is 0 for cosines up to this one. */
  cutoffCosine: number;
  zeroAngle: number;
  /** The angle at which the lobe is 1/2. */
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
  /** The lobe at angles, in double precision. */
  theoryValues(words: string, exponent: number, angles: ArrayLike<number>): Float64Array;
  theory(words: string, exponent: number): Theory;
  convert(name: Conversion, value: number): number;
  /** The output of `burnish lobe` for words such as ["claims", "--format=csv"]: table, claims, choose, boundary; JSON is not available. */
  lobe(words: (string | number)[]): string;
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
