// Compares the lobes of burnish.wgsl, run by Dawn on a Vulkan driver, with burnish/lobe.h's operations in single precision, and its area lights
// with integrals.
// Usage: wgsl_values.mjs FOLDER_OF_NODE_MODULES BURNISH_WGSL LOBES_CSV AREA_CSV
// VK_ICD_FILENAMES chooses the driver; Dawn rejects lavapipe and accepts SwiftShader.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [folder, shaders, csv, area] = process.argv.slice(2);
const { create, globals } = await import(pathToFileURL(createRequire(folder + '/').resolve('webgpu')));
Object.assign(globalThis, globals);
const gpu = create(['backend=vulkan']); // kept: its collection would take the device along
const adapter = await gpu.requestAdapter();
if (!adapter) {
    console.log('shaders: WGSL is not run: Dawn takes no driver that is here');
    process.exit(0);
}
const device = await adapter.requestDevice();

const cases = readFileSync(csv, 'utf8').split('\n').map((line) => line.split(','))
    .filter((fields) => fields[0] === 'family')
    .map(([, order, , , cosine, zeta]) => ({ order: +order, cosine: parse(cosine), zeta: Math.fround(+zeta) }));

// C's hexadecimal floats.
function parse(text) {
    const [, sign, whole, fraction, exponent] = /^(-?)0x(\d)\.?([0-9a-f]*)p([+-]?\d+)$/.exec(text) ?? [];
    return whole === undefined ? Math.fround(+text)
        : Math.fround((sign ? -1 : 1) * parseInt(whole + fraction, 16) * 2 ** (+exponent - 4 * fraction.length));
}

function lobe({ order, cosine, zeta }) {
    const lambda = Math.fround(1 - cosine);
    let u = Math.min(1, Math.max(0, Math.fround(1 - Math.fround(zeta * lambda))));
    for (; order > 1; order /= 2) {
        u = Math.fround(u * u);
    }
    return u;
}

// Runs a compute shader's main(number of the case) on `count` cases of `stride` floats; its values have `width` floats.
async function run(main, data, stride, width) {
    const count = data.length / stride;
    const code = readFileSync(shaders, 'utf8') + `
@group(0) @binding(0) var<storage, read> cases: array<f32>;
@group(0) @binding(1) var<storage, read_write> values: array<${width === 1 ? 'f32' : `vec${width}f`}>;
${main}
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
    if (at.x < arrayLength(&values)) { values[at.x] = valueOf(at.x * ${stride}); }
}`;
    const size = 4 * width * count;
    const input = device.createBuffer({ size: data.byteLength, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST });
    const output = device.createBuffer({ size, usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC });
    const result = device.createBuffer({ size, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
    device.queue.writeBuffer(input, 0, data);
    const pipeline = device.createComputePipeline({ layout: 'auto', compute: { module: device.createShaderModule({ code }) } });
    const bindings = [input, output].map((buffer, binding) => ({ binding, resource: { buffer } }));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: bindings }));
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(output, 0, result, 0, size);
    device.queue.submit([encoder.finish()]);
    await result.mapAsync(GPUMapMode.READ);
    return new Float32Array(result.getMappedRange());
}

const values = await run(`
fn valueOf(i: u32) -> f32 {
    let order = cases[i + 2];
    if (order == 2.0) { return burnishLobe2(cases[i], cases[i + 1]); }
    if (order == 4.0) { return burnishLobe4(cases[i], cases[i + 1]); }
    if (order == 8.0) { return burnishLobe8(cases[i], cases[i + 1]); }
    if (order == 16.0) { return burnishLobe16(cases[i], cases[i + 1]); }
    return burnishLobe32(cases[i], cases[i + 1]);
}`, new Float32Array(cases.flatMap((one) => [one.cosine, one.zeta, one.order])), 3, 1);

let flushed = 0;
let others = 0;
cases.forEach((one, i) => {
    const expected = lobe(one);
    if (values[i] === 0 && expected > 0 && expected < 2 ** -126) {
        ++flushed;
    } else if (values[i] !== expected && ++others < 10) {
        console.log(`order ${one.order}, zeta ${one.zeta}, cosine ${one.cosine}: ${values[i]}, expected ${expected}`);
    }
});
console.log(`vectors, WGSL by Dawn: ${cases.length} values, ${flushed} flushed to 0, ${others} others`);

// e^-x at x = -1 ... 15: the bounds of lobe.h, 1 at 0, and 0 from the end on.
const FALLOFFS = [[0.029374, 4.15566015], [0.005173, 5.97967911], [0.000137, 9.25124741]];
const xs = FALLOFFS.flatMap((_, kind) => Array.from({ length: 4096 }, (_, i) => [i / 256 - 1, kind]));
const falloffs = await run(`
fn valueOf(i: u32) -> f32 {
    if (cases[i + 1] == 0.0) { return burnishExpFalloff3(cases[i]); }
    if (cases[i + 1] == 1.0) { return burnishExpFalloff4(cases[i]); }
    return burnishExpFalloff5(cases[i]);
}`, new Float32Array(xs.flat()), 2, 1);
xs.forEach(([x, kind], i) => {
    const [most, end] = FALLOFFS[kind];
    const good = x <= 0 ? falloffs[i] === 1 : x >= end ? falloffs[i] === 0 : Math.abs(falloffs[i] - Math.exp(-x)) <= most;
    if (!good && ++others < 10) {
        console.log(`e^-${x}, ${kind + 3}: ${falloffs[i]}`);
    }
});

// Lines of area.csv: the shape, then numbers; the last two are expected.
const SHAPES = ['rect', 'disc', 'ggx'];
const MOST = [2e-5, 2.5e-3, 0.06]; // as in area.h
const lights = readFileSync(area, 'utf8').split('\n').slice(1).filter(Boolean)
    .map((line) => line.split(',').map((field, i) => (i === 0 ? SHAPES.indexOf(field) : Number(field))));
const light = await run(`
fn at(i: u32) -> vec3f { return vec3f(cases[i], cases[i + 1], cases[i + 2]); }
fn valueOf(i: u32) -> vec2f {
    let sides = i32(cases[i + 1]);
    let order = i32(cases[i + 2]);
    if (cases[i] == 2.0) { return burnishRectLightGgx(at(i + 4), at(i + 7), at(i + 10), sides, at(i + 13), at(i + 16), cases[i + 3]); }
    if (cases[i] == 1.0) { return burnishDiscLight(at(i + 4), at(i + 7), at(i + 10), sides, at(i + 13), at(i + 16), cases[i + 3], order); }
    return burnishRectLight(at(i + 4), at(i + 7), at(i + 10), sides, at(i + 13), at(i + 16), cases[i + 3], order);
}`, new Float32Array(lights.flat()), 21, 2);
const largest = [0, 0, 0];
lights.forEach(([shape, ...numbers], i) => {
    for (const k of [0, 1]) {
        const error = Math.abs(light[2 * i + k] - numbers[18 + k]);
        largest[shape] = Math.max(largest[shape], Number.isNaN(error) ? Infinity : error);
    }
});
console.log(`area lights, WGSL by Dawn: ${lights.length} values, errors ${SHAPES.map((name, i) => `${name} ${largest[i].toExponential(1)}`).join(', ')}`);
if (lights.length < 300 || largest.some((error, i) => error > MOST[i])) {
    ++others;
}
process.exit(others > 0 || cases.length < 300 ? 1 : 0);
