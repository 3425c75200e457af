// A page that shows a picture, as the README describes.
import { load, render, type Picture } from "burnish/wasm";
import glsl from "burnish/glsl";

function show(picture: Picture): ImageData {
  return new ImageData(new Uint8ClampedArray(picture.pixels.buffer), picture.width, picture.height);
}

const picture = await render(":teapot", { size: 64, rgba: true, look: "plain" });
const canvas = document.body.appendChild(document.createElement("canvas"));
canvas.getContext("2d")!.putImageData(show(picture), 0, 0);
const burnish = await load();
document.title = `${picture.hash} ${burnish.threads} ${glsl.length}`;

// @ts-expect-error: an option that does not exist
await render(":teapot", { siz: 64 });
