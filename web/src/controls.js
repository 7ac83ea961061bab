/** Sliders: one for each input and each coordinate of the pose, with a number beside it; both say the same state. */

import { el, figures, indexed, minus, shownUnit, symbol } from "./dom.js";
import { holding, rangeOf, roundBelow, unwound } from "./ends.js";
import { sizesNote } from "./source.js";
import { isLength, poseOfShown, shownPose } from "./solver/pose.js";

const STEPS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
const STEP = 100; // an arrow key goes a round number that is at most this part of the slider

let made = 0;

/** One slider with its number. What is inside is in lengths and rad, what is shown in the scene's units. */
class Slider {
  /** @param {object} given its ends are those of the range, unless what it shows lies beyond; `turns`: an angle that may wind */
  constructor({ label, name, range, unit, factor, places, turns, stroke }, moved) {
    const ends = range.map((end) => end * factor);
    Object.assign(this, { factor, unit, places, turns, stroke, moved, least: ends, value: range[0] });
    const id = `slider-${(made += 1)}`;
    this.why = el("p", { class: "why", id: `${id}-why` });
    const drawn = { oninput: () => this.ask(this.range.valueAsNumber), onkeydown: (event) => this.pressed(event) };
    this.range = el("input", { type: "range", id, step: "any", "aria-describedby": this.why.id, ...drawn });
    const typed = { inputmode: "decimal", onbeforeinput: pointed, onchange: () => this.typed() };
    const step = 10 ** -Math.min(2, this.places);
    this.number = el("input", { type: "number", step, "aria-label": `${name} in ${unit}`, ...typed });
    [this.low, this.note, this.high] = [el("span"), el("span"), el("span")];
    const amount = el("span", { class: "amount" }, this.number, el("span", { class: "unit" }, unit));
    const low = el("div", { class: "ends", "aria-hidden": "true" }, this.low, this.note, this.high);
    const head = el("label", { for: id, title: name }, label);
    this.row = el("div", { class: "slider" }, head, this.range, amount, low, this.why);
    this.span(ends);
  }

  /** Takes ends, in what is shown. */
  span(ends) {
    this.ends = ends;
    [this.range.min, this.range.max] = ends;
    [this.low.textContent, this.high.textContent] = ends.map((end) => figures(end));
    const beyond = ends[0] < this.least[0] || ends[1] > this.least[1];
    this.note.textContent = this.stroke ? (beyond ? "beyond the stroke" : "stroke") : "";
  }

  /** Asks for a value as it is shown, inside the ends; a turning angle with as many turns as it has made. */
  ask(shown) {
    const [low, high] = this.ends;
    const inside = Math.min(high, Math.max(low, this.wound(shown)));
    this.moved(this.value + (inside - this.shown(this.value)) / this.factor);
  }

  /** An angle as the slider shows it. */
  wound(shown) {
    return this.turns ? unwound(shown / this.factor, this.ends.map((end) => end / this.factor)) * this.factor : shown;
  }

  shown(value) {
    return this.wound(value * this.factor);
  }

