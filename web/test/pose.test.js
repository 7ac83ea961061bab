import assert from "node:assert/strict";
import { test } from "node:test";
import { between, turnOfPose } from "../src/solver/pose.js";
import { fromVector, multiply, times, toQuaternion, toVector, transpose } from "../src/solver/rotation.js";
import { apart, mechanism } from "./numbers.js";

test("between two poses a platform turns evenly about one axis, the shorter way", () => {
  const { model } = mechanism("gough_stewart");
  const [first, turn] = [fromVector([0.3, -0.2, 0.5]), [1.2, -1.6, 0.9]];
  const pose = (rotation, point) => [...point, ...toQuaternion(rotation)];
  const way = between(model, pose(first, [1, 2, 3]), pose(multiply(fromVector(turn), first), [2, 0, 7]));
  for (const t of [0, 0.1, 0.25, 0.5, 0.8, 1]) {
    const there = way(t);
    const turned = toVector(multiply(turnOfPose(model, there), transpose(first)));
    assert.ok(apart(turned, times(t, turn)) < 1e-12, String(t));
    assert.ok(apart(there.slice(0, 3), [1 + t, 2 - 2 * t, 3 + 4 * t]) < 1e-12);
    assert.ok(Math.abs(Math.hypot(...there.slice(3)) - 1) < 1e-12);
  }
});
