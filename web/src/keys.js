/** Keys that do what buttons do, and the dialog that lists them. */

import { el } from "./dom.js";

const KEYS = [
  ["Tab", "next control"],
  ["← →", "move a slider by a round step, or the next tab"],
  ["PgUp PgDn", "move a slider by ten steps"],
  ["1 – 9", "choose an assembly mode"],
  ["p", "play or pause the course"],
  ["r", "reset"],
  ["f", "fit the view"],
  ["g", "ghosts"],
  ["n", "letters"],
  ["s", "save a picture"],
  ["l", "copy a link"],
  ["?", "this list"],
];

const GESTURES =
  "Drag to turn, wheel or two fingers to zoom, right button or two fingers to shift. Click a ghost to make it current.";

/** @returns {HTMLDialogElement} */
export function help() {
  const dialog = el(
    "dialog",
    { class: "help", "aria-labelledby": "help-title" },
    el("h2", { id: "help-title" }, "Keys and gestures"),
    el("dl", {}, ...KEYS.map(([key, text]) => el("div", {}, el("dt", {}, el("kbd", {}, key)), el("dd", {}, text)))),
    el("p", { class: "quiet" }, GESTURES),
    el("form", { method: "dialog" }, el("button", { class: "plain", autofocus: true }, "Close")),
  );
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
