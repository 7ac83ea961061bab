import assert from "node:assert/strict";
import { test } from "node:test";
import { distanceSaid } from "../src/readout.js";

test("a distance says its kind, and whether the search came to its end", () => {
  const said = (amount, kind, over) => distanceSaid({ amount, kind }, over, 280.2, "mm");
  assert.equal(said(59.39, "serial", true), "59.4 mm, serial");
  assert.equal(said(59.39, "passive", true), "59.4 mm, a passive leg");
  assert.equal(said(59.39, "parallel", false), "at most 59.4 mm, parallel");
  assert.equal(said(Infinity, "parallel", true), "none seen within 280 mm");
  assert.equal(said(Infinity, "parallel", false), "none seen yet");
  assert.equal(said(NaN, "parallel", true), "–");
});
