/** One line that says how it stands, for eyes and for screen readers. */

import { el, minus } from "./dom.js";

/** A measure below it is called near to a singularity. */
export const NEAR = 0.03;
const SAID = 4000; // milliseconds that a word stays that is not about the mechanism

/** @returns {{kind: "good"|"near"|"stopped", text: string}} */
export function explained({ reason, smallest, serial }) {
  if (reason) return { kind: "stopped", text: minus(reason.text) };
  if (smallest < NEAR)
    return { kind: "near", text: "near a parallel singularity: the inputs hardly hold the platform" };
  if (serial < NEAR) return { kind: "near", text: "near a serial singularity: the inputs hardly move the platform" };
  return { kind: "good", text: "" };
}

/** @returns {{element: HTMLElement, say: (text: string) => void}} the line, spoken when it changes; `say` a word there */
export function statusLine(mechanism) {
  const text = el("span");
  const element = el("div", { class: "status", role: "status", "aria-live": "polite" }, text);
  const write = (kind, said) => {
    element.dataset.kind = kind;
    if (text.textContent !== said) text.textContent = said;
  };
  let timer = 0;
  const show = () => {
    clearTimeout(timer);
    const { kind, text: said } = explained(mechanism.state());
    write(kind, said);
  };
  const say = (said) => {
    write("said", said);
    clearTimeout(timer);
    timer = setTimeout(show, SAID);
  };
  mechanism.listen(show);
  show();
  return { element, say };
}
