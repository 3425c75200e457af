// The difference of two pictures in colours from black to yellow.

const STOPS = [[0, 0, 4], [66, 10, 104], [147, 38, 103], [221, 81, 58], [252, 165, 10], [252, 255, 164]];

const TABLE = Uint32Array.from({ length: 256 }, (_, i) => {
  const at = (i / 255) * (STOPS.length - 1);
  const from = Math.min(Math.floor(at), STOPS.length - 2);
  const [r, g, b] = STOPS[from].map((c, k) => Math.round(c + (STOPS[from + 1][k] - c) * (at - from)));
  return 0xff000000 | (b << 16) | (g << 8) | r;
});

/** The largest difference of each pixel's channels, in 8-bit values; the colour scale ends at the picture's largest, at least 8. */
export function heat(a, b) {
  const count = a.width * a.height;
  const differences = new Uint8Array(count);
  let most = 0;
  let different = 0;
  for (let i = 0, at = 0; i < count; ++i, at += a.channels) {
    const d = Math.max(Math.abs(a.pixels[at] - b.pixels[at]), Math.abs(a.pixels[at + 1] - b.pixels[at + 1]),
      Math.abs(a.pixels[at + 2] - b.pixels[at + 2]));
    differences[i] = d;
    most = Math.max(most, d);
    different += d > 0;
  }
  const scale = 255 / Math.max(most, 8);
  const colors = Uint32Array.from(differences, (d) => TABLE[Math.round(d * scale)]);
  return { rgba: new Uint8ClampedArray(colors.buffer), most, share: different / count };
}
