import type { Bytes, Decode, Picture } from "./wasm.js";

/** A PNG file of a picture with three or four channels. */
export function encodePng(picture: Pick<Picture, "width" | "height" | "channels" | "pixels">): Bytes;

/** A decoder of textures with the optional packages pngjs and jpeg-js. */
export function findDecoder(): Promise<Decode>;

/** Files of the input's folder whose names the input, or a material library among them, contains: by relative name. */
export function companions(input: string, bytes: Uint8Array): Record<string, Bytes>;
