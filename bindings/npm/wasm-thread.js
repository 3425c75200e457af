// A thread of burnish/wasm: an instance of the module that shares the memory of the main instance.
onmessage = async ({ data: { module, memory, stack } }) => {
  const { exports } = await WebAssembly.instantiate(module, { env: { memory } });
  exports.__stack_pointer.value = stack;
  exports.thread_loop();
};
