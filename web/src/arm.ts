// The whole arm: activations and load in, every muscle's surface out, and how long that took.

import { AngleNetwork } from "./angle";
import { Blob64, type PackedTruth, type PageData } from "./data";
import { Muscle } from "./muscle";
import { Surface, normalsOf } from "./surface";

/** What is drawn of a muscle; the arrays stay the same, their numbers change. */
export interface Drawn {
  muscle: Muscle;
  surface: Surface;
  position: Float32Array;
  normal: Float32Array;
  value: Float32Array;
  known: boolean;
}

const ENOUGH = 1e-6;

export class Arm {
  readonly drawn: Drawn[];
  readonly angle: AngleNetwork;
  activation: number[];
  load = 0;
  x = 0;
  field = "muscle";
  truth: PackedTruth | null = null;
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
      return { muscle, surface, position: array(3), normal: array(3), value: array(1), known: false };
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
      const { muscle, surface } = drawn;
      const u = this.data.angle.range * (2 * this.activation[muscle.told.own]! - 1);
      muscle.move({ x, u, xDeviation: deviation, uDeviation: muscle.told.own_deviation });
      surface.carry(muscle.position, 3, drawn.position);
      normalsOf(drawn.position, surface.triangles, drawn.normal);
      this.paint(drawn);
    }
    this.milliseconds = performance.now() - started;
  }

  /** Colour by another field; positions stay. */
  show(field: string, truth: PackedTruth | null): void {
    this.field = field;
    this.truth = truth;
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
    return words;
  }

  private paint(drawn: Drawn): void {
    const values = this.field === "muscle" ? null : drawn.muscle.values(this.field, this.truth);
    drawn.known = values !== null;
    if (values) drawn.surface.carry(values, 1, drawn.value);
  }
}

function range([low, high]: [number, number]): string {
  return low === high ? `at ${low.toFixed(1)}` : `${low.toFixed(1)} to ${high.toFixed(1)}`;
}
