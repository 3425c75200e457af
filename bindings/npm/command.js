#!/usr/bin/env node
// npx burnish part.stl part.png --size=256: the program's flags and pixels, for a single picture.
import { closeSync, existsSync, openSync, readFileSync, readSync, renameSync, rmSync, statSync, writeFileSync } from "node:fs";
import { basename, extname, parse } from "node:path";
import { Worker, isMainThread } from "node:worker_threads";
import { companions, encodePng, findDecoder } from "./node.js";
import { BurnishError, load } from "./wasm.js";

// The command's own flags; the others are options of the module.
const OWN = {
  output: {}, "max-seconds": {}, json: { isOptional: true }, quiet: { isSwitch: true }, overwrite: { isSwitch: true },
  help: { isOptional: true }, version: { isSwitch: true },
};
const LETTERS = { o: "output", s: "size", q: "quiet", h: "help", V: "version" };
const EXIT = { ARGUMENT: 2, READ: 3, FORMAT: 4, LIMIT: 5, MEMORY: 6, WRITE: 7 };
const IMAGES = new Set([".png", ".jpg", ".jpeg", ".webp", ".gif", ".svg", ".pdf", ".exr", ".npy", ".bmp"]);
const HELP = `Usage: burnish INPUT [OUTPUT.png] [options]   draws a mesh into a PNG

  -o, --output=FILE   the PNG; - is standard output [INPUT's name]
  -s, --size=WxH      width and height in pixels; N: a square [1024x768]
  -q, --quiet         no warnings
      --json[=FILE]   a report on standard output, or in FILE
      --max-seconds=N time limit [none]
      --look=NAME, --color=COLOR, --views=NAME, --azimuth=DEG, --ground ...
                      the flags of burnish render for camera, light, surface and input
  -h, --help          this screen
  -V, --version       the version

This command runs in WebAssembly: one picture at a time, PNG only. The program burnish also has batches, contact sheets, turntables and other formats.
`;

const fail = (text, status = "ARGUMENT") => {
  throw new BurnishError(text, status);
};

/** { operands, options, settings } of the command line; options and settings have the names of flags. */
function parseArguments(words, findFlag) {
  const operands = [], options = {}, settings = {};
  for (let i = 0; i < words.length; ++i) {
    const word = words[i], short = /^-([a-zA-Z])(.*)$/s.exec(word), long = /^--([a-z][a-z-]*)(?:=(.*))?$/s.exec(word);
    if (word === "--") {
      operands.push(...words.slice(i + 1));
      break;
    }
    if (!short && !long) {
      operands.push(word);
      continue;
    }
    const name = short ? LETTERS[short[1]] ?? fail(`${word}: unknown flag; "burnish --help" lists the flags`) : long[1];
    const flag = OWN[name] ?? findFlag(name);
    let value = short ? short[2] || undefined : long[2];
    if (value !== undefined && OWN[name]?.isSwitch) {
      fail(`--${name}: takes no value; write --${name} alone`);
    }
    if (value === undefined && flag && !flag.isSwitch && !flag.isOptional && i + 1 < words.length && !words[i + 1].startsWith("--")) {
      value = words[++i];
    }
    value ??= OWN[name] && !flag.isSwitch && !flag.isOptional ? fail(`--${name}: a value is missing: --${name}=VALUE`) : true;
    const target = OWN[name] ? settings : options;
    target[name] = flag?.repeats ? [...(target[name] ?? []), value] : value;
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

/** Checks the names of the input and of the picture: { name, output }; name is the file's, undefined without one. */
function chooseNames(operands, settings) {
  const [input, second] = operands;
  if (operands.length === 0 || operands.length > 2 || (second !== undefined && !IMAGES.has(extname(second).toLowerCase()))) {
    fail(operands.length === 0 ? "no INPUT; try \"burnish :teapot\" or \"burnish --help\"" : `"${operands.at(-1)}": draw one INPUT at a time`);
  }
  const name = input === "-" || input[0] === ":" ? undefined : basename(input);
  const output = settings.output ?? second ?? (input === "-" ? "-" : `${input[0] === ":" ? input.slice(1) : parse(input).name}.png`);
  if (output !== "-" && extname(output).toLowerCase() !== ".png") {
    fail(`--output: "${output}": this command writes PNG; end the name in .png`);
  }
  if (settings.output === undefined && output !== "-" && !settings.overwrite && !isReplaceable(output)) {
    fail(`${output}: exists and was not written by burnish; replace it with --overwrite, or name the picture with --output=FILE`);
  }
  return { name, output };
}

/** Runs this file in another thread, which --max-seconds ends. */
function runLimited(words, limit) {
  const seconds = Number(limit) > 0 ? Number(limit) : fail(`--max-seconds: "${limit}" is not a number above 0`);
  const worker = new Worker(new URL(import.meta.url), { argv: words });
  const timer = setTimeout(() => {
    process.stderr.write(`burnish: not done after ${seconds} seconds (--max-seconds): raise the limit or simplify the input\n`);
    process.exit(EXIT.LIMIT);
  }, 1000 * seconds);
  worker.on("error", report);
  worker.on("exit", (code) => {
    clearTimeout(timer);
    process.exitCode ??= code;
  });
}

async function main(words) {
  const burnish = await load({ dashes: true });
  const findFlag = (name) => burnish.flags[name.replace(/-(.)/g, (_, letter) => letter.toUpperCase())];
  const { operands, options, settings } = parseArguments(words[0] === "render" ? words.slice(1) : words, findFlag);
  if (words.length === 0 || settings.help || settings.version) {
    process.stdout.write(settings.version ? `burnish ${burnish.version}\n` : HELP);
    return;
  }
  if (settings["max-seconds"] !== undefined && isMainThread) {
    runLimited(words, settings["max-seconds"]);
    return;
  }
  const [input] = operands, { name, output } = chooseNames(operands, settings);
  const bytes = input?.startsWith(":") ? input : readInput(input), { loading, drawing } = burnish.split(options);
  const mesh = await burnish.read(bytes, { ...loading, ...(name && { name }), files: name ? companions(input, bytes) : {}, decode: await findDecoder() });
  const picture = mesh.render(drawing);
  write(output, encodePng(picture));
  if (!settings.quiet) {
    picture.warnings.forEach((line) => process.stderr.write(`burnish: warning: ${line}\n`));
    if (process.stderr.isTTY && output !== "-") {
      process.stderr.write(`burnish: wrote ${output}, ${picture.width} x ${picture.height}\n`);
    }
  }
  if (settings.json) {
    const { pixels, ...facts } = picture;
    write(settings.json === true ? "-" : settings.json, `${JSON.stringify({ input, output, ...facts }, null, 2)}\n`);
  }
}

function report(error) {
  process.stderr.write(`burnish: ${error instanceof BurnishError ? error.message : error.stack}\n`);
  process.exitCode = EXIT[error.status] ?? 1;
}

main(process.argv.slice(2)).catch(report);
