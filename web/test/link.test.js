import assert from "node:assert/strict";
import { test } from "node:test";
import { hashOf, packed, readHash, unpacked } from "../src/link.js";
import { apart } from "./numbers.js";

const KNOWN = { count: 4, sizes: 2, tabs: ["move", "show", "facts"], courses: 5, layers: 3 };
const UNHARMED = ["", "#"];
const NONE = { tab: null, course: null, layers: null, ghosts: null, letters: null, limits: null };

test("an address brings back what it says", () => {
  const values = [1.5, -2.25e-3, 1e5, 0];
  const camera = [-52, 24, 3.25, 0, 0, 0.5];
  for (const choices of [
    { tab: "show", course: 4, layers: [0, 2], ghosts: false, letters: true, limits: false },
    { tab: "facts", course: 0, layers: [], ghosts: true, letters: false, limits: true },
  ]) {
    const found = readHash(hashOf({ mode: "+-b~Pa1", values, sizes: [70, 0.5], camera, choices }), KNOWN);
    assert.deepEqual(found.sizes, [70, 0.5]);
    assert.equal(found.mode, "+-b~Pa1");
    assert.deepEqual(found.camera, camera);
    assert.ok(apart(found.values, values) < 1e-2);
    assert.deepEqual(found.choices, choices);
  }
});

test("an address that the page wrote is never called damaged", () => {
  const choices = { tab: "move", course: 0, layers: [], ghosts: true, letters: true, limits: true };
  for (const mode of ["", "+", "--", "0+a", "a", "home", "this one"]) {
    const hash = hashOf({ mode, values: [0, 1, 2, 3], camera: [-52, 24, 3.25, 0, 0, 0.5], choices });
    const found = readHash(hash, KNOWN);
    assert.equal(found.damaged, false, hash);
    assert.equal(found.mode, mode || null);
    assert.ok(apart(found.values, [0, 1, 2, 3]) < 1e-6);
  }
});

test("an address of before there were choices says nothing of them", () => {
  const found = readHash(`#mode=%2B&joints=${packed([1, 2, 3, 4])}&view=-52,24,3.25,0,0,0.5`, KNOWN);
  assert.deepEqual(found, {
    mode: "+", damaged: false, values: [1, 2, 3, 4], sizes: null, camera: [-52, 24, 3.25, 0, 0, 0.5], choices: NONE,
  });
});

test("an address that makes no sense changes nothing", () => {
  for (const hash of [
    "",
    "#",
    "#mode=9%2F2&joints=!!&view=1,2",
    `#sizes=${packed([1, 2, 3])}`,
    "#mode=&joints=&view=&tab=&course=&ghosts=&letters=&limits=",
    "#mode=%3C&joints=AAAA&view=a,b,c,d,e,f",
    `#joints=${packed([NaN, 1, 1, 1])}&view=1,,1,0,0,0`,
    "#view=1,1,1,1e9,0,0&tab=__proto__&course=5&layers=0,3&ghosts=yes&letters=2&limits=-1",
    "#layers=0,&course=1.5&tab=Show&ghosts=constructor&mode=%00",
    "#layers=,&view=0,0,-1,0,0,0&%E0%A4%A&&&=",
  ])
    assert.deepEqual(
      readHash(hash, KNOWN),
      { mode: null, values: null, sizes: null, camera: null, choices: NONE, damaged: !UNHARMED.includes(hash) },
      hash,
    );
});

test("numbers of another mechanism are not taken", () => {
  assert.equal(unpacked(packed([1, 2, 3]), 4), null);
});
