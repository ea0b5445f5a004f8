// The whole arm: activations and load in, every muscle's surface out, and how long that took.

import { AngleNetwork } from "./angle";
import { Blob64, type PackedTruth, type PageData } from "./data";
import { Muscle } from "./muscle";
import type { Network } from "./network/network";
import { Surface, normalsOf } from "./surface";

/** What is drawn of a muscle; the arrays stay the same, their numbers change. */
export interface Drawn {
  muscle: Muscle;
  surface: Surface;
  /** Positions of the nodes that are drawn: of the modes, or of the network. */
  shape: Float32Array;
  position: Float32Array;
  normal: Float32Array;
  value: Float32Array;
  known: boolean;
}

const ENOUGH = 1e-6;
/** The field that only a network makes. */
export const DIFFERENCE = "difference";

export class Arm {
  readonly drawn: Drawn[];
  readonly angle: AngleNetwork;
  activation: number[];
  load = 0;
  x = 0;
  field = "muscle";
  truth: PackedTruth | null = null;
  network: Network | null = null;
  /** Whether the network's muscle is drawn as the network says. */
  networkDrawn = false;
  /** Of the last prediction, with surfaces and normals [ms]. */
  milliseconds = 0;

  constructor(readonly data: PageData, blob: Blob64) {
    this.activation = data.muscles.map(() => 0);
    this.angle = new AngleNetwork(data.angle, blob);
    this.drawn = data.bodies.map((told, number) => {
      const muscle = new Muscle(told, blob);
      muscle.body = number;
      const surface = new Surface(told, blob);
      const array = (components: number) => new Float32Array(components * surface.vertices);
      return { muscle, surface, shape: muscle.position, position: array(3), normal: array(3), value: array(1), known: false };
    });
  }

  /** Move everything to these activations [0 to 1] and this load [N]. */
  predict(activation: ArrayLike<number>, load: number): void {
    const started = performance.now();
    this.activation = Array.from(activation);
    this.load = load;
    const { x, deviation } = this.angle.x(this.activation, load);
    this.x = x;
    for (const drawn of this.drawn) {
      const { muscle } = drawn;
      const u = this.data.angle.range * (2 * this.activation[muscle.told.own]! - 1);
      muscle.move({ x, u, xDeviation: deviation, uDeviation: muscle.told.own_deviation });
      this.form(drawn);
      this.paint(drawn);
    }
    this.milliseconds = performance.now() - started;
    this.askNetwork();
  }

  /** Draw the network's muscle as the network says, or as the modes do. */
  drawNetwork(on: boolean): void {
    this.networkDrawn = on;
    this.askNetwork();
    this.answered();
  }

  /** The network has said something new. */
  answered(): void {
    const drawn = this.network && this.drawn[this.network.told.body]!;
    if (!drawn) return;
    this.form(drawn);
    this.paint(drawn);
  }

  /** Whether what is shown needs the network. */
  get needsNetwork(): boolean {
    return this.network !== null && (this.networkDrawn || this.field === DIFFERENCE);
  }

  /** A field at the nodes of a body [its unit]; null where there is none. */
  values(drawn: Drawn, key: string): Float32Array | null {
    if (key === DIFFERENCE) return drawn === this.drawn[this.network?.told.body ?? -1] ? this.network!.difference : null;
    return drawn.muscle.values(key, this.truth);
  }

  /** Colour by another field; positions stay. */
  show(field: string, truth: PackedTruth | null): void {
    this.field = field;
    this.truth = truth;
    this.askNetwork();
    this.drawn.forEach((drawn) => this.paint(drawn));
  }

  /** The elbow's angle [degrees]; null where the model does not know it. */
  get angleDegrees(): number | null {
    const angle = this.angle.angle(this.x);
    return angle === null ? null : (angle * 180) / Math.PI;
  }

  /** What lies outside of what the model was trained on, in words; empty inside. */
  get outside(): string[] {
    const { low, high, load } = this.data.trained;
    const slack = ENOUGH * Math.max(1, Math.abs(load[0]), Math.abs(load[1]));
    const words = this.data.muscles.flatMap((name, i) => {
      const value = this.activation[i]!;
      const inside = value >= low[i]! - ENOUGH && value <= high[i]! + ENOUGH;
      return inside ? [] : [`${name} ${value.toFixed(2)} (trained ${low[i]!.toFixed(2)} to ${high[i]!.toFixed(2)})`];
    });
    if (this.load < load[0] - slack || this.load > load[1] + slack) {
      words.push(`load ${this.load.toFixed(1)} N (trained ${range(load)} N)`);
    }
    if (this.needsNetwork && this.network!.outside) words.push("sensors of the network");
    return words;
  }

  /** Where the sensors of the network are does not need the network. */
  private askNetwork(): void {
    const { network } = this;
    if (!network) return;
    const { muscle } = this.drawn[network.told.body]!;
    network.move(muscle.place);
    if (!this.needsNetwork) return;
    network.ask({ activation: this.activation, load: this.load, modes: muscle.position });
  }

  private form(drawn: Drawn): void {
    const { muscle, surface } = drawn;
    const answer = drawn === this.drawn[this.network?.told.body ?? -1] && this.networkDrawn ? this.network!.position : null;
    drawn.shape = answer ?? muscle.position;
    surface.carry(drawn.shape, 3, drawn.position);
    normalsOf(drawn.position, surface.triangles, drawn.normal);
  }

  private paint(drawn: Drawn): void {
    const values = this.field === "muscle" ? null : this.values(drawn, this.field);
    drawn.known = values !== null;
    if (values) drawn.surface.carry(values, 1, drawn.value);
  }
}

function range([low, high]: [number, number]): string {
  return low === high ? `at ${low.toFixed(1)}` : `${low.toFixed(1)} to ${high.toFixed(1)}`;
}
