// A network that is asked anywhere, beside the modes of its muscle: asked in a worker, which starts with the first
// question. Where its sensors are is what the modes say; its answers are positions of the muscle's nodes.

import { Blob64, type Packed, type PackedNetwork } from "../data";
import { Field, type Place } from "../field";
import { Asking } from "./asking";
import type { Answer, FromWorker, Inputs, ToWorker } from "./messages";

/** What a worker is here; tests have another. */
export interface Port {
  postMessage(message: ToWorker, owned?: Transferable[]): void;
  onmessage: ((event: MessageEvent<FromWorker>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** Makes the worker, and gives it the runtime: WebAssembly as gzip in base64. */
export interface Engine {
  port: () => Port;
  wasm: () => string;
}

/** What the network is asked about. */
export interface Question {
  activation: number[];
  load: number;
  /** Positions of the nodes as the modes say. */
  modes: Float32Array;
}

interface Asked {
  number: number;
  inputs: Inputs;
}

export class Network {
  /** Positions of the nodes [mm], and how far they are from those of the modes of the same state; null at first. */
  position: Float32Array | null = null;
  difference: Float32Array | null = null;
  /** Of the last answer, in the worker [ms]. */
  milliseconds: number | null = null;
  /** Why there is none, in words. */
  problem = "";
  /** Questions that reached the worker. */
  sent = 0;
  readonly nodes: Float32Array | null;
  readonly sensors: Float32Array;
  private readonly field: Field;
  private readonly low: Float32Array;
  private readonly high: Float32Array;
  private readonly still: Inputs;
  private readonly asking: Asking<Asked>;
  private readonly questions = new Map<number, Float32Array>();
  private port: Port | null = null;
  private asked = 0;

  constructor(readonly told: PackedNetwork, blob: Blob64, private readonly engine: Engine, private readonly heard: () => void) {
    this.nodes = told.nodes && blob.floats(told.nodes);
    this.field = new Field(told.sensors, blob);
    this.sensors = new Float32Array(this.field.mean.length);
    this.low = blob.floats(told.low);
    this.high = blob.floats(told.high);
    const given = (packed: Packed) => ({ data: blob.floats(packed), shape: [1, ...packed.shape] });
    this.still = Object.fromEntries(Object.entries(told.still).map(([name, packed]) => [name, given(packed)]));
    this.asking = new Asking((question) => {
      this.sent++;
      this.port!.postMessage({ kind: "ask", ...question });
    });
  }

  /** Whether it has answered the newest question. */
  get settled(): boolean {
    return this.asking.settled;
  }

  get started(): boolean {
    return this.port !== null;
  }

  /** Move the sensors: for their dots, and for the verdict. */
  move(place: Place): void {
    this.field.values(place, this.sensors);
  }

  /** Whether a sensor is where none was in training. */
  get outside(): boolean {
    return this.sensors.some((value, i) => value < this.low[i]! || value > this.high[i]!);
  }

  /** Ask about the place that the sensors were moved to; the answer is told by `heard`. The worker starts with the first question. */
  ask(question: Question): void {
    if (this.problem) return;
    if (!this.port) this.start();
    if (!this.port) return;
    const number = this.asked++;
    this.questions.set(number, Float32Array.from(question.modes));
    this.asking.ask({ number, inputs: this.inputs(question) });
  }

  private inputs(question: Question): Inputs {
    const { sensors } = this;
    const every: Inputs = {
      sensor_position_target: { data: Float32Array.from(sensors), shape: [1, sensors.length / 3, 3] },
      activation: { data: Float32Array.from(question.activation), shape: [1, question.activation.length] },
      hand_load: { data: Float32Array.of(question.load), shape: [1] },
    };
    return Object.fromEntries(Object.entries(every).filter(([name]) => this.told.inputs.includes(name)));
  }

  private start(): void {
    try {
      this.port = this.engine.port();
      this.port.onmessage = ({ data }) => this.hear(data);
      this.port.onerror = (event) => this.fail(event.message || "its worker cannot start");
      this.port.postMessage({ kind: "start", wasm: this.engine.wasm(), model: this.told.model, still: this.still });
    } catch (problem) {
      this.fail(problem instanceof Error ? problem.message : String(problem));
    }
  }

  private hear(told: FromWorker): void {
    if (told.kind === "failed") this.fail(told.reason);
    else {
      if (told.kind === "answer") this.take(told);
      this.asking.free();
      if (told.kind === "answer") this.heard();
    }
  }

  private take({ number, position, milliseconds }: Answer): void {
    const modes = this.questions.get(number)!;
    for (const older of this.questions.keys()) if (older <= number) this.questions.delete(older);
    this.position = position;
    this.milliseconds = milliseconds;
    this.difference = new Float32Array(position.length / 3);
    for (let i = 0; i < this.difference.length; i++) {
      const k = 3 * i;
      this.difference[i] = Math.hypot(position[k]! - modes[k]!, position[k + 1]! - modes[k + 1]!, position[k + 2]! - modes[k + 2]!);
    }
  }

  private fail(reason: string): void {
    this.problem = `The network cannot run in this browser (${reason}). The modes are shown.`;
    this.position = this.difference = this.milliseconds = null;
    this.heard();
  }
}
