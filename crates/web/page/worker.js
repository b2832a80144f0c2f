// Runs in a Blob worker, after the glue of wasm-bindgen: one call at a time, the answer or the line of what is wrong.
"use strict";
let memory;
self.onmessage = ({ data }) => {
  const { id, call, args } = data;
  if (call === "begin") {
    memory = wasm_bindgen.initSync({ module: args[0] }).memory;
    for (const [name, bytes] of args[1]) wasm_bindgen.give_file(name, bytes);
    self.postMessage({ id, answer: wasm_bindgen.version() });
    return;
  }
  const began = performance.now();
  try {
    const answer = wasm_bindgen[call](...args);
    self.postMessage({ id, answer, took: performance.now() - began, memory: memory.buffer.byteLength });
  } catch (error) {
    // a string is the program's own line; all else ends the worker
    if (typeof error === "string") self.postMessage({ id, error });
    else self.postMessage({ id, crash: String(error) });
  }
};
