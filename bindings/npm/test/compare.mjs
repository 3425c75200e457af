// The installed package against the program: hashes of the golden pictures, and what each says of the fuzzer's seeds.
// Usage: node compare.mjs GOLDEN DATA PROGRAM SEEDS, in a folder where `burnish` is installed
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { load as loadLobes } from "burnish/lobe";
import { companions, encodePng, readPngSize } from "burnish/node";
import { hasSimd, load, render } from "burnish/wasm";
import { decodePng } from "./png.mjs";

const [golden, data, program, seeds] = process.argv.slice(2);
const ran = (...words) => spawnSync(program, words, { encoding: "utf8" });
let failures = 0;
let checks = 0;
function check(what, found, expected) {
  ++checks;
  if (found !== expected) {
    ++failures;
    console.log(`FAILED ${what}\n  found    ${found}\n  expected ${expected}`);
  }
}

const errorOf = (use) => {
  try {
    use();
    return "none";
  } catch (error) {
    return `${error.status} ${error.message}`;
  }
};

// "--camera-view-angle=30" to cameraViewAngle: "30"
function optionsOf(flags) {
  const options = {};
  for (const flag of flags) {
    const [name, value = true] = flag.slice(2).split(/=(.*)/s, 2);
    const key = name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());
    options[key] = key in options ? [...options[key], value] : value === true ? true : [value];
  }
  return options;
}

// Sheets are the program's.
const isSheet = (flags) => flags.some((flag) => /^--(views|lobe)=.*,/.test(flag) || flag === "--same-scale");

const files = Object.fromEntries(readdirSync(data).map((name) => [name, readFileSync(join(data, name))]));
const inputOf = (input) => (input.startsWith(":") ? input : files[input]);

check("SIMD", hasSimd(), true);
const instances = [await load(), await load({ simd: false })];
check("instances", instances.map((b) => b.simd).join(), "true,false");

// ---- Golden pictures ----

let drawn = 0;
for (const line of readFileSync(golden, "utf8").trim().split("\n")) {
  const [hash, input, ...flags] = line.split(" ");
  if (isSheet(flags)) {
    continue;
  }
  ++drawn;
  for (const burnish of instances) {
    const { loading, drawing } = burnish.split(optionsOf(flags));
    const mesh = await burnish.read(inputOf(input), { ...loading, name: input, files, decode: decodePng });
    const picture = mesh.render(drawing);
    mesh.close();
    check(`${input} ${flags.join(" ")} simd ${burnish.simd}`, picture.hash, hash);
    check(`${input}: pixels`, picture.pixels.length, picture.width * picture.height * picture.channels);
  }
}

// ---- Seeds: the same picture, or the same line ----

// What the fuzzer's seeds hold after the bytes that are its options, as files.
function unpackSeeds() {
  const names = [];
  for (const format of readdirSync(seeds)) {
    for (const seed of readdirSync(join(seeds, format)).filter((name) => !name.startsWith("draco"))) { // an importer's
      const name = `${seed}.${format}`;
      writeFileSync(name, readFileSync(join(seeds, format, seed)).subarray(3));
      names.push(name);
    }
  }
  return names;
}

function ask(name) {
  const run = ran("render", name, "--size=64", "--look=plain", "--no-textures", "--no-libraries", "--json", "-o", "/dev/null");
  const line = run.stderr.split("\n").find((text) => text && !text.includes(": warning: "));
  return run.status === 0 ? JSON.parse(run.stdout).hash : line;
}

const names = unpackSeeds();
for (const name of names) {
  const expected = ask(name);
  for (const burnish of instances) {
    let hash = "";
    const error = errorOf(() => ({ hash } = burnish.render(readFileSync(name), { name, size: 64, look: "plain", noTextures: true, noLibraries: true })));
    check(`${name} simd ${burnish.simd}`, hash || error.replace(/^[A-Z]+/, "burnish:"), expected);
  }
}

const [burnish] = instances;

// ---- A mesh drawn again and again ----

