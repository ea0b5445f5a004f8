// What the page and the network's worker say to each other.

/** Numbers of one input; the first axis is a batch of one. */
export interface Given {
  data: Float32Array;
  shape: number[];
}

export type Inputs = Record<string, Given>;

/** First: the runtime (WebAssembly, gzip, base64), the network (base64), and inputs that stay. */
export interface Start {
  kind: "start";
  wasm: string;
  model: string;
  still: Inputs;
}

export interface Ask {
  kind: "ask";
  number: number;
  inputs: Inputs;
}

export type ToWorker = Start | Ask;

export interface Answer {
  kind: "answer";
  number: number;
  position: Float32Array;
  milliseconds: number;
}

export interface Failed {
  kind: "failed";
  reason: string;
}

export type FromWorker = { kind: "ready" } | Answer | Failed;
