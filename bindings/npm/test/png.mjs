import { inflateSync } from "node:zlib";

/** A PNG of 8 bits per channel without a palette, as RGBA. */
export function decodePng(bytes) {
  const png = Buffer.from(bytes);
  const [width, height, channels] = [png.readUInt32BE(16), png.readUInt32BE(20), { 0: 1, 2: 3, 6: 4 }[png[25]]];
  const packed = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") {
      packed.push(png.subarray(at + 8, at + 8 + png.readUInt32BE(at)));
    }
  }
  const rows = inflateSync(Buffer.concat(packed));
  const stride = width * channels;
  const codes = new Uint8Array(stride * height);
  for (let y = 0; y < height; ++y) {
    const filter = rows[y * (stride + 1)];
    for (let x = 0; x < stride; ++x) {
      const left = x < channels ? 0 : codes[y * stride + x - channels];
      const up = y === 0 ? 0 : codes[(y - 1) * stride + x];
      const corner = x < channels || y === 0 ? 0 : codes[(y - 1) * stride + x - channels];
      const paeth = [left, up, corner].sort((a, b) => Math.abs(left + up - corner - a) - Math.abs(left + up - corner - b))[0];
      codes[y * stride + x] = rows[y * (stride + 1) + 1 + x] + [0, left, up, (left + up) >> 1, paeth][filter];
    }
  }
  const pixels = Uint8Array.from({ length: 4 * width * height }, (_, i) =>
    i % 4 === 3 ? (channels === 4 ? codes[i] : 255) : codes[(i >> 2) * channels + (channels === 1 ? 0 : i % 4)]);
  return { width, height, pixels };
}
