/** Keys that do what buttons do, and the dialog that lists them. */

import { el, icon } from "./dom.js";

const KEYS = [
  ["Tab", "next control"],
  ["← →", "move a slider by a round step, or the next tab"],
  ["PgUp PgDn", "move a slider by ten steps"],
  ["1 – 9", "choose an assembly mode"],
  ["p", "play or pause the course"],
  ["g", "ghosts"],
  ["n", "letters"],
];

/** Keys that have a button, which says what they do by an icon. */
const ICONS = {
  r: ["Reset", "M4 12a8 8 0 1 0 2.6-5.9M4 4v4.5h4.5"],
  f: ["Fit the view", "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5"],
  s: ["Save a picture", "M4 8h3.5L9 5.5h6L16.5 8H20v11H4zM12 10a3.4 3.4 0 1 0 0 6.8 3.4 3.4 0 0 0 0-6.8"],
  l: ["Copy a link to this view", "M10 14a4 4 0 0 0 5.7 0l3-3a4 4 0 0 0-5.7-5.7l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1"],
  "?": ["Keys", "M9.2 9a2.9 2.9 0 1 1 4.2 2.6c-.9.5-1.4 1.1-1.4 2.2M12 17.2v.3"],
};

/** Buttons for calls, each with its key. @param {Record<string, Function>} calls */
export function tools(calls) {
  const button = ([key, [name, path]]) => {
    const label = `${name} (${key})`;
    const given = { type: "button", class: "tool", title: label, "aria-label": label, onclick: calls[key] };
    return el("button", given, icon(path));
  };
  return el("div", { class: "tools", role: "group", "aria-label": "Tools" }, ...Object.entries(ICONS).map(button));
}

const GESTURES =
  "Drag to turn, wheel or two fingers to zoom, right button or two fingers to shift. Click a ghost to make it current.";

/** @returns {HTMLDialogElement} */
export function help() {
  const keys = [...KEYS, ...Object.entries(ICONS).map(([key, [name]]) => [key, name.toLowerCase()])];
  const title = el("h2", { id: "help-title" }, "Keys and gestures");
  const row = ([key, text]) => el("div", {}, el("dt", {}, el("kbd", {}, key)), el("dd", {}, text));
  const close = el("form", { method: "dialog" }, el("button", { class: "plain", autofocus: true }, "Close"));
  const content = [title, el("dl", {}, ...keys.map(row)), el("p", { class: "quiet" }, GESTURES), close];
  const dialog = el("dialog", { class: "help", "aria-labelledby": title.id }, ...content);
  dialog.addEventListener("click", (event) => event.target === dialog && dialog.close());
  return dialog;
}

/** Calls what belongs to a key, unless something is being typed. @param {Record<string, Function>} calls */
export function shortcuts(calls) {
  addEventListener("keydown", (event) => {
    if (event.repeat || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    if (event.target.matches?.("input[type=number], select, textarea")) return;
    const digit = /^[1-9]$/.test(event.key) ? Number(event.key) : 0;
    if (digit) calls.digit(digit);
    else if (calls[event.key]) calls[event.key]();
    else return;
    event.preventDefault();
  });
}
