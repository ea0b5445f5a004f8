// The arm in space, drawn by WebGL when something has changed, and not otherwise.

import {
  BufferAttribute, BufferGeometry, type DataTexture, Group, Matrix4, Mesh, MeshBasicMaterial, OctahedronGeometry, PerspectiveCamera,
  Raycaster, Scene, type ShaderMaterial, Sphere, SphereGeometry, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Arm, Drawn } from "./arm";
import { lookupTable } from "./colours";
import type { Blob64, PageData } from "./data";
import { makeMaterial, tableTexture } from "./material";
import type { Points } from "./network/panel";

/** A node that was clicked. */
export interface Pick {
  body: number;
  node: number;
}

const SENSOR_RADIUS = 2.4, GRAPH_RADIUS = 4.5;
const GRAPH_COLOUR = 0x6a3dff, HALO = 1.4;

export class View {
  private readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(28, 1, 10, 6000);
  private readonly controls: OrbitControls;
  private readonly table: DataTexture;
  private readonly meshes: Mesh<BufferGeometry, ShaderMaterial>[];
  private readonly ghosts: Mesh<BufferGeometry, ShaderMaterial>[];
  private readonly forearm = new Group();
  private readonly dots = new Group();
  private readonly networkSensors = new Group();
  private readonly graph = new Group();
  private readonly marker: Mesh;
  private waiting = false;
  private readonly centre = new Vector3();
  private extent = 300;
  private sidewards = 0.3;
  /** Pictures drawn so far. */
  drawings = 0;

