// burnish/three: highlights without pow in three.js' materials, and rectangular lights without tables, for WebGLRenderer.
//
// In MeshPhongMaterial the lobe replaces pow( dotNH, shininess ); in MeshStandardMaterial and
// MeshPhysicalMaterial the normalised lobe replaces GGX's distribution of normals. It throws if three.js no longer
// contains the replaced source text.
import { RectAreaLight, ShaderChunk } from "three";
import glsl from "./glsl.js";
import { checkLobe } from "./fits.js";

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
  changedChunk(material, lobe); // throws early
  const before = material.onBeforeCompile;
  const key = material.customProgramCacheKey();
  material.onBeforeCompile = function (shader, renderer) {
    before.call(this, shader, renderer);
    const { name, source } = changedChunk(material, lobe); // now: a BurnishRectLight changes chunks
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

// ---- Area lights ----

const AREA = "lights_physical_pars_fragment";
const MARK = "RE_Direct_RectArea_Burnish";

// The part of GGX's light that a surface reflects: three.js' own table where it has one.
const share = (source, normal, roughness) => (source.includes("vec2 dfg;") && normal === "geometryNormal" ? "material.dfg"
  : `burnishGgxAlbedo( saturate( dot( ${normal}, geometryViewDir ) ), ${roughness} )`);

// Follows RE_Direct_RectArea_Physical; older versions of three.js have other names for colours.
function areaFunction(source) {
  const specular = source.includes("specularColorBlended") ? "specularColorBlended" : "specularColor";
  const diffuse = source.includes("diffuseContribution") ? "diffuseContribution" : "diffuseColor";
  return `
#if NUM_RECT_AREA_LIGHTS > 0 && ! defined( USE_LTC )
${glsl}
	void ${MARK}( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 center = rectAreaLight.position - geometryPosition;
		vec3 halfU = - rectAreaLight.halfWidth; // it shines in the local negative z direction
		vec2 light = burnishRectLightGgx( center, halfU, rectAreaLight.halfHeight, 1, geometryNormal, geometryViewDir, material.roughness );
		vec2 share = ${share(source, "geometryNormal", "material.roughness")};
		reflectedLight.directSpecular += rectAreaLight.color * ( material.${specular} * share.x + material.specularF90 * share.y ) * light.y;
		reflectedLight.directDiffuse += rectAreaLight.color * material.${diffuse} * light.x;
		#ifdef USE_CLEARCOAT
			light = burnishRectLightGgx( center, halfU, rectAreaLight.halfHeight, 1, geometryClearcoatNormal, geometryViewDir, material.clearcoatRoughness );
			share = ${share(source, "geometryClearcoatNormal", "material.clearcoatRoughness")};
			clearcoatSpecularDirect += rectAreaLight.color * ( material.clearcoatF0 * share.x + material.clearcoatF90 * share.y ) * light.y;
		#endif
	}
	#undef RE_Direct_RectArea
	#define RE_Direct_RectArea ${MARK}
#endif
`;
}

/**
 * A RectAreaLight that MeshStandardMaterial and MeshPhysicalMaterial integrate in the shader, without RectAreaLightUniformsLib and its tables. The first one
 * changes all rectangular lights of the page, but not the materials with the define USE_LTC.
 */
export class BurnishRectLight extends RectAreaLight {
  constructor(color, intensity, width, height) {
    super(color, intensity, width, height);
    const source = ShaderChunk[AREA];
    if (!source?.includes("#define RE_Direct_RectArea")) {
      throw new Error(`burnish/three: three.js' shader chunk "${AREA}" no longer has rectangular lights; use a version of burnish that knows this one`);
    }
    if (!source.includes(MARK)) {
      ShaderChunk[AREA] = source + areaFunction(source);
    }
  }
}
