/** Functions in GLSL or WGSL to put before the shader's own. */
declare const source: string;
export default source;
