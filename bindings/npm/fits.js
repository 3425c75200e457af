// Options of a lobe: the fits and orders of the shaders' sources.

export const FITS = ["taylor", "energy", "projected", "minimax", "shift7", "shift3", "zeta"];
export const ORDERS = [2, 4, 8, 16, 32];

/** { fit, order, zeta } of checked options. */
export function checkLobe({ fit, order = 2, zeta = 0, ...others } = {}, usual = "energy") {
  const lobe = { fit: fit ?? (zeta ? "zeta" : usual), order, zeta };
  const extra = Object.keys(others)[0];
  if (extra) {
    throw new Error(`burnish: "${extra}": unknown option; expected fit, order or zeta`);
  }
  if (!FITS.includes(lobe.fit)) {
    throw new Error(`burnish: "${lobe.fit}" is not a fit; use one of ${FITS.join(", ")}`);
  }
  if (!ORDERS.includes(order)) {
    throw new Error(`burnish: order ${order}; expected one of ${ORDERS.join(", ")}`);
  }
  if (lobe.fit.startsWith("shift") && order !== 2) {
    throw new Error(`burnish: ${lobe.fit} has order 2 only, not ${order}`);
  }
  if (lobe.fit === "zeta" && !(zeta > 0 && zeta <= 65536)) {
    throw new Error(`burnish: zeta ${zeta}; expected a number above 0 and at most 65536`);
  }
  return lobe;
}
