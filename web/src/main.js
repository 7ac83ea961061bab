/** The page: reads the scene, puts everything together, and lets others move the mechanism by `window.assur`. */

import { Mesh, MeshBasicMaterial, SphereGeometry } from "three";
import { controls } from "./controls.js";
import { el, saved } from "./dom.js";
import { statusLine } from "./explain.js";
import { Ghosts } from "./ghosts.js";
import { help, shortcuts, tools } from "./keys.js";
import { linked } from "./link.js";
import { Mechanism } from "./mechanism.js";
import { modeLists } from "./modes.js";
import { check, panel } from "./panel.js";
import { Player } from "./player.js";
import { readout } from "./readout.js";
import { recorder } from "./recorder.js";
import { layerOf } from "./scene/layers.js";
import { Labels } from "./scene/labels.js";
import { body, LinkGeometries } from "./scene/links.js";
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
for (const name of ["configuration", "kernel", "resize"]) if (scene[name]) scene[name] = compiled(scene[name]);

const mechanism = new Mechanism(scene);
const { model } = mechanism;
const app = document.getElementById("app");
const place = el("main", { class: "stage" });
app.replaceChildren(place);

const stage = new Stage(place, { dark: darkness.matches, calm });
stage.canvas.setAttribute("role", "img");
stage.canvas.setAttribute("aria-label", `${scene.title || scene.name} in space`);
const geometries = new LinkGeometries(scene, model);
const current = body(model, geometries);
stage.add(current.group);
const labels = new Labels(scene, model, stage.root);
const point = new Mesh(
  new SphereGeometry(0.011 * scene.extent, 24, 16),
  new MeshBasicMaterial({ color: "#d55e00", toneMapped: false, depthTest: false }),
);
point.renderOrder = 9;
stage.root.add(point);

function paint() {
  stage.setDark(darkness.matches);
  labels.paint(darkness.matches);
  current.tint.color.set(darkness.matches ? "#dde2e9" : "#ffffff");
  placeAll();
}

function placeAll() {
  geometries.resize(mechanism.resized);
  current.place(mechanism.values);
  labels.place(mechanism.values, mechanism.reason);
  point.position.set(...configurationAt(model, mechanism.values).platform.origin);
  stage.moved();
}
paint();
stage.frame(current.group, scene.extent);

const layers = scene.layers.map((layer) => {
  const object = layerOf(layer);
  stage.add(object);
  let wanted = Boolean(layer.visible);
  const show = (on = wanted) => {
    wanted = on;
    const shown = on && !mechanism.resized; // it is of the file's dimensions
    if (shown !== object.visible) stage.keep([Object.assign(object, { visible: shown })], shown);
  };
  show();
  mechanism.listen(() => show());
  return check(layer.label.replaceAll("^2", "²"), wanted, show, layer.colour);
});
const ghosts = new Ghosts(mechanism, geometries, stage, current.group);
const player = new Player(mechanism, stage);
mechanism.listen(placeAll);

const checks = {
  ghosts: check("Ghosts of the other assembly modes", ghosts.shown, (shown) => ghosts.show(shown)),
  letters: check("Letters", true, (shown) => {
    labels.shown = shown;
    stage.invalidate();
  }),
  limits: check("Stop at strokes and joint limits", true, (on) => (mechanism.limits = on)),
};
const view = (name, ...angles) =>
  el("button", { type: "button", class: "plain", onclick: () => stage.look(angles) }, name);
const views = [view("3-D", ...SPACE), view("Front", -90, 0), view("Side", 0, 0), view("Top", -90, 90)];

const { element: status, say } = statusLine(mechanism);
const save = async () => {
  saved(`${scene.name}.png`, await stage.picture());
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
const reset = () => {
  mechanism.reset();
  stage.look();
};
const calls = { r: reset, f: () => stage.look(stage.view.numbers()), s: save, l: share, "?": () => dialog.showModal() };

place.append(el("div", { class: "over" }, heading(scene), status, el("div", { class: "foot" }, readout(mechanism), tools(calls))));
const movers = { sliders: controls(mechanism), modes: modeLists(mechanism, ghosts), player, recorder: recorder(mechanism) };
const side = panel({ scene, ...movers, looks: { checks: Object.values(checks), views: el("div", { class: "modes" }, ...views) }, layers });
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
  ...calls,
  p: () => player.toggle(),
  g: checks.ghosts.press,
  n: checks.letters.press,
  digit: (k) => mechanism.choose(k - 1),
});
darkness.addEventListener("change", paint);
stage.before.push(
  () => root.dataset.ready && ghosts.advance(), // the mechanism itself comes first
  () => stage.follow(),
  () => labels.arrange(stage.view.camera, place.clientWidth, place.clientHeight, stage.scale),
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
