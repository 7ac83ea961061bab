/** Small helpers for the page's elements and the text in them. */

/** An element. @param {Record<string, any>} given attributes; on... are listeners */
export function el(tag, given = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(given)) {
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else if (value !== false && value !== null) node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null));
  return node;
}

const LETTERS =
  "alpha α, beta β, gamma γ, delta δ, epsilon ε, theta θ, phi φ, varphi φ, psi ψ, rho ρ, lambda λ, mu μ, omega ω, kappa κ, xi ξ, " +
  "eta η, sigma σ, tau τ";
const GREEK = Object.fromEntries(LETTERS.split(", ").map((pair) => pair.split(" ")));

/** Greek letters for their names. @param {string} text */
export const greek = (text) =>
  text.replace(/\\?([A-Za-z]+)/g, (whole, name) => GREEK[name] ?? (whole[0] === "\\" ? "" : whole));

/** A symbol written in LaTeX's way, with its index below the line. */
export function symbol(latex) {
  const plain = greek(latex).replace(/[$\s]/g, "");
  const [, base, index] = /^([^_]*)_?(.*)$/.exec(plain);
  const clean = (text) => text.replace(/[{}_]/g, "");
  const node = el("var", {}, clean(base));
  if (index) node.append(el("sub", {}, clean(index)));
  return node;
}

/** Names of joint values and dimensions have their index without a line: q1, rho2, sB, betaH. */
export const indexed = (name) => name.replace(/^([A-Za-z]+?)_?(\d+)$|^([a-z]+)([A-Z]\w*)$/, "$1$3_$2$4");

/** A factor's name as a person writes it: "u1_minus_u2" is u1 − u2, "sin_alpha" is sin α. @returns {HTMLElement} */
export function spelt(name) {
  const words = name.split("_").map((word) => {
    if (word === "minus") return " \u2212 ";
    return /^[a-z]\d?$/i.test(word) || GREEK[word] ? symbol(indexed(word)) : `${word} `;
  });
  return el("span", {}, ...words);
}

/** A point's name as a letter and its index, its own or its leg's: "leg2.K" is K 2. @returns {[string, string]} */
export function letterOf(name) {
  const [, leg, own] = /^(?:.*?(\d*)\.)?([^.]*)$/.exec(name) ?? [null, "", name];
  const [, letter, index] = /^([^\d_]*)_?(.*)$/.exec(own);
  return letter ? [letter, index || leg || ""] : [own, ""];
}

/** Negative numbers, and signs that name a mode, alone or among words. */
const HYPHENS = /(?<![^\s(=±≈<>^])(?:-(?=[\d.∞])|[+-][+/-]*[+-](?![^\s),.:;]))|^[+-]+[a-z]?(?:~[a-z]+)?$/g;

/** Text as a person reads it: true minus signs; the hyphens of words, chains and formulas stay. @param {string} text */
export const minus = (text) => text.replace(HYPHENS, (found) => found.replaceAll("-", "\u2212"));

/** A number with so many figures, as a person reads it. */
export function figures(value, count = 4) {
  if (value === Infinity) return "∞";
  if (!Number.isFinite(value)) return "–";
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6)) {
    const [mantissa, power] = value.toExponential(1).split("e");
    return `${minus(mantissa)}·10${[...String(Number(power))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻").join("")}`;
  }
  return minus(String(Number(value.toPrecision(count))));
}

/** Saves a file. @param {Blob} blob */
export function saved(name, blob) {
  const link = el("a", { download: name, href: URL.createObjectURL(blob) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** How lengths, or angles, are shown: their unit, and how many of it a length or a radian is. */
export const shownUnit = ({ unit, angleUnit }, length) =>
  length ? { unit, factor: 1 } : angleUnit === "deg" ? { unit: "°", factor: 180 / Math.PI } : { unit: "rad", factor: 1 };

/** An icon by its strokes on 24 x 24, for buttons that also have a label. */
export function icon(path) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.innerHTML = `<path d="${path}"/>`;
  return svg;
}
