/** One line that says how it stands, for eyes and for screen readers. */

import { el } from "./dom.js";

const NEAR = 0.03;

/** @returns {{kind: "good"|"near"|"stopped", text: string}} */
export function explained({ reason, smallest, serial }) {
  if (reason) return { kind: "stopped", text: reason.text };
  if (smallest < NEAR)
    return { kind: "near", text: "near a parallel singularity: the inputs hardly hold the platform" };
  if (serial < NEAR) return { kind: "near", text: "near a serial singularity: the inputs hardly move the platform" };
  return { kind: "good", text: "" };
}

/** @returns {HTMLElement} the line, spoken when it changes */
export function statusLine(mechanism) {
  const text = el("span");
  const line = el("div", { class: "status", role: "status", "aria-live": "polite" }, text);
  const show = () => {
    const { kind, text: said } = explained(mechanism.state());
    line.dataset.kind = kind;
    if (text.textContent !== said) text.textContent = said;
  };
  mechanism.listen(show);
  show();
  return line;
}
