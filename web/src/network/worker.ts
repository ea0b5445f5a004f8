// The network in a worker: onnxruntime-web on one thread, its WebAssembly given by the page, nothing fetched.

import { InferenceSession, Tensor, env } from "onnxruntime-web/wasm";
import type { Ask, FromWorker, Inputs, Start, ToWorker } from "./messages";

const scope = self as unknown as {
  onmessage: (event: { data: ToWorker }) => void;
  postMessage(message: FromWorker, owned?: Transferable[]): void;
};

let session: InferenceSession;
let still: Record<string, Tensor> = {};
let warm = false;

function bytes(base64: string): Uint8Array<ArrayBuffer> {
  const text = atob(base64);
  const array = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) array[i] = text.charCodeAt(i);
  return array;
}

async function unpacked(gzip: Uint8Array<ArrayBuffer>): Promise<ArrayBuffer> {
  return new Response(new Blob([gzip]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

function tensors(inputs: Inputs): Record<string, Tensor> {
  return Object.fromEntries(
    Object.entries(inputs).map(([name, { data, shape }]) => [name, new Tensor("float32", data, shape)]));
}

async function start(told: Start): Promise<void> {
  env.wasm.numThreads = 1;
  env.wasm.wasmBinary = await unpacked(bytes(told.wasm));
  session = await InferenceSession.create(bytes(told.model), { executionProviders: ["wasm"] });
  still = tensors(told.still);
  scope.postMessage({ kind: "ready" });
}

/** The first question is asked twice: what the browser compiles on the way is not the network's own time. */
async function answer({ number, inputs }: Ask): Promise<void> {
  const given = { ...still, ...tensors(inputs) };
  if (!warm) await session.run(given, ["position"]);
  warm = true;
  const started = performance.now();
  const found = await session.run(given, ["position"]);
  const position = Float32Array.from(found["position"]!.data as Float32Array);
  scope.postMessage({ kind: "answer", number, position, milliseconds: performance.now() - started }, [position.buffer]);
}

scope.onmessage = ({ data }) => {
  const done = data.kind === "start" ? start(data) : answer(data);
  done.catch((problem: unknown) =>
    scope.postMessage({ kind: "failed", reason: problem instanceof Error ? problem.message : String(problem) }));
};
