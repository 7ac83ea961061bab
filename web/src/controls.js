/** Sliders: one for each input and each coordinate of the pose, with a number beside it; both say the same state. */

import { el, figures, indexed, symbol } from "./dom.js";
import { isLength, poseOfShown, shownPose } from "./solver/pose.js";

const DEGREE = 180 / Math.PI;

/**
 * One slider with its number. What is inside is in lengths and rad, what is shown in the scene's units.
 */
class Slider {
  constructor({ label, name, low, high, unit, factor, note }, moved) {
    Object.assign(this, { factor, low, high, value: low });
    this.places = Math.max(0, Math.min(6, 3 - Math.floor(Math.log10(Math.max(1e-9, (high - low) * factor)))));
    const id = `slider-${name.replace(/\W/g, "-")}`;
    this.range = el("input", {
      type: "range",
      id,
      min: low * factor,
      max: high * factor,
      step: "any",
      "aria-describedby": `${id}-why`,
      oninput: () => moved(this.range.valueAsNumber / factor),
      onchange: () => this.settled?.(),
    });
    this.number = el("input", {
      type: "number",
      step: 10 ** -Math.min(2, this.places),
      "aria-label": `${name} in ${unit}`,
      inputmode: "decimal",
      onchange: () => this.typed(moved),
    });
    this.why = el("p", { class: "why", id: `${id}-why` });
    this.ends = el(
      "div",
      { class: "ends", "aria-hidden": "true" },
      el("span", {}, figures(low * factor)),
      el("span", {}, note),
      el("span", {}, figures(high * factor)),
    );
    this.row = el(
      "div",
      { class: "slider" },
      el("label", { for: id, title: name }, label),
      this.range,
      el("span", { class: "amount" }, this.number, el("span", { class: "unit" }, unit)),
      this.ends,
      this.why,
    );
  }

  /** A number that was typed: kept inside the slider's ends, or where it stands beyond them; what is none goes back. */
  typed(moved) {
    const wanted = this.number.valueAsNumber / this.factor;
    if (!Number.isFinite(wanted)) return this.show(this.value);
    const [low, high] = [Math.min(this.low, this.value), Math.max(this.high, this.value)];
    return moved(Math.min(high, Math.max(low, wanted)));
  }

  show(value) {
    this.value = value;
    const shown = value * this.factor;
    this.range.value = shown;
    this.range.setAttribute("aria-valuetext", `${figures(shown)}`);
    const share = (shown - this.range.min) / (this.range.max - this.range.min);
    this.range.style.setProperty("--share", `${100 * Math.min(1, Math.max(0, share))}%`);
    this.number.value = shown.toFixed(this.places).replace(/^-(?=[0.]*$)/, "");
  }

  /** Red with a reason, or as usual with none. */
  stop(text) {
    this.row.classList.toggle("stopped", Boolean(text));
    this.range.setAttribute("aria-invalid", String(Boolean(text)));
    if (this.why.textContent !== text) this.why.textContent = text;
  }
}

/** @returns {{inputs: HTMLElement, pose: HTMLElement, show: () => void}} both groups of sliders, which follow the state */
export function controls(mechanism) {
  const { scene, model } = mechanism;
  const degrees = scene.angleUnit === "deg";
  const scaled = (length) =>
    length ? { unit: scene.unit, factor: 1 } : { unit: degrees ? "°" : "rad", factor: degrees ? DEGREE : 1 };
  let last = null;
  const inputs = scene.inputs.map((item, k) => {
    const slider = new Slider(
      {
        label: symbol(item.latex || indexed(item.name)),
        name: item.name,
        low: item.range[0],
        high: item.range[1],
        ...scaled(item.kind === "length"),
        note: item.stroke ? "stroke" : "",
      },
      (value) => {
        last = slider;
        const wanted = mechanism.inputs;
        wanted[k] = turned(value, wanted[k], item);
        mechanism.toInputs(wanted);
      },
    );
    return slider;
  });
  const { names } = shownPose(model, mechanism.pose);
  const pose = names.map((name, k) => {
    const known = model.pose.indexOf(name);
    const [low, high] = known >= 0 ? scene.poseRange[known] : [-Math.PI / 2, Math.PI / 2];
    const slider = new Slider(
      { label: symbol(name), name, low, high, ...scaled(isLength(name)), note: "" },
      (value) => {
        last = slider;
        const wanted = shownPose(model, mechanism.pose).values.slice();
        wanted[k] = value;
        mechanism.toPose(poseOfShown(model, wanted));
      },
    );
    return slider;
  });
  const show = () => {
    mechanism.inputs.forEach((value, k) => inputs[k].show(within(value, scene.inputs[k])));
    shownPose(model, mechanism.pose).values.forEach((value, k) => pose[k].show(value));
    const { reason } = mechanism;
    const blamed =
      reason && reason.kind === "stroke" ? inputs[scene.inputs.findIndex((item) => item.name === reason.joint)] : null;
    for (const slider of [...inputs, ...pose])
      slider.stop(reason && (slider === last || slider === blamed) ? reason.text : "");
  };
  mechanism.listen((what) => {
    if (what === "mode") last = null;
    show();
  });
  show();
  return {
    inputs: el("div", { class: "sliders", role: "group", "aria-label": "Inputs" }, ...inputs.map((item) => item.row)),
    pose: el(
      "div",
      { class: "sliders", role: "group", "aria-label": "Pose of the platform" },
      ...pose.map((item) => item.row),
    ),
    show,
  };
}

/** An angle as the slider shows it: whole turns added so that it lies in the range, if the range is that wide. */
function within(value, { kind, range: [low, high] }) {
  if (kind === "length" || (value >= low && value <= high)) return value;
  const turns = Math.round((value - (low + high) / 2) / (2 * Math.PI));
  return value - 2 * Math.PI * turns;
}

/** The printed value of a slider's: with the turns that the joint has made. */
const turned = (wanted, now, item) => wanted + (now - within(now, item));
