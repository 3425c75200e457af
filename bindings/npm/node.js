// burnish/node: what a program in Node needs besides the renderer: PNG files, textures, files that a mesh refers to.
import { readFileSync, readdirSync, statSync } from "node:fs";
import { basename, dirname, extname, join, relative, sep } from "node:path";
import { deflateSync } from "node:zlib";

const MOST_PIXELS = 2 ** 27;

/** A PNG file of a picture with three or four channels. */
export function encodePng({ width, height, channels, pixels }) {
  const stride = width * channels, rows = Buffer.alloc(height * (stride + 1));
  for (let y = 0; y < height; ++y) {
    rows.set(pixels.subarray(y * stride, (y + 1) * stride), y * (stride + 1) + 1);
  }
  const crcTable = Int32Array.from({ length: 256 }, (_, n) => {
    for (let k = 0; k < 8; ++k) {
      n = n & 1 ? (n >>> 1) ^ 0xedb88320 : n >>> 1;
    }
    return n;
  });
  const chunk = (name, data) => {
    const bytes = Buffer.concat([Buffer.alloc(4), Buffer.from(name), data, Buffer.alloc(4)]);
    bytes.writeUInt32BE(data.length, 0);
    let crc = -1;
    for (const byte of bytes.subarray(4, -4)) {
      crc = crcTable[(crc ^ byte) & 255] ^ (crc >>> 8);
    }
    bytes.writeInt32BE(~crc, bytes.length - 4);
    return bytes;
  };
  const head = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, 8, channels === 4 ? 6 : 2, 0, 0, 0]);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  return Buffer.concat([
    Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk("IHDR", head), chunk("sRGB", Buffer.from([0])),
    chunk("tEXt", Buffer.from("Software\0burnish")), chunk("IDAT", deflateSync(rows, { level: 6 })), chunk("IEND", Buffer.alloc(0)),
  ]);
}

/** The width and height of a PNG file, which pngjs allocates before it decodes: from its only header, since the last one counts there. */
export function readPngSize(bytes) {
  const head = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), HEADER = 0x49484452;
  for (let at = 8, headers = 0; at + 8 <= bytes.length; at += 12 + head.getUint32(at)) {
    headers += head.getUint32(at + 4) === HEADER;
    if (headers !== 1) {
      throw new Error("a PNG file has one header, at its beginning");
    }
  }
  if (bytes.length < 24) {
    throw new Error("not a PNG file");
  }
  return [head.getUint32(16), head.getUint32(20)];
}

/** Decodes a texture with the optional packages pngjs and jpeg-js; null leaves it out. */
export async function findDecoder() {
  const optional = (name) => import(name).then((module) => module.default ?? module, () => null);
  const [png, jpeg] = await Promise.all([optional("pngjs"), optional("jpeg-js")]);
  return (bytes) => {
    const isPng = bytes[0] === 137, isJpeg = bytes[0] === 255;
    if (isPng && readPngSize(bytes).reduce((area, side) => area * side) > MOST_PIXELS) {
      throw new Error("more pixels than any texture needs");
    }
    const decoded = isPng && png ? png.PNG.sync.read(Buffer.from(bytes)) : isJpeg && jpeg ? jpeg.decode(bytes, { useTArray: true }) : null;
    if (!decoded) {
      throw new Error("no decoder for this texture; install pngjs and jpeg-js");
    }
    return { width: decoded.width, height: decoded.height, pixels: new Uint8Array(decoded.data.buffer, decoded.data.byteOffset, decoded.data.length) };
  };
}

const EXTENSIONS = "\\.(?:mtl|bin|png|jpe?g|webp|bmp|tga)";
const LONGEST = 3 * 255; // bytes of a name in percent-encoding
const PART = 1 << 24;
const MOST_NAMES = 1e6;

const decodePercents = (name) => {
  try {
    return decodeURIComponent(name);
  } catch {
    return name;
  }
};

/** What can be the names of files in a text, without folders: it ends in an extension, and begins after a slash, a quote or a blank. */
function* namesIn(text) {
  let left = MOST_NAMES;
  for (let at = 0; at < text.length; at += PART) {
    const part = text.toString("latin1", Math.max(at - LONGEST, 0), Math.min(at + PART, text.length));
    for (const { index, 0: extension } of part.matchAll(new RegExp(EXTENSIONS, "gi"))) {
      const end = index + extension.length, near = part.slice(Math.max(end - LONGEST, 0), end);
      const tail = near.slice(Math.max(...["/", "\\", '"', "\n", "\r"].map((mark) => near.lastIndexOf(mark))) + 1);
      for (const { index: from } of tail.matchAll(/^|(?<=[ \t])/g)) {
        if (--left < 0) {
          return;
        }
        const name = Buffer.from(tail.slice(from), "latin1").toString();
        yield name;
        yield decodePercents(name);
      }
    }
  }
}

/** Files of the input's folder whose names the input, or a material library among them, contains: by relative name. */
export function companions(input, bytes) {
  const files = {}, folder = dirname(input), found = new Map(), texts = [Buffer.from(bytes.buffer, bytes.byteOffset, bytes.byteLength)];
  if (![".obj", ".gltf", ".ply"].includes(extname(input).toLowerCase())) {
    return files;
  }
  const isNamed = new RegExp(`${EXTENSIONS}$`, "i");
  let count = 0;
  const visit = (place, depth) => {
    for (const entry of readdirSync(place, { withFileTypes: true })) {
      const path = join(place, entry.name);
      if (entry.isDirectory() && depth < 3) {
        visit(path, depth + 1);
      } else if (entry.isFile() && isNamed.test(entry.name) && ++count <= 10000) {
        found.set(entry.name, [...(found.get(entry.name) ?? []), path]);
      }
    }
  };
  visit(folder, 0);
  for (const text of texts) {
    for (const name of namesIn(text)) {
      for (const path of found.get(name) ?? []) {
        if (statSync(path).size < 1 << 28) {
          const content = readFileSync(path);
          files[relative(folder, path).split(sep).join("/")] = content;
          /\.mtl$/i.test(path) && texts.push(content); // libraries name textures
        }
      }
      found.delete(name);
    }
  }
  return files;
}
