/** The player: a course, a button to play it and a time bar. */

import { BufferGeometry, Line, LineBasicMaterial, Vector3 } from "three";
import { coursesOf, followedCourse, onCourse } from "./courses.js";
import { el, greek, icon } from "./dom.js";
import { frames } from "./solver/frames.js";
import { platformOf } from "./solver/pose.js";

const SECONDS = 6;
const PLAY = "M8 5l11 7-11 7z";
const PAUSE = "M8 5v14M16 5v14";

export class Player {
  constructor(mechanism, stage) {
    Object.assign(this, { mechanism, stage, playing: false, time: 0, own: false, known: null });
    this.trail = new Line(new BufferGeometry(), new LineBasicMaterial({ color: "#d55e00", toneMapped: false }));
    this.trail.frustumCulled = false;
    this.trail.raycast = () => {};
    stage.root.add(this.trail);
    this.choice = el("select", { "aria-label": "Course", onchange: () => this.fresh() });
    this.button = el("button", { type: "button", class: "play", onclick: () => this.toggle() });
    this.bar = el("input", {
      type: "range",
      min: 0,
      max: 1,
      step: 0.001,
      value: 0,
      "aria-label": "Time",
      oninput: () => this.seek(this.bar.valueAsNumber),
    });
    this.note = el("p", { class: "why" });
    this.courses = coursesOf(mechanism);
    this.choice.append(...this.courses.map(({ label }, k) => el("option", { value: k }, greek(label))));
    this.element = el(
      "div",
      { class: "player" },
      this.choice,
      el("div", { class: "time" }, this.button, this.bar),
      this.note,
    );
    this.bar.style.setProperty("--share", "0%");
    this.paint();
    mechanism.listen(() => {
      if (!this.own) this.fresh(); // moved by hand: the next course starts from there
    });
  }

  fresh() {
    this.pause();
    this.known = null;
    this.time = 0;
    this.bar.value = 0;
    this.bar.style.setProperty("--share", "0%");
    this.note.textContent = "";
    if (this.trail.visible) this.stage.invalidate();
    this.trail.visible = false;
  }

  /** Follows the chosen course once, if that was not done yet. */
  prepare() {
    if (this.known) return true;
    const index = Number(this.choice.value);
    this.courses = coursesOf(this.mechanism);
    const course = this.courses[index];
    const found = followedCourse(this.mechanism, course);
    this.note.textContent = found ? "" : "this course cannot be followed from here";
    if (!found) return false;
    this.known = { course, ...found };
    const { model } = this.mechanism;
    this.trail.geometry.setFromPoints(
      found.samples.map((values) => new Vector3(...platformOf(model, frames(model, values)).point)),
    );
    this.trail.visible = true;
    return true;
  }

  seek(t) {
    if (!this.prepare()) return;
    this.time = t;
    this.bar.value = t;
    this.bar.style.setProperty("--share", `${100 * t}%`);
    this.own = true;
    this.mechanism.moved(onCourse(this.mechanism, this.known.course, this.known, t));
    this.own = false;
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  play() {
    if (!this.prepare()) return;
    this.playing = true;
    this.paint();
    let last = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      this.seek((this.time + Math.min(0.1, (now - last) / 1000) / SECONDS) % 1);
      last = now;
      this.frame = requestAnimationFrame(tick);
    };
    this.frame = requestAnimationFrame(tick);
  }

  pause() {
    this.playing = false;
    cancelAnimationFrame(this.frame);
    this.paint();
  }

  paint() {
    this.button.replaceChildren(icon(this.playing ? PAUSE : PLAY), el("span", {}, this.playing ? "Pause" : "Play"));
    this.button.classList.toggle("playing", this.playing);
  }
}
