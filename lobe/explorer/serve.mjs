// Serves a folder on this machine, with cross-origin isolation for threads; "plain": without it.
// Usage: node lobe/explorer/serve.mjs FOLDER [PORT] [plain]
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize, resolve } from "node:path";

const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml", ".wasm": "application/wasm" };
const ISOLATION = { "cross-origin-opener-policy": "same-origin", "cross-origin-embedder-policy": "require-corp" };
const [folder = "build/web", port = "8000", plain] = process.argv.slice(2);
const root = resolve(folder);

createServer(async (request, response) => {
  try {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname)); // throws for "/%"
    const file = join(root, path.endsWith("/") ? `${path}index.html` : path);
    const bytes = await readFile(file);
    response.writeHead(200, { "content-type": TYPES[extname(file)] ?? "application/octet-stream", ...(plain ? {} : ISOLATION) });
    response.end(bytes);
  } catch {
    response.writeHead(404).end();
  }
}).listen(Number(port), "127.0.0.1", () => console.log(`http://127.0.0.1:${port}/`));
