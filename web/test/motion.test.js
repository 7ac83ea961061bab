import assert from "node:assert/strict";
import { test } from "node:test";
import { residual } from "../src/solver/closure.js";
import { modelOf } from "../src/solver/configuration.js";
import { determinant, singular } from "../src/solver/leastsquares.js";
import { inputsOf, toInputs, toPose } from "../src/solver/motion.js";
import { poseOf as pose } from "../src/solver/pose.js";
import { looseJoint, measuresAt } from "../src/solver/rates.js";
import { fromVector } from "../src/solver/rotation.js";
import { MECHANISMS, apart, mechanism } from "./numbers.js";
import { nearestSingular } from "./walks.js";

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
        (value, k) => value + (model.inputs[k].kind === "length" ? 1e-4 * model.length : 1e-4),
      );
      const there = toInputs(model, values, target);
      assert.equal(there.status, "moved");
      const back = toInputs(model, there.values, inputsOf(model, values));
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
  const side = ({ pose, inputs }) => Math.sign(determinant(pose) * determinant(inputs)); // of the map between their rates
  const home = side(measuresAt(model, scene.home));
  assert.equal(Math.abs(home), 1);
  for (const { values, reason } of stopped) {
    assert.equal(reason.kind, "singular");
    assert.match(reason.text, /no longer hold the platform/);
    const there = measuresAt(model, values);
    assert.ok(there.parallel < 0.08);
    assert.equal(side(there), home); // not on the other side
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

test("the cone of a ball joint stops a motion", () => {
  const { scene } = mechanism("gough_stewart");
  const [first] = modelOf(scene).balls;
  const ball = scene.graph.joints.find((item) => item.first === first);
  const limited = (cone) => {
    const joints = scene.graph.joints.map((item) => (item === ball ? { ...item, cone, coneAxis: [0, 0, 1] } : item));
    return modelOf({ ...scene, graph: { ...scene.graph, joints } });
  };
  const start = inputsOf(modelOf(scene), scene.home);
  const target = start.map((value, k) => value * (1 + 0.03 * Math.cos(k)));
  assert.equal(toInputs(limited(Math.PI), scene.home, target).status, "moved");
  const [x, y, z] = scene.home.slice(first, first + 3);
  const turn = fromVector([x, y, z]);
  const now = Math.acos(turn[8]);
  const ends = [target, start.map((value, k) => 2 * value - target[k])].map((to) =>
    toInputs(limited(now + 1e-4), scene.home, to),
  );
  assert.ok(ends.some(({ reason }) => reason?.kind === "limit" && reason.joint === ball.name));
});

// Leg ends B1 and B2 of the five-bar meet in working mode +- wherever P is as far from the point where they meet as its
// rods are long: on a circle, inside which P stands at home. The platform moves by itself there.
const [MEET, ROD] = [Math.sqrt(100 ** 2 - 70 ** 2), 194];
const crossed = () => {
  const { model, scene } = mechanism("fivebar");
  return { model, start: scene.branches.working.find(({ label }) => label === "+-").values };
};
const outside = ([x, y]) => Math.hypot(x, y - MEET) - ROD;

test("a chord that dips through a parallel singularity and comes out of it again is stopped before it", () => {
  const { model, start } = crossed();
  for (const [half, dip] of [
    [5, 0.02],
    [10, 0.1],
    [14, 0.3],
    [20, 0.6],
  ]) {
    const height = MEET + ROD - dip;
    const from = toPose(model, start, [-half, height], { through: true });
    assert.ok(from.crossed);
    const along = toPose(model, from.values, [half, height]);
    assert.equal(along.status, "stopped", `${half} ${dip}`);
    assert.equal(along.reason.kind, "singular");
    assert.match(along.reason.text, /^parallel/);
    const place = pose(model, along.values);
    assert.ok(outside(place) > 0 && outside(place) < 0.01 * half && place[0] < 0, String(place));
    assert.equal(toPose(model, from.values, [half, height + 4 * dip]).status, "moved"); // this chord stays outside
  }
});

test("neither a pose nor inputs lead through it, and what was near it may go away", () => {
  const { model, start } = crossed();
  const beyond = toPose(model, start, [0, MEET + ROD + 5], { through: true });
  assert.equal(beyond.status, "moved");
  const inputs = inputsOf(model, beyond.values);
  for (const [side, far] of [
    ["pose", toPose(model, start, [0, MEET + ROD + 5])],
    ["inputs", toInputs(model, start, inputs)],
  ]) {
    assert.equal(far.status, "stopped", side);
    assert.match(far.reason.text, /^parallel/);
    assert.ok(outside(pose(model, far.values)) < 0);
    const back = toPose(model, far.values, pose(model, start));
    assert.equal(back.status, "moved");
    assert.equal(back.crossed, false);
  }
  for (const near of [0, 1e-9, -1e-9, 1e-11, -1e-11]) // where nobody can tell on which side that is
    assert.equal(toPose(model, start, [0, MEET + ROD + near]).status, "stopped");
  const on = toPose(model, start, [0, MEET + ROD], { through: true });
  assert.equal(on.status, "moved");
  for (const side of [5, -5]) assert.equal(toPose(model, on.values, [0, MEET + ROD + side]).status, "moved");
});

/** Condition of the velocities of P per rate of the cranks, from (P - B) v = (P - B) B' q' of either leg. */
function fivebarCondition([x, y], angles) {
  const rows = angles.map((angle, k) => {
    const [cos, sin] = [100 * Math.cos(angle), 100 * Math.sin(angle)];
    const rod = [x - (k ? 70 : -70) - cos, y - sin];
    return { rod, rate: rod[1] * cos - rod[0] * sin };
  });
  const [first, second] = rows;
  // the map but for its determinant, which has no part in the condition
  const [most, least] = singular([
    [second.rod[1] * first.rate, -first.rod[1] * second.rate],
    [-second.rod[0] * first.rate, first.rod[0] * second.rate],
  ]).values;
  return most / least;
}

test("numbers are true up to a parallel singularity and on it", () => {
  const { model, start } = crossed();
  for (const away of [1, 0.01, 1e-4, 0]) {
    const there = toPose(model, start, [0, MEET + ROD - away], { through: true });
    assert.equal(there.status, "moved");
    const { amount, kind } = nearestSingular(model, there.values);
    const { condition, parallel, serial } = measuresAt(model, there.values);
    assert.equal(kind, "parallel");
    assert.ok(Math.abs(amount - away) <= 1e-3 * away, `${amount} ${away}`);
    assert.ok(serial > 0.2);
    assert.equal(parallel > 0, away > 0);
    const wanted = away ? fivebarCondition(pose(model, there.values), inputsOf(model, there.values)) : Infinity;
    assert.ok(condition === wanted || Math.abs(condition / wanted - 1) < 1e-5, `${condition} ${wanted}`);
  }
});

test("a ball joint's rotation vector comes back into one turn, its frames as they were", () => {
  const { model, scene } = mechanism("gough_stewart");
  const long = (first) => Math.hypot(...scene.home.slice(first, first + 3));
  const first = model.balls.find((item) => long(item) > 0.1 && long(item) < 2);
  const [angle, values] = [long(first), scene.home.slice()];
  for (let k = first; k < first + 3; k++) values[k] *= 1 - (2 * Math.PI) / angle;
  assert.ok(2 * Math.PI - angle > 1.25 * Math.PI);
  const there = toInputs(model, values, inputsOf(model, values));
  assert.equal(there.status, "moved");
  assert.ok(apart(there.values.slice(first, first + 3), scene.home.slice(first, first + 3)) < 1e-9);
  assert.ok(apart(pose(model, there.values), pose(model, scene.home)) < 1e-9 * model.length);
});

test("a whole turn of a crank is a way, though it ends where it began", () => {
  const turned = ({ model, scene }) => {
    const [first, ...others] = inputsOf(model, scene.home);
    return toInputs(model, scene.home, [first + 2 * Math.PI, ...others]);
  };
  const five = mechanism("fivebar");
  const { status, values } = turned(five);
  assert.equal(status, "moved");
  assert.ok(apart(pose(five.model, values), pose(five.model, five.scene.home)) < 1e-9);
  const change = values.map((value, k) => (value - five.scene.home[k]) / (2 * Math.PI));
  assert.ok(apart(change, [1, 0, -1, 0, 0]) < 1e-6, String(change)); // the rod turns back on its crank
  assert.match(turned(mechanism("planar_3rrr")).reason.text, /^parallel/);
});

// A table that two slides drive, and a leg of two rods that nobody drives. It folds where the table's point is as far
// from its foot as one rod is longer than the other: 0.6, and the point may not come nearer.
const [LONG, SHORT] = [1, 0.4];
const FOLD = LONG - SHORT;

/** Joint values where the table's point is at (x, y), the knee bent by a positive or negative angle. */
function stood(x, y, sense = 1) {
  const cosine = (x * x + y * y - LONG ** 2 - SHORT ** 2) / (2 * LONG * SHORT);
  const knee = sense * Math.acos(Math.max(-1, cosine));
  const foot = Math.atan2(y, x) - Math.atan2(SHORT * Math.sin(knee), LONG + SHORT * Math.cos(knee));
  return [x, y, foot, knee, -foot - knee];
}

test("a leg that nobody drives is not led through its fold, however long the step", () => {
  const { model } = mechanism("table");
  assert.ok(residual(model, model.home) < 1e-12);
  for (const [half, beyond] of [
    [0.02, 1e-5],
    [0.1, 1e-4],
    [0.15, 1e-3],
    [0.15, 5e-3],
  ]) {
    const [start, end] = [stood(-half, FOLD - beyond), [half, FOLD - beyond]];
    assert.ok(residual(model, start) < 1e-12);
    for (const move of [toInputs, toPose]) {
      const there = move(model, start, end);
      assert.equal(there.status, "stopped", `${half} ${beyond}`);
      const [x, y] = pose(model, there.values);
      assert.ok(x < 0 && Math.hypot(x, y) > FOLD - 1e-9, `${x} ${y}`);
      assert.equal(move(model, there.values, [-half, FOLD - beyond]).status, "moved");
      const outside = move(model, start, [-half, FOLD + 4 * beyond]);
      const along = move(model, outside.values, [half, FOLD + 4 * beyond]); // this way stays outside
      assert.equal(along.status, "moved");
      assert.ok(apart(along.values, stood(half, FOLD + 4 * beyond)) < 1e-6); // and the knee bent as it was
    }
  }
});

test("at the fold of such a leg its measure is 0, and rises evenly to both sides of it", () => {
  const { model } = mechanism("table");
  const passive = (knee) => {
    const far = Math.sqrt(LONG ** 2 + SHORT ** 2 + 2 * LONG * SHORT * Math.cos(knee));
    return measuresAt(model, stood(0, far, Math.sign(Math.PI - knee))).passive;
  };
  const folded = measuresAt(model, stood(0, FOLD));
  assert.ok(folded.passive < 1e-7, String(folded.passive));
  const slope = passive(Math.PI + 1e-2) / 1e-2;
  for (const bent of [1e-3, -1e-3, 1e-5, -1e-5])
    assert.ok(Math.abs(passive(Math.PI + bent) / Math.abs(bent) - slope) < 1e-2 * slope, String(bent));
});

test("the joint of a leg that is folded is named, also where nothing else can move", () => {
  const knees = ["foot", "knee", "hip"];
  for (const far of [FOLD + 1e-4, FOLD]) {
    const [x, ...others] = stood(far, 0);
    assert.ok(knees.includes(looseJoint(mechanism("table").model, [x, ...others]).name));
    assert.ok(knees.includes(looseJoint(mechanism("rail").model, [x, ...others.slice(1)]).name), String(far));
  }
});

test("an input outside its stroke that stands still stops no motion, and repeated pushes do not creep on", () => {
  const { scene } = mechanism("three_crr");
  const free = modelOf(scene);
  const [first, ...others] = inputsOf(free, scene.home);
  const ended = (high) =>
    modelOf({ ...scene, inputs: scene.inputs.map((item, k) => (k === 0 ? { ...item, stroke: [null, high] } : item)) });
  for (const outside of [1e-6, 1e-3, 0.02]) {
    const model = ended(first - outside * free.length);
    let values = scene.home;
    const [x, y, z] = pose(free, values);
    for (let k = 1; k <= 40; k++) {
      const there = toPose(model, values, [x, y + 0.05 * free.length * Math.sin(k), z]); // the first input stands still
      assert.equal(there.reason, null, `${outside} ${k}`);
      values = there.values;
    }
    assert.ok(Math.abs(inputsOf(model, values)[0] - first) < 1e-10 * free.length);
    const on = toInputs(model, values, [first + 0.01 * free.length, ...others]);
    assert.equal(on.reason.kind, "stroke");
  }
  const end = first + 0.01 * free.length;
  const model = ended(end);
  let values = scene.home;
  for (let k = 0; k < 20; k++) values = toInputs(model, values, [end + 0.01 * free.length, ...others]).values;
  assert.ok(Math.abs(inputsOf(model, values)[0] - end) < 2e-9 * free.length);
});
