// From the activations of all muscles and the load to x, the elbow's angle scaled into ±range: a few small networks.
//
// x = mean over the members of  c + w · tanh(B tanh(A y + a) + b),   y = (activations and load - centre) / scale

import { Blob64, type PackedAngle } from "./data";

export class AngleNetwork {
  private readonly layers: Record<"first" | "firstOffset" | "second" | "secondOffset" | "last" | "lastOffset", Float64Array>;

  constructor(private readonly told: PackedAngle, blob: Blob64) {
    this.layers = {
      first: blob.doubles(told.first),
      firstOffset: blob.doubles(told.first_offset),
      second: blob.doubles(told.second),
      secondOffset: blob.doubles(told.second_offset),
      last: blob.doubles(told.last),
      lastOffset: blob.doubles(told.last_offset),
    };
  }

  /** x within what the model lets its networks say, and its standard deviation. */
  x(activation: ArrayLike<number>, load: number): { x: number; deviation: number } {
    const { centre, scale, members, misfit, most_x } = this.told;
    const inputs = centre.map((middle, i) => ((i < activation.length ? activation[i]! : load) - middle) / scale[i]!);
    const each = Array.from({ length: members }, (_, member) => this.member(member, inputs));
    const mean = each.reduce((sum, value) => sum + value, 0) / members;
    const variance = each.reduce((sum, value) => sum + (value - mean) ** 2, 0) / members;
    return { x: Math.min(most_x, Math.max(-most_x, mean)), deviation: Math.sqrt(variance + misfit * misfit) };
  }

  /** The elbow's angle [rad] at x; null where the model does not know it. */
  angle(x: number): number | null {
    const { ends, range } = this.told;
    return ends && ends[0] + ((x + range) / (2 * range)) * (ends[1] - ends[0]);
  }

  private member(member: number, inputs: number[]): number {
    const { width } = this.told;
    const { first, firstOffset, second, secondOffset, last, lastOffset } = this.layers;
    const hidden = layer(inputs, first, firstOffset, { member, width });
    const again = layer(hidden, second, secondOffset, { member, width });
    return again.reduce((sum, value, i) => sum + value * last[member * width + i]!, lastOffset[member]!);
  }
}

function layer(
  inputs: ArrayLike<number>, weights: Float64Array, offsets: Float64Array, place: { member: number; width: number },
): Float64Array {
  const { member, width } = place;
  const outputs = offsets.slice(member * width, (member + 1) * width);
  const start = member * inputs.length * width;
  for (let i = 0; i < inputs.length; i++) {
    for (let k = 0; k < width; k++) outputs[k]! += inputs[i]! * weights[start + i * width + k]!;
  }
  return outputs.map(Math.tanh);
}
