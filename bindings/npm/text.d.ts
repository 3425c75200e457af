/** shaders/burnish.glsl or burnish.wgsl: functions to put before the shader's own. */
declare const source: string;
export default source;
