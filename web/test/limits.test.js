/** Strokes and joint limits: what exceeds them, whole turns of revolutes aside, those of screws counted. */

import assert from "node:assert/strict";
import test from "node:test";

import { limitsSaid } from "../src/readout.js";
import { modelOf } from "../src/solver/configuration.js";
import { exceeded, limitsOf } from "../src/solver/limits.js";

const TURN = 2 * Math.PI;
const joint = (name, first, limits) => ({
  ...{ name, parent: "base", child: name, at: [0, 0, 0], childAt: [0, 0, 0], first, freedoms: 1 },
  ...{ limits: [limits], cone: null, coneAxis: null },
});

/** A revolute, a screw and a slider side by side, the last one driven. */
function model(limits = [[-0.5, 1], [-TURN, TURN], null], stroke = [0, 10]) {
  const joints = ["R", "H", "P"].map((type, k) => joint(type, k, limits[k]));
  return modelOf({
    graph: { links: ["base", "R", "H", "P"], joints, steps: [], cut: [], dimensions: [] },
    platform: { link: "P", point: [0, 0, 0], pose: ["z"] },
    coordinates: [
      { kind: "angle", counted: false },
      { kind: "angle", counted: true },
      { kind: "length", counted: false },
    ],
    inputs: [{ name: "q", index: 2, sign: -1, offset: 1, kind: "length", counted: false, stroke }],
    characteristicLength: 100,
    home: [0, 0, 0],
    unit: "mm",
  });
}

test("a turn of a revolute changes nothing, a turn of a screw does", () => {
  assert.deepEqual(exceeded(model(), [0.25 + 3 * TURN, 0, 0]), []);
  const found = exceeded(model(), [0, 1.5 * TURN, 0]);
  assert.deepEqual(found.map(({ name, angle }) => [name, angle]), [["H", true]]);
  assert.ok(Math.abs(found[0].by - 0.5 * TURN) < 1e-12);
});

test("strokes are of the printed value, and the worst comes first", () => {
  const found = exceeded(model(), [1.25, 0, 6]); // q = 1 - 6
  assert.deepEqual(found.map(({ name }) => name), ["R", "q"]);
  assert.ok(Math.abs(found[1].by - 5) < 1e-12);
});

test("a value on its bound is within", () => assert.deepEqual(exceeded(model(), [1, TURN, 1]), []));

test("an open end bounds nothing", () => {
  const open = model([[null, 1], null, null], null);
  assert.deepEqual(exceeded(open, [-50, 0, 0]), []);
  assert.equal(exceeded(open, [2, 0, 0]).length, 1);
});

test("it is said whether limits are stated, kept, or by how much not", () => {
  const scene = { unit: "mm", angleUnit: "deg" };
  const none = limitsOf(model([null, null, null], null));
  assert.equal(limitsSaid({ stated: none.length > 0, exceeded: [] }, scene), "no limits are stated");
  assert.equal(limitsSaid({ stated: true, exceeded: [] }, scene), "within");
  const far = exceeded(model(), [0, 1.5 * TURN, 6]);
  assert.equal(limitsSaid({ stated: true, exceeded: far }, scene), "H outside by 180 deg, 1 more");
});
