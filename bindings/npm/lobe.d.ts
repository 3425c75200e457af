/** Facts of lobes, and the program burnish-lobe, in WebAssembly. */
export { BurnishError } from "./wasm.js";

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

/** An instance of the module. It belongs to one thread. */
export interface Lobes {
  readonly version: string;
  /** An example of each kind of lobe. */
  readonly lobes: string[];
  /** The lobe at angles, in double precision. */
  theoryValues(words: string, exponent: number, angles: ArrayLike<number>): Float64Array;
  theory(words: string, exponent: number): Theory;
  convert(name: Conversion, value: number): number;
  /** The output of `burnish lobe` for words such as ["claims", "--format=csv"]: table, claims, choose, boundary; JSON is not available. */
  lobe(words: (string | number)[]): string;
}

/** Creates an instance. module: instead of the file of the package. */
export function load(how?: { module?: URL | string | BufferSource | WebAssembly.Module }): Promise<Lobes>;
