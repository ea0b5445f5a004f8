// T_0 = 1, T_1 = x, T_{k+1} = 2 x T_k - T_{k-1}, and their slopes T'_k = k U_{k-1}. Beyond ±1 they are taken as there.

export function polynomials(x: number, degree: number): Float64Array {
  const at = Math.min(1, Math.max(-1, x));
  const values = new Float64Array(degree + 1);
  values[0] = 1;
  if (degree > 0) values[1] = at;
  for (let k = 2; k <= degree; k++) values[k] = 2 * at * values[k - 1]! - values[k - 2]!;
  return values;
}

export function slopes(x: number, degree: number): Float64Array {
  const at = Math.min(1, Math.max(-1, x));
  const values = new Float64Array(degree + 1);
  let before = 0; // U_{k-2}
  let second = 1; // U_{k-1}
  for (let k = 1; k <= degree; k++) {
    values[k] = k * second;
    [before, second] = [second, 2 * at * second - before];
  }
  return values;
}

/** Sum over the products of both, weighted: one number for each mode. `weights` is (terms, modes). */
export function combine(first: Float64Array, second: Float64Array, weights: Float64Array, modes: number): Float64Array {
  const sums = new Float64Array(modes);
  let row = 0;
  for (const a of first) {
    for (const b of second) {
      const product = a * b;
      for (let k = 0; k < modes; k++) sums[k]! += product * weights[row + k]!;
      row += modes;
    }
  }
  return sums;
}
