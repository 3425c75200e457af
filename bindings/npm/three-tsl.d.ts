import type { MeshPhongNodeMaterial, Node } from "three/webgpu";
import type { Lobe } from "./three.js";

/** The slope of an exponent, a node. */
export function burnishZeta(exponent: Node | number, lobe?: Lobe): Node;

/** The replacement of pow(cosine, exponent), a node. */
export function burnishLobe(cosine: Node, exponent: Node | number, lobe?: Lobe): Node;

/** MeshPhongNodeMaterial with the lobe. */
export class BurnishPhongMaterial extends MeshPhongNodeMaterial {
  constructor(parameters?: object, lobe?: Lobe);
  lobe: Lobe;
}
