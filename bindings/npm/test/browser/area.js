// A sphere and a floor of white metal under a rectangular light: BurnishRectLight and three.js' own RectAreaLight, compared with each other.
import * as three from "three";
import { RectAreaLightUniformsLib } from "three/addons/lights/RectAreaLightUniformsLib.js";
import { BurnishRectLight } from "burnish/three";

const EYE = [0, 1.3, 4.2];
const TARGET = [0, 0.55, 0];
const FIELD = 34; // degrees, vertical
const SPHERE = { center: [0.45, 0.6, 0.2], radius: 0.6 };
const LIGHT = { center: [-1.5, 1, -0.8], target: [0.2, 0.3, 0.3], width: 1.4, height: 1.2 };

function sceneOf(material, light) {
  const { center, target, width, height } = LIGHT;
  const floor = new three.Mesh(new three.PlaneGeometry(40, 40).rotateX(-Math.PI / 2), material);
  const sphere = new three.Mesh(new three.SphereGeometry(SPHERE.radius, 384, 192), material);
  sphere.position.set(...SPHERE.center);
  light.position.set(...center);
  light.lookAt(...target);
  const shape = new three.Mesh(new three.PlaneGeometry(width, height), new three.MeshBasicMaterial({ side: three.DoubleSide }));
  light.add(shape);
  return new three.Scene().add(floor, sphere, light);
}

// three.js widens highlights by the curvature of a pixel; that is switched off for both.
function metal(roughness, defines) {
  const material = new three.MeshStandardMaterial({ color: "white", metalness: 1, roughness });
  material.defines = { ...material.defines, ...defines };
  material.onBeforeCompile = (shader) => {
    const source = three.ShaderChunk.lights_physical_fragment.replace("material.roughness += geometryRoughness;", "");
    shader.fragmentShader = shader.fragmentShader.replace("#include <lights_physical_fragment>", source);
  };
  return material;
}

/** Linear light, rows from the bottom. */
function picture(renderer, scene, width, height) {
  const target = new three.WebGLRenderTarget(width, height, { type: three.FloatType });
  const camera = new three.PerspectiveCamera(FIELD, width / height, 0.1, 100);
  camera.position.set(...EYE);
  camera.lookAt(...TARGET);
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  target.dispose();
  return pixels.filter((_, i) => i % 4 === 0);
}

/** RMS and largest difference of both at several roughnesses. The metals with USE_LTC have three.js' own light. */
export function compareAreaLights(roughnesses, width, height) {
  const renderer = new three.WebGLRenderer({ canvas: document.createElement("canvas") });
  const drawn = (Light, defines, roughness) => picture(renderer, sceneOf(metal(roughness, defines), new Light("white", 1, LIGHT.width, LIGHT.height)), width, height);
  return roughnesses.map((roughness) => { // first without three.js' tables
    const lobes = drawn(BurnishRectLight, {}, roughness);
    RectAreaLightUniformsLib.init();
    const tables = drawn(three.RectAreaLight, { USE_LTC: "" }, roughness);
    const errors = [...lobes].map((value, i) => Math.abs(value - tables[i]));
    return { roughness, rms: Math.sqrt(errors.reduce((sum, e) => sum + e * e, 0) / errors.length), most: Math.max(...errors) };
  });
}
