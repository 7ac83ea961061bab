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

/** A table of the dimensions, and what differs; those that are not the original's have both values. */
export function dimensions(scene) {
  const { parameters, original } = scene;
  const row = ({ name, value, unit, meaning, original: other }) => {
    const was = other === null ? null : el("div", { class: "was" }, `${original.name}: ${exact(other)}`);
    return el(
      "tr",
      { class: was ? "differs" : null },
      el("th", { scope: "row" }, name),
      el("td", {}, exact(value)),
      el("td", {}, UNITS[unit] ?? unit),
      el("td", {}, minus(meaning), was),
    );
  };
  return el("table", {}, el("tbody", {}, ...parameters.map(row)));
}
