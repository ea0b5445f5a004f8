// One muscle: its fields at the nodes for a place, from the numbers of the page.

import { Blob64, type PackedBody, type PackedTruth } from "./data";
import { Field, type Place, addVonMisesChange, vonMises } from "./field";

/** Values at the nodes of a muscle by the keys of the page's list of fields. */
export type FieldKey = string;

export class Muscle {
  readonly name: string;
  readonly colour: string;
  readonly nodes: Uint32Array;
  readonly reference: Float32Array;
  readonly position: Float32Array;
  readonly sensors: number[];
  readonly fields: Record<string, Field>;
  private readonly change: Float32Array;
  private readonly restChange: Float32Array;
  place: Place = { x: 0, u: 0, xDeviation: 0, uDeviation: 0 };

  constructor(readonly told: PackedBody, private readonly blob: Blob64) {
    this.name = told.name;
    this.colour = told.colour;
    this.sensors = told.sensors;
    this.nodes = blob.integers(told.nodes);
    this.reference = blob.floats(told.reference);
    this.restChange = blob.floats(told.rest_change);
    this.change = Float32Array.from(this.restChange);
    this.position = Float32Array.from(this.reference);
    this.fields = Object.fromEntries(Object.entries(told.fields).map(([key, field]) => [key, new Field(field, blob)]));
  }

  get count(): number {
    return this.nodes.length;
  }

  /** Put the muscle there: positions follow at once, other fields when they are asked for. */
  move(place: Place): void {
    this.place = place;
    const field = this.fields["position"]!;
    field.change(place, this.change);
    for (let i = 0; i < this.position.length; i++) this.position[i] = field.mean[i]! + this.change[i]!;
  }

  /** A field at the nodes [its unit]; null where there is none, such as an error without a truth. */
  values(key: FieldKey, truth: PackedTruth | null): Float32Array | null {
    if (key === "displacement") return distances(this.change, this.restChange, this.count);
    if (key === "von_mises") return this.stress();
    if (key === "deviation") return this.positionDeviation();
    if (key === "stress_deviation") return this.stressDeviation();
    if (key === "error" || key === "stress_error") return this.error(key, truth);
    const field = this.fields[key];
    if (!field || field.components !== 1) return null;
    const values = new Float32Array(this.count);
    field.values(this.place, values);
    return values;
  }

  /** Positions of the truth [mm] at the nodes; null where it has none of this muscle. */
  ghost(truth: PackedTruth, body: number): Float32Array | null {
    const told = truth.bodies[body];
    return told ? this.blob.floats(told.position) : null;
  }

  /** Number of this body in the page, which is that of its truth. */
  body = 0;

  private tensor(): Float32Array | null {
    const field = this.fields["cauchy_stress"];
    if (!field) return null;
    const stress = new Float32Array(6 * this.count);
    field.values(this.place, stress);
    return stress;
  }

  private stress(): Float32Array | null {
    const tensor = this.tensor();
    const values = new Float32Array(this.count);
    if (tensor) vonMises(tensor, values);
    else if (this.fields["von_mises"]) this.fields["von_mises"].values(this.place, values);
    else return null;
    return values;
  }

  private positionDeviation(): Float32Array {
    const field = this.fields["position"]!;
    const alongX = new Float32Array(3 * this.count), alongU = new Float32Array(3 * this.count);
    field.changes(this.place, alongX, alongU);
    const values = new Float32Array(this.count);
    for (let i = 0; i < this.count; i++) {
      let square = field.misfit[i]! ** 2;
      for (let k = 3 * i; k < 3 * i + 3; k++) square += alongX[k]! ** 2 + alongU[k]! ** 2;
      values[i] = (field.factor ?? 1) * Math.sqrt(square);
    }
    return values;
  }

  private stressDeviation(): Float32Array | null {
    const field = this.fields["cauchy_stress"];
    const stress = this.tensor();
    if (!field || !stress) return this.scalarDeviation("von_mises");
    const alongX = new Float32Array(6 * this.count), alongU = new Float32Array(6 * this.count);
    const both = field.changes(this.place, alongX, alongU);
    const values = field.misfit.map((misfit) => misfit * misfit);
    addVonMisesChange(stress, alongX, values);
    if (both) addVonMisesChange(stress, alongU, values);
    return values.map((square) => (field.factor ?? 1) * Math.sqrt(square));
  }

  private scalarDeviation(name: string): Float32Array | null {
    const field = this.fields[name];
    if (!field) return null;
    const alongX = new Float32Array(this.count), alongU = new Float32Array(this.count);
    field.changes(this.place, alongX, alongU);
    return alongX.map((x, i) => (field.factor ?? 1) * Math.hypot(x, alongU[i]!, field.misfit[i]!));
  }

  private error(key: "error" | "stress_error", truth: PackedTruth | null): Float32Array | null {
    const told = truth?.bodies[this.body];
    if (!told) return null;
    if (key === "error") return distances(this.position, this.blob.floats(told.position), this.count);
    const stress = this.stress();
    if (!stress || !told.von_mises) return null;
    const right = this.blob.floats(told.von_mises);
    return stress.map((value, i) => Math.abs(value - right[i]!));
  }
}

function distances(a: Float32Array, b: Float32Array, count: number): Float32Array {
  const values = new Float32Array(count);
  for (let i = 0, k = 0; i < count; i++, k += 3) {
    values[i] = Math.hypot(a[k]! - b[k]!, a[k + 1]! - b[k + 1]!, a[k + 2]! - b[k + 2]!);
  }
  return values;
}
