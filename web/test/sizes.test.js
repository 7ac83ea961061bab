import assert from "node:assert/strict";
import { test } from "node:test";
import { Mechanism } from "../src/mechanism.js";
import { table } from "../src/recorder.js";
import { apart, MECHANISMS, mechanism } from "./numbers.js";

for (const { name, scene, resized } of MECHANISMS)
  test(`${name}: another dimension leads where Python follows it, and back`, () => {
    const it = new Mechanism(scene);
    const [home, own, inputs] = [it.pose, it.model.sizes, it.inputs];
    const there = it.toSizes(resized.sizes);
    assert.equal(there.reason, null);
    assert.ok(it.resized && apart(there.inputs, inputs) < 1e-9 * it.model.length);
    assert.ok(apart(there.pose, resized.pose) < 1e-8 * it.model.length);
    assert.ok(apart(there.pose, home) > 1e-4 * it.model.length);
    assert.ok(Math.abs(it.model.length / resized.length - 1) < 1e-12);
    assert.ok(there.residual < 1e-9 * it.model.length);
    assert.ok(apart(it.toSizes(own).pose, home) < 1e-8 * it.model.length);
  });

test("a dimension stops where the loops cannot close, and says why; reset brings the file's back", () => {
  const it = new Mechanism(mechanism("fivebar").scene);
  const sizes = it.model.sizes.slice();
  const place = it.scene.sizes.findIndex(({ name }) => name === "l2");
  sizes[place] = 1;
  const there = it.toSizes(sizes);
  assert.equal(there.status, "stopped");
  assert.equal(there.reason.kind, "singular");
  assert.ok(it.model.sizes[place] > 1 && it.model.sizes[place] < it.sizes[place]);
  assert.ok(there.residual < 1e-8 * it.model.length);
  it.reset();
  assert.ok(!it.resized && it.state().residual < 1e-9);
});

test("working modes go along to other dimensions", () => {
  const { scene, resized } = mechanism("zeng2019");
  const it = new Mechanism(scene);
  it.toSizes(resized.sizes);
  const pose = it.pose;
  for (const k of [1, 2]) {
    assert.equal(it.work(k).status, "moved");
    assert.ok(apart(it.pose, pose) < 1e-8);
    assert.ok(it.state().residual < 1e-8);
  }
});

test("a table of moments names each column with its unit", () => {
  const scene = {
    unit: "mm", angleUnit: "deg", platform: { pose: ["x", "theta", "qw"] },
    inputs: [{ name: "a1", kind: "angle" }, { name: "d2", kind: "length" }],
  };
  const [head, row, end] = table(scene, [[0.5, 1.25, Math.PI, 1, -Math.PI / 2, 3]]).split("\n");
  assert.equal(head, "t [s],x [mm],theta [deg],qw [1],a1 [deg],d2 [mm]");
  assert.deepEqual(row.split(",").map(Number), [0.5, 1.25, 180, 1, -90, 3]);
  assert.equal(end, "");
});
