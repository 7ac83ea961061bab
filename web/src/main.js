/** The page: reads the scene, puts everything together, and lets others move the mechanism by `window.assur`. */

import { Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import { controls } from "./controls.js";
import { el, icon } from "./dom.js";
import { statusLine } from "./explain.js";
import { Ghosts } from "./ghosts.js";
import { help, shortcuts } from "./keys.js";
import { linked } from "./link.js";
import { Mechanism } from "./mechanism.js";
import { modeLists } from "./modes.js";
import { check, panel } from "./panel.js";
import { Player } from "./player.js";
import { readout } from "./readout.js";
import { layerOf } from "./scene/layers.js";
import { Letters } from "./scene/letters.js";
import { body, linkGeometries } from "./scene/links.js";
import { Marker } from "./scene/marker.js";
import { SPACE, Stage } from "./scene/stage.js";
import { configurationAt } from "./solver/configuration.js";
import { heading } from "./source.js";

const scene = JSON.parse(document.getElementById("scene").textContent);
const root = document.documentElement;
const darkness = matchMedia("(prefers-color-scheme: dark)");
const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Programs are text of functions; a script element of its own runs each, so that no eval is needed. */
function compiled(text) {
  document.head.append(el("script", {}, `window.assur = ${text};`));
  return window.assur;
}
for (const name of ["configuration", "kernel"]) if (scene[name]) scene[name] = compiled(scene[name]);

const mechanism = new Mechanism(scene);
const { model } = mechanism;
const app = document.getElementById("app");
const place = el("main", { class: "stage" });
app.replaceChildren(place);

const stage = new Stage(place, { dark: darkness.matches, calm });
stage.canvas.setAttribute("role", "img");
stage.canvas.setAttribute("aria-label", `${scene.title || scene.name} in space`);
const geometries = linkGeometries(scene, model);
const current = body(model, geometries);
stage.add(current.group);
const letters = new Letters(scene, model, stage.root);
const marker = new Marker(model, stage.root);
const point = new Mesh(
  new SphereGeometry(0.011 * scene.extent, 24, 16),
  new MeshBasicMaterial({ color: "#d55e00", toneMapped: false, depthTest: false }),
);
point.renderOrder = 9;
stage.root.add(point);

function paint() {
  stage.setDark(darkness.matches);
  letters.paint(darkness.matches);
  marker.paint(darkness.matches);
  current.tint.color.set(darkness.matches ? "#dde2e9" : "#ffffff");
  placeAll();
}

function placeAll() {
  current.place(mechanism.values);
  letters.place(mechanism.values);
  marker.show(mechanism.reason, mechanism.values);
  point.position.set(...configurationAt(model, mechanism.values).platform.origin);
  stage.moved();
}
paint();
stage.frame(current.group, scene.extent);

const layers = scene.layers.map((layer) => {
  const object = layerOf(layer);
  object.visible = Boolean(layer.visible);
  stage.add(object);
  const show = (shown) => {
    object.visible = shown;
    stage.keep([object], shown);
  };
  return check(layer.label.replaceAll("^2", "²"), object.visible, show, layer.colour);
});
const ghosts = new Ghosts(mechanism, geometries, stage, current.group);
const player = new Player(mechanism, stage);
mechanism.listen(placeAll);

const checks = {
  ghosts: check("Ghosts of the other assembly modes", ghosts.shown, (shown) => ghosts.show(shown)),
  letters: check("Letters", true, (shown) => {
    letters.shown = shown;
    stage.invalidate();
  }),
  limits: check("Stop at strokes and joint limits", true, (on) => (mechanism.limits = on)),
};
const view = (name, ...angles) =>
  el("button", { type: "button", class: "plain", onclick: () => stage.look(angles) }, name);
const sides = [view("3-D", ...SPACE), view("Front", -90, 0), view("Side", 0, 0), view("Top", -90, 90)];
const views = el("div", { class: "modes" }, ...sides);

const { element: status, say } = statusLine(mechanism);
const save = async () => {
  const link = el("a", { download: `${scene.name}.png`, href: URL.createObjectURL(await stage.picture()) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
  say("picture saved");
};
const share = async () => {
  history.replaceState(null, "", address());
  try {
    await navigator.clipboard.writeText(address());
    say("link copied");
  } catch {
    say("the address above is the link");
  }
};
const dialog = help();
const tool = (label, path, call) =>
  el("button", { type: "button", class: "tool", title: label, "aria-label": label, onclick: call }, icon(path));
const tools = el(
  "div",
  { class: "tools", role: "group", "aria-label": "Tools" },
  tool("Reset (r)", "M4 12a8 8 0 1 0 2.6-5.9M4 4v4.5h4.5", () => reset()),
  tool("Fit the view (f)", "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5", () => stage.fit()),
  tool("Save a picture (s)", "M4 8h3.5L9 5.5h6L16.5 8H20v11H4zM12 10a3.4 3.4 0 1 0 0 6.8 3.4 3.4 0 0 0 0-6.8", save),
  tool(
    "Copy a link to this view (l)",
    "M10 14a4 4 0 0 0 5.7 0l3-3a4 4 0 0 0-5.7-5.7l-1 1M14 10a4 4 0 0 0-5.7 0l-3 3a4 4 0 0 0 5.7 5.7l1-1",
    share,
  ),
  tool("Keys (?)", "M9.2 9a2.9 2.9 0 1 1 4.2 2.6c-.9.5-1.4 1.1-1.4 2.2M12 17.2v.3", () => dialog.showModal()),
);
const reset = () => {
  mechanism.reset();
  stage.look();
};

const foot = el("div", { class: "foot" }, readout(mechanism), tools);
place.append(el("div", { class: "over" }, heading(scene), status, foot));
const side = panel({
  scene,
  sliders: controls(mechanism),
  player,
  modes: modeLists(mechanism, ghosts),
  looks: { checks: Object.values(checks), views },
  layers,
});
app.append(side.element, dialog);
stage.resize();
stage.look();
const drawn = {
  read: () => [...layers.keys()].filter((k) => layers[k].read()),
  put: (wanted) => layers.forEach((layer, k) => layer.put(wanted.includes(k))),
};
const choices = { tab: side.tab, course: player.course, layers: drawn, ...checks };
const known = { tabs: side.tabs, courses: player.courses.length, layers: layers.length };
const address = linked(mechanism, stage, choices, known, say);

shortcuts({
  r: reset,
  f: () => stage.fit(),
  s: save,
  l: share,
  p: () => player.toggle(),
  "?": () => dialog.showModal(),
  g: checks.ghosts.press,
  n: checks.letters.press,
  digit: (k) => mechanism.choose(k - 1),
});
darkness.addEventListener("change", paint);
stage.before.push(
  () => root.dataset.ready && ghosts.advance(), // the mechanism itself comes first
  () => stage.follow(),
  () => {
    const picture = [stage.view.camera, place.clientWidth, place.clientHeight, stage.scale];
    letters.arrange(...picture, marker.arrange(...picture));
  },
  () => {
    if (root.dataset.ready) return;
    requestAnimationFrame(() => {
      root.dataset.ready = "1";
      performance.mark("assur-first-picture");
      stage.invalidate();
    });
  },
);
stage.invalidate();

window.assur = mechanism;
