/** The numbers that Python made: tests/page/test_page_solver.py keeps them what they are. */

import { readFileSync } from "node:fs";
import { modelOf } from "../src/solver/configuration.js";
import { compiled } from "./compiled.js";

const NUMBERS = JSON.parse(readFileSync(new URL("numbers.json", import.meta.url), "utf8"));

const made = ([name, found]) => {
  const scene = compiled(found.scene);
  return { name, ...found, scene, model: modelOf(scene) };
};
const ALL = Object.entries(NUMBERS).map(made);

/** Every mechanism of the catalogue that is among them, with its model. */
export const MECHANISMS = ALL.filter(({ loose }) => loose);

/** One by its name. */
export const mechanism = (name) => ALL.find((item) => item.name === name);

/** The largest difference of two lists. */
export const apart = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));
