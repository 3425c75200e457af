// Dawn must accept WGSL files and reject a broken one. Usage: wgsl.mjs FOLDER_OF_NODE_MODULES FILE...
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [folder, ...files] = process.argv.slice(2);
const path = createRequire(folder + '/').resolve('webgpu');
const { create } = await import(pathToFileURL(path));
const gpu = create(['backend=null']); // kept: its collection would take the device along
const adapter = await gpu.requestAdapter();
const device = await adapter.requestDevice();
device.addEventListener?.('uncapturederror', (event) => event.preventDefault());

async function problems(code) {
    device.pushErrorScope('validation');
    const { messages } = await device.createShaderModule({ code }).getCompilationInfo();
    await device.popErrorScope();
    return messages.map((m) => `${m.lineNum}:${m.linePos}: ${m.message}`);
}

let failed = 0;
for (const file of files) {
    for (const problem of await problems(readFileSync(file, 'utf8'))) {
        console.log(`${file}:${problem}`);
        failed = 1;
    }
}
if ((await problems('fn f() -> f32 { return nothing; }')).length === 0) {
    console.log('a broken shader is not refused');
    failed = 1;
}
process.exit(failed);
