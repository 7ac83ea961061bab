import assert from "node:assert/strict";
import { test } from "node:test";
import { figures, greek, indexed, letterOf, minus } from "../src/dom.js";

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
  assert.equal(greek("platform (epsilon1) is +"), "platform (ε1) is +");
  assert.equal(greek("input theta2 to and fro").slice(0, 6), "input ");
  assert.equal(indexed("rho2"), "rho_2");
  assert.equal(indexed("v"), "v");
});

test("minus signs are true ones in numbers and modes, hyphens stay in words and chains", () => {
  for (const [text, wanted] of [
    ["-1.5", "−1.5"],
    ["z = -1.065, not (-.5)", "z = −1.065, not (−.5)"],
    ["++-++", "++−++"],
    ["-", "−"],
    ["-a", "−a"],
    ["+-b~turned", "+−b~turned"],
    ["mode +-/-- does not exist", "mode +−/−− does not exist"],
    ["10^-3", "10^−3"],
    ["2P4R-R-R of IRB 360-1/1600 on the -Y side", "2P4R-R-R of IRB 360-1/1600 on the -Y side"],
    ["R[0.8,0,-0.6] R[x]", "R[0.8,0,-0.6] R[x]"],
    ["l2 - l3", "l2 - l3"],
  ])
    assert.equal(minus(text), wanted);
});
