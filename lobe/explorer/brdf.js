// Disney's .brdf files with a formula: parameters, and a function BRDF(L, V, N, X, Y) in GLSL, compiled by the browser.

function section(text, name, file) {
  const found = text.match(new RegExp(`^\\s*::begin\\s+${name}\\s*$([\\s\\S]*?)^\\s*::end\\s+${name}\\s*$`, "m"));
  if (!found && name === "shader") {
    throw new Error(`${file}: no "::begin shader" and "::end shader"; only .brdf files with a formula are supported, not measured ones`);
  }
  return found ? found[1] : "";
}

function parameterOf(line, number, file) {
  const [type, name, ...values] = line.trim().split(/\s+/);
  const counts = { float: 3, bool: 1, color: 3 };
  const numbers = values.slice(0, counts[type]).map(Number);
  if (!counts[type] || !/^[A-Za-z_]\w*$/.test(name ?? "") || numbers.length < counts[type] || numbers.some((x) => !Number.isFinite(x))) {
    throw new Error(`${file}: parameter ${number}, "${line.trim().slice(0, 60)}": give float NAME LEAST MOST START, bool NAME 0|1 or color NAME R G B`);
  }
  const [low, high, start] = numbers;
  return type === "float" ? { type, name, low, high, value: start } : { type, name, value: type === "bool" ? low : numbers };
}

/** { parameters: [{ type, name, low, high, value }], shader } */
export function parseBrdf(text, file) {
  if (!/^\s*(#.*\s*)*analytic\b/.test(text)) {
    throw new Error(`${file}: it does not begin with "analytic"; only .brdf files with a formula are supported, not measured ones`);
  }
  const lines = section(text, "parameters", file).split("\n").map((line) => line.replace(/#.*/, "")).filter((line) => line.trim());
  return { parameters: lines.map((line, i) => parameterOf(line, i + 1, file)), shader: section(text, "shader", file) };
}

// Desktop GLSL converts integer literals to floats; WebGL requires the decimal point.
function withPoints(shader) {
  const plain = shader.replace(/\/\*[\s\S]*?\*\//g, " ").replace(/\/\/.*/g, "");
  return plain.split("\n").map((line) =>
    /\b(u?int|ivec\d)\b/.test(line) ? line : line.replace(/(?<![\w.[])(\d+)(?![\w.\]]|\.\d)/g, "$1.0")).join("\n");
}

// Desktop GLSL lets a function replace a built-in one of the same name, such as reflect; WebGL does not.
const renamed = (shader) => [...shader.matchAll(/^\s*(?:float|bool|int|vec[234]|mat[234])\s+(\w+)\s*\(/gm)]
  .map(([, name]) => name).filter((name) => name !== "BRDF").map((name) => `#define ${name} own_${name}\n`).join("");

const UNIFORM = { float: "float", bool: "bool", color: "vec3" };

// Directions come from a texture, since sines in GLSL have eleven bits. Blinn's model: L = V = H, only N.H varies; Phong's: L = N, only R.V varies.
const source = ({ parameters, shader }) => `#version 300 es
precision highp float;
precision highp int;
${parameters.map(({ type, name }) => `uniform ${UNIFORM[type]} ${name};`).join("\n")}
uniform sampler2D burnishDirections;
uniform bool burnishPhong;
out vec4 burnishValue;
${renamed(shader)}${withPoints(shader)}
void main() {
  vec3 V = texelFetch(burnishDirections, ivec2(gl_FragCoord.x, 0), 0).xyz;
  vec3 N = vec3(0.0, 0.0, 1.0);
  burnishValue = vec4(BRDF(burnishPhong ? N : V, V, N, vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0)), 1.0);
}`;

/** Starts to compile and link a fragment shader that fills the picture: { program, shader }. */
export function startProgram(gl, fragment) {
  const program = gl.createProgram();
  const [, shader] = [[gl.VERTEX_SHADER, "#version 300 es\nvoid main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }"],
    [gl.FRAGMENT_SHADER, fragment]].map(([type, text]) => {
    const made = gl.createShader(type);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    gl.attachShader(program, made);
    return made;
  });
  gl.linkProgram(program);
  return { program, shader };
}

/** Makes evaluate(parameters, count, step, isPhong): luminances of the function at `count` angles, `step` radians apart. */
export function makeBrdf(brdf, file) {
  const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
  if (!gl?.getExtension("EXT_color_buffer_float")) {
    throw new Error(`${file}: .brdf files are run by WebGL 2, which this browser lacks`);
  }
  const { program, shader } = startProgram(gl, source(brdf));
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
    const [line] = (gl.getShaderInfoLog(shader) ?? "").split("\n");
    throw new Error(`${file}: its shader can't be compiled: ${line.replace(/^ERROR: \d+:\d+: /, "")}`);
  }
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error(`${file}: its shader can't be linked: is there a function vec3 BRDF(vec3 L, vec3 V, vec3 N, vec3 X, vec3 Y)?`);
  }
  gl.useProgram(program);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  const [values, directions] = [gl.createTexture(), gl.createTexture()];
  const fill = (texture, count, numbers) => {
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, count, 1, 0, gl.RGBA, gl.FLOAT, numbers);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  };
  const at = (name) => gl.getUniformLocation(program, name);
  return (parameters, count, step, isPhong) => {
    for (const { type, name, value } of parameters) {
      type === "color" ? gl.uniform3fv(at(name), value) : type === "bool" ? gl.uniform1i(at(name), value) : gl.uniform1f(at(name), value);
    }
    gl.uniform1i(at("burnishPhong"), Number(isPhong));
    fill(values, count, null);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, values, 0);
    fill(directions, count, Float32Array.from({ length: 4 * count }, (_, i) => [Math.sin((i >> 2) * step), 0, Math.cos((i >> 2) * step), 0][i & 3]));
    gl.viewport(0, 0, count, 1);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const pixels = new Float32Array(4 * count);
    gl.readPixels(0, 0, count, 1, gl.RGBA, gl.FLOAT, pixels);
    return Array.from({ length: count }, (_, i) => 0.2126 * pixels[4 * i] + 0.7152 * pixels[4 * i + 1] + 0.0722 * pixels[4 * i + 2]);
  };
}
