import assert from "node:assert/strict";
import { test } from "node:test";
import { NearestSingular } from "../src/solver/distance.js";
import { regularKinds, toPose } from "../src/solver/motion.js";
import { poseOf as pose } from "../src/solver/pose.js";
import { measuresAt } from "../src/solver/rates.js";
import { MECHANISMS, mechanism } from "./numbers.js";
import { nearestSingular, random } from "./walks.js";

const FREE = { limits: false };

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

/** Ways along which every search looks, and some others. */
const WAYS = { 2: [[1, 0], [0, -1], [-1, 1], [1, 1]], 3: [[1, 0, 0], [0, -1, 0], [0, 0, 1], [-1, 0, 1], [1, 1, -1], [0, -1, -1]] };

/** Angles in a plane, a closed form with parallelograms, a pose of two lengths; the long run takes the others too. */
const QUICK = ["planar_3rrr", "zeng2019", "fivebar"];
const SEARCHED = MECHANISMS.filter(({ name }) =>
  process.env.ASSUR_DEEP ? name !== "gough_stewart" : QUICK.includes(name), // whose whole search takes too long
);

for (const { name, scene, model } of SEARCHED) {
  test(`${name}: the way is free to all that is nearer, and what was found is nearly singular`, () => {
    const draw = random(5);
    const home = pose(model, scene.home);
    for (let k = process.env.ASSUR_DEEP ? 0 : 1; k < 2; k++) {
      const target = home.map((value, i) => value + (k && model.pose[i].length === 1 ? 0.3 * model.length * (draw() - 0.5) : 0));
      const { values } = toPose(model, scene.home, target, FREE);
      const found = nearestSingular(model, values);
      const start = pose(model, values);
      assert.ok(found.amount <= model.length, `${start}`);
      assert.ok(least(model, nearly(model, values, found.pose)) < Math.max(0.05, 0.1 * least(model, values)));
      assert.ok(Math.abs(found.away(found.pose) - found.amount) < 2e-3 * found.amount + 2e-5 * model.length);
      for (const way of WAYS[found.lengths.length]) {
        const nearer = start.slice();
        found.lengths.forEach((index, j) => (nearer[index] += (0.98 * found.amount * way[j]) / Math.hypot(...way)));
        const there = toPose(model, values, nearer, FREE);
        assert.equal(there.status, "moved", `${start} to ${nearer}: ${there.reason?.text}`);
      }
    }
  });
}

/** The least of the measures, of those that are not 0 everywhere. */
const least = (model, values) => {
  const measured = measuresAt(model, values);
  return Math.min(...regularKinds(model).map((kind) => measured[kind]));
};

/** As near to a pose as the mechanism comes. */
const nearly = (model, values, wanted) => toPose(model, values, wanted, { ...FREE, through: true }).values;

test("it may be stopped at any time, and at the border of the reach the distance is almost none", () => {
  const { model, scene } = mechanism("zeng2019");
  const found = new NearestSingular(model, scene.home);
  const search = found.search();
  assert.equal(search.next().done, false);
  assert.equal(found.amount, Infinity);
  while (!search.next().done);
  assert.ok(found.amount > 0 && found.amount < model.length);
  const [x, y, z] = pose(model, scene.home);
  const border = toPose(model, scene.home, [x, y, z + 100]);
  assert.equal(border.status, "stopped");
  assert.ok(nearestSingular(model, border.values).amount < 0.01);
});
