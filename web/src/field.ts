// One field at the nodes: mean + sum of modes, whose amounts are polynomials of the place (x, u) of the muscle.

import { combine, polynomials, slopes } from "./chebyshev";
import { Blob64, type PackedField } from "./data";

/** Where a muscle is on the surface of its shapes, with the standard deviations of both numbers. */
export interface Place {
  x: number;
  u: number;
  xDeviation: number;
  uDeviation: number;
}

export class Field {
  readonly components: number;
  readonly mean: Float32Array;
  readonly misfit: Float32Array;
  readonly factor: number | null;
  private readonly modes: Float32Array;
  private readonly weights: Float64Array;
  private readonly count: number;
  private readonly degrees: [number, number];

  constructor(told: PackedField, blob: Blob64) {
    this.components = told.components;
    this.degrees = told.degrees;
    this.factor = told.factor;
    this.count = told.modes.shape[0]!;
    this.mean = blob.floats(told.mean);
    this.modes = blob.floats(told.modes);
    this.weights = blob.doubles(told.weights);
    this.misfit = blob.floats(told.misfit);
  }

  /** Values at all nodes, into `into`. */
  values(place: Place, into: Float32Array): void {
    this.change(place, into);
    for (let i = 0; i < into.length; i++) into[i]! += this.mean[i]!;
  }

  /** Values at all nodes less the mean, into `into`. */
  change(place: Place, into: Float32Array): void {
    into.fill(0);
    const [m, n] = this.degrees;
    this.add(combine(polynomials(place.x, m), polynomials(place.u, n), this.weights, this.count), into);
  }

  /** What a standard deviation of x, and one of u, change: two fields, the second null where u is certain. */
  changes(place: Place, alongX: Float32Array, alongU: Float32Array): boolean {
    const [m, n] = this.degrees;
    const ofX = combine(slopes(place.x, m), polynomials(place.u, n), this.weights, this.count);
    this.add(ofX.map((slope) => slope * place.xDeviation), alongX.fill(0));
    if (!place.uDeviation) return false;
    const ofU = combine(polynomials(place.x, m), slopes(place.u, n), this.weights, this.count);
    this.add(ofU.map((slope) => slope * place.uDeviation), alongU.fill(0));
    return true;
  }

  /** Mode by mode, four at a time: the inner loop runs over memory in its order. */
  private add(amounts: Float64Array, into: Float32Array): void {
    const size = into.length;
    const modes = this.modes;
    let k = 0;
    for (; k + 3 < this.count; k += 4) {
      const a = amounts[k]!, b = amounts[k + 1]!, c = amounts[k + 2]!, d = amounts[k + 3]!;
      const second = (k + 1) * size, third = (k + 2) * size, fourth = (k + 3) * size;
      const first = k * size;
      for (let i = 0; i < size; i++) {
        into[i]! += a * modes[first + i]! + b * modes[second + i]! + c * modes[third + i]! + d * modes[fourth + i]!;
      }
    }
    for (; k < this.count; k++) {
      const a = amounts[k]!;
      for (let i = 0; i < size; i++) into[i]! += a * modes[k * size + i]!;
    }
  }
}

/** Von Mises stress of Cauchy stresses in the order xx yy zz yz xz xy. */
export function vonMises(stress: Float32Array, into: Float32Array): void {
  for (let i = 0, s = 0; i < into.length; i++, s += 6) {
    const xx = stress[s]!, yy = stress[s + 1]!, zz = stress[s + 2]!;
    const yz = stress[s + 3]!, xz = stress[s + 4]!, xy = stress[s + 5]!;
    const normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2;
    into[i] = Math.sqrt(normal / 2 + 3 * (yz * yz + xz * xz + xy * xy));
  }
}

const SMALLEST = 1e-6;

/** Squares of what a small change of the stress changes of von Mises stress, added to `into`. */
export function addVonMisesChange(stress: Float32Array, change: Float32Array, into: Float32Array): void {
  for (let i = 0, s = 0; i < into.length; i++, s += 6) {
    let product = 0, square = 0;
    for (let k = 0; k < 3; k++) {
      const next = (k + 1) % 3;
      const difference = stress[s + k]! - stress[s + next]!;
      product += (difference * (change[s + k]! - change[s + next]!)) / 2 + 3 * stress[s + 3 + k]! * change[s + 3 + k]!;
      square += (difference * difference) / 2 + 3 * stress[s + 3 + k]! ** 2;
    }
    into[i]! += (product / Math.max(Math.sqrt(square), SMALLEST)) ** 2;
  }
}
