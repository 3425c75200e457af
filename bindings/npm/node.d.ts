import type { Bytes, Decode, Picture } from "./wasm.js";

/** A PNG file of a picture with three or four channels. */
export function encodePng(picture: Pick<Picture, "width" | "height" | "channels" | "pixels">): Bytes;

/** A decoder of textures with the optional packages pngjs and jpeg-js. */
export function findDecoder(): Promise<Decode>;

/** Width and height of a PNG file before it is decoded. A second header is an error, because pngjs would use its size. */
export function readPngSize(bytes: Uint8Array): [number, number];

/** Files of the input's folder whose names the input, or a material library among them, contains: by relative name. */
export function companions(input: string, bytes: Uint8Array): Record<string, Bytes>;