{
  const mesh = burnish.open(files["cube.obj"], { name: "cube.obj", files });
  const drawn = mesh.render({ size: 64 }), first = drawn.hash;
  for (const key of ["triangles", "vertices", "boundingBox", "up"]) {
    check(`mesh.${key}`, JSON.stringify(mesh[key]), JSON.stringify(drawn[key]));
  }
  mesh.render({ size: 100, color: "red", material: "metal", look: "clay" });
  check("options of one picture do not stay", mesh.render({ size: 64 }).hash, first);
  mesh.close();
  check("a fresh mesh", burnish.render(files["cube.obj"], { name: "cube.obj", files, size: 64 }).hash, first);
}

// ---- Facts and differences: the program's numbers ----

for (const name of ["wedge.stl", "cube.obj", ...names.filter((name) => /^cube.*\.(off|ply)$/.test(name))]) {
  const content = files[name] ?? readFileSync(name);
  writeFileSync(name, content);
  const info = JSON.parse(ran("info", name, "--json").stdout);
  const mesh = burnish.open(content, { name, files, measure: true });
  for (const [key, value] of Object.entries(mesh.facts)) {
    const wanted = info[{ centerOfMass: "center_of_mass" }[key] ?? key.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`)];
    check(`${name}: ${key}`, JSON.stringify(value), JSON.stringify(wanted));
  }
  mesh.close();
}
for (const name of names.filter((name) => /\.(3mf|gcode)$/.test(name))) {
  const run = ran("info", name, "--json"), wanted = run.status === 0 ? JSON.parse(run.stdout) : null;
  const mesh = wanted && burnish.open(readFileSync(name), { name });
  for (const kind of ["parts", "plates"]) {
    check(`${name}: ${kind}`, JSON.stringify(mesh?.[kind]), JSON.stringify(wanted?.[kind]));
  }
  check(`${name}: filaments`, JSON.stringify(mesh?.filaments.map(({ color }) => color)), JSON.stringify(wanted?.filaments));
  mesh?.close();
}
{
  const pictures = ["left", "iso"].map((views) => burnish.render(files["cube.obj"], { name: "cube.obj", files, size: 64, views }));
  pictures.forEach((picture, i) => writeFileSync(`${i}.png`, encodePng(picture)));
  const wanted = JSON.parse(ran("compare", "0.png", "1.png", "--tolerance=2", "--json").stdout);
  const found = burnish.compare(...pictures, { tolerance: 2 });
  for (const [key, name] of [["differentPixels", "different_pixels"], ["psnr", "psnr"], ["ssim", "ssim"], ["flip", "flip"], ["bounds", "different_bounds"], ["silhouetteIou", "silhouette_iou"], ["largest", "largest_difference"]]) {
    check(`compare: ${key}`, JSON.stringify(found[key]), JSON.stringify(wanted[name]));
  }
  check("equal pictures", burnish.compare(pictures[0], pictures[0]).psnr, Infinity);
}

// ---- Errors: the program's lines ----

// options without dashes
const lineOf = (...flags) => ran("render", ":sphere", ...flags, "-o", "/dev/null").stderr.replace(/--(?!help)(?=[a-z])/g, "");
for (const [options, flag] of [[{ samples: 3 }, "--samples=3"], [{ lobe: "enrgy" }, "--lobe=enrgy"], [{ size: 0 }, "--size=0"],
  [{ margn: 1 }, "--margn=1"], [{ light: ["spot:1,2,3"] }, "--light=spot:1,2,3"]]) {
  check(flag, `burnish: ${errorOf(() => burnish.render(":sphere", options)).replace(/^ARGUMENT /, "")}\n`, lineOf(flag));
}
check("a sheet", errorOf(() => burnish.render(":sphere", { views: ["front,top"] })),
  "ARGUMENT views: one picture at a time; give one of them");
check("loading", errorOf(() => burnish.open(":sphere").render({ clip: "1,0,0,0" })),
  "ARGUMENT clip: an option of loading; pass it to open()");
check("drawing", errorOf(() => burnish.open(":sphere", { size: 3 })), "ARGUMENT size: an option of drawing; pass it to the mesh's render()");
check("unknown to open()", errorOf(() => burnish.open(":sphere", { strickt: true })), "ARGUMENT strickt: unknown flag; did you mean strict?");
check("not switched off", errorOf(() => burnish.render(":sphere", { look: false })), "ARGUMENT look: it can't be switched off; omit it, or give NAME");
check("an object", errorOf(() => burnish.render(":sphere", { size: {} })).split(";")[0], "ARGUMENT size: an object is not a value");
check("a file's name", errorOf(() => burnish.render(new Uint8Array(9), { name: "--size" })).startsWith("FORMAT --size: "), true);

// ---- Options: lists, false, sizes ----

for (const [options, flags] of [
  [{ annotate: ["axes", "box"] }, ["--annotate=axes,box"]],
  [{ edges: ["creases", "boundaries"], "edge-width": 3 }, ["--edges=creases,boundaries", "--edge-width=3"]],
  [{ clip: [[1, 0, 0, 0.5], "0,1,0,0.5"] }, ["--clip=1,0,0,.5", "--clip=0,1,0,.5"]],
  [{ clip: new Float64Array([1, 0, 0, 0.5]) }, ["--clip=1,0,0,.5"]],
  [{ light: ["point:0,1,2", "directional:1,2,3"] }, ["--light=point:0,1,2", "--light=directional:1,2,3"]],
  [{ views: "front", cameraOrthographic: false }, ["--views=front", "--camera-orthographic=no"]],
  [{ look: "technical", edges: false }, ["--look=technical", "--edges=none"]],
  [{ look: "technical", edges: [] }, ["--look=technical", "--edges=none"]],
  [{ occlusion: false, annotate: false, clip: false, ground: false, color: null }, ["--occlusion=none"]],
  [{ background: false, light: false }, ["--no-background", "--light=none"]],
  [{ width: 64 }, ["--width=64"]],
  [{ size: [64, 48] }, ["--size=64x48"]],
]) {
  writeFileSync("cube.obj", files["cube.obj"]);
  writeFileSync("cube.mtl", files["cube.mtl"]);
  const wanted = JSON.parse(ran("render", "cube.obj", "--size=64", ...flags, "--json", "-o", "/dev/null").stdout);
  check(flags.join(" "), burnish.render(files["cube.obj"], { name: "cube.obj", files, size: 64, ...options }).hash, wanted.hash);
}

// ---- Types: the options of the module ----

const types = readFileSync("node_modules/burnish/options.d.ts", "utf8");
const typed = [...types.matchAll(/^  (\w+)\?: /gm)].map(([, key]) => key).sort();
check("typed options", typed.join(), Object.keys(burnish.flags).filter((key) => key !== "threads").sort().join()); // load() has them
check("no such object", errorOf(() => burnish.render(":cow")).split(" ")[0], "ARGUMENT");

// ---- Inputs that are not bytes ----

const wedge = files["wedge.stl"];
const typeErrorOf = (use) => errorOf(() => {
  try {
    use();
  } catch (error) {
    throw { status: error instanceof TypeError ? "TypeError" : error.status, message: error.message };
  }
});
for (const [input, found] of [["part.stl", 'the string "part.stl"; read the file first'], [7, "Number"], [[1, 2], "Array"], [{}, "Object"]]) {
  const kind = typeof input === "string" ? "expected bytes, found" : "expected bytes (an ArrayBuffer or a typed array), found";
  check(`input ${input}`, typeErrorOf(() => burnish.render(input)), `TypeError input: ${kind} ${found}`);
}
check("no input", typeErrorOf(() => burnish.render()), "TypeError input: expected bytes (an ArrayBuffer or a typed array), found undefined");
check("a file's content", typeErrorOf(() => burnish.render(wedge, { files: { "a.mtl": "newmtl" } })),
  'TypeError files["a.mtl"]: expected bytes, found the string "newmtl"; read the file first');
check("open(Blob)", typeErrorOf(() => burnish.open(new Blob([wedge]))),
  "TypeError input: expected bytes, found a Blob; use the asynchronous read() or render(), or await its arrayBuffer()");
check("render(undefined)", await render().then(() => "none", (error) => error instanceof TypeError), true);
{
  const { hash } = burnish.render(wedge, { name: "wedge.stl", size: 64 });
  const blob = new Blob([wedge]);
  check("render(Blob)", (await render(blob, { name: "wedge.stl", size: 64 })).hash, hash);
  check("render(File)", (await render(Object.assign(new Blob([wedge]), { name: "wedge.stl" }), { size: 64 })).hash, hash);
  const materials = Object.fromEntries(Object.entries(files).map(([name, bytes]) => [name, new Blob([bytes])]));
  check("Blobs of files", (await render(files["cube.obj"], { name: "cube.obj", files: materials, size: 64 })).hash,
    burnish.render(files["cube.obj"], { name: "cube.obj", files, size: 64 }).hash);
}

// ---- Entries of the package ----

check("the root", (await import("burnish")).render === render, true);
check("require()", (await createRequire(import.meta.url)("burnish").render(":sphere", { size: 16 })).hash, burnish.render(":sphere", { size: 16 }).hash);
{
  const older = createRequire(import.meta.url)(join(process.cwd(), "node_modules/burnish/require.cjs")); // Node before 20.19
  check("require.cjs", (await older.render(":sphere", { size: 16 })).hash, burnish.render(":sphere", { size: 16 }).hash);
  check("no dead links", /\]\(\.\./.test(readFileSync("node_modules/burnish/README.md", "utf8")), false);
}
for (const name of ["burnish", "burnish-simd", "burnish-threads"]) {
  check(name, createRequire(import.meta.url).resolve(`burnish/${name}.wasm`).endsWith(`${name}.wasm`), true);
}
// esbuild resolves literal names of modules, also Node's, and browsers have none of them.
check("literal imports", /import\((\s|\/\*.*?\*\/)*["'`]/.test(readFileSync("node_modules/burnish/wasm.js", "utf8")), false);

// ---- Four channels ----

for (const noBackground of [false, true]) {
  const [straight, four] = [false, true].map((rgba) => burnish.render(":sphere", { size: 40, noBackground, rgba }));
  const { channels, pixels } = straight;
  const expected = Uint8Array.from({ length: 4 * 40 * 40 }, (_, i) => (i % 4 < channels ? pixels[(i >> 2) * channels + (i % 4)] : 255));
  check(`four channels from ${channels}`, `${four.channels} ${four.hash} ${Buffer.from(four.pixels).equals(Buffer.from(expected))}`, `4 ${straight.hash} true`);
}
check("scalar kernels with SIMD", errorOf(() => burnish.render(":sphere", { isa: "scalar" })).split(" ")[0], "ARGUMENT");
burnish.startThreads(); // does nothing here

// ---- Lobes and theory ----

const lobes = await loadLobes();
for (const [words, exponent] of [["energy:2", 64], ["minimax:4", 100], ["schlick", 20], ["power", 33.5]]) {
  const cosines = Float32Array.from({ length: 101 }, (_, i) => i / 100);
  const [vectors, scalars] = instances.map((b) => b.lobeValues(words, exponent, cosines));
  check(`${words}: bits`, Buffer.from(vectors.buffer).equals(Buffer.from(scalars.buffer)), true);
  const exact = lobes.theoryValues(words, exponent, cosines.map((c) => Math.acos(c)));
  check(`${words}: theory`, vectors.every((value, i) => Math.abs(value - exact[i]) < 1e-5), true);
}
check("slope", lobes.theory("energy:2", 64).zeta, 65 / 3);
check("largest error", Math.abs(lobes.theory("power", 64).maximumError), 0);
check("no such lobe", errorOf(() => lobes.theory("enrgy", 64)).split(" ")[0], "ARGUMENT");
check("roughness", lobes.convert("exponentFromRoughness", 0.5), 30);
check("lobes", burnish.lobes.includes("minimax:8") && lobes.lobes.includes("minimax:8"), true);
check("extensions", burnish.extensions.join(" ").startsWith(".gltf .glb .obj"), true);

// ---- What `burnish lobe` prints ----

const printed = (...words) => ran("lobe", ...words);
const about = (text) => text.split("\n").map((line) => line.split(",").map((field) => (field === "" || isNaN(field) ? field : Number(field).toPrecision(6))).join()).join("\n");
for (const words of [["claims", "--format=text"], ["boundary", "--exponents=1-255", "--as=mem"], ["boundary", "--lobe=shift7", "--lambda"],
  ["choose", "--exponent=100", "--epsilon=0.02"]]) {
  check(`lobe ${words.join(" ")}`, lobes.lobe(words), printed(...words).stdout);
}
// libm is another: the last digits differ
for (const words of [["claims", "core-w", "--format=csv"], ["table", "--metrics=energy,angle:1,angle:8", "--exponents=1-1024x1.5", "--format=csv"]]) {
  check(`lobe ${words.join(" ")}`, about(lobes.lobe(words)), about(printed(...words).stdout));
}
for (const words of [["claims", "core"], ["table", "--lobes=enrgy"]]) {
  check(`lobe ${words.join(" ")}`, `burnish: ${errorOf(() => lobes.lobe(words)).replace(/^[A-Z]+ /, "")}\n`, printed(...words).stderr);
}
check("no help", errorOf(() => lobes.lobe(["help"])).split(" ")[0], "ARGUMENT");
check("no JSON", errorOf(() => lobes.lobe(["claims", "--format=json"])).split(" ")[0], "ARGUMENT");
check("no command", errorOf(() => lobes.lobe([])), "ARGUMENT no command");

// ---- The short way ----

const plain = await render(files["wedge.stl"], { name: "wedge.stl", size: 64 });
check("gzip", (await render(gzipSync(files["wedge.stl"]), { name: "wedge.stl.gz", size: 64, inputFormat: "stl" })).hash, plain.hash);
check("half a gzip", await render(gzipSync(files["wedge.stl"]).subarray(0, 40), { name: "w.gz" }).then(() => "none", (e) => e.status), "FORMAT");

const { warnings } = await render(files["textured.obj"], { name: "textured.obj", files, size: 32 });
{
  const [strict, lenient] = await Promise.all([true, false].map((strict) => render(files["textured.obj"], { name: "textured.obj", files, size: 32, strict, decode: decodePng })));
  check("strict with textures", strict.hash, lenient.hash);
  const line = await render(files["textured.obj"], { name: "textured.obj", files, size: 32, strict: true, decode: () => null }).catch(({ message }) => message);
  check("strict without them", /was skipped.*as loading is strict/.test(line), true);
}
for (const decode of [() => null, () => { throw new Error("no"); }, async () => { throw new Error("no"); }]) {
  check(`decoder ${decode}`, (await render(files["textured.obj"], { name: "textured.obj", files, size: 32, decode })).warnings.join(), warnings.join());
}
check("no decoder", warnings.some((line) => line.includes("images can't be decoded here")), true);

// ---- The command ----

const command = (...words) => spawnSync(process.execPath, [join("node_modules", "burnish", "command.js"), ...words], { encoding: "utf8" });
for (const words of [
  [":teapot", "command.png", "--size=48x32", "--azimuth", "30", "--ground"], [":knot", "-s", "40", "--no-background", "-o", "command.png"],
  [":knot", "command.png", "--width=60", "--edges", "--edge-width=3", "--light=point:0,1,2", "--light", "directional:1,2,3", "--background", "red"],
]) {
  const report = JSON.parse(command(...words, "--json").stdout);
  const program = JSON.parse(ran("render", ...words, "--json", "--overwrite").stdout);
  check(`command ${words.join(" ")}`, report.hash, program.hash);
  check(`command ${words.join(" ")}: reference`, ran("render", ...words.filter((word) => !/png|^-o$/.test(word)), "--reference=command.png", "-o", "other.png").status, 0);
}
mkdirSync("parts");
for (const name of ["cube.obj", "cube.mtl"]) {
  writeFileSync(join("parts", name), files[name]);
}
writeFileSync(join("parts", "other.mtl"), "newmtl red\nKd 1 1 1\n");
check("command with a material library", JSON.parse(command("parts/cube.obj", "cube.png", "-s", "40", "--json").stdout).hash,
  JSON.parse(ran("render", "parts/cube.obj", "cube.png", "-s", "40", "--json", "--overwrite").stdout).hash);
writeFileSync("foreign.png", "texture");
for (const [words, status, line] of [
  [[":teapot", "foreign.png"], 2, "burnish: foreign.png: exists and was not written by burnish; replace it with --overwrite, or name the picture with --output=FILE\n"],
  [[":teapot", "a.jpg"], 2, 'burnish: --output: "a.jpg": this command writes PNG; end the name in .png\n'],
  [["none.stl"], 3, "burnish: none.stl: can't be opened: No such file or directory\n"],
  [["-z"], 2, 'burnish: -z: unknown flag; "burnish --help" lists the flags\n'],
  [[":teapot", "a.png", "--edge-widht=3"], 2, "burnish: --edge-widht: unknown flag; did you mean --edge-width?\n"],
  [[":teapot", "a.png", "--azimuth"], 2, "burnish: --azimuth: a value is missing: --azimuth=DEG\n"],
  [[":teapot", "a.png", "--ground=yes"], 2, "burnish: --ground: takes no value; write --ground alone\n"],
  [[":teapot", "a.png", "--views=front,top"], 2, "burnish: --views: one picture at a time; give one of them\n"],
  [[":teapot", "a.png", "--output"], 2, "burnish: --output: a value is missing: --output=VALUE\n"],
  [[":teapot", "a.png", "--max-seconds=0"], 2, 'burnish: --max-seconds: "0" is not a number above 0\n'],
  [[":teapot", "a.png", "--max-seconds=1e-6", "--size=2000"], 5, "burnish: not done after 0.000001 seconds (--max-seconds): raise the limit or simplify the input\n"],
  [[":teapot", "a.png", "--max-seconds=1e6", "--look=nice"], 2, null],
  [[":teapot", "limited.png", "--max-seconds=1e6", "--size=16", "--json=limited.json"], 0, ""],
]) {
  const ended = command(...words);
  check(`command ${words.join(" ")}: exit code`, ended.status, status);
  check(`command ${words.join(" ")}: line`, line === null ? ended.stderr.split("\n").length === 2 : ended.stderr === line, true);
}

check("--json=FILE", JSON.parse(readFileSync("limited.json")).hash, burnish.render(":teapot", { size: 16 }).hash);
for (const word of ["--version", "-V"]) {
  check(word, command(word).stdout, `burnish ${burnish.version}\n`);
}
check("--help", command("--help").stdout.startsWith("Usage: burnish INPUT"), true);

// ---- Files that a mesh refers to ----

mkdirSync("companions/sub folder", { recursive: true });
const beside = ["a b.mtl", "sub folder/wood plank.png", "sub folder/Ü.png", "unused.png", "used.mtl.png", "mtl.txt"];
for (const name of beside) {
  writeFileSync(join("companions", name), name === "a b.mtl" ? "newmtl x\nmap_Kd -s 1 1 1 sub folder\\wood plank.png\n" : name);
}
for (const [input, text, wanted] of [
  ["a.obj", "mtllib a b.mtl\n", "a b.mtl,sub folder/wood plank.png"],
  ["a.gltf", '{"images": [{"uri": "sub%20folder/%C3%9C.png"}, {"uri": "../x/used.mtl.png"}]}', "sub folder/Ü.png,used.mtl.png"],
  ["a.ply", "ply\ncomment TextureFile Ü.png\n", "sub folder/Ü.png"],
  ["a.obj", `${"#".repeat(2 ** 24 - 9)} mtllib a b.mtl`, "a b.mtl,sub folder/wood plank.png"], // across two parts
  ["a.obj", "x.png ".repeat(300), ""],
  ["a.stl", "a b.mtl", ""],
]) {
  check(`companions of ${text.slice(-40)}`, Object.keys(companions(`companions/${input}`, Buffer.from(text))).sort().join(), wanted);
}

// ---- Headers of PNG files, by which pngjs allocates ----

const small = encodePng({ width: 2, height: 1, channels: 3, pixels: new Uint8Array(6) });
const two = Buffer.concat([small.subarray(0, 33), small.subarray(8, 33), small.subarray(33)]);
two.writeUInt32BE(1 << 20, 33 + 8);
check("a PNG's size", readPngSize(small).join(), "2,1");
for (const bytes of [two, small.subarray(0, 20), Buffer.from("\x89PNG"), Buffer.concat([small.subarray(0, 8), small.subarray(33)])]) {
  check("wrong headers", typeErrorOf(() => readPngSize(bytes)).startsWith("undefined "), true);
}

console.log(`npm: ${drawn} golden pictures, ${names.length} seeds, ${checks} checks, ${failures} failed`);
process.exit(failures > 0 ? 1 : 0);
