import assert from "node:assert/strict";
import { test } from "node:test";
import { closingSystem, gaps, residual } from "../src/solver/closure.js";
import { configurationAt } from "../src/solver/configuration.js";
import { poseError, poseOf } from "../src/solver/pose.js";
import { MECHANISMS, apart } from "./numbers.js";

for (const { name, scene, model, loose } of MECHANISMS) {
  test(`${name}: home is closed`, () => {
    assert.ok(residual(model, scene.home) < 1e-12 * model.length * scene.home.length);
  });

  test(`${name}: gaps of loops that are open, and of the pose, are Python's`, () => {
    const at = configurationAt(model, loose.values);
    const found = [...gaps(model, at), ...poseError(model, at, poseOf(model, scene.home))];
    assert.ok(
      apart(found, loose.gaps) < 1e-12 * Math.max(1, ...loose.gaps.map(Math.abs)),
      String(apart(found, loose.gaps)),
    );
    assert.ok(Math.max(...loose.gaps.map(Math.abs)) > 1e-2 * model.length);
  });

  test(`${name}: derivatives are Python's`, () => {
    const { matrix } = closingSystem(model, loose.values, poseOf(model, scene.home));
    const wanted = loose.derivative.map((row) => row.map((value, k) => (value * model.scale[k]) / model.length));
    assert.equal(matrix.length, wanted.length);
    matrix.forEach((row, k) => assert.ok(apart([...row], wanted[k]) < 1e-11));
  });

  test(`${name}: derivatives are those of differences, whether loops are closed or open`, () => {
    const step = 1e-6;
    for (const start of [scene.home, loose.values]) {
      const { matrix } = closingSystem(model, start, null);
      for (let k = 0; k < model.count; k++) {
        const [ahead, behind] = [step, -step].map((h) => {
          const values = start.map((value, j) => value + (j === k ? h * model.scale[k] : 0));
          return gaps(model, configurationAt(model, values));
        });
        const slopes = ahead.map((value, row) => (value - behind[row]) / (2 * step * model.length));
        const column = matrix.map((row) => row[k]);
        assert.ok(apart(slopes, column) < 1e-7 * Math.max(1, ...column.map(Math.abs)), String(apart(slopes, column)));
      }
    }
  });
}
