#!/usr/bin/env node
// npx burnish part.stl part.png --size=256: the program's flags and pixels, for a single picture.
import { closeSync, existsSync, openSync, readFileSync, readSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, extname, parse } from "node:path";
import { companions, encodePng, findDecoder } from "./node.js";
import { BurnishError, render } from "./wasm.js";

// Flags of render without a value. Every other flag takes one, as --name=VALUE or --name VALUE.
const SWITCHES = new Set(["cull-back-faces", "no-background", "ground", "shadow", "wireframe", "strict", "no-textures", "no-libraries", "quiet", "json", "overwrite", "no-colors", "hidden-lines", "center-lines"]);
const OPTIONAL = new Set(["edges", "camera-orthographic"]); // --name or --name=VALUE
const SHORT = { o: "output", s: "size", q: "quiet" };
const EXIT = { ARGUMENT: 2, READ: 3, FORMAT: 4, LIMIT: 5, MEMORY: 6, WRITE: 7 };
const IMAGES = new Set([".png", ".jpg", ".jpeg", ".webp", ".gif", ".svg", ".pdf", ".exr", ".npy", ".bmp"]);
const HELP = `Usage: burnish INPUT [OUTPUT.png] [options]   draws a mesh into a PNG

  -o, --output=FILE   the PNG; - is standard output [INPUT's name]
  -s, --size=WxH      width and height in pixels; N: a square [1024x768]
  -q, --quiet         no warnings
      --json          a report on standard output
      --look=NAME, --color=COLOR, --views=NAME, --azimuth=DEG, --ground ...
                      the flags of burnish render for camera, light, surface and input

This command runs in WebAssembly: one picture at a time, PNG only. The program burnish also has batches, contact sheets, turntables and other formats.
`;

const fail = (text, status = "ARGUMENT") => {
  throw new BurnishError(text, status);
};
const camelCase = (name) => name.replace(/-(.)/g, (_, letter) => letter.toUpperCase());

/** { operands, options, settings } of the command line; options have the names of wasm.d.ts. */
function parseArguments(words) {
  const operands = [], options = {}, settings = {};
  for (let i = 0; i < words.length; ++i) {
    const word = words[i], short = /^-([a-z])(.*)$/.exec(word), long = /^--([a-z][a-z-]*)(?:=(.*))?$/s.exec(word);
    if (!short && !long) {
      operands.push(word);
      continue;
    }
    const name = short ? SHORT[short[1]] ?? fail(`${word}: unknown flag; "burnish --help" lists the flags`) : long[1];
    let value = short ? short[2] || undefined : long[2];
    if (SWITCHES.has(name)) {
      value = value === undefined ? true : fail(`--${name}: takes no value; write --${name} alone`);
    } else if (value === undefined && OPTIONAL.has(name)) {
      value = true;
    } else if (value === undefined) {
      value = words[++i] ?? fail(`--${name}: a value is missing: --${name}=VALUE`);
    }
    if (["output", "quiet", "json", "overwrite"].includes(name)) {
      settings[name] = value;
    } else if (name === "light" || name === "clip") {
      (options[name] ??= []).push(value);
    } else if (name === "size" && /[,x]/.test(value)) {
      options.resolution = value;
    } else {
      options[camelCase(name)] = value;
    }
  }
  return { operands, options, settings };
}

/** Whether a file does not exist or is a PNG of burnish, as the program checks it. */
function isReplaceable(path) {
  if (!existsSync(path)) {
    return true;
  }
  const head = Buffer.alloc(128), file = statSync(path).isFile() ? openSync(path) : -1;
  if (file >= 0) {
    readSync(file, head);
    closeSync(file);
  }
  return head.indexOf("\x89PNG", 0, "latin1") === 0 && head.includes("tEXtSoftware\0burnish");
}

function readInput(input) {
  try {
    return input === "-" ? readFileSync(0) : readFileSync(input);
  } catch (error) {
    return fail(`${input}: can't be opened: ${error.code === "ENOENT" ? "No such file or directory" : error.message}`, "READ");
  }
}

function write(output, bytes) {
  if (output === "-") {
    writeFileSync(1, bytes);
    return;
  }
  const temporary = `${output}.${process.pid}.tmp`;
  try {
    writeFileSync(temporary, bytes, { flag: "wx" });
    renameSync(temporary, output);
  } catch (error) {
    rmSync(temporary, { force: true });
    fail(`${output}: can't be written: ${error.message}`, "WRITE");
  }
}

async function main(words) {
  if (words.length === 0 || words.includes("--help") || words.includes("-h")) {
    process.stdout.write(HELP);
    return;
  }
  const { operands, options, settings } = parseArguments(words[0] === "render" ? words.slice(1) : words);
  const [input, second] = operands;
  if (operands.length === 0 || operands.length > 2 || (second !== undefined && !IMAGES.has(extname(second).toLowerCase()))) {
    fail(operands.length === 0 ? "no INPUT; try \"burnish :teapot\" or \"burnish --help\"" : `"${operands.at(-1)}": draw one INPUT at a time`);
  }
  const name = input === "-" || input[0] === ":" ? undefined : basename(input);
  const output = settings.output ?? second ?? (input === "-" ? "-" : `${input[0] === ":" ? input.slice(1) : parse(input).name}.png`);
  if (output !== "-" && extname(output).toLowerCase() !== ".png") {
    fail(`--output: "${output}": this command writes PNG; end the name in .png`);
  }
  if (String(options.views ?? "").includes(",")) {
    fail("--views: this command draws one view; the program burnish draws sheets");
  }
  if (settings.output === undefined && output !== "-" && !settings.overwrite && !isReplaceable(output)) {
    fail(`${output}: exists and was not written by burnish; replace it with --overwrite, or name the picture with --output=FILE`);
  }
  const bytes = name && readInput(input);
  const picture = await render(
    input[0] === ":" ? input : bytes ?? readInput(input),
    { resolution: "1024,768", ...options, ...(name && { name }), files: name ? companions(input, bytes) : {}, decode: await findDecoder() });
  write(output, encodePng(picture));
  if (!settings.quiet) {
    picture.warnings.forEach((line) => process.stderr.write(`burnish: warning: ${line}\n`));
    if (process.stderr.isTTY && output !== "-") {
      process.stderr.write(`burnish: wrote ${output}, ${picture.width} x ${picture.height}\n`);
    }
  }
  if (settings.json) {
    const { pixels, ...report } = picture;
    process.stdout.write(`${JSON.stringify({ input, output, ...report }, null, 2)}\n`);
  }
}

main(process.argv.slice(2)).catch((error) => {
  process.stderr.write(`burnish: ${error instanceof BurnishError ? error.message : error.stack}\n`);
  process.exitCode = EXIT[error.status] ?? 1;
});
