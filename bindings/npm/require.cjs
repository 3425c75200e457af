// For require() in versions of Node that can't load ES modules by it: the asynchronous functions. Newer ones load wasm.js itself.
for (const name of ["load", "render"]) {
  exports[name] = async (...given) => (await import("./wasm.js"))[name](...given);
}
