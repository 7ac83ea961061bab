/** Lists of assembly and working modes: what a click on a ghost does, for the keyboard and for fingers too. */

import { el, greek, minus } from "./dom.js";
import { COLOURS } from "./ghosts.js";

/** A mode's name as a person reads it, and whether it is that of home. */
export function named({ label, home }) {
  const name = minus(label) || "the only one";
  return home && label !== "home" ? `${name} (home)` : name;
}

/** The name, what is not as usual, and what its signs mean. @param {string[]} said */
function told(item, said, gone = false) {
  const unusual = gone ? "not at these inputs" : item.status === "regular" ? "" : item.status;
  return [unusual ? `${named(item)}: ${unusual}` : named(item), ...said.map(greek)].join("\n");
}

/** @returns {{assembly: HTMLElement, working: HTMLElement}} */
export function modeLists(mechanism, ghosts) {
  const said = mechanism.scene.modes;
  const button = (item, title, choose, given, ...before) => {
    const own = { type: "button", class: "mode", "aria-pressed": "false", title, onclick: choose, ...given };
    return el("button", own, ...before, named(item));
  };
  const ghost = (item, k) => {
    const [light, dim] = [() => ghosts.light(k), () => ghosts.light(-1)];
    const given = { onpointerenter: light, onpointerleave: dim, onfocus: light, onblur: dim };
    const title = told(item, said.assembly.said);
    return button(item, title, () => mechanism.choose(k), given, el("i", { style: `--colour:${COLOURS[k % COLOURS.length]}` }));
  };
  const group = (name) => el("div", { class: "modes", role: "group", "aria-label": name });
  const [assembly, working] = [group("Assembly modes"), group("Working modes")];
  working.append(...mechanism.working.map((item, k) => button(item, told(item, said.working.said), () => mechanism.work(k))));
  const note = el("p", { class: "quiet", hidden: true }, "It stands in none of these, which are those of home’s pose.");
  const pressed = (list, current) =>
    [...list.children].forEach((node, k) => node.setAttribute("aria-pressed", String(k === current)));
  const lone = el("p", { class: "quiet", hidden: true }, "Other assembly modes were not looked for in this working mode.");
  let listed = null;
  let timer = 0;
  const show = () => {
    if (listed !== mechanism.assembly) {
      listed = mechanism.assembly; // of another working mode
      assembly.replaceChildren(...listed.map(ghost));
    }
    lone.hidden = !mechanism.lone;
    pressed(assembly, mechanism.branch);
    clearTimeout(timer);
    const mark = () => {
      const index = mechanism.currentWork();
      pressed(working, index);
      note.hidden = index >= 0;
    };
    if (mechanism.here !== null) mark();
    else timer = setTimeout(mark, 150); // it must be searched for
  };
  ghosts.done = () =>
    [...assembly.children].forEach((node, k) => {
      const gone = k !== mechanism.branch && !mechanism.assembly[k].reached;
      node.classList.toggle("gone", gone);
      node.title = told(listed[k], said.assembly.said, gone);
    });
  mechanism.listen(show);
  show();
  return { assembly: el("div", {}, assembly, lone), working: el("div", {}, working, note) };
}
