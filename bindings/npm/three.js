// burnish/three: highlights without pow in three.js' materials, for WebGLRenderer.
//
//   import { useBurnish } from "burnish/three";
//   const material = useBurnish(new MeshPhongMaterial({ shininess: 60 }), { fit: "minimax", order: 4 });
//
// In MeshPhongMaterial the lobe replaces pow( dotNH, shininess ); in MeshStandardMaterial and
// MeshPhysicalMaterial the normalised lobe replaces GGX's distribution of normals. It throws if three.js no longer
// contains the replaced source text.
import { ShaderChunk } from "three";
import glsl from "./glsl.js";
import { checkLobe } from "./lobe.js";

// The replaced text of three.js' chunks.
const POWER = { chunk: "bsdfs", text: "pow( dotNH, shininess )" };
const GGX = { chunk: "lights_physical_pars_fragment", text: /(float D_GGX\( const in float alpha, const in float dotNH \) \{)[^}]*\}/ };

const real = (x) => (Number.isInteger(x) ? `${x}.0` : String(x));

// The slope of an exponent in GLSL. Below its order a lobe has the exponent of its order.
function slope(exponent, { fit, order, zeta }) {
  const n = `max( ${exponent}, ${real(order)} )`;
  if (fit === "zeta") {
    return real(zeta);
  }
  const name = `burnishZeta${fit[0].toUpperCase()}${fit.slice(1)}`;
  return fit.startsWith("shift") ? `${name}( ${n} )` : `${name}( ${n}, ${real(order)} )`;
}

function replaced({ chunk, text }, by) {
  const source = ShaderChunk[chunk];
  const changed = source?.replace(text, by);
  if (!source || changed === source) {
    throw new Error(`burnish/three: three.js' shader chunk "${chunk}" no longer holds ${text}; take a version of burnish that knows this one`);
  }
  return changed;
}

function changedChunk(material, lobe) {
  if (material.isMeshStandardMaterial) {
    const body = `$1
	float slope = ${slope("2.0 / pow2( alpha ) - 2.0", lobe)};
	return burnishNormalizeLobeDistribution( slope, ${real(lobe.order)} ) * burnishLobe${lobe.order}( dotNH, slope );
}`;
    return { name: GGX.chunk, source: replaced(GGX, body) };
  }
  if (material.isMeshPhongMaterial) {
    return { name: POWER.chunk, source: replaced(POWER, `burnishLobe${lobe.order}( dotNH, ${slope("shininess", lobe)} )`) };
  }
  throw new Error(`burnish/three: ${material.type} has no highlight to replace; use MeshPhongMaterial or MeshStandardMaterial`);
}

/** Adds the lobe to the material and its clones, and returns it. An existing onBeforeCompile runs first. */
export function useBurnish(material, options = {}) {
  const lobe = checkLobe(options, material.isMeshStandardMaterial ? "projected" : "energy");
  const { name, source } = changedChunk(material, lobe);
  const before = material.onBeforeCompile;
  const key = material.customProgramCacheKey();
  material.onBeforeCompile = function (shader, renderer) {
    before.call(this, shader, renderer);
    const include = `#include <${name}>`;
    if (!shader.fragmentShader.includes(include)) {
      throw new Error(`burnish/three: the shader of ${material.type} has no ${include}; take a version of burnish that knows this three.js`);
    }
    shader.fragmentShader = shader.fragmentShader.replace(include, () => `${glsl}\n${source}`);
  };
  material.customProgramCacheKey = () => `${key} burnish ${lobe.fit}:${lobe.order} ${lobe.zeta}`;
  const { clone } = material;
  material.clone = function () { // three.js does not copy onBeforeCompile
    return useBurnish(clone.call(this), lobe);
  };
  material.needsUpdate = true;
  return material;
}
