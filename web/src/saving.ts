// The shown state as a file for other programs: STL (binary, mm), glTF (one .glb, m, with the colours that are shown).

export interface Part {
  name: string;
  position: Float32Array;
  normal: Float32Array;
  triangles: Uint32Array;
  /** Red, green, blue from 0 to 1 of each vertex, as on the screen. */
  colour: Float32Array;
}

/** A binary STL of all parts, in mm. */
export function stl(parts: Part[], title: string): ArrayBuffer {
  const count = parts.reduce((sum, part) => sum + part.triangles.length / 3, 0);
  const file = new DataView(new ArrayBuffer(84 + 50 * count));
  for (let i = 0; i < Math.min(79, title.length); i++) file.setUint8(i, title.charCodeAt(i) & 127);
  file.setUint32(80, count, true);
  let at = 84;
  for (const { position, triangles } of parts) {
    for (let t = 0; t < triangles.length; t += 3) {
      const corners = [0, 1, 2].map((k) => 3 * triangles[t + k]!);
      const numbers = [...flat(position, corners), ...corners.flatMap((c) => [...position.subarray(c, c + 3)])];
      numbers.forEach((value, k) => file.setFloat32(at + 4 * k, value, true));
      at += 50;
    }
  }
  return file.buffer;
}

/** Unit normal of a triangle, whose corners begin at these places. */
function flat(p: Float32Array, corners: number[]): number[] {
  const [a, b, c] = corners as [number, number, number];
  const u = [0, 1, 2].map((k) => p[b + k]! - p[a + k]!), v = [0, 1, 2].map((k) => p[c + k]! - p[a + k]!);
  const n = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
  const length = Math.hypot(...n) || 1;
  return n.map((value) => value / length);
}

const FLOAT = 5126, UNSIGNED = 5125, ARRAY = 34962, ELEMENTS = 34963;

interface Written {
  bufferViews: object[];
  accessors: object[];
  chunks: Uint8Array[];
  size: number;
}

/** A glTF 2.0 scene in one .glb: a mesh for each part; metres, y up. */
export function glb(parts: Part[], title: string): ArrayBuffer {
  const written: Written = { bufferViews: [], accessors: [], chunks: [], size: 0 };
  const meshes = parts.map((part) => ({
    name: part.name,
    primitives: [{
      attributes: {
        POSITION: add(written, part.position.map((value) => value / 1000), "VEC3", true),
        NORMAL: add(written, part.normal, "VEC3"),
        COLOR_0: add(written, part.colour.map(linear), "VEC3"),
      },
      indices: add(written, part.triangles, "SCALAR"),
      material: 0,
    }],
  }));
  const content = {
    asset: { version: "2.0", generator: "myograph", extras: { title } },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [
      { name: "arm", rotation: [-Math.SQRT1_2, 0, 0, Math.SQRT1_2], children: parts.map((_, i) => i + 1) },
      ...parts.map((part, i) => ({ name: part.name, mesh: i })),
    ],
    meshes,
    materials: [{ name: "skin", pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0.6 }, doubleSided: true }],
    accessors: written.accessors,
    bufferViews: written.bufferViews,
    buffers: [{ byteLength: written.size }],
  };
  return packed(padded(new TextEncoder().encode(JSON.stringify(content)), 32), written);
}

/** glTF counts light, not what screens are told. */
function linear(value: number): number {
  return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

function add(written: Written, values: Float32Array | Uint32Array, type: "VEC3" | "SCALAR", bounded = false): number {
  const whole = values instanceof Uint32Array;
  const components = type === "VEC3" ? 3 : 1;
  const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
  written.bufferViews.push({
    buffer: 0, byteOffset: written.size, byteLength: bytes.length, target: whole ? ELEMENTS : ARRAY,
  });
  written.accessors.push({
    bufferView: written.bufferViews.length - 1, componentType: whole ? UNSIGNED : FLOAT,
    count: values.length / components, type, ...(bounded ? bounds(values as Float32Array) : {}),
  });
  written.chunks.push(bytes);
  written.size += bytes.length;
  return written.accessors.length - 1;
}

function bounds(values: Float32Array): { min: number[]; max: number[] } {
  const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
  values.forEach((value, i) => {
    min[i % 3] = Math.min(min[i % 3]!, value);
    max[i % 3] = Math.max(max[i % 3]!, value);
  });
  return { min, max };
}

function padded(bytes: Uint8Array, filler: number): Uint8Array {
  const whole = new Uint8Array(4 * Math.ceil(bytes.length / 4)).fill(filler);
  whole.set(bytes);
  return whole;
}

function packed(json: Uint8Array, written: Written): ArrayBuffer {
  const bytes = new Uint8Array(28 + json.length + written.size);
  const head = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, json.length, 0x4e4f534a].forEach((word, i) => head.setUint32(4 * i, word, true));
  bytes.set(json, 20);
  head.setUint32(20 + json.length, written.size, true);
  head.setUint32(24 + json.length, 0x004e4942, true);
  let at = 28 + json.length;
  for (const chunk of written.chunks) {
    bytes.set(chunk, at);
    at += chunk.length;
  }
  return bytes.buffer;
}

/** Hand a file to the browser's downloads. */
export function download(content: ArrayBuffer, name: string, kind: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type: kind }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
