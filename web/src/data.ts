// What `myograph view` puts into the page: a description in JSON, and one blob of numbers that it points into.

export type NumberType = "f4" | "f8" | "i2" | "u2" | "u4";

/** Where an array lies in the blob; `scale` turns the integers of each row (first axis) into numbers. */
export interface Packed {
  type: NumberType;
  shape: number[];
  at: number;
  scale?: number[];
}

export interface PackedField {
  components: number;
  degrees: [number, number];
  mean: Packed;
  modes: Packed;
  weights: Packed;
  misfit: Packed;
  /** Times the deviation: half the width of the interval of 90 %; null where the model is not calibrated. */
  factor: number | null;
}

export interface PackedAngle {
  centre: number[];
  scale: number[];
  members: number;
  width: number;
  first: Packed;
  first_offset: Packed;
  second: Packed;
  second_offset: Packed;
  last: Packed;
  last_offset: Packed;
  misfit: number;
  /** Elbow angles [rad] at x = -range and x = range; null where the model does not know them. */
  ends: [number, number] | null;
  most_x: number;
  range: number;
}

export interface PackedBody {
  name: string;
  colour: string;
  own: number;
  own_deviation: number;
  /** Numbers of the nodes in the whole body; the last ones may be sensors below the skin. */
  nodes: Packed;
  skin_nodes: number;
  reference: Packed;
  /** Position of the relaxed arm less the field's mean: small numbers keep their digits. */
  rest_change: Packed;
  tendon: Packed | null;
  triangles: Packed;
  /** Vertices between the nodes: of each, some nodes and their weights. */
  between: { nodes: Packed; weights: Packed } | null;
  sensors: number[];
  fields: Record<string, PackedField>;
}

export interface PackedBone {
  name: string;
  colour: string;
  points: Packed;
  triangles: Packed;
  moves: boolean;
}

export interface FieldChoice {
  key: string;
  label: string;
  unit: string;
  low: number;
  high: number;
  meaning: string;
}

export interface PackedTruth {
  name: string;
  activation: number[];
  hand_load: number;
  elbow_angle_deg: number | null;
  /** Of each body: positions and, where the dataset has it, von Mises stress; null where it has no such muscle. */
  bodies: ({ position: Packed; von_mises: Packed | null } | null)[];
}

/** A network that is asked at the nodes of one body; see `network/network.ts`. */
export interface PackedNetwork {
  name: string;
  muscle: string;
  body: number;
  inputs: string[];
  /** The network, base64. */
  model: string;
  /** Inputs that stay the same. */
  still: Record<string, Packed>;
  /** Positions of its sensors, as a field of the muscle's place. */
  sensors: PackedField;
  /** Where each sensor was in training [mm]. */
  low: Packed;
  high: Packed;
  /** Nodes of a graph element network, in the space of the relaxed arm; null for another kind. */
  nodes: Packed | null;
}

/** How long a solver takes for one state. */
export interface SolveTime {
  seconds: number;
  what: string;
  told: string;
}

export interface PageData {
  schema: number;
  title: string;
  muscles: string[];
  colours: string[];
  bodies: PackedBody[];
  bones: PackedBone[];
  hinge: { point: number[]; forward: number[]; up: number[]; axis: number[]; reference_angle: number } | null;
  angle: PackedAngle;
  trained: { low: number[]; high: number[]; load: [number, number] };
  most_load: number;
  fields: FieldChoice[];
  presets: { name: string; activation: number[]; hand_load: number }[];
  truth: PackedTruth[];
  movement: { name: string; times: number[]; activation: Packed } | null;
  network: PackedNetwork | null;
  solve: SolveTime | null;
  about: Record<string, string>;
  notes: string[];
}

export const SCHEMA = 1;

/** The arrays of the page, out of one blob. */
export class Blob64 {
  private readonly buffer: ArrayBuffer;

  constructor(text: string) {
    const bytes = atob(text);
    const array = new Uint8Array(bytes.length);
    for (let i = 0; i < bytes.length; i++) array[i] = bytes.charCodeAt(i);
    this.buffer = array.buffer;
  }

  /** Numbers in single precision. */
  floats(packed: Packed): Float32Array {
    if (packed.type === "f4") return new Float32Array(this.buffer, packed.at, length(packed));
    return Float32Array.from(this.doubles(packed));
  }

  /** Numbers in double precision. */
  doubles(packed: Packed): Float64Array {
    const count = length(packed);
    if (packed.type === "f8") return new Float64Array(this.buffer, packed.at, count);
    if (packed.type === "f4") return Float64Array.from(new Float32Array(this.buffer, packed.at, count));
    if (packed.type !== "i2" || !packed.scale) throw new Error(`expected real numbers, got the type ${packed.type}`);
    const rows = packed.shape[0]!;
    const each = count / rows;
    const whole = new Int16Array(this.buffer, packed.at, count);
    const values = new Float64Array(count);
    for (let i = 0; i < count; i++) values[i] = whole[i]! * packed.scale[Math.floor(i / each)]!;
    return values;
  }

  /** Whole numbers. */
  integers(packed: Packed): Uint32Array {
    const count = length(packed);
    if (packed.type === "u4") return new Uint32Array(this.buffer, packed.at, count);
    if (packed.type === "u2") return Uint32Array.from(new Uint16Array(this.buffer, packed.at, count));
    throw new Error(`expected whole numbers, got the type ${packed.type}`);
  }
}

function length(packed: Packed): number {
  return packed.shape.reduce((product, size) => product * size, 1);
}

/** The page's own data; throws an error for people where there is none or it is of another version. */
export function readPage(page: Document): { data: PageData; blob: Blob64 } {
  const text = page.getElementById("myograph-data")?.textContent?.trim() ?? "";
  const numbers = page.getElementById("myograph-numbers")?.textContent?.trim() ?? "";
  if (!text.startsWith("{")) {
    throw new Error("This page has no arm in it. Make one with: myograph view --out page.html");
  }
  const data = JSON.parse(text) as PageData;
  if (data.schema !== SCHEMA) {
    throw new Error(`This page has data of version ${data.schema}, expected ${SCHEMA}. Make it anew with: myograph view`);
  }
  return { data, blob: new Blob64(numbers) };
}