  constructor(context: WebGL2RenderingContext, private readonly arm: Arm, blob: Blob64) {
    this.canvas = context.canvas as HTMLCanvasElement;
    this.renderer = new WebGLRenderer({ canvas: this.canvas, context });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.outputColorSpace = "srgb-linear";
    this.table = tableTexture();
    this.meshes = arm.drawn.map((drawn) => this.muscleMesh(drawn, blob));
    this.ghosts = arm.drawn.map((drawn) => this.ghostMesh(drawn));
    this.scene.add(...this.meshes, ...this.ghosts, this.forearm, this.dots, this.networkSensors, this.graph);
    this.addBones(arm.data, blob);
    this.addSensors();
    this.addNetwork();
    this.marker = new Mesh(new SphereGeometry(3), new MeshBasicMaterial({ color: 0xb3005e, depthTest: false }));
    this.marker.visible = false;
    this.marker.renderOrder = 4;
    this.scene.add(this.marker);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.measure();
    this.look(this.sidewards);
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement!);
    this.resize();
  }

  /** Show what the arm has become. */
  update(): void {
    this.meshes.forEach((mesh, i) => {
      const drawn = this.arm.drawn[i]!;
      for (const name of ["position", "normal", "value"]) mesh.geometry.getAttribute(name).needsUpdate = true;
      mesh.material.uniforms["painted"]!.value = drawn.known;
    });
    this.turnForearm();
    this.moveDots();
    this.draw();
  }

  /** Colours of a field between two values. */
  colours(field: string, low: number, high: number): void {
    this.table.image.data.set(lookupTable(field));
    this.table.needsUpdate = true;
    for (const mesh of this.meshes) (mesh.material.uniforms["range"]!.value as Vector2).set(low, high);
  }

  /** Ghost of other positions of every muscle's vertices, or none. */
  ghost(positions: (Float32Array | null)[] | null): void {
    this.ghosts.forEach((mesh, i) => {
      const position = positions?.[i];
      mesh.visible = Boolean(position);
      if (!position) return;
      const { surface } = this.arm.drawn[i]!;
      surface.carry(position, 3, mesh.geometry.getAttribute("position").array as Float32Array);
      mesh.geometry.getAttribute("position").needsUpdate = true;
      mesh.geometry.computeVertexNormals();
    });
    this.draw();
  }

  sensors(visible: boolean): void {
    this.dots.visible = visible;
    this.draw();
  }

  /** Sensors of the network, which follow the muscle, and the nodes of its graph, which stay. */
  points(shown: Points): void {
    this.networkSensors.visible = shown.sensors;
    this.graph.visible = shown.nodes;
    this.draw();
  }

  /** Mark a node, or none. */
  mark(pick: Pick | null): void {
    this.marker.visible = pick !== null;
    this.marker.userData = { pick };
    this.moveDots();
    this.draw();
  }

  /** The node nearest to what is under a point of the window; null for the background. */
  pick(clientX: number, clientY: number): Pick | null {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    const hit = ray.intersectObjects(this.meshes, false)[0];
    if (!hit) return null;
    const body = this.meshes.indexOf(hit.object as (typeof this.meshes)[number]);
    return { body, node: nearest(this.arm.drawn[body]!.shape, hit.point) };
  }

  /** Look at the arm from the side, walking `turn` [rad] from there to the front. */
  look(turn: number): void {
    const { forward, side } = this.directions();
    const level = side.clone().multiplyScalar(Math.cos(turn)).addScaledVector(forward, Math.sin(turn));
    const towards = level.multiplyScalar(Math.cos(0.12)).add(new Vector3(0, 0, Math.sin(0.12)));
    this.sidewards = turn;
    const narrow = Math.min(1, this.camera.aspect * 1.15);
    const distance = this.extent / Math.tan((this.camera.fov * Math.PI) / 360) / narrow;
    this.controls.target.copy(this.centre);
    this.camera.position.copy(this.centre).addScaledVector(towards, distance);
    this.controls.update();
    this.draw();
  }

  /** Turn by angles [rad], or come nearer by a factor; for keys. */
  turn(around: number, up: number, nearer = 1): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    offset.applyAxisAngle(new Vector3(0, 0, 1), around);
    const across = new Vector3().crossVectors(new Vector3(0, 0, 1), offset).normalize();
    const tilted = offset.clone().applyAxisAngle(across, -up);
    const kept = Math.abs(tilted.z) < 0.98 * tilted.length() ? tilted : offset;
    this.camera.position.copy(this.controls.target).addScaledVector(kept, 1 / nearer);
    this.controls.update();
    this.draw();
  }

  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
      this.drawings++;
    });
  }

  private muscleMesh(drawn: Drawn, blob: Blob64): Mesh<BufferGeometry, ShaderMaterial> {
    const geometry = this.geometry(drawn, drawn.position, drawn.normal);
    const tendon = new Float32Array(drawn.surface.vertices);
    if (drawn.muscle.told.tendon) drawn.surface.carry(blob.floats(drawn.muscle.told.tendon), 1, tendon);
    geometry.setAttribute("value", new BufferAttribute(drawn.value, 1));
    geometry.setAttribute("tendon", new BufferAttribute(tendon, 1));
    return still(new Mesh(geometry, makeMaterial({ colour: drawn.muscle.colour }, this.table)));
  }

  private ghostMesh(drawn: Drawn): Mesh<BufferGeometry, ShaderMaterial> {
    const size = 3 * drawn.surface.vertices;
    const geometry = this.geometry(drawn, new Float32Array(size), new Float32Array(size));
    for (const name of ["value", "tendon"]) {
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(size / 3), 1));
    }
    const mesh = still(new Mesh(geometry, makeMaterial({ colour: "#8a9099", opacity: 0.4 }, this.table)));
    mesh.visible = false;
    mesh.renderOrder = 2;
    return mesh;
  }

  private geometry(drawn: Drawn, position: Float32Array, normal: Float32Array): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setIndex(new BufferAttribute(drawn.surface.triangles, 1));
    geometry.setAttribute("position", new BufferAttribute(position, 3));
    geometry.setAttribute("normal", new BufferAttribute(normal, 3));
    geometry.boundingSphere = new Sphere(new Vector3(), 1e6);
    return geometry;
  }

  private addBones(data: PageData, blob: Blob64): void {
    for (const bone of data.bones) {
      const points = blob.floats(bone.points);
      const geometry = new BufferGeometry();
      geometry.setIndex(new BufferAttribute(blob.integers(bone.triangles), 1));
      geometry.setAttribute("position", new BufferAttribute(points, 3));
      for (const name of ["value", "tendon"]) {
        geometry.setAttribute(name, new BufferAttribute(new Float32Array(points.length / 3), 1));
      }
      geometry.computeVertexNormals();
      const mesh = new Mesh(geometry, makeMaterial({ colour: bone.colour }, this.table));
      (bone.moves ? this.forearm : this.scene).add(mesh);
    }
    this.forearm.matrixAutoUpdate = false;
  }

  private addSensors(): void {
    const make = dots(new SphereGeometry(SENSOR_RADIUS, 12, 8), 0x000000);
    this.arm.drawn.forEach(({ muscle }, body) => {
      for (const node of muscle.sensors) {
        const dot = make();
        dot.userData = { body, node };
        this.dots.add(dot);
      }
    });
    this.dots.visible = false;
  }

  private addNetwork(): void {
    const { network } = this.arm;
    this.networkSensors.visible = this.graph.visible = false;
    if (!network) return;
    const sensor = dots(new SphereGeometry(SENSOR_RADIUS, 12, 8), 0x000000);
    for (let i = 0; i < network.sensors.length; i += 3) this.networkSensors.add(sensor());
    const node = dots(new OctahedronGeometry(GRAPH_RADIUS), GRAPH_COLOUR);
    for (let i = 0; i < (network.nodes?.length ?? 0); i += 3) {
      const dot = node();
      dot.position.fromArray(network.nodes!, i);
      this.graph.add(dot);
    }
  }

  private moveDots(): void {
    this.networkSensors.children.forEach((dot, i) => dot.position.fromArray(this.arm.network!.sensors, 3 * i));
    const put = (mesh: { position: Vector3 }, { body, node }: Pick) =>
      mesh.position.fromArray(this.arm.drawn[body]!.shape, 3 * node);
    for (const dot of this.dots.children) put(dot, dot.userData as Pick);
    const pick = this.marker.userData["pick"] as Pick | null | undefined;
    if (pick) put(this.marker, pick);
  }

  private turnForearm(): void {
    const { hinge } = this.arm.data;
    const angle = this.arm.angle.angle(this.arm.x);
    this.forearm.visible = hinge !== null && angle !== null;
    if (!hinge || angle === null) return;
    const frame = new Matrix4().makeBasis(vector(hinge.forward), vector(hinge.up), vector(hinge.axis));
    const flexed = new Matrix4().makeRotationZ(angle - hinge.reference_angle);
    const back = frame.clone().transpose();
    const [x, y, z] = hinge.point as [number, number, number];
    this.forearm.matrix = new Matrix4().makeTranslation(x, y, z)
      .multiply(frame).multiply(flexed).multiply(back).multiply(new Matrix4().makeTranslation(-x, -y, -z));
    this.forearm.matrixWorldNeedsUpdate = true;
  }

  /** Forwards, and to the viewer at the side, both level. */
  private directions(): { forward: Vector3; side: Vector3 } {
    const forward = vector(this.arm.data.hinge?.forward ?? [1, 1.5, 0]).setZ(0).normalize();
    return { forward, side: new Vector3(0, 0, 1).cross(forward) };
  }

  /** Middle and size of the muscles at rest, and of the bones. */
  private measure(): void {
    const points = this.arm.drawn.flatMap(({ muscle }) => Array.from(muscle.position));
    for (const bone of [...this.scene.children, ...this.forearm.children]) {
      if (!(bone instanceof Mesh) || this.meshes.includes(bone) || this.ghosts.includes(bone)) continue;
      const position = (bone.geometry as BufferGeometry).getAttribute("position");
      if (position && bone !== this.marker) points.push(...Array.from(position.array as Float32Array));
    }
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    points.forEach((value, i) => {
      low[i % 3] = Math.min(low[i % 3]!, value);
      high[i % 3] = Math.max(high[i % 3]!, value);
    });
    this.centre.set((low[0]! + high[0]!) / 2, (low[1]! + high[1]!) / 2, (low[2]! + high[2]!) / 2);
    this.extent = 0.6 * Math.max(high[0]! - low[0]!, high[1]! - low[1]!, high[2]! - low[2]!);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement!;
    if (!width || !height) return;
    const before = this.camera.aspect;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (before !== this.camera.aspect) this.look(this.sidewards);
    this.draw();
  }
}

/** Makes dots that are seen through everything, each with a light rim. */
function dots(shape: BufferGeometry, color: number): () => Mesh {
  const paint = new MeshBasicMaterial({ color, depthTest: false });
  const light = new MeshBasicMaterial({ color: 0xffffff, depthTest: false });
  return () => {
    const dot = new Mesh(shape, paint), rim = new Mesh(shape, light);
    rim.scale.setScalar(HALO);
    rim.renderOrder = 2;
    dot.renderOrder = 3;
    dot.add(rim);
    return dot;
  };
}

function vector(numbers: number[]): Vector3 {
  return new Vector3(numbers[0], numbers[1], numbers[2]);
}

/** It is somewhere else in every picture: never left out, never looked for by its old place. */
function still<T extends Mesh>(mesh: T): T {
  mesh.frustumCulled = false;
  return mesh;
}

function nearest(position: Float32Array, point: Vector3): number {
  let best = 0, least = Infinity;
  for (let i = 0; i < position.length; i += 3) {
    const distance = (position[i]! - point.x) ** 2 + (position[i + 1]! - point.y) ** 2 + (position[i + 2]! - point.z) ** 2;
    if (distance < least) [best, least] = [i / 3, distance];
  }
  return best;
}
