// The drawn surface of a muscle: its nodes, and vertices between them, which are weighted sums of nodes.

import { Blob64, type PackedBody } from "./data";

export class Surface {
  readonly triangles: Uint32Array;
  readonly vertices: number;
  private readonly skinNodes: number;
  private readonly parents: Uint32Array;
  private readonly weights: Float32Array;
  private readonly each: number;

  constructor(told: PackedBody, blob: Blob64) {
    this.skinNodes = told.skin_nodes;
    this.triangles = blob.integers(told.triangles);
    this.parents = told.between ? blob.integers(told.between.nodes) : new Uint32Array(0);
    this.weights = told.between ? blob.floats(told.between.weights) : new Float32Array(0);
    this.each = told.between ? told.between.nodes.shape[1]! : 1;
    this.vertices = this.skinNodes + this.parents.length / this.each;
  }

  /** Values at the nodes -> values at all vertices, into `into`. */
  carry(values: Float32Array, components: number, into: Float32Array): void {
    into.set(values.subarray(0, this.skinNodes * components));
    const each = this.each;
    for (let place = 0, out = this.skinNodes * components; place < this.parents.length; place += each) {
      for (let c = 0; c < components; c++) {
        let sum = 0;
        for (let k = 0; k < each; k++) sum += this.weights[place + k]! * values[this.parents[place + k]! * components + c]!;
        into[out++] = sum;
      }
    }
  }
}

/** Unit normals of an indexed surface: sums of the triangles' area normals. */
export function normalsOf(position: Float32Array, triangles: Uint32Array, into: Float32Array): void {
  into.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t]!, b = 3 * triangles[t + 1]!, c = 3 * triangles[t + 2]!;
    const ux = position[b]! - position[a]!, uy = position[b + 1]! - position[a + 1]!, uz = position[b + 2]! - position[a + 2]!;
    const vx = position[c]! - position[a]!, vy = position[c + 1]! - position[a + 1]!, vz = position[c + 2]! - position[a + 2]!;
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    into[a]! += x; into[a + 1]! += y; into[a + 2]! += z;
    into[b]! += x; into[b + 1]! += y; into[b + 2]! += z;
    into[c]! += x; into[c + 1]! += y; into[c + 2]! += z;
  }
  for (let i = 0; i < into.length; i += 3) {
    const length = Math.sqrt(into[i]! ** 2 + into[i + 1]! ** 2 + into[i + 2]! ** 2) || 1;
    into[i]! /= length; into[i + 1]! /= length; into[i + 2]! /= length;
  }
}
