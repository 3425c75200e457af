// Three spheres under a rectangular light that can be dragged: the light's reflection in the lobe on screen, integrated by shaders/burnish.glsl for each pixel.
import { startProgram } from "./brdf.js";
import { byHand, darkScheme } from "./picture.js";
import { NUMBERS, at, clamp, show, state } from "./state.js";

const EYE = [0, 1.25, 6];
const TARGET = [0, 0.85, 0];
const FIELD = 0.245; // tangent of half the vertical angle
const DEPTH = 1; // z of the light; it faces AIM
const AIM = [0, 0.35, 0];

const fragmentOf = (glsl) => `#version 300 es
precision highp float;
${glsl}
uniform vec2 size;
uniform vec3 eye, right, up, forward, light, halfU, halfV, ground;
uniform float zeta;
uniform int order;
out vec4 color;

const float RADIANCE = 4.0;

struct Surface {
  float distance;
  vec3 point, normal, base;
  float metal;
};

void meetSphere(vec3 direction, vec3 center, vec3 base, float metal, inout Surface surface) {
  vec3 from = eye - center;
  float b = dot(from, direction);
  float under = b * b - dot(from, from) + 0.36;
  float distance = -b - sqrt(max(under, 0.0));
  if (under > 0.0 && distance < surface.distance) {
    vec3 point = eye + direction * distance;
    surface = Surface(distance, point, (point - center) / 0.6, base, metal);
  }
}

// How much of the sky above a point of the floor a sphere leaves.
float openTo(vec3 point, float x) {
  vec3 away = vec3(x, 0.6, 0.0) - point;
  float squared = dot(away, away);
  return 1.0 - 0.36 * away.y / (squared * sqrt(squared));
}

vec3 shade(Surface s, vec3 V) {
  vec3 R = reflect(-V, s.normal);
  vec2 lit = RADIANCE * burnishRectLight(light - s.point, halfU, halfV, 1, s.normal, R, zeta, order);
  float open = s.point.y > 0.001 ? 0.6 + 0.4 * s.normal.y : openTo(s.point, -1.45) * openTo(s.point, 0.0) * openTo(s.point, 1.45);
  vec3 F = mix(vec3(0.04), s.base, s.metal);
  F += (1.0 - F) * pow(1.0 - max(dot(s.normal, V), 0.0), 5.0) * (s.metal > 0.0 ? 1.0 : 0.6);
  float sky = mix(0.05, 0.3, smoothstep(-0.3, 1.0, R.y));
  return s.base * (1.0 - s.metal) * (lit.x + 0.16) * open + F * (lit.y + sky * open);
}

vec3 picture(vec2 at) {
  vec3 direction = normalize(forward + right * at.x + up * at.y);
  Surface surface = Surface(1e9, vec3(0), vec3(0, 1, 0), vec3(0.3), 0.0);
  if (direction.y < 0.0) {
    surface.distance = -eye.y / direction.y;
    surface.point = eye + direction * surface.distance;
    surface.point.y = 0.0;
  }
  meetSphere(direction, vec3(-1.45, 0.6, 0.0), vec3(0.02), 0.0, surface);
  meetSphere(direction, vec3(0.0, 0.6, 0.0), vec3(0.5, 0.09, 0.02), 0.0, surface);
  meetSphere(direction, vec3(1.45, 0.6, 0.0), vec3(0.92, 0.89, 0.84), 1.0, surface);
  vec3 result = ground;
  if (surface.distance < 1e8) {
    result = mix(shade(surface, -direction), ground, smoothstep(6.5, 15.0, surface.distance));
  }
  // the softbox itself: its front is white, its back a frame
  vec3 facing = cross(halfU, halfV);
  float distance = dot(light - eye, facing) / dot(direction, facing);
  vec3 from = eye + direction * distance - light;
  vec2 box = abs(vec2(dot(from, halfU) / dot(halfU, halfU), dot(from, halfV) / dot(halfV, halfV)));
  if (distance > 0.0 && max(box.x, box.y) < 1.0) {
    vec2 edge = (1.0 - box) * vec2(length(halfU), length(halfV));
    result = mix(result, vec3(1.0), min(edge.x, edge.y) < 0.02 ? 1.0 : 0.35);
  }
  return result;
}

void main() {
  vec2 at = (2.0 * gl_FragCoord.xy - size) / size.y * ${FIELD};
  vec3 linear = clamp(picture(at), 0.0, 1.0);
  color = vec4(mix(12.92 * linear, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear)), 1.0);
}`;

const add = (a, b, scale = 1) => a.map((x, i) => x + scale * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, length) => a.map((x) => (x * length) / Math.hypot(...a));

const forward = scaled(add(TARGET, EYE, -1), 1);
const right = scaled(cross(forward, [0, 1, 0]), 1);
const up = cross(right, forward);

/** Centre and half sides of the light, which faces AIM. */
function light() {
  const center = [Number(state.boxx), Number(state.boxy), DEPTH];
  const facing = scaled(add(AIM, center, -1), 1);
  const halfU = scaled(cross([0, 1, 0], facing), Number(state.boxw) / 2);
  return { center, halfU, halfV: scaled(cross(facing, halfU), Number(state.boxh) / 2) };
}

const canvas = at("softbox-canvas");
let draw = () => {}; // until the shader is compiled
let isMoving = false;

