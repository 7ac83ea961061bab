/** What the source says: its errata where they belong, and the dimensions, each beside that of the original. */

import { el, minus } from "./dom.js";

/** A dimension with all its digits, as a person reads it. @param {number} value */
const exact = (value) => minus(String(Number(value.toPrecision(8))));

const UNITS = { deg: "°" };

/** Errata in a list, and why there are none. @returns {HTMLElement} */
export function errata({ errata: found, errataNote }) {
  if (!found.length) return el("p", { class: "quiet" }, minus(errataNote));
  const item = ({ id, text }) => el("li", {}, el("b", {}, id), " ", minus(text));
  return el("ul", { class: "errata" }, ...found.map(item));
}

const MANY = 3;

/** What of a mechanism is not as in its original; empty where it is one. @returns {string} */
export function difference({ original, parameters }) {
  if (!original) return "";
  const found = parameters.filter((item) => item.original !== null);
  if (!found.length) return `dimensions of ${original.name}`;
  const one = ({ name, value, original: there }) => `${name} = ${exact(value)} (${original.name}: ${exact(there)})`;
  if (found.length > MANY) return `${found.length} dimensions differ from ${original.name}`;
  return `with ${found.map(one).join(", ")}`;
}

/** The title over the picture, the name under it, and what differs from the original. @returns {HTMLElement} */
export function heading(scene) {
  const { title, name } = scene;
  const below = [title ? name : "", difference(scene)].filter(Boolean).join(": ");
  return el("header", { class: "title" }, el("h1", {}, title || name), el("p", {}, below));
}

/** What follows from dimensions that are not the file's, and how to have them everywhere. @returns {string} */
export function sizesNote({ resized, model, sizes, scene }) {
  const fixed = scene.sizesFixed.join(", ");
  if (!resized) return fixed && `${fixed}: strokes or limits of the file depend on them, so they stay.`;
  const shown = (value, unit) => Number((unit === "deg" ? value * (180 / Math.PI) : value).toPrecision(6));
  const set = ({ name, unit }, k) => (model.sizes[k] === sizes[k] ? [] : [`--set ${name}=${shown(model.sizes[k], unit)}`]);
  const changed = scene.sizes.flatMap(set);
  return `Links are drawn as bars, and layers are left out, until r resets all. For a whole page: assur page … ${changed.join(" ")}`;
}

/** A table of the dimensions, and what differs; those that are not the original's have both values. */
export function dimensions(scene) {
  const { parameters, original } = scene;
  const row = ({ name, value, unit, meaning, original: other }) => {
    const was = other === null ? null : el("div", { class: "was" }, `${original.name}: ${exact(other)}`);
    const cells = [[exact(value)], [UNITS[unit] ?? unit], [minus(meaning), was]].map((cell) => el("td", {}, ...cell));
    return el("tr", { class: was ? "differs" : null }, el("th", { scope: "row" }, name), ...cells);
  };
  return el("table", {}, el("tbody", {}, ...parameters.map(row)));
}
