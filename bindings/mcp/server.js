#!/usr/bin/env node
// burnish-mcp [FOLDER]: a Model Context Protocol server over stdio that draws, measures and compares the models below FOLDER.
import { readFileSync, realpathSync, statSync } from "node:fs";
import { isAbsolute, relative, resolve, sep } from "node:path";
import { parseArgs } from "node:util";
import { Worker } from "node:worker_threads";
import { McpServer } from "@modelcontextprotocol/sdk/server/mcp.js";
import { StdioServerTransport } from "@modelcontextprotocol/sdk/server/stdio.js";
import { load } from "burnish";
import { z } from "zod";

const HELP = `Usage: burnish-mcp [FOLDER] [options]   a Model Context Protocol server on standard input and output

  FOLDER              only files below it can be read [the current folder]
  --max-seconds=N     the longest time for one request [60]
  --max-megabytes=N   the largest file [256]
`;
const MOST_PIXELS = 2048; // of a side
const MOST_VIEWS = 8;

const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { help: { type: "boolean", short: "h" }, "max-seconds": { type: "string", default: "60" }, "max-megabytes": { type: "string", default: "256" } },
});
if (values.help || positionals.length > 1) {
  process.stdout.write(HELP);
  process.exit(values.help ? 0 : 2);
}
const root = realpathSync(positionals[0] ?? ".");
const limits = { seconds: Number(values["max-seconds"]), bytes: Number(values["max-megabytes"]) * 1048576 };
if (!(limits.seconds > 0) || !(limits.bytes > 0)) {
  process.stderr.write("burnish-mcp: --max-seconds and --max-megabytes are positive numbers\n");
  process.exit(2);
}

/** The real path of a file below the folder. */
function find(file) {
  if (/^:[a-z]+$/.test(file)) {
    return file; // a built-in object
  }
  let path;
  try {
    path = realpathSync(resolve(root, file));
  } catch (error) {
    throw new Error(`${file}: can't be opened: ${error.code === "ENOENT" ? "no such file" : error.code}`);
  }
  const inside = relative(root, path);
  if (inside === ".." || inside.startsWith(`..${sep}`) || isAbsolute(inside)) {
    throw new Error(`${file}: not below ${root}, the folder of this server`);
  }
  const { size } = statSync(path);
  if (size > limits.bytes) {
    throw new Error(`${file}: ${size} bytes; the limit is ${limits.bytes}`);
  }
  return path;
}

// One worker draws one request at a time. A request that takes too long ends it; the next one starts another.
let worker, queue = Promise.resolve();
const ask = (request) =>
  new Promise((settle, fail) => {
    worker ??= new Worker(new URL("./worker.js", import.meta.url));
    worker.unref(); // the server ends with its input
    const used = worker;
    const end = (use, value, isOver) => {
      clearTimeout(timer);
      used.removeAllListeners("message").removeAllListeners("error");
      if (isOver) {
        worker = undefined;
        used.terminate();
      }
      use(value);
    };
    const timer = setTimeout(() => end(fail, new Error(`takes longer than ${limits.seconds} s; draw a smaller picture or a simpler model`), true), 1000 * limits.seconds);
    used.once("message", ({ error, ...reply }) => end(error ? fail : settle, error ? new Error(error) : reply));
    used.once("error", (error) => end(fail, error, true));
    used.postMessage({ ...request, root, maxBytes: limits.bytes });
  });

/** Runs a request after those before it; its errors become the tool's. */
async function run(makeRequest) {
  try {
    const request = makeRequest(), reply = queue.then(() => ask(request));
    queue = reply.catch(() => {});
    const { text, images = [] } = await reply;
    return {
      content: [
        ...images.map((bytes) => ({ type: "image", data: Buffer.from(bytes).toString("base64"), mimeType: "image/png" })),
        { type: "text", text: JSON.stringify(text) },
      ],
    };
  } catch (error) {
    return { isError: true, content: [{ type: "text", text: error.message }] };
  }
}

const { extensions, flags } = await load();
const file = z.string().describe(`a model (${extensions.join(" ")}), relative to the server's folder; or :teapot, :sphere, :torus, :knot`);
const side = z.number().int().min(16).max(MOST_PIXELS).default(512);
const view = z.enum(flags.views.words.filter((word) => !word.endsWith("-angle"))); // these are sheets
const readOnly = { readOnlyHint: true, openWorldHint: false };

const { version } = JSON.parse(readFileSync(new URL("./package.json", import.meta.url)));
const server = new McpServer({ name: "burnish", version });
server.registerTool("render", {
  description: "Draws a 3-D model. Returns one PNG per view, and the size of the model, its triangles and warnings. Look at a model after changing it.",
  annotations: { title: "Draw a model", ...readOnly },
  inputSchema: {
    file,
    views: z.array(view).max(MOST_VIEWS).default([]).describe("standard views in parallel projection; without them one perspective from the front right"),
    width: side, height: side,
    azimuth: z.number().optional().describe("degrees that the camera turns to the right"),
    elevation: z.number().optional().describe("degrees that the camera rises"),
    zoom: z.number().positive().optional(),
    look: z.enum(flags.look.words).optional().describe("technical and drawing show edges"),
    annotate: z.array(z.enum(flags.annotate.words)).optional(),
    options: z.record(z.string(), z.union([z.string(), z.number(), z.boolean(), z.array(z.number()), z.array(z.string())])).optional()
      .describe('other flags of `burnish render` in camelCase, such as { "clip": "1,0,0,0", "color": "steelblue", "up": "+Z" }'),
  },
}, ({ file: input, ...rest }) => run(() => ({ tool: "render", input: find(input), ...rest })));
server.registerTool("info", {
  description: "Measures a 3-D model: bounding box, area, volume, centre of mass, whether it is closed, shells and defects such as open edges, as JSON.",
  annotations: { title: "Measure a model", ...readOnly },
  inputSchema: { file },
}, ({ file: input }) => run(() => ({ tool: "info", input: find(input) })));
server.registerTool("compare", {
  description: "Compares two models with one camera, or two PNG files of the same size. Returns numbers (PSNR, SSIM, FLIP, pixels that differ) and a PNG: before, after, difference.",
  annotations: { title: "Compare two models or pictures", ...readOnly },
  inputSchema: {
    before: file, after: file, view: view.optional(), width: side, height: side,
    tolerance: z.number().int().min(0).max(255).default(0).describe("largest accepted difference of a channel, of 255"),
  },
}, ({ before, after, ...rest }) => run(() => ({ tool: "compare", inputs: [find(before), find(after)], ...rest })));
await server.connect(new StdioServerTransport());
