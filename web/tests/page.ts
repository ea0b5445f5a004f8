// A small arm for tests: two modes of three nodes, one field of stress, a network of two members.

import { Blob64, type Packed, type PackedAngle, type PackedBody, type PackedField } from "../src/data";

/** Packs numbers as `myograph view` does. */
export class Packing {
  private readonly bytes: number[] = [];

  reals(values: number[], shape = [values.length]): Packed {
    return this.add(new Uint8Array(Float32Array.from(values).buffer), "f4", shape);
  }

  doubles(values: number[], shape = [values.length]): Packed {
    return this.add(new Uint8Array(Float64Array.from(values).buffer), "f8", shape);
  }

  compact(values: number[], shape: number[], scale: number[]): Packed {
    return { ...this.add(new Uint8Array(Int16Array.from(values).buffer), "i2", shape), scale };
  }

  integers(values: number[], shape = [values.length]): Packed {
    return this.add(new Uint8Array(Uint16Array.from(values).buffer), "u2", shape);
  }

  blob(): Blob64 {
    return new Blob64(btoa(String.fromCharCode(...this.bytes)));
  }

  private add(bytes: Uint8Array, type: Packed["type"], shape: number[]): Packed {
    const at = this.bytes.length;
    this.bytes.push(...bytes);
    while (this.bytes.length % 8) this.bytes.push(0);
    return { type, shape, at };
  }
}

/** A field of three nodes whose mode k is c_k = x (k = 0) or x u (k = 1). */
export function linearField(packing: Packing, components: number): PackedField {
  const size = 3 * components;
  return {
    components,
    degrees: [1, 1],
    mean: packing.reals(Array.from({ length: size }, (_, i) => i), [3, components]),
    modes: packing.reals(Array.from({ length: 2 * size }, (_, i) => Math.sin(i + 1)), [2, 3, components]),
    weights: packing.doubles([0, 0, 0, 0, 1, 0, 0, 1], [4, 2]),
    misfit: packing.reals([0.1, 0.2, 0.3]),
    factor: 2,
  };
}

export function body(packing: Packing): PackedBody {
  return {
    name: "biceps", colour: "#d55e00", own: 2, own_deviation: 0.05, nodes: packing.integers([4, 7, 9]), skin_nodes: 3,
    reference: packing.reals([0, 0, 0, 1, 0, 0, 0, 1, 0]), rest_change: packing.reals([0, 0, 0, 1, 0, 0, 0, 1, 0]), tendon: null,
    triangles: packing.integers([0, 1, 2]), between: null, sensors: [1],
    fields: { position: linearField(packing, 3), cauchy_stress: linearField(packing, 6) },
  };
}

export function angle(packing: Packing): PackedAngle {
  return {
    centre: [0.5, 0.5, 0.5, 0.5, 0.5, 0], scale: [0.5, 0.5, 0.5, 0.5, 0.5, 1], members: 2, width: 1,
    first: packing.doubles([0.1, 0.2, 0.3, -0.1, -0.2, 0, 0.1, 0.2, 0.3, -0.1, -0.2, 0]),
    first_offset: packing.doubles([0, 0.1]), second: packing.doubles([1, 1]), second_offset: packing.doubles([0, 0]),
    last: packing.doubles([1, 1]), last_offset: packing.doubles([0.2, 0.2]), misfit: 0.01, ends: [0.5, 2], most_x: 1, range: 0.9,
  };
}
