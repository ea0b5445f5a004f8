import { expect, test } from "vitest";
import { Asking } from "../src/network/asking";
import type { FromWorker, ToWorker } from "../src/network/messages";
import { Network, type Port } from "../src/network/network";
import { sentence } from "../src/network/panel";
import { duration } from "../src/times";
import { Packing, linearField } from "./page";

const PLACE = { x: 0.5, u: -0.4, xDeviation: 0, uDeviation: 0 };

/** A network of three sensors and two nodes, and a worker that is played by the test. */
function played(inputs = ["sensor_position_target", "query_places"]) {
  const packing = new Packing();
  const told = {
    name: "net", muscle: "biceps", body: 0, inputs, model: "bW9kZWw=",
    still: { query_places: packing.reals([0, 0, 0, 1, 1, 1], [2, 3]) },
    sensors: linearField(packing, 3), low: packing.reals(Array(9).fill(-50), [3, 3]), high: packing.reals(Array(9).fill(50), [3, 3]),
    nodes: packing.reals([1, 2, 3], [1, 3]),
  };
  const said: ToWorker[] = [];
  const port: Port = { postMessage: (message) => said.push(message), onmessage: null, onerror: null };
  let made = 0, heard = 0;
  const engine = { port: () => (made++, port), wasm: () => "d2FzbQ==" };
  const network = new Network(told, packing.blob(), engine, () => heard++);
  const says = (data: FromWorker) => port.onmessage!({ data } as MessageEvent<FromWorker>);
  const ask = (modes: number[]) => network.ask({ activation: [0, 0, 1, 0, 0], load: 2, modes: Float32Array.from(modes) });
  return { network, said, says, ask, port, counts: () => ({ made, heard }) };
}

test("one question at a time, and of those that wait only the newest is asked", () => {
  const sent: number[] = [];
  const asking = new Asking<number>((question) => sent.push(question));
  [1, 2, 3].forEach((question) => asking.ask(question));
  expect(sent).toEqual([]);
  asking.free();
  expect(sent).toEqual([3]);
  [4, 5].forEach((question) => asking.ask(question));
  expect(sent).toEqual([3]);
  expect(asking.settled).toBe(false);
  asking.free();
  expect(sent).toEqual([3, 5]);
  asking.free();
  expect(asking.settled).toBe(true);
});

test("the worker is made with the first question, which it gets when it is ready", () => {
  const { network, said, says, ask, counts } = played();
  network.move(PLACE);
  expect(counts().made).toBe(0);
  expect(sentence(network)).toContain("starts when it is first asked");
  ask([0, 0, 0, 1, 1, 1]);
  ask([0, 0, 0, 1, 1, 1]);
  expect(counts().made).toBe(1);
  expect(said.map((message) => message.kind)).toEqual(["start"]);
  expect(sentence(network)).toContain("starting");
  says({ kind: "ready" });
  expect(said.map((message) => message.kind)).toEqual(["start", "ask"]);
  expect(network.sent).toBe(1);
});

test("a question tells where the sensors are, and no more than the network reads", () => {
  const { network, said, says, ask } = played();
  network.move(PLACE);
  ask([0, 0, 0, 1, 1, 1]);
  says({ kind: "ready" });
  const question = said[1]!;
  if (question.kind !== "ask") throw new Error("no question");
  expect(Object.keys(question.inputs)).toEqual(["sensor_position_target"]);
  expect(question.inputs["sensor_position_target"]!.shape).toEqual([1, 3, 3]);
  question.inputs["sensor_position_target"]!.data.forEach((value, i) =>
    expect(value).toBeCloseTo(i + 0.5 * Math.sin(i + 1) - 0.2 * Math.sin(i + 10), 5));
  const both = played(["activation", "hand_load"]);
  both.ask([0, 0, 0, 1, 1, 1]);
  both.says({ kind: "ready" });
  expect(Object.keys((both.said[1] as { inputs: object }).inputs)).toEqual(["activation", "hand_load"]);
});

test("the difference is from the modes of the question that was answered", () => {
  const { network, says, ask, counts } = played();
  ask([0, 0, 0, 1, 1, 1]);
  says({ kind: "ready" });
  ask([9, 9, 9, 9, 9, 9]);
  says({ kind: "answer", number: 0, position: Float32Array.of(3, 4, 0, 1, 1, 1), milliseconds: 7 });
  expect(Array.from(network.difference!)).toEqual([5, 0]);
  expect(network.milliseconds).toBe(7);
  expect(counts().heard).toBe(1);
  expect(network.settled).toBe(false);
  says({ kind: "answer", number: 1, position: Float32Array.of(9, 9, 9, 9, 9, 8), milliseconds: 6 });
  expect(Array.from(network.difference!)).toEqual([0, 1]);
  expect(network.settled).toBe(true);
});

test("a sensor out of its box is outside", () => {
  const { network } = played();
  network.move(PLACE);
  expect(network.outside).toBe(false);
  network.sensors[4] = 51;
  expect(network.outside).toBe(true);
});

test("a network that fails says why, shows nothing, and is not asked again", () => {
  const { network, said, says, ask, counts } = played();
  ask([0, 0, 0, 1, 1, 1]);
  says({ kind: "failed", reason: "no WebAssembly" });
  expect(sentenceOf(network)).toContain("cannot run in this browser (no WebAssembly). The modes are shown.");
  expect(network.position).toBeNull();
  expect(counts().heard).toBe(1);
  ask([0, 0, 0, 1, 1, 1]);
  expect(said.length).toBe(1);
});

test("a worker that cannot be made is not made again", () => {
  const { network, ask } = played();
  let tried = 0;
  Object.assign(network, { engine: { port: () => { tried++; throw new Error("no workers here"); }, wasm: () => "" } });
  ask([0, 0, 0, 1, 1, 1]);
  ask([0, 0, 0, 1, 1, 1]);
  expect(tried).toBe(1);
  expect(network.problem).toContain("no workers here");
});

function sentenceOf(network: Network): string {
  return network.problem || sentence(network);
}

test("times are written as people say them", () => {
  expect([0.00134, 0.0277, 0.19, 1.04, 27.34].map(duration)).toEqual(["1.3 ms", "27.7 ms", "190 ms", "1.0 s", "27 s"]);
});
