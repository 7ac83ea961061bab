/** The panel: tabs with everything that moves, shows and says something; on a phone a sheet that folds. */

import { el, icon, minus } from "./dom.js";
import { NUMBERS } from "./readout.js";
import { difference, dimensions, errata } from "./source.js";

const section = (title, note, ...content) =>
  el("section", {}, el("h2", {}, title, note ? el("small", {}, note) : null), ...content);

/** A check box with its label; `press` and `put` do what a hand would. */
export function check(label, checked, changed, colour) {
  const box = el("input", { type: "checkbox", onchange: () => changed(box.checked) });
  box.checked = checked;
  const dye = colour ? el("i", { style: `--colour:${colour}` }) : null;
  const press = () => box.click();
  return {
    element: el("label", { class: "check" }, box, dye, el("span", {}, minus(label))),
    read: () => box.checked,
    put: (on) => box.checked !== on && press(),
    press,
  };
}

const elements = (checks) => checks.map(({ element }) => element);

/** Tabs as the keyboard expects them: arrows go from one to the next, Home and End to the first and the last. */
function tabs(pages) {
  const list = el("div", { role: "tablist", class: "tabs", "aria-label": "Panel" });
  const choose = (k, focus) => {
    pages.forEach(({ tab, page }, j) => {
      tab.setAttribute("aria-selected", String(j === k));
      tab.tabIndex = j === k ? 0 : -1;
      page.hidden = j !== k;
    });
    if (focus) pages[k].tab.focus();
  };
  pages.forEach((item, k) => {
    const id = `page-${item.name.toLowerCase()}`;
    const tab = { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": id, onclick: () => choose(k) };
    const page = { role: "tabpanel", id, "aria-labelledby": tab.id, class: "tabpage", tabindex: item.text ? 0 : -1 };
    item.tab = el("button", tab, item.name);
    item.page = el("div", page, ...item.content.filter(Boolean));
    list.append(item.tab);
  });
  list.addEventListener("keydown", (event) => {
    const now = pages.findIndex(({ tab }) => tab === document.activeElement);
    const next = { ArrowRight: now + 1, ArrowLeft: now - 1, Home: 0, End: pages.length - 1 }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    choose((next + pages.length) % pages.length, true);
  });
  choose(0);
  const names = pages.map(({ name }) => name.toLowerCase());
  const chosen = {
    read: () => names[pages.findIndex(({ page }) => !page.hidden)],
    put: (name) => choose(names.indexOf(name)),
  };
  return { list, pages: pages.map(({ page }) => page), names, chosen };
}

/** Facts of the topology, errata of the source and its dimensions. */
function facts(scene) {
  const said = Object.entries(NUMBERS).filter(([key]) => key !== "factor" || scene.kernel);
  const meanings = said.map(([, [title, text]]) => ({ title, text }));
  const pair = ({ title, text }) => el("div", {}, el("dt", {}, title), el("dd", {}, minus(text)));
  const list = (items) => el("dl", { class: "facts" }, ...items.map(pair));
  return [
    scene.facts.length ? section("Topology", "", list(scene.facts)) : null,
    section("Errata of the source", "", errata(scene)),
    scene.parameters.length ? section("Dimensions", difference(scene), dimensions(scene)) : null,
    scene.source ? section("Source", "", el("p", { class: "quiet" }, scene.source)) : null,
    section("What the numbers mean", "", list(meanings)),
  ].filter(Boolean);
}

/** A sentence below what it is about, if there is one. */
const note = (text) => (text ? el("p", { class: "quiet" }, minus(text)) : "");

const count = (list) => (list.length > 1 ? String(list.length) : "");

/** @returns {{element: HTMLElement, tabs: string[], tab: {read: () => string, put: (name: string) => void}}} */
export function panel({ scene, sliders, player, recorder, modes, looks, layers }) {
  const { list, pages, names, chosen } = tabs([
    {
      name: "Move",
      content: [
        section("Inputs", "", sliders.inputs),
        section("Pose", `of ${scene.platform.link}`, sliders.pose),
        section("Course", "", player.element, recorder),
        section("Assembly modes", "", modes.assembly),
        section("Working modes", count(scene.branches.working), modes.working),
        sliders.sizes,
      ],
    },
    {
      name: "Show",
      content: [
        section("Layers", "", ...elements(layers), note(scene.layersNote)),
        section("Drawing", "", ...elements(looks.checks)),
        section("View", "", looks.views),
      ],
    },
    { name: "Facts", text: true, content: facts(scene) },
  ]);
  const { classList } = document.documentElement;
  const folded = (on) => {
    classList.toggle("folded", on);
    fold.setAttribute("aria-expanded", String(!on));
    fold.setAttribute("aria-label", on ? "Unfold the panel" : "Fold the panel");
  };
  const turn = () => folded(!classList.contains("folded"));
  const fold = el("button", { type: "button", class: "fold", onclick: turn }, icon("M6 9l6 6 6-6"));
  folded(false);
  list.addEventListener("click", () => folded(false));
  const bar = el("div", { class: "bar" }, list, fold);
  const element = el("aside", { class: "panel", "aria-label": "Controls" }, bar, ...pages);
  return { element, tabs: names, tab: chosen };
}
