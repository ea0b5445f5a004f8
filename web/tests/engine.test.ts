import { expect, test } from "vitest";
import { AngleNetwork } from "../src/angle";
import { combine, polynomials, slopes } from "../src/chebyshev";
import { Field, vonMises } from "../src/field";
import { Muscle } from "../src/muscle";
import { Packing, angle, body, linearField } from "./page";

test("polynomials are cosines of multiples of the angle", () => {
  const x = 0.37;
  polynomials(x, 8).forEach((value, k) => expect(value).toBeCloseTo(Math.cos(k * Math.acos(x)), 12));
  expect(polynomials(1.7, 3)).toEqual(polynomials(1, 3));
});

test("slopes are those of differences", () => {
  const x = -0.41, step = 1e-6;
  const low = polynomials(x - step, 9), high = polynomials(x + step, 9);
  slopes(x, 9).forEach((slope, k) => expect(slope).toBeCloseTo((high[k]! - low[k]!) / (2 * step), 6));
});

test("amounts run over products with the second factor fastest", () => {
  const sums = combine(Float64Array.of(1, 2), Float64Array.of(3, 5), Float64Array.of(1, 0, 0, 0, 0, 1, 0, 0), 2);
  expect(Array.from(sums)).toEqual([3, 6]);
});

test("the networks' answer is the mean of the members, their spread is part of its deviation", () => {
  const packing = new Packing();
  const told = angle(packing);
  const { x, deviation } = new AngleNetwork(told, packing.blob()).x([1, 0, 0, 0, 1], 0);
  const sum = 0.1 - 0.2 - 0.3 + 0.1 - 0.2;
  const each = [0, 0.1].map((offset) => Math.tanh(Math.tanh(sum + offset)) + 0.2);
  const mean = (each[0]! + each[1]!) / 2;
  expect(x).toBeCloseTo(mean, 12);
  expect(deviation).toBeCloseTo(Math.hypot((each[0]! - each[1]!) / 2, 0.01), 12);
});

test("x is held within what the model lets its networks say, and gives the elbow's angle", () => {
  const packing = new Packing();
  const network = new AngleNetwork({ ...angle(packing), most_x: 0.1 }, packing.blob());
  expect(network.x([0.5, 0.5, 0.5, 0.5, 0.5], 0).x).toBe(0.1);
  expect(network.angle(-0.9)).toBeCloseTo(0.5, 12);
  expect(network.angle(0.9)).toBeCloseTo(2, 12);
});

test("a field is its mean and its modes in their amounts", () => {
  const packing = new Packing();
  const told = linearField(packing, 3);
  const field = new Field(told, packing.blob());
  const values = new Float32Array(9);
  field.values({ x: 0.5, u: -0.4, xDeviation: 0, uDeviation: 0 }, values);
  values.forEach((value, i) => expect(value).toBeCloseTo(i + 0.5 * Math.sin(i + 1) - 0.2 * Math.sin(i + 10), 5));
});

test("compact numbers are whole numbers times the scale of their row", () => {
  const packing = new Packing();
  const told = packing.compact([1, -2, 3, 4], [2, 2], [0.5, 10]);
  expect(Array.from(packing.blob().floats(told))).toEqual([0.5, -1, 30, 40]);
});

test("von Mises stress of a pull is the pull, of a shear the shear times the root of three", () => {
  const into = new Float32Array(2);
  vonMises(Float32Array.of(3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2), into);
  expect(into[0]).toBeCloseTo(3, 6);
  expect(into[1]).toBeCloseTo(2 * Math.sqrt(3), 6);
});

test("the deviation of a position joins both uncertain numbers and the misfit, times the factor", () => {
  const packing = new Packing();
  const muscle = new Muscle(body(packing), packing.blob());
  const [x, u, ofX, ofU] = [0.5, -0.4, 0.02, 0.05];
  muscle.move({ x, u, xDeviation: ofX, uDeviation: ofU });
  const values = muscle.values("deviation", null)!;
  let square = 0.1 ** 2;
  for (let i = 0; i < 3; i++) {
    const first = Math.sin(i + 1), second = Math.sin(i + 10);
    square += ((first + u * second) * ofX) ** 2 + (x * second * ofU) ** 2;
  }
  expect(values[0]).toBeCloseTo(2 * Math.sqrt(square), 5);
});

test("the deviation of von Mises stress is that of small steps of x and u", () => {
  const packing = new Packing();
  const muscle = new Muscle(body(packing), packing.blob());
  const place = { x: 0.3, u: 0.2, xDeviation: 0.5, uDeviation: 0.8 };
  const stressAt = (dx: number, du: number) => {
    muscle.move({ ...place, x: place.x + dx, u: place.u + du });
    return Float32Array.from(muscle.values("von_mises", null)!);
  };
  const step = 1e-2;
  const alongX = stressAt(step, 0).map((value, i) => (value - stressAt(-step, 0)[i]!) / (2 * step));
  const alongU = stressAt(0, step).map((value, i) => (value - stressAt(0, -step)[i]!) / (2 * step));
  muscle.move(place);
  muscle.values("stress_deviation", null)!.forEach((value, i) => {
    const expected = 2 * Math.hypot(alongX[i]! * 0.5, alongU[i]! * 0.8, [0.1, 0.2, 0.3][i]!);
    expect(value).toBeCloseTo(expected, 2);
  });
});

test("without a truth there is no error, with one it is the distance", () => {
  const packing = new Packing();
  const told = body(packing);
  const position = packing.reals([3, 4, 0, 1, 0, 0, 0, 1, 0]);
  const muscle = new Muscle(told, packing.blob());
  const truth = { name: "", activation: [], hand_load: 0, elbow_angle_deg: null, bodies: [{ position, von_mises: null }] };
  expect(muscle.values("error", null)).toBeNull();
  expect(muscle.values("error", truth)![0]).toBeCloseTo(5, 6);
  expect(muscle.values("stress_error", truth)).toBeNull();
});
