// The SDK's own client, over standard input and output. Usage: node client.mjs DATA, where both packages are installed
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";
import { load } from "burnish";
import pngjs from "pngjs";

const outside = mkdtempSync(join(tmpdir(), "burnish-mcp-")), folder = join(outside, "models");
cpSync(process.argv[2], folder, { recursive: true });
writeFileSync(join(outside, "secret.stl"), "solid\n");
symlinkSync(join(outside, "secret.stl"), join(folder, "link.stl"));
writeFileSync(join(folder, "broken.stl"), "solid\nfacet");
cpSync(join(folder, "wedge.stl"), join(folder, "..x.stl"));
writeFileSync(join(folder, "large.stl"), Buffer.alloc(3 << 20));

async function connect(...options) {
  const client = new Client({ name: "test", version: "1" });
  await client.connect(new StdioClientTransport({ command: process.execPath, args: ["node_modules/burnish-mcp/server.js", folder, ...options], stderr: "inherit" }));
  const call = async (name, args) => {
    const { content, isError } = await client.callTool({ name, arguments: args });
    const text = content.find(({ type }) => type === "text").text;
    const images = content.filter(({ type }) => type === "image").map(({ data }) => pngjs.PNG.sync.read(Buffer.from(data, "base64")));
    return { isError, images, text, ...(!isError && { json: JSON.parse(text) }) };
  };
  const fails = async (name, args, pattern) => {
    const { isError, text } = await call(name, args);
    assert.ok(isError, `${name} ${JSON.stringify(args)} succeeds`);
    assert.match(text, pattern);
  };
  return { client, call, fails };
}

const { client, call, fails } = await connect("--max-megabytes=2");
const { tools } = await client.listTools();
assert.deepEqual(tools.map(({ name }) => name), ["render", "info", "compare"]);

// render: the pixels of the package, several views, textures and libraries next to the file
const burnish = await load();
const { file, look, annotate } = tools[0].inputSchema.properties;
assert.deepEqual([look.enum, annotate.items.enum], [burnish.flags.look.words, burnish.flags.annotate.words]);
assert.ok(burnish.extensions.every((extension) => file.description.includes(extension)), file.description);
const drawn = await call("render", { file: ":teapot", width: 96, height: 64, look: "plain", azimuth: 30 });
const wanted = burnish.render(":teapot", { resolution: [96, 64], look: "plain", azimuth: 30, rgba: true });
assert.deepEqual(Buffer.from(drawn.images[0].data), Buffer.from(wanted.pixels));
assert.equal(drawn.json.triangles, wanted.triangles);
const views = await call("render", { file: "cube.obj", views: ["front", "top"], width: 32, height: 32, options: { up: "+Z", color: "red" } });
assert.deepEqual(views.images.map(({ width }) => width), [32, 32]);
assert.deepEqual([views.json.up, views.json.warnings], ["+Z", []]);
const words = await call("render", { file: "cube.obj", width: 64, height: 64, annotate: ["axes", "box"],
  options: { colorBy: "height", tessellation: 4, strict: false, noLibraries: true, edges: ["creases", "boundaries"], size: 300 } });
assert.deepEqual(Buffer.from(words.images[0].data), Buffer.from(burnish.render(readFileSync(join(folder, "cube.obj")), {
  name: "cube.obj", size: 64, annotate: "axes,box", edges: "creases,boundaries", colorBy: "height", noLibraries: true, rgba: true }).pixels));
assert.equal((await call("render", { file: ":sphere", width: 32, height: 16, annotate: [], options: { width: 999, resolution: "3,3" } })).images[0].width, 32);
assert.equal((await call("info", { file: "..x.stl" })).isError, undefined);
await fails("render", { file: "cube.obj", options: { colour: "red" } }, /^colour: unknown/);
await fails("render", { file: "broken.stl" }, /^broken\.stl:/);

// info: numbers of a cube
const { json } = await call("info", { file: "cube.obj" });
assert.deepEqual([json.closed, json.openEdges, json.shells], [true, 0, 1]);
assert.equal(json.volume, json.boundingBox.size.reduce((product, side) => product * side, 1));

// compare: the same, a difference, pictures
const same = await call("compare", { before: "cube.obj", after: join(folder, "cube.obj"), width: 32, height: 32 });
assert.deepEqual([same.json.same, same.json.psnr, same.images[0].width], [true, null, 96]);
for (const view of ["front", undefined]) {
  const { json } = await call("compare", { before: ":sphere", after: ":teapot", view, width: 160, height: 120 });
  const [left, top, right, bottom] = json.bounds;
  assert.ok(!json.same && json.silhouetteIou < 0.9 && json.differentPixels > 500, `${view}: ${JSON.stringify(json)}`);
  assert.ok(left > 0 && top > 0 && right < 160 && bottom < 120 && (right - left > 120 || bottom - top > 90), `${view}: both fill the picture: ${json.bounds}`);
}
writeFileSync(join(folder, "picture.png"), pngjs.PNG.sync.write(drawn.images[0]));
assert.equal((await call("compare", { before: "picture.png", after: "picture.png" })).json.same, true);
await fails("compare", { before: "picture.png", after: ":sphere" }, /two of the same kind/);

// pngjs would allocate the second header's 16 GB
const [png, header] = [pngjs.PNG.sync.write(drawn.images[0]), Buffer.alloc(8)];
header.writeUInt32BE(65536);
header.writeUInt32BE(65536, 4);
writeFileSync(join(folder, "two.png"), Buffer.concat([png.subarray(0, 33), png.subarray(8, 16), header, png.subarray(24)]));
await fails("compare", { before: "two.png", after: "two.png" }, /one header/);

// Files outside the folder, links to them, large files, long requests
await fails("info", { file: "../secret.stl" }, /not below/);
await fails("info", { file: ".." }, /not below/);
await fails("info", { file: join(outside, "secret.stl") }, /not below/);
await fails("render", { file: "link.stl" }, /not below/);
await fails("render", { file: "none.stl" }, /no such file/);
await fails("render", { file: "large.stl" }, /3145728 bytes; the limit is 2097152/);
await fails("render", { file: ":teapot", width: 4096 }, /width/);
await client.close();
const hasty = await connect("--max-seconds=0.001");
await hasty.fails("render", { file: ":teapot", width: 2048, height: 2048 }, /^takes longer than 0.001 s/);
await hasty.client.close();
rmSync(outside, { recursive: true });
console.log("mcp: all checks passed");
