// A sphere and a floor of white metal under a rectangular light: BurnishRectLight and three.js' own RectAreaLight, compared with samples of GGX.
import * as three from "three";
import { RectAreaLightUniformsLib } from "three/addons/lights/RectAreaLightUniformsLib.js";
import { BurnishRectLight } from "burnish/three";

const EYE = [0, 1.3, 4.2];
const TARGET = [0, 0.55, 0];
const FIELD = 34; // degrees, vertical
const SPHERE = { center: [0.45, 0.6, 0.2], radius: 0.6 };

const add = (a, b, scale = 1) => a.map((x, i) => x + scale * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

/** A light with the axes of its rectangle; it shines along `axis`. */
function rectangle(center, target, width, height) {
  const axis = unit(add(target, center, -1));
  const right = unit(cross([0, 1, 0], axis));
  return { center, target, width, height, axis, right, up: cross(axis, right) };
}

const LIGHT = rectangle([-1.5, 1, -0.8], [0.2, 0.3, 0.3], 1.4, 1.2);

// ---- three.js ----

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

function cameraOf(width, height) {
  const camera = new three.PerspectiveCamera(FIELD, width / height, 0.1, 100);
  camera.position.set(...EYE);
  camera.lookAt(...TARGET);
  return camera;
}

/** Linear light, rows from the bottom. */
function picture(renderer, scene, width, height) {
  const target = new three.WebGLRenderTarget(width, height, { type: three.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, cameraOf(width, height));
  const pixels = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
  target.dispose();
  return pixels.filter((_, i) => i % 4 === 0);
}

// ---- Samples of GGX ----

/** Where a ray meets the light's rectangle: its distance, or 0. */
function meetLight({ center, width, height, axis, right, up }, from, direction) {
  const distance = dot(add(center, from, -1), axis) / dot(direction, axis);
  const at = add(add(from, direction, distance), center, -1);
  return distance > 0 && Math.abs(dot(at, right)) <= width / 2 && Math.abs(dot(at, up)) <= height / 2 ? distance : 0;
}

/** What a pixel shows: { kind: "light" }, or a surface's point, normal and direction to the viewer. */
function surfaceAt(light, x, y, width, height) {
  const forward = unit(add(TARGET, EYE, -1));
  const right = unit(cross(forward, [0, 1, 0]));
  const scale = Math.tan((FIELD * Math.PI) / 360);
  const across = scale * (width / height) * ((2 * (x + 0.5)) / width - 1);
  const direction = unit(add(add(forward, right, across), cross(right, forward), scale * ((2 * (y + 0.5)) / height - 1)));
  const found = [{ kind: "light", distance: meetLight(light, EYE, direction) }, { kind: "floor", distance: -EYE[1] / direction[1] }];
  const toEye = add(EYE, SPHERE.center, -1);
  const b = dot(toEye, direction);
  const under = b * b - dot(toEye, toEye) + SPHERE.radius ** 2;
  found.push({ kind: "sphere", distance: under > 0 ? -b - Math.sqrt(under) : 0 });
  const [first] = found.filter(({ distance }) => distance > 0).sort((p, q) => p.distance - q.distance);
  if (!first || first.kind === "light") {
    return first ?? { kind: "none" };
  }
  const point = add(EYE, direction, first.distance);
  const normal = first.kind === "floor" ? [0, 1, 0] : unit(add(point, SPHERE.center, -1));
  return { kind: first.kind, point, normal, view: direction.map((c) => -c) };
}

function radicalInverse(i) {
  let bits = ((i << 16) | (i >>> 16)) >>> 0;
  for (const [shift, mask] of [[1, 0x55555555], [2, 0x33333333], [4, 0x0f0f0f0f], [8, 0x00ff00ff]]) {
    bits = (((bits & mask) << shift) | ((bits >>> shift) & mask)) >>> 0;
  }
  return bits / 2 ** 32;
}

const smith = (alpha, cosine) => 0.5 * (Math.sqrt(1 + (alpha * alpha * (1 - cosine * cosine)) / (cosine * cosine)) - 1);

/**
 * The light that GGX with F = 1 and correlated Smith shadowing reflects, by visible normals.
 * Source: Heitz, Sampling the GGX Distribution of Visible Normals, 2018.
 */
function reflected(light, { point, normal, view }, alpha, samples) {
  const tangent = unit(cross(Math.abs(normal[1]) < 0.9 ? [0, 1, 0] : [1, 0, 0], normal));
  const other = cross(normal, tangent);
  const v = [dot(view, tangent), dot(view, other), dot(view, normal)];
  const [hx, hy, hz] = unit([alpha * v[0], alpha * v[1], v[2]]);
  const plane = Math.hypot(hx, hy);
  const t1 = plane > 1e-9 ? [-hy / plane, hx / plane, 0] : [1, 0, 0];
  const t2 = cross([hx, hy, hz], t1);
  const lambdaV = smith(alpha, v[2]);
  // the light in the surface's frame, in units of its half sides
  const local = (w) => [dot(w, tangent), dot(w, other), dot(w, normal)];
  const [ax, ay, az] = local(light.axis);
  const [rx, ry, rz] = local(light.right.map((c) => (2 * c) / light.width));
  const [ux, uy, uz] = local(light.up.map((c) => (2 * c) / light.height));
  const [cx, cy, cz] = local(add(light.center, point, -1));
  const [ca, cr, cu] = [cx * ax + cy * ay + cz * az, cx * rx + cy * ry + cz * rz, cx * ux + cy * uy + cz * uz];
  const isLit = (x, y, z) => {
    const away = x * ax + y * ay + z * az;
    const distance = ca / away;
    return away < 0 && distance > 0 && Math.abs(distance * (x * rx + y * ry + z * rz) - cr) <= 1 && Math.abs(distance * (x * ux + y * uy + z * uz) - cu) <= 1;
  };
  const half = 0.5 * (1 + hz);
  let sum = 0;
  for (let i = 0; i < samples; ++i) { // scalars: arrays make it ten times slower
    const radius = Math.sqrt((i + 0.5) / samples);
    const angle = 2 * Math.PI * radicalInverse(i);
    const p = radius * Math.cos(angle);
    const q = (1 - half) * Math.sqrt(1 - p * p) + half * radius * Math.sin(angle);
    const up = Math.sqrt(Math.max(0, 1 - p * p - q * q));
    const mx = alpha * (p * t1[0] + q * t2[0] + up * hx);
    const my = alpha * (p * t1[1] + q * t2[1] + up * hy);
    const mz = Math.max(1e-9, p * t1[2] + q * t2[2] + up * hz);
    const twice = (2 * (v[0] * mx + v[1] * my + v[2] * mz)) / (mx * mx + my * my + mz * mz);
    const [lx, ly, lz] = [twice * mx - v[0], twice * my - v[1], twice * mz - v[2]];
    if (lz > 0 && isLit(lx, ly, lz)) {
      sum += (1 + lambdaV) / (1 + lambdaV + smith(alpha, lz));
    }
  }
  return sum / samples;
}

/** Linear light and a mask of the pixels to compare: those whose neighbours show the same surface. */
function reference(light, roughness, width, height, samples) {
  const surfaces = Array.from({ length: width * height }, (_, i) => surfaceAt(light, i % width, Math.floor(i / width), width, height));
  const isSame = (i, x, y) => x < 0 || y < 0 || x >= width || y >= height || surfaces[y * width + x].kind === surfaces[i].kind;
  return surfaces.map((surface, i) => {
    const [x, y] = [i % width, Math.floor(i / width)];
    const isInside = isSame(i, x - 1, y) && isSame(i, x + 1, y) && isSame(i, x, y - 1) && isSame(i, x, y + 1);
    return { value: surface.point ? reflected(light, surface, roughness ** 2, samples) : Number(surface.kind === "light"), counts: Boolean(surface.point) && isInside };
  });
}

// ---- Comparison ----

// First without three.js' tables.
const KINDS = { burnish: [BurnishRectLight, {}], three: [three.RectAreaLight, { USE_LTC: "" }] };

const sceneFor = (kind, roughness) => {
  const [Light, defines] = KINDS[kind];
  if (kind === "three") {
    RectAreaLightUniformsLib.init();
  }
  return sceneOf(metal(roughness, defines), new Light("white", 1, LIGHT.width, LIGHT.height));
};

/** Errors under the light: { roughness, burnish: { rms, most }, three }. */
function compare(renderer, roughness, width, height, samples) {
  const expected = reference(LIGHT, roughness, width, height, samples);
  const row = { roughness };
  for (const kind of Object.keys(KINDS)) {
    const pixels = picture(renderer, sceneFor(kind, roughness), width, height);
    const errors = expected.flatMap(({ value, counts }, i) => (counts ? [Math.abs(pixels[i] - value)] : []));
    row[kind] = { rms: Math.sqrt(errors.reduce((sum, e) => sum + e * e, 0) / errors.length), most: Math.max(...errors) };
  }
  return row;
}

/** The same light at several roughnesses. */
export function compareAreaLights(roughnesses, width, height, samples) {
  const renderer = new three.WebGLRenderer({ canvas: document.createElement("canvas") });
  const rows = roughnesses.map((roughness) => compare(renderer, roughness, width, height, samples));
  renderer.dispose();
  return rows;
}
