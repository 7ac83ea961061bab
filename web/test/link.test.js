import assert from "node:assert/strict";
import { test } from "node:test";
import { hashOf, packed, readHash, unpacked } from "../src/link.js";
import { apart } from "./numbers.js";

test("an address brings back what it says", () => {
  const values = [1.5, -2.25e-3, 1e5, 0];
  const found = readHash(hashOf({ branch: 2, values, camera: [-52, 24, 3.25, 0, 0, 0.5] }), { count: 4, branches: 3 });
  assert.equal(found.branch, 2);
  assert.deepEqual(found.camera, [-52, 24, 3.25, 0, 0, 0.5]);
  assert.ok(apart(found.values, values) < 1e-2);
});

test("an address that makes no sense changes nothing", () => {
  for (const hash of [
    "",
    "#",
    "#mode=9&joints=!!&view=1,2",
    "#mode=-1&joints=AAAA&view=a,b,c,d,e,f",
    `#joints=${packed([NaN, 1])}`,
  ])
    assert.deepEqual(readHash(hash, { count: 2, branches: 3 }), { branch: null, values: null, camera: null });
});

test("numbers of another mechanism are not taken", () => {
  assert.equal(unpacked(packed([1, 2, 3]), 4), null);
});
