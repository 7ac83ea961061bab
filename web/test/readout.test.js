import assert from "node:assert/strict";
import { test } from "node:test";
import { conditionSaid, distanceSaid } from "../src/readout.js";

test("a distance says its kind, and whether the search came to its end", () => {
  const said = (amount, kind, over) => distanceSaid({ amount, kind }, over, 280.2, "mm");
  assert.equal(said(59.39, "serial", true), "59.4 mm, serial");
  assert.equal(said(59.39, "passive", true), "59.4 mm, a passive leg");
  assert.equal(said(59.39, "parallel", false), "at most 59.4 mm, parallel");
  assert.equal(said(Infinity, "parallel", true), "none seen within 280 mm");
  assert.equal(said(Infinity, "parallel", false), "none seen yet");
  assert.equal(said(NaN, "parallel", true), "–");
});

test("a condition number names its characteristic length where lengths and angles mix", () => {
  const scene = { inputs: [{ kind: "length" }, { kind: "length" }], characteristicLength: 285.35, unit: "mm" };
  const said = (pose, inputs = scene.inputs) => conditionSaid(10.441, { ...scene, platform: { pose }, inputs });
  assert.equal(said(["x", "z"]), "10.4");
  assert.equal(said(["phi", "psi"]), "10.4");
  assert.equal(said(["x", "z", "theta"]), "10.4, L = 285 mm");
  assert.equal(said(["x", "z"], [{ kind: "length" }, { kind: "angle" }]), "10.4, L = 285 mm");
});
