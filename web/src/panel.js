/** The panel: tabs with everything that moves, shows and says something; on a phone a sheet that folds. */

import { el, icon } from "./dom.js";

const section = (title, note, ...content) =>
  el("section", {}, el("h2", {}, title, note ? el("small", {}, note) : null), ...content);

/** A check box with its label. */
export function check(label, checked, changed, colour) {
  const box = el("input", { type: "checkbox", onchange: () => changed(box.checked) });
  box.checked = checked;
  return el(
    "label",
    { class: "check" },
    box,
    colour ? el("i", { style: `--colour:${colour}` }) : null,
    el("span", {}, label),
  );
}

/** Tabs as the keyboard expects them: arrows go from one to the next. */
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
    item.tab = el(
      "button",
      { type: "button", role: "tab", id: `tab-${id}`, "aria-controls": id, onclick: () => choose(k) },
      item.name,
    );
    item.page = el(
      "div",
      { role: "tabpanel", id, "aria-labelledby": `tab-${id}`, class: "tabpage", tabindex: -1 },
      ...item.content,
    );
    list.append(item.tab);
  });
  list.addEventListener("keydown", ({ key }) => {
    const now = pages.findIndex(({ tab }) => tab === document.activeElement);
    const next = { ArrowRight: now + 1, ArrowLeft: now - 1 }[key];
    if (next !== undefined) choose((next + pages.length) % pages.length, true);
  });
  choose(0);
  return { list, pages: pages.map(({ page }) => page) };
}

/** Facts of the topology, errata of the source and its dimensions. */
function facts(scene) {
  const pair = ({ title, text }) => el("div", {}, el("dt", {}, title), el("dd", {}, text));
  const parameter = ({ name, value, unit, meaning }) =>
    el(
      "tr",
      { title: meaning },
      el("th", { scope: "row" }, name),
      el("td", {}, String(Number(value.toPrecision(8)))),
      el("td", {}, unit),
      el("td", {}, meaning),
    );
  return [
    scene.facts.length ? section("Topology", "", el("dl", { class: "facts" }, ...scene.facts.map(pair))) : null,
    section(
      "Errata of the source",
      "",
      ...(scene.errata.length
        ? [
            el(
              "ul",
              { class: "errata" },
              ...scene.errata.map(({ id, text }) => el("li", {}, el("b", {}, id), " ", text)),
            ),
          ]
        : [el("p", { class: "quiet" }, "None are known.")]),
    ),
    scene.parameters.length
      ? section("Dimensions", "", el("table", {}, el("tbody", {}, ...scene.parameters.map(parameter))))
      : null,
    scene.source ? section("Source", "", el("p", { class: "quiet" }, scene.source)) : null,
  ].filter(Boolean);
}

const count = (list) => (list.length > 1 ? String(list.length) : "");

/**
 * @param {object} parts what goes into it, made elsewhere
 * @returns {HTMLElement}
 */
export function panel({ scene, sliders, player, modes, looks, layers }) {
  const { list, pages } = tabs([
    {
      name: "Move",
      content: [
        section("Inputs", "", sliders.inputs),
        section("Pose", `of ${scene.platform.link}`, sliders.pose),
        section("Course", "", player.element),
        section("Assembly modes", "", modes.assembly),
        section("Working modes", count(scene.branches.working), modes.working),
      ],
    },
    {
      name: "Show",
      content: [
        section("Layers", "", ...(layers.length ? layers : [el("p", { class: "quiet" }, "This page has none.")])),
        section("Drawing", "", ...looks.checks),
        section("View", "", looks.views),
      ],
    },
    { name: "Facts", content: facts(scene) },
  ]);
  const fold = el(
    "button",
    {
      type: "button",
      class: "fold",
      "aria-expanded": "true",
      "aria-label": "Fold the panel",
      onclick: () => {
        const folded = document.documentElement.classList.toggle("folded");
        fold.setAttribute("aria-expanded", String(!folded));
        fold.setAttribute("aria-label", folded ? "Unfold the panel" : "Fold the panel");
      },
    },
    icon("M6 9l6 6 6-6"),
  );
  return el("aside", { class: "panel", "aria-label": "Controls" }, el("div", { class: "bar" }, list, fold), ...pages);
}
