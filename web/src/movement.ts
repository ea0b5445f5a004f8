// A movement: activations over time, linear between its rows.

export interface Movement {
  name: string;
  times: number[];
  /** Of each row, of each muscle. */
  activation: Float32Array;
}

/** Activations at a time [s]; before and after the movement those of its ends. */
export function activationAt(movement: Movement, time: number): number[] {
  const { times, activation } = movement;
  const muscles = activation.length / times.length;
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= time) low = middle;
    else high = middle;
  }
  const share = Math.min(1, Math.max(0, (time - times[low]!) / (times[high]! - times[low]! || 1)));
  return Array.from({ length: muscles }, (_, m) =>
    (1 - share) * activation[low * muscles + m]! + share * activation[high * muscles + m]!);
}
