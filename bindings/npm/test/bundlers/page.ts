// A page that shows a picture, as the README describes.
import { load, render, type Picture } from "burnish/wasm";
import { load as loadLobes } from "burnish/lobe";
import glsl from "burnish/glsl";

function show(picture: Picture): ImageData {
  return new ImageData(new Uint8ClampedArray(picture.pixels.buffer), picture.width, picture.height);
}

const picture = await render(":teapot", { size: 64, rgba: true, look: "plain" });
const canvas = document.body.appendChild(document.createElement("canvas"));
canvas.getContext("2d")!.putImageData(show(picture), 0, 0);
const burnish = await load();
const mesh = burnish.open(":teapot", { clip: [[1, 0, 0, 0]], up: "+Z" });
document.title = `${picture.hash} ${burnish.threads} ${glsl.length} ${(await loadLobes()).version}`;

// @ts-expect-error: an option that does not exist
await render(":teapot", { siz: 64 });

// Words are checked, in lists too.
mesh.render({ annotate: ["axes", "box"], edges: "creases,boundaries", views: "front", size: [64, 48], background: false, light: ["none"] });
// @ts-expect-error
mesh.render({ look: "nice" });
// @ts-expect-error
mesh.render({ annotate: ["axes", "bx"] });
// @ts-expect-error
mesh.render({ edges: "crease,boundaries" });
// @ts-expect-error
mesh.render({ clip: [1, 0, 0, 0] });
// @ts-expect-error
burnish.open(":teapot", { up: "Z" });
