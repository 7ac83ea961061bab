import assert from "node:assert/strict";
import { test } from "node:test";
import { figures, greek, indexed, letterOf } from "../src/dom.js";

test("a letter has its own index, or its leg's", () => {
  assert.deepEqual(letterOf("C2"), ["C", "2"]);
  assert.deepEqual(letterOf("leg3.K"), ["K", "3"]);
  assert.deepEqual(letterOf("leg3.B1"), ["B", "1"]);
  assert.deepEqual(letterOf("O'"), ["O'", ""]);
  assert.deepEqual(letterOf("7"), ["7", ""]);
});

test("numbers as a person reads them", () => {
  assert.equal(figures(-12.3456, 4), "−12.35");
  assert.equal(figures(1.94e-13, 2), "1.9·10⁻¹³");
  assert.equal(figures(Infinity), "∞");
  assert.equal(figures(NaN), "–");
  assert.equal(figures(0), "0");
});

test("names become symbols", () => {
  assert.equal(greek("\\theta_1"), "θ_1");
  assert.equal(greek("input theta2 to and fro").slice(0, 6), "input ");
  assert.equal(indexed("rho2"), "rho_2");
  assert.equal(indexed("v"), "v");
});