// The lobe that the shader can integrate: of order 8 at most, around the reflected direction. Blinn's half vector moves half as fast.
function lobeFor({ zeta, order, exponent, isBlinn }) {
  const isKnown = zeta > 0 && order <= 8;
  const slope = isKnown ? zeta : (exponent + 1) / 9;
  return { zeta: Math.max(1, slope / (isBlinn ? 4 : 1)), order: isKnown ? order : 8, isKnown };
}

let lobe = lobeFor({ zeta: 0, order: 8, exponent: 40, isBlinn: true });

function fail(message) {
  show(message, "softbox-error"); // it covers the picture
  at("softbox-move").hidden = at("softbox-size").hidden = true;
}

async function start() {
  const { default: glsl } = await import("./burnish/glsl.js");
  const gl = canvas.getContext("webgl2", { antialias: false, alpha: false });
  if (!gl) {
    fail("This picture needs WebGL 2, which this browser lacks.");
    return;
  }
  const { program } = startProgram(gl, fragmentOf(glsl));
  const parallel = gl.getExtension("KHR_parallel_shader_compile");
  while (parallel && !gl.getProgramParameter(program, parallel.COMPLETION_STATUS_KHR)) { // the page stays responsive
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    fail("This browser can't compile the shader of this picture.");
    return;
  }
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  for (const [name, value] of Object.entries({ eye: EYE, right, up, forward })) {
    gl.uniform3fv(uniform(name), value);
  }
  draw = () => {
    const scale = Math.max(devicePixelRatio, isMoving ? 1 : 1.5);
    const width = Math.round(canvas.clientWidth * scale);
    const height = Math.round(canvas.clientHeight * scale);
    if (canvas.width !== width || canvas.height !== height) {
      Object.assign(canvas, { width, height });
    }
    gl.viewport(0, 0, width, height);
    gl.uniform2f(uniform("size"), width, height);
    const { center, halfU, halfV } = light();
    for (const [name, value] of Object.entries({ light: center, halfU, halfV, ground: darkScheme.matches ? [0.012, 0.011, 0.01] : [0.23, 0.22, 0.2] })) {
      gl.uniform3fv(uniform(name), value);
    }
    gl.uniform1f(uniform("zeta"), lobe.zeta);
    gl.uniform1i(uniform("order"), lobe.order);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  };
  darkScheme.addEventListener("change", () => draw());
  new ResizeObserver(() => {
    place();
    draw();
  }).observe(canvas);
}

// ---- Handles ----

/** A point in per cent of the picture. */
function project(point) {
  const from = add(point, EYE, -1);
  const depth = FIELD * dot(from, forward);
  const aspect = canvas.clientWidth / canvas.clientHeight;
  return [50 + (50 * dot(from, right)) / depth / aspect, 50 - (50 * dot(from, up)) / depth];
}

function place() {
  const { center, halfU, halfV } = light();
  const corners = [-1, 1].map((side) => project(add(add(center, halfU, side), halfV, -1)));
  for (const [id, [x, y]] of [["softbox-move", project(center)], ["softbox-size", corners.sort((a, b) => b[0] - a[0])[0]]]) {
    Object.assign(at(id).style, { left: `${x}%`, top: `${y}%` });
  }
  const text = `${Number(state.boxw).toFixed(2)} × ${Number(state.boxh).toFixed(2)} at ${Number(state.boxx).toFixed(2)}, ${Number(state.boxy).toFixed(2)}`;
  at("softbox-about").textContent = `Softbox ${text}; lobe of order ${lobe.order}, slope ${lobe.zeta.toFixed(2)} around the reflected direction` +
    (lobe.isKnown ? "." : ": the one chosen above has no such integral.");
}

let rest = 0;
let rested = () => {};

function move(changes) {
  for (const [key, step] of Object.entries(changes)) {
    state[key] = String(Number(clamp(Number(state[key]) + step, NUMBERS[key]).toFixed(3)));
  }
  isMoving = true;
  place();
  draw();
  clearTimeout(rest);
  rest = setTimeout(() => {
    isMoving = false;
    draw();
    rested();
  }, 200);
}

const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const HANDLES = { "softbox-move": (x, y) => ({ boxx: x, boxy: y }), "softbox-size": (x, y) => ({ boxw: 2 * x, boxh: -2 * y }) };

for (const [id, changes] of Object.entries(HANDLES)) {
  byHand(at(id), (now, before) => {
    const unit = (2 * FIELD * dot(add(light().center, EYE, -1), forward)) / canvas.clientHeight;
    move(changes((now[0] - before[0]) * unit, (before[1] - now[1]) * unit));
  }, (key) => STEPS[key] && (() => move(changes(0.05 * STEPS[key][0], 0.05 * STEPS[key][1]))));
}

// The shader is compiled when the picture comes into view.
const watcher = new IntersectionObserver(([entry]) => {
  if (entry.isIntersecting) {
    watcher.disconnect();
    start();
  }
}, { rootMargin: "200px" });
watcher.observe(canvas);

/** Shows a lobe: { zeta, order, exponent, isBlinn }; zeta 0 if it is not u to the m. */
export function showSoftbox(chosen) {
  lobe = lobeFor(chosen);
  place();
  draw();
}

/** Calls onRest when the light has been moved. */
export const watchSoftbox = (onRest) => (rested = onRest);
