// Compares the lobes of burnish.wgsl, run by Dawn on a Vulkan driver, with burnish/lobe.h's operations in single precision.
// Usage: wgsl_values.mjs FOLDER_OF_NODE_MODULES BURNISH_WGSL LOBES_CSV
// VK_ICD_FILENAMES chooses the driver; Dawn rejects lavapipe and accepts SwiftShader.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [folder, shaders, csv] = process.argv.slice(2);
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

const code = readFileSync(shaders, 'utf8') + `
struct Case { cosine: f32, zeta: f32, order: f32, unused: f32 }
@group(0) @binding(0) var<storage, read> cases: array<Case>;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) at: vec3u) {
    if (at.x >= arrayLength(&values)) { return; }
    let one = cases[at.x];
    var value = burnishLobe2(one.cosine, one.zeta);
    if (one.order == 4.0) { value = burnishLobe4(one.cosine, one.zeta); }
    if (one.order == 8.0) { value = burnishLobe8(one.cosine, one.zeta); }
    if (one.order == 16.0) { value = burnishLobe16(one.cosine, one.zeta); }
    if (one.order == 32.0) { value = burnishLobe32(one.cosine, one.zeta); }
    values[at.x] = value;
}`;

const data = new Float32Array(cases.flatMap((one) => [one.cosine, one.zeta, one.order, 0]));
const size = 4 * cases.length;
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
pass.dispatchWorkgroups(Math.ceil(cases.length / 64));
pass.end();
encoder.copyBufferToBuffer(output, 0, result, 0, size);
device.queue.submit([encoder.finish()]);
await result.mapAsync(GPUMapMode.READ);
const values = new Float32Array(result.getMappedRange());

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
process.exit(others > 0 || cases.length < 2000 ? 1 : 0);