  /** Keys go by round numbers, in every browser. */
  pressed(event) {
    const count = STEPS[event.key];
    if (!count || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const step = roundBelow((this.ends[1] - this.ends[0]) / STEP);
    const at = this.shown(this.value) / step;
    this.ask(step * (count > 0 ? Math.floor(at + 1e-6) : Math.ceil(at - 1e-6)) + step * count);
  }

  /** A number that was typed; what is none goes back, and what lies beyond the ends is said to. */
  typed() {
    const wanted = this.number.valueAsNumber;
    if (!Number.isFinite(wanted)) return this.show(this.value);
    const [low, high] = this.ends;
    const beyond = this.wound(wanted) < low || this.wound(wanted) > high;
    this.ask(wanted);
    if (!beyond) return;
    const where = this.stroke ? "the stroke" : "this slider";
    this.stop(`${minus(figures(wanted))} is beyond ${where}: ${this.why.textContent || "its end was taken"}`);
  }

  /** Shows a value; its ends go as far as it needs, and back to those of the range when a mode is chosen. */
  show(value, anew) {
    this.value = value;
    if (anew) this.ends = this.least;
    const shown = this.shown(value);
    const ends = holding(this.ends, shown);
    if (anew || ends !== this.ends) this.span(ends);
    this.range.value = shown;
    const share = (shown - ends[0]) / (ends[1] - ends[0]);
    this.range.style.setProperty("--share", `${100 * Math.min(1, Math.max(0, share))}%`);
    this.range.setAttribute("aria-valuetext", `${figures(shown)} ${this.unit}`);
    this.number.value = shown.toFixed(this.places).replace(/^-(?=[0.]*$)/, "");
  }

  /** Red with a reason, or with one that another slider says; as usual with none. */
  stop(text, red = false) {
    this.row.classList.toggle("stopped", Boolean(text || red));
    this.range.setAttribute("aria-invalid", String(Boolean(text || red)));
    if (this.why.textContent !== text) this.why.textContent = text;
  }
}

/** A decimal comma is typed as a point: browsers that know the point alone would leave it out, 90,5 would be 905. */
function pointed(event) {
  if (event.data !== ",") return;
  event.preventDefault();
  document.execCommand("insertText", false, ".");
}

const replaced = (values, k, value) => values.map((other, j) => (j === k ? value : other));

/** @returns {{inputs: HTMLElement, pose: HTMLElement, sizes: HTMLElement|null}} groups of sliders, which follow the state */
export function controls(mechanism) {
  const { scene, model } = mechanism;
  const fine = Math.min(6, Math.max(0, 3 - Math.floor(Math.log10(scene.extent))));
  const places = (length) => (length ? fine : scene.angleUnit === "deg" ? 2 : 4);
  const winds = ({ kind, counted }) => kind !== "length" && !counted; // a screw's turns are never wound back
  let last = null;
  const sliderOf = (length, given, change) => {
    const slider = new Slider({ ...shownUnit(scene, length), places: places(length), ...given }, (value) => {
      last = slider;
      change(value);
    });
    return slider;
  };
  const inputs = scene.inputs.map((item, k) => {
    const { name, kind, range, stroke } = item;
    const given = { label: symbol(item.latex || indexed(name)), name, range, stroke, turns: winds(item) };
    return sliderOf(kind === "length", given, (value) => mechanism.toInputs(replaced(mechanism.inputs, k, value)));
  });
  const shown = () => shownPose(model, mechanism.pose);
  const pose = shown().names.map((name, k) => {
    const length = isLength(name);
    const given = { label: symbol(name), name, range: rangeOf(name, mechanism), stroke: null, turns: !length };
    const change = (value) => mechanism.toPose(poseOfShown(model, replaced(shown().values, k, value)));
    return sliderOf(length, given, change);
  });
  const sizes = scene.sizes.map((size, k) => {
    const { name, unit, range } = size;
    const pure = unit ? {} : { unit, factor: 1, places: 4 };
    const given = { label: symbol(indexed(name)), name, range, stroke: null, turns: false, ...pure };
    const change = (value) => mechanism.toSizes(replaced(model.sizes, k, value));
    return sliderOf(unit === scene.unit, given, change);
  });
  const words = el("p", { class: "quiet" });
  const show = (anew) => {
    model.sizes.forEach((value, k) => sizes[k].show(value, anew));
    words.textContent = sizesNote(mechanism);
    mechanism.inputs.forEach((value, k) => inputs[k].show(value, anew));
    shown().values.forEach((value, k) => pose[k].show(value, anew));
    const { reason } = mechanism;
    const blamed = reason && inputs[scene.inputs.findIndex((item) => item.name === reason.joint)];
    for (const slider of [...inputs, ...pose, ...sizes])
      slider.stop(reason && slider === (last ?? blamed) ? minus(reason.text) : "", reason && slider === blamed);
  };
  mechanism.listen((what) => {
    if (what === "mode") last = null;
    show(what === "mode");
  });
  show(true);
  const group = (name, sliders) =>
    el("div", { class: "sliders", role: "group", "aria-label": name }, ...sliders.map(({ row }) => row));
  const own = el("details", { class: "sizes" }, el("summary", {}, "Dimensions"), group("Dimensions", sizes), words);
  return { inputs: group("Inputs", inputs), pose: group("Pose of the platform", pose), sizes: sizes.length ? own : null };
}
