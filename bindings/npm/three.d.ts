import type { ColorRepresentation, Material } from "three";
import { RectAreaLight } from "three";

/** The lobe that replaces cos^n. */
export interface Lobe {
  /** "energy" by default; for MeshStandardMaterial "projected". */
  fit?: "taylor" | "energy" | "projected" | "minimax" | "shift7" | "shift3" | "zeta";
  /** 2, 4, 8, 16 or 32; 2 by default. Higher orders cost more squarings. shift7 and shift3 only have order 2. */
  order?: 2 | 4 | 8 | 16 | 32;
  /** The slope, instead of the exponent: (0, 65536]. */
  zeta?: number;
}

/** Adds the lobe to a MeshPhongMaterial or MeshStandardMaterial and its clones, and returns it. */
export function useBurnish<M extends Material>(material: M, lobe?: Lobe): M;

/**
 * A RectAreaLight for WebGLRenderer that MeshStandardMaterial and MeshPhysicalMaterial integrate in the shader, without RectAreaLightUniformsLib and its tables.
 * Width, height, intensity (nits) and lookAt are as in RectAreaLight. The first one changes all rectangular lights of the page, but not the materials with
 * `defines: { USE_LTC: "" }`.
 */
export class BurnishRectLight extends RectAreaLight {
  constructor(color?: ColorRepresentation, intensity?: number, width?: number, height?: number);
}
