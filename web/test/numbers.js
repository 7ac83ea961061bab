/** The numbers that Python made: tests/page/test_page_solver.py keeps them what they are. */

import { readFileSync } from "node:fs";
import { modelOf } from "../src/solver/frames.js";

export const NUMBERS = JSON.parse(readFileSync(new URL("numbers.json", import.meta.url), "utf8"));

/** Every mechanism with its model. */
export const MECHANISMS = Object.entries(NUMBERS).map(([name, found]) => ({
  name,
  ...found,
  model: modelOf(found.scene),
}));

/** One by its name. */
export const mechanism = (name) => MECHANISMS.find((item) => item.name === name);

/** The largest difference of two lists. */
export const apart = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));
