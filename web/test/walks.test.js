import assert from "node:assert/strict";
import { test } from "node:test";
import { MECHANISMS } from "./numbers.js";
import { walked } from "./walks.js";

const MOVES = process.env.ASSUR_DEEP ? 10 : 6; // of these seven; Python's tests walk more, with every mechanism of the catalogue
const SELDOM = { three_crr: 6 }; // stopped seldom: so many times as many moves

for (const { name, model } of MECHANISMS)
  test(`${name}: no stop is a trap, and every reason is true`, () => {
    const { faults, stops } = walked(model, { moves: MOVES * (SELDOM[name] ?? 1), seed: 6 });
    assert.deepEqual(faults, []);
    assert.ok(Object.keys(stops).length > 0);
  });
