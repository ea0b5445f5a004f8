import { expect, test } from "vitest";
import { ENTRIES, lookupTable, written } from "../src/colours";
import { activationAt } from "../src/movement";
import { type Part, glb, stl } from "../src/saving";
import { Surface, normalsOf } from "../src/surface";
import { Packing, body } from "./page";

const triangle: Part = {
  name: "one", position: Float32Array.of(0, 0, 0, 2, 0, 0, 0, 2, 0), normal: Float32Array.of(0, 0, 1, 0, 0, 1, 0, 0, 1),
  triangles: Uint32Array.of(0, 1, 2), colour: Float32Array.of(0.5, 0, 0, 0, 1, 0, 0, 0, 1),
};

test("normals are of length one and turn outwards", () => {
  const position = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1);
  const into = new Float32Array(12);
  normalsOf(position, Uint32Array.of(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3), into);
  const third = 1 / Math.sqrt(3);
  expect(into[0]).toBeCloseTo(-third, 6);
  for (let i = 0; i < 12; i += 3) expect(Math.hypot(into[i]!, into[i + 1]!, into[i + 2]!)).toBeCloseTo(1, 6);
});

test("vertices between nodes are weighted sums", () => {
  const packing = new Packing();
  const told = {
    ...body(packing),
    between: { nodes: packing.integers([0, 2], [1, 2]), weights: packing.reals([0.25, 0.75], [1, 2]) },
  };
  const surface = new Surface(told, packing.blob());
  const into = new Float32Array(4);
  surface.carry(Float32Array.of(4, 5, 8), 1, into);
  expect(Array.from(into)).toEqual([4, 5, 8, 7]);
});

test("tables begin and end with the map's own colours", () => {
  const table = lookupTable("von_mises");
  expect(Array.from(table.slice(0, 4))).toEqual([0x44, 0x01, 0x54, 255]);
  expect(Array.from(table.slice(4 * (ENTRIES - 1)))).toEqual([0xfd, 0xe7, 0x25, 255]);
  expect(Array.from(lookupTable("error").slice(0, 3))).toEqual([0x00, 0x22, 0x4e]);
  const stretch = lookupTable("fibre_stretch");
  expect(stretch[2]).toBeGreaterThan(stretch[0]!);
  expect(Math.min(...stretch.slice(4 * 127, 4 * 127 + 3))).toBeGreaterThan(0xf0);
  expect(stretch[4 * 240]).toBeGreaterThan(2 * stretch[4 * 240 + 2]!);
});

test("numbers are written short", () => {
  expect([0, 0.05, 12.345, 1234, 0.00012, NaN].map(written)).toEqual(["0", "0.05", "12.3", "1.2e+3", "1.2e-4", "–"]);
});

test("a movement is linear between its rows and stays at its ends", () => {
  const movement = { name: "", times: [0, 1, 3], activation: Float32Array.of(0, 1, 1, 0, 0.5, 0) };
  expect(activationAt(movement, -1)).toEqual([0, 1]);
  expect(activationAt(movement, 0.25)).toEqual([0.25, 0.75]);
  expect(activationAt(movement, 2)).toEqual([0.75, 0]);
  expect(activationAt(movement, 9)).toEqual([0.5, 0]);
});

test("an STL has a header, a count and fifty bytes for each triangle", () => {
  const file = new DataView(stl([triangle, triangle], "arm"));
  expect(file.byteLength).toBe(84 + 100);
  expect(file.getUint32(80, true)).toBe(2);
  expect([0, 1, 2].map((k) => file.getFloat32(84 + 4 * k, true))).toEqual([0, 0, 1]);
  expect(file.getFloat32(84 + 24, true)).toBe(2);
  expect(file.getFloat32(84 + 50 + 24, true)).toBe(2);
});

test("a glTF file is whole: lengths, chunks, bounds in metres", () => {
  const file = glb([triangle], "arm");
  const head = new DataView(file);
  expect(head.getUint32(0, true)).toBe(0x46546c67);
  expect(head.getUint32(8, true)).toBe(file.byteLength);
  const size = head.getUint32(12, true);
  const content = JSON.parse(new TextDecoder().decode(new Uint8Array(file, 20, size)));
  expect(content.accessors[0].max[0]).toBeCloseTo(0.002, 6);
  expect(content.buffers[0].byteLength).toBe(head.getUint32(20 + size, true));
  expect(28 + size + content.buffers[0].byteLength).toBe(file.byteLength);
  expect(content.meshes[0].primitives[0].indices).toBe(3);
  const colour = content.bufferViews[content.accessors[2].bufferView].byteOffset;
  expect(head.getFloat32(28 + size + colour, true)).toBeCloseTo(0.2140, 3);
});
