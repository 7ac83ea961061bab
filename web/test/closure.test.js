import assert from "node:assert/strict";
import { test } from "node:test";
import { closingSystem, gaps, residual } from "../src/solver/closure.js";
import { childFrame, frames } from "../src/solver/frames.js";
import { IDENTITY } from "../src/solver/rotation.js";
import { poseError, poseOf } from "../src/solver/pose.js";
import { MECHANISMS, apart } from "./numbers.js";

for (const { name, scene, model, loose } of MECHANISMS) {
  test(`${name}: home is closed`, () => {
    assert.ok(residual(model, scene.home) < 1e-12 * model.length * scene.home.length);
  });

  test(`${name}: gaps of loops that are open, and of the pose, are Python's`, () => {
    const placed = frames(model, loose.values);
    const pose = poseOf(model, frames(model, scene.home));
    const found = [...gaps(model, placed, loose.values), ...poseError(model, placed, pose)];
    assert.ok(
      apart(found, loose.gaps) < 1e-12 * Math.max(1, ...loose.gaps.map(Math.abs)),
      String(apart(found, loose.gaps)),
    );
    assert.ok(Math.max(...loose.gaps.map(Math.abs)) > 1e-2 * model.length);
  });

  test(`${name}: derivatives are Python's`, () => {
    const { matrix } = closingSystem(model, loose.values, poseOf(model, frames(model, scene.home)));
    const wanted = loose.derivative.map((row) => row.map((value, k) => (value * model.scale[k]) / model.length));
    assert.equal(matrix.length, wanted.length);
    matrix.forEach((row, k) => assert.ok(apart([...row], wanted[k]) < 1e-11));
  });

  test(`${name}: derivatives are those of differences, where loops are closed`, () => {
    const { matrix } = closingSystem(model, scene.home, null);
    const step = 1e-6;
    for (let k = 0; k < model.count; k++) {
      const [ahead, behind] = [step, -step].map((h) => {
        const values = scene.home.map((value, j) => value + (j === k ? h * model.scale[k] : 0));
        return gaps(model, frames(model, values), values);
      });
      const slopes = ahead.map((value, row) => (value - behind[row]) / (2 * step * model.length));
      assert.ok(
        apart(
          slopes,
          matrix.map((row) => row[k]),
        ) < 1e-7,
      );
    }
  });
}

test("one turn of a helical joint shifts by its pitch", () => {
  const joint = {
    name: "H",
    type: "H",
    at: [1, 0, 0],
    childAt: [0, 0, 0],
    axes: [[0, 0, 1]],
    turn: IDENTITY,
    pitch: 5,
    first: 0,
  };
  const { turn, origin } = childFrame(joint, { turn: IDENTITY, origin: [0, 0, 0] }, [2 * Math.PI]);
  assert.ok(apart(turn, IDENTITY) < 1e-14);
  assert.ok(apart(origin, [1, 0, 5]) < 1e-14);
});
