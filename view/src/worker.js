// Worker of the playground: asks the module, one question after the other.

const module = fetch("motet.wasm").then((reply) => {
  if (!reply.ok) throw new Error(`motet.wasm: ${reply.status}`);
  return reply.arrayBuffer();
});
const instance = module.then((bytes) => WebAssembly.instantiate(bytes, {})).then(({ instance }) => instance.exports);

onmessage = async ({ data }) => {
  try {
    const bench = await instance;
    const bytes = new TextEncoder().encode(data.question);
    // The memory may move with each call.
    const place = bench.question(bytes.length);
    new Uint8Array(bench.memory.buffer, place, bytes.length).set(bytes);
    const length = bench.answer();
    const answer = new Uint8Array(bench.memory.buffer, bench.answer_address(), length);
    postMessage({ id: data.id, answer: JSON.parse(new TextDecoder().decode(answer)) });
  } catch (error) {
    postMessage({ id: data.id, answer: { error: String(error.message) }, broken: error instanceof WebAssembly.RuntimeError || error instanceof RangeError });
  }
};
