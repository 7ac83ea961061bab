import assert from "node:assert/strict";
import { test } from "node:test";
import { NearestSingular, nearestSingular } from "../src/solver/distance.js";
import { frames } from "../src/solver/frames.js";
import { toPose } from "../src/solver/motion.js";
import { poseOf } from "../src/solver/pose.js";
import { measuresAt } from "../src/solver/rates.js";
import { MECHANISMS, mechanism } from "./numbers.js";
import { random } from "./walks.js";

const pose = (model, values) => poseOf(model, frames(model, values));

/** A leg of the five-bar is stretched or folded where P is so far from its motor. */
const [MOTORS, STRETCHED, FOLDED] = [[-70, 70], 294, 94];
const serialOfFivebar = ([x, y]) =>
  Math.min(...MOTORS.flatMap((g) => [STRETCHED, FOLDED].map((radius) => Math.abs(Math.hypot(x - g, y) - radius))));

test("a five-bar's distance is that to the circles on which its legs are stretched or folded", () => {
  const { model, scene } = mechanism("fivebar");
  for (const wanted of [[0, 223.924], [17, 188], [-3, 191], [20, 222]]) {
    const { values, status } = toPose(model, scene.home, wanted);
    assert.equal(status, "moved");
    const { amount, kind } = nearestSingular(model, values);
    const serial = serialOfFivebar(pose(model, values));
    assert.equal(kind, "serial");
    assert.ok(Math.abs(amount / serial - 1) < 2e-3, `${amount} ${serial}`);
  }
});

test("at the border of the reach the distance is almost nothing", () => {
  const { model, scene } = mechanism("zeng2019");
  const home = pose(model, scene.home);
  const border = toPose(model, scene.home, [home[0], home[1], home[2] + 100]);
  const { amount, kind } = nearestSingular(model, border.values);
  assert.equal(kind, "serial");
  assert.ok(amount < 0.01, String(amount));
});

// the whole search takes too long for six legs with ball joints
for (const { name, scene, model } of MECHANISMS.filter((item) => item.name !== "gough_stewart")) {
  test(`${name}: no pose that is nearer than the singularity found is singular or out of reach`, () => {
    const { amount } = nearestSingular(model, scene.home);
    const start = pose(model, scene.home);
    const draw = random(5);
    const lengths = start.map((_, k) => k).filter((k) => model.pose[k].length === 1);
    for (let k = 0; k < 20; k++) {
      const way = lengths.map(() => draw() - 0.5);
      const away = (0.97 * Math.min(amount, model.length / 2)) / Math.hypot(...way);
      const target = start.slice();
      lengths.forEach((index, j) => (target[index] += away * way[j]));
      const there = toPose(model, scene.home, target, { limits: false });
      assert.equal(there.status, "moved", `${target}: ${there.reason?.text}`);
    }
  });
}

test("it may be stopped at any time, and a singular pose has no distance", () => {
  const { model, scene } = mechanism("zeng2019");
  const found = new NearestSingular(model, scene.home);
  const search = found.search();
  assert.equal(search.next().done, false);
  assert.equal(found.amount, Infinity);
  while (!search.next().done);
  const [amount] = [found.amount];
  assert.ok(amount > 0 && amount < model.length);
  const [x, y, z] = pose(model, scene.home);
  const up = toPose(model, scene.home, [x, y, z + 100]).values;
  assert.ok(measuresAt(model, up).serial < 0.02 && pose(model, up)[2] - z >= 0.99 * amount);
});
