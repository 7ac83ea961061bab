import assert from "node:assert/strict";
import { test } from "node:test";
import { closingSystem, gaps, residual } from "../src/solver/closure.js";
import { childFrame, frames, modelOf, screws } from "../src/solver/frames.js";
import { IDENTITY, aboutAxis, add, cross, multiply, subtract, times, toVector, transpose } from "../src/solver/rotation.js";
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

for (const [type, freedoms] of Object.entries({ R: 1, P: 1, H: 1, C: 2, U: 2, S: 3 })) {
  test(`${type}: unit twists are the rates of the child's frame`, () => {
    const joint = {
      ...{ name: type, type, parent: 0, child: 1, first: 0, freedoms, pitch: 5 },
      at: [1, -2, 0.5],
      childAt: [0.3, 0.2, -0.1],
      axes: [
        [0, 0.6, 0.8],
        [1, 0, 0],
      ],
      turn: aboutAxis([1, 0, 0], 0.3),
    };
    const base = { turn: aboutAxis([0, 0, 1], 0.5), origin: [0.2, 0.1, -0.4] };
    const values = [0.4, -0.7, 0.2].slice(0, freedoms);
    const here = childFrame(joint, base, values);
    const step = 1e-6;
    screws({ joints: [joint], count: freedoms }, [base, here], values).forEach(({ angular, linear }, k) => {
      const [ahead, behind] = [step, -step].map((h) =>
        childFrame(
          joint,
          base,
          values.map((value, j) => value + (j === k ? h : 0)),
        ),
      );
      const turned = times(1 / (2 * step), toVector(multiply(ahead.turn, transpose(behind.turn))));
      const moved = times(1 / (2 * step), subtract(ahead.origin, behind.origin));
      assert.ok(apart(turned, angular) < 1e-8);
      assert.ok(apart(moved, add(linear, cross(angular, here.origin))) < 1e-8);
    });
  });
}

test("derivatives are those of differences where the tree goes from a child to its parent", () => {
  const joint = { type: "R", at: [0, 0, 0], childAt: [0, 0, 0], axes: [[0, 0, 1]], turn: [IDENTITY], freedoms: 1, pitch: 0 };
  const graph = {
    links: ["base", "link"],
    base: "base",
    joints: [
      { ...joint, name: "back", parent: "link", child: "base", first: 0 },
      { ...joint, name: "cut", parent: "base", child: "link", first: 1 },
    ],
    tree: [{ joint: 0, forward: false }],
    cut: [1],
  };
  const angles = [{ kind: "angle" }, { kind: "angle" }];
  const platform = { link: "link", point: [1, 0, 0], pose: ["x"] };
  const model = modelOf({ graph, platform, home: [0, 0], characteristicLength: 2, coordinates: angles, inputs: [], unit: "" });
  const values = [0.3, -0.3];
  assert.ok(residual(model, values) < 1e-15);
  const { matrix } = closingSystem(model, values, null);
  for (const k of [0, 1]) {
    const [ahead, behind] = [1e-6, -1e-6].map((h) => {
      const moved = values.map((value, j) => value + (j === k ? h : 0));
      return gaps(model, frames(model, moved), moved);
    });
    assert.ok(
      apart(
        ahead.map((value, row) => (value - behind[row]) / (2e-6 * model.length)),
        matrix.map((row) => row[k]),
      ) < 1e-8,
    );
  }
});
