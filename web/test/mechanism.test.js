import assert from "node:assert/strict";
import { test } from "node:test";
import { explained } from "../src/explain.js";
import { Mechanism } from "../src/mechanism.js";
import { apart, mechanism } from "./numbers.js";

const made = () => new Mechanism(mechanism("zeng2019").scene);

test("choosing another assembly keeps the inputs and changes the pose; reset brings home back", () => {
  const it = made();
  const [home, inputs] = [it.pose, it.inputs];
  const there = it.choose(1);
  assert.equal(there.status, "moved");
  assert.ok(apart(there.inputs, inputs) < 1e-9);
  assert.ok(apart(there.pose, home) > 1);
  assert.ok(apart(it.choose(0).pose, home) < 1e-9);
  it.choose(1);
  assert.ok(apart(it.reset().pose, home) < 1e-12);
});

test("working modes keep the pose and change the inputs, and the current one is known", () => {
  const it = made();
  assert.equal(it.currentWork(), 0);
  const [home, inputs] = [it.pose, it.inputs];
  for (let k = 1; k < it.working.length; k++) {
    const there = it.work(k);
    assert.equal(there.status, "moved");
    assert.ok(apart(there.pose, home) < 1e-9);
    assert.ok(apart(there.inputs, inputs) > 1e-3);
    assert.equal(it.currentWork(), k);
  }
});

test("ghosts follow the inputs", () => {
  const it = made();
  it.toInputs(it.inputs.map((value) => value + 2));
  assert.ok(it.follow(1));
  const there = it.choose(1);
  assert.ok(there.residual < 1e-9);
});

test("what is said depends on what stands in the way", () => {
  assert.deepEqual(explained({ reason: null, smallest: 0.5, serial: 0.5 }), { kind: "good", text: "" });
  assert.equal(explained({ reason: null, smallest: 0.01, serial: 0.5 }).kind, "near");
  assert.equal(explained({ reason: { text: "stroke" }, smallest: 0.5, serial: 0.5 }).text, "stroke");
});
