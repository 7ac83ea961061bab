import assert from "node:assert/strict";
import { test } from "node:test";
import * as rotation from "../src/solver/rotation.js";
import { apart } from "./numbers.js";

const VECTORS = [
  [0, 0, 0],
  [1e-9, 0, 2e-9],
  [0.3, -0.2, 0.1],
  [1, 2, -0.5],
  [0, 3.1415, 0],
  [2, -1, 1.9],
  [0, 0, Math.PI],
];

test("a rotation vector comes back from its rotation", () => {
  for (const vector of VECTORS.slice(0, -1))
    assert.ok(apart(rotation.toVector(rotation.fromVector(vector)), vector) < 1e-9, String(vector));
});

test("so it does, with its sense, as near to a half turn as can be told", () => {
  for (const left of [1e-3, 9e-5, 5e-5, 1e-6])
    for (const axis of [
      [0, 0, 1],
      [0, -1, 0],
      [0.6, -0.8, 0],
      [-2 / 3, 1 / 3, 2 / 3],
    ]) {
      const vector = axis.map((value) => value * (Math.PI - left));
      assert.ok(apart(rotation.toVector(rotation.fromVector(vector)), vector) < 1e-9, `${axis} ${left}`);
    }
});

test("a half turn is as far from the identity as can be", () => {
  assert.ok(Math.abs(rotation.norm(rotation.toVector([1, 0, 0, 0, -1, 0, 0, 0, -1])) - Math.PI) < 1e-12);
});

test("quaternions and angles say the same rotation", () => {
  for (const vector of VECTORS) {
    const turn = rotation.fromVector(vector);
    assert.ok(apart(rotation.fromQuaternion(rotation.toQuaternion(turn)), turn) < 1e-12);
    assert.ok(apart(rotation.fromAngles(...rotation.toAngles(turn)), turn) < 1e-12);
  }
});

test("the left Jacobian turns rates of the vector into the angular velocity, its inverse turns them back", () => {
  for (const vector of VECTORS.slice(0, 5)) {
    const jacobian = rotation.leftJacobian(vector);
    for (let k = 0; k < 3; k++) {
      const step = 1e-6;
      const [ahead, behind] = [step, -step].map((h) =>
        rotation.fromVector(vector.map((value, j) => value + (j === k ? h : 0))),
      );
      const spin = rotation
        .toVector(rotation.multiply(ahead, rotation.transpose(behind)))
        .map((value) => value / (2 * step));
      assert.ok(apart(spin, [jacobian[k], jacobian[k + 3], jacobian[k + 6]]) < 1e-8);
    }
    const back = rotation.multiply(rotation.vectorRates(vector), jacobian);
    assert.ok(apart(back, [1, 0, 0, 0, 1, 0, 0, 0, 1]) < 1e-12, String(vector));
  }
});
