import type { Material } from "three";

/** Which lobe stands for the power. */
export interface Lobe {
  /** "energy" by default; for MeshStandardMaterial "projected". */
  fit?: "taylor" | "energy" | "projected" | "minimax" | "shift7" | "shift3" | "zeta";
  /** Squarings cost: 2, 4, 8, 16 or 32; 2 by default. shift7 and shift3 have 2 only. */
  order?: 2 | 4 | 8 | 16 | 32;
  /** The slope itself, whatever the exponent is: (0, 65536]. */
  zeta?: number;
}

/** Gives a MeshPhongMaterial or MeshStandardMaterial the lobe, and returns it. */
export function useBurnish<M extends Material>(material: M, lobe?: Lobe): M;
