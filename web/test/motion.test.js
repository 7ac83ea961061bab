import assert from "node:assert/strict";
import { test } from "node:test";
import { residual } from "../src/solver/closure.js";
import { frames, modelOf } from "../src/solver/frames.js";
import { inputsOf, toInputs, toPose } from "../src/solver/motion.js";
import { poseOf } from "../src/solver/pose.js";
import { distanceToSingular, measuresAt } from "../src/solver/rates.js";
import { fromVector } from "../src/solver/rotation.js";
import { MECHANISMS, apart, mechanism } from "./numbers.js";

const pose = (model, values) => poseOf(model, frames(model, values));

for (const { name, scene, model, moves, singular } of MECHANISMS) {
  test(`${name}: poses of moved inputs are Python's, and the way back leads home`, () => {
    for (const { inputs, pose: wanted } of moves) {
      const there = toInputs(model, scene.home, inputs);
      assert.equal(there.status, "moved");
      assert.ok(apart(inputsOf(model, there.values), inputs) < 1e-12 * model.length);
      assert.ok(apart(pose(model, there.values), wanted) < 1e-9 * Math.max(1, model.length));
      assert.ok(residual(model, there.values) <= 1e-12 * model.length * 4);
      const back = toPose(model, there.values, pose(model, scene.home));
      assert.equal(back.status, "moved");
      assert.ok(apart(inputsOf(model, back.values), inputsOf(model, scene.home)) < 1e-9 * Math.max(1, model.length));
    }
  });

  test(`${name}: measures of singularity at home are Python's`, () => {
    const { parallel, serial } = measuresAt(model, scene.home);
    assert.ok(Math.abs(parallel - singular.parallel) < 1e-7, `${parallel} ${singular.parallel}`);
    assert.ok(Math.abs(serial - singular.serial) < 1e-7, `${serial} ${singular.serial}`);
  });

  test(`${name}: every branch stays itself and none becomes another`, () => {
    for (const { values } of scene.branches.assembly.slice(0, 4)) {
      const target = inputsOf(model, values).map(
        (value, k) => value + (model.inputs[k].kind === "length" ? 1e-3 * model.length : 1e-3),
      );
      const there = toInputs(model, values, target);
      const back = toInputs(model, there.values, inputsOf(model, values));
      if (there.status !== "moved") continue;
      assert.ok(apart(pose(model, back.values), pose(model, values)) < 1e-8 * Math.max(1, model.length));
    }
  });
}

test("what is out of reach stops at the last place that is reached, and the gap is said", () => {
  const { model, scene } = mechanism("zeng2019");
  const start = pose(model, scene.home);
  const { values, status, reason, share } = toPose(model, scene.home, [start[0], start[1], start[2] + 100]);
  assert.equal(status, "stopped");
  assert.equal(reason.kind, "gap");
  assert.ok(reason.amount > 1 && reason.text.includes(reason.joint) && reason.text.includes("mm"));
  assert.ok(residual(model, values) < 1e-12 * model.length * 4);
  assert.ok(Math.abs(pose(model, values)[2] - start[2] - 100 * share) < 1e-6);
  assert.ok(measuresAt(model, values).serial < 0.02); // the leg is stretched there
});

test("inputs do not push through a parallel singularity", () => {
  const { model, scene } = mechanism("planar_3rrr");
  const start = inputsOf(model, scene.home);
  const ends = [0, 1, 2, 3].map((k) =>
    toInputs(
      model,
      scene.home,
      start.map((value, j) => value + 1.2 * Math.sin(k + j)),
    ),
  );
  const stopped = ends.filter(({ status }) => status === "stopped");
  assert.ok(stopped.length > 0);
  const sign = measuresAt(model, scene.home).sign;
  for (const { values, reason } of stopped) {
    assert.equal(reason.kind, "singular");
    assert.match(reason.text, /no longer hold the platform/);
    const there = measuresAt(model, values);
    assert.ok(there.parallel < 0.08);
    assert.equal(there.sign, sign); // not on the other side
  }
});

test("a mode is kept along a way that passes near its border", () => {
  const { model, scene } = mechanism("zeng2019");
  const home = pose(model, scene.home);
  const border = toPose(model, scene.home, [home[0], home[1], home[2] + 100]);
  const near = pose(model, border.values);
  near[2] -= 0.02;
  const along = toPose(model, scene.home, near);
  assert.equal(along.status, "moved");
  const back = toPose(model, along.values, home);
  assert.ok(apart(back.values, scene.home) < 1e-7 * model.length);
});

test("strokes stop, and what was outside may come back", () => {
  const { scene } = mechanism("zeng2019");
  const start = inputsOf(modelOf(scene), scene.home);
  const stroke = [start[0] - 10, start[0] + 5];
  const model = modelOf({ ...scene, inputs: scene.inputs.map((item, k) => (k === 0 ? { ...item, stroke } : item)) });
  const up = toInputs(model, scene.home, [start[0] + 20, start[1], start[2]]);
  assert.equal(up.reason.kind, "stroke");
  assert.equal(up.reason.joint, scene.inputs[0].name);
  assert.ok(Math.abs(inputsOf(model, up.values)[0] - stroke[1]) < 0.01);
  assert.equal(toInputs(model, scene.home, [start[0] + 20, start[1], start[2]], { limits: false }).reason, null);
  const outside = toInputs(model, scene.home, [start[0] + 20, start[1], start[2]], { limits: false }).values;
  assert.equal(toInputs(model, outside, start).status, "moved");
});

test("the distance to a singularity, to first order, is about what is left", () => {
  const { model, scene } = mechanism("zeng2019");
  const home = pose(model, scene.home);
  const left = pose(model, toPose(model, scene.home, [home[0], home[1], home[2] + 100]).values)[2] - home[2];
  const { amount, kind } = distanceToSingular(model, scene.home);
  assert.equal(kind, "serial");
  assert.ok(amount < 1.3 * left && amount > 0.5 * left);
});

test("at the border the distance is almost nothing", () => {
  const { model, scene } = mechanism("zeng2019");
  const home = pose(model, scene.home);
  const border = toPose(model, scene.home, [home[0], home[1], home[2] + 100]);
  const { amount, kind } = distanceToSingular(model, border.values);
  assert.equal(kind, "serial");
  assert.ok(amount < 0.05, String(amount));
});

test("the cone of a ball joint stops a motion", () => {
  const { scene } = mechanism("gough_stewart");
  const ball = scene.graph.joints.find(({ type }) => type === "S");
  const limited = (cone) => {
    const joints = scene.graph.joints.map((item) => (item === ball ? { ...item, cone, coneAxis: [0, 0, 1] } : item));
    return modelOf({ ...scene, graph: { ...scene.graph, joints } });
  };
  const start = inputsOf(modelOf(scene), scene.home);
  const target = start.map((value, k) => value * (1 + 0.03 * Math.cos(k)));
  assert.equal(toInputs(limited(Math.PI), scene.home, target).status, "moved");
  const [x, y, z] = scene.home.slice(ball.first, ball.first + 3);
  const turn = fromVector([x, y, z]);
  const now = Math.acos(turn[8]);
  const ends = [target, start.map((value, k) => 2 * value - target[k])].map((to) =>
    toInputs(limited(now + 1e-4), scene.home, to),
  );
  assert.ok(ends.some(({ reason }) => reason?.kind === "limit" && reason.joint === ball.name));
});
