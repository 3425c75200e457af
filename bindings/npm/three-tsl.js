// burnish/three/tsl: highlights without pow as nodes, for WebGPURenderer and both of its backends.
import { MeshPhongNodeMaterial, PhongLightingModel } from "three/webgpu";
import { F_Schlick, float, materialSpecularStrength, normalView, positionViewDirection, shininess, specularColor } from "three/tsl";
import { checkLobe } from "./fits.js";

const MINIMAX = { 2: [0.355859, 0.2345, 0.104], 4: [0.211335, 0.14, 0.058], 8: [0.114995, 0.0762, 0.031], 16: [0.0599556, 0.0397, 0.016], 32: [0.0306084, 0.0202, 0.008] };

// The same as in lobe/shaders/burnish.shade.
const SLOPES = {
  taylor: (n, m) => n.div(m),
  energy: (n, m) => n.add(1).div(m + 1),
  projected: (n, m) => {
    const b = n.add(2).mul(m + 2);
    const a = 2 * (m + 1) * (m + 2);
    return b.add(b.mul(b).sub(n.add(2).mul(2 * a)).sqrt()).div(a);
  },
  minimax: (n, m) => n.mul(MINIMAX[m][0]).add(MINIMAX[m][1]).add(float(MINIMAX[m][2]).div(n)),
  shift7: (n) => n.mul(0.4375),
  shift3: (n) => n.mul(0.375),
};

/** The slope zeta of an exponent, a node. Below its order a lobe has the exponent of its order. */
export function burnishZeta(exponent, options) {
  const { fit, order, zeta } = checkLobe(options);
  return fit === "zeta" ? float(zeta) : SLOPES[fit](float(exponent).max(order), order);
}

/** The lobe at a cosine, a node, to replace pow(cosine, exponent). */
export function burnishLobe(cosine, exponent, options) {
  const { order } = checkLobe(options);
  let lobe = float(1).sub(burnishZeta(exponent, options).mul(float(1).sub(cosine))).clamp();
  for (let m = order; m > 1; m /= 2) {
    lobe = lobe.mul(lobe).toVar();
  }
  return lobe;
}

if (typeof PhongLightingModel?.prototype?.direct !== "function" ||
    typeof MeshPhongNodeMaterial?.prototype?.setupLightingModel !== "function") {
  throw new Error("burnish/three/tsl: three.js' PhongLightingModel is not what it was; take a version of burnish that knows this one");
}

/** three.js' Phong model with the lobe instead of cos^n: D = (n / 2 + 1) / pi lobe, G = 1/4, F by Schlick. */
class BurnishLightingModel extends PhongLightingModel {
  constructor(lobe) {
    super(false); // no specular part; it adds the diffuse part
    this.lobe = lobe;
  }

  direct(lights, builder) {
    super.direct(lights, builder);
    const { lightDirection, lightColor, reflectedLight } = lights;
    const half = lightDirection.add(positionViewDirection).normalize();
    const lobe = burnishLobe(normalView.dot(half).clamp(), shininess, this.lobe);
    const fresnel = F_Schlick({ f0: specularColor, f90: 1, dotVH: positionViewDirection.dot(half).clamp() });
    const distribution = shininess.mul(0.5).add(1).mul(1 / Math.PI).mul(lobe);
    const irradiance = normalView.dot(lightDirection).clamp().mul(lightColor);
    reflectedLight.directSpecular.addAssign(irradiance.mul(fresnel).mul(distribution.mul(0.25)).mul(materialSpecularStrength));
  }
}

/** MeshPhongNodeMaterial with that model. */
export class BurnishPhongMaterial extends MeshPhongNodeMaterial {
  static get type() {
    return "BurnishPhongMaterial";
  }

  constructor(parameters, lobe = {}) {
    super(parameters);
    this.lobe = checkLobe(lobe);
  }

  setupLightingModel() {
    return new BurnishLightingModel(this.lobe);
  }

  // NodeMaterial uses it as the key of programs
  customProgramCacheKey() {
    return `${super.customProgramCacheKey()} burnish ${this.lobe.fit}:${this.lobe.order} ${this.lobe.zeta}`;
  }

  copy(source) {
    this.lobe = source.lobe ?? this.lobe;
    return super.copy(source);
  }
}
