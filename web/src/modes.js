/** Lists of assembly and working modes: what a click on a ghost does, for the keyboard and for fingers too. */

import { el } from "./dom.js";
import { COLOURS } from "./ghosts.js";

/** A mode's signs with true minus signs, so that they are as wide as plus signs. */
const label = (text, k) => (/^[+-]/.test(text) ? text.replace(/-/g, "−") : text || `mode ${k + 1}`);

/** @returns {{assembly: HTMLElement, working: HTMLElement}} */
export function modeLists(mechanism, ghosts) {
  const button = (item, k, colour, choose) =>
    el(
      "button",
      {
        type: "button",
        class: "mode",
        "aria-pressed": "false",
        title: item.status && item.status !== "regular" ? `${item.label}: ${item.status}` : item.label,
        onclick: choose,
        ...(colour
          ? {
              onpointerenter: () => ghosts.light(k),
              onpointerleave: () => ghosts.light(-1),
              onfocus: () => ghosts.light(k),
              onblur: () => ghosts.light(-1),
            }
          : {}),
      },
      colour ? el("i", { style: `--colour:${colour}` }) : null,
      label(item.label, k),
    );
  const group = (name) => el("div", { class: "modes", role: "group", "aria-label": name });
  const [assembly, working] = [group("Assembly modes"), group("Working modes")];
  working.append(...mechanism.working.map((item, k) => button(item, k, null, () => mechanism.work(k))));
  const pressed = (list, current) =>
    [...list.children].forEach((node, k) => node.setAttribute("aria-pressed", String(k === current)));
  let listed = null;
  let timer = 0;
  const show = () => {
    if (listed !== mechanism.assembly) {
      listed = mechanism.assembly; // of another working mode
      assembly.replaceChildren(
        ...listed.map((item, k) => button(item, k, COLOURS[k % COLOURS.length], () => mechanism.choose(k))),
      );
    }
    pressed(assembly, mechanism.branch);
    clearTimeout(timer);
    timer = setTimeout(() => pressed(working, mechanism.currentWork()), 150);
  };
  ghosts.done = () =>
    [...assembly.children].forEach((node, k) =>
      node.classList.toggle("gone", k !== mechanism.branch && !mechanism.assembly[k].reached),
    );
  mechanism.listen(show);
  show();
  return { assembly, working };
}
