import assert from "node:assert/strict";
import { test } from "node:test";
import { difference } from "../src/source.js";

const one = (name, value, original) => ({ name, value, original });

test("what differs from the original is said, each dimension if they are few", () => {
  const parameters = [one("l1", -300, -280), one("l2", 30, null)];
  assert.equal(difference({ original: null, parameters }), "");
  assert.equal(difference({ original: { name: "its file" }, parameters }), "with l1 = −300 (its file: −280)");
  assert.equal(difference({ original: { name: "b" }, parameters: [one("l2", 30, null)] }), "dimensions of b");
  const many = [1, 2, 3, 4].map((value) => one(`l${value}`, value, 0));
  assert.equal(difference({ original: { name: "b" }, parameters: many }), "4 dimensions differ from b");
});
