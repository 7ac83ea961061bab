import assert from "node:assert/strict";
import { test } from "node:test";
import { holding, roundBelow, unwound } from "../src/ends.js";

test("round numbers are 1, 2 and 5 times a power of ten", () => {
  for (const [value, wanted] of [
    [30, 20],
    [50, 50],
    [49.9, 20],
    [0.001, 0.001],
    [0.3, 0.2],
    [1e3, 1e3],
    [9.9, 5],
  ])
    assert.ok(Math.abs(roundBelow(value) - wanted) < 1e-12 * wanted, String(value));
});

test("a slider whose value lies on it keeps its very ends", () => {
  const ends = [-10, 30];
  for (const value of [-10, 0, 30, 30 + 1e-9]) assert.equal(holding(ends, value), ends);
});

test("a value beyond the ends is held, with room, by a round end; the other end stays", () => {
  for (const value of [-396.33, -10.5, 31, 1234.5, 1e6]) {
    const [low, high] = holding([-10, 30], value);
    assert.ok(low < value && value < high);
    assert.ok(value < -10 ? high === 30 && low <= value - 4 : low === -10 && high >= value + 4);
    const step = roundBelow((Math.max(30, value) - Math.min(-10, value)) / 20);
    const moved = value < -10 ? low : high;
    assert.ok(Math.abs(moved / step - Math.round(moved / step)) < 1e-9);
  }
});

test("a whole turn holds every angle", () => {
  for (let value = -20; value < 20; value += 0.37) {
    const found = unwound(value, [-Math.PI, Math.PI]);
    assert.ok(found >= -Math.PI && found <= Math.PI);
    const turns = (value - found) / (2 * Math.PI);
    assert.ok(Math.abs(turns - Math.round(turns)) < 1e-12);
  }
  assert.equal(unwound(5, [0, 6]), 5);
  assert.ok(Math.abs(unwound(6, [-1, 1]) - (6 - 2 * Math.PI)) < 1e-12);
});
