/** The player: a course, a button to play it and a time bar. */

import { BufferGeometry, Line, LineBasicMaterial, Vector3 } from "three";
import { coursesOf, followedCourse, onCourse } from "./courses.js";
import { el, icon, minus } from "./dom.js";
import { configurationAt } from "./solver/configuration.js";

const SECONDS = 6;
const PLAY = "M8 5l11 7-11 7z";
const PAUSE = "M8 5v14M16 5v14";

export class Player {
  constructor(mechanism, stage) {
    Object.assign(this, { mechanism, stage, playing: false, time: 0, own: false, known: null });
    this.trail = new Line(new BufferGeometry(), new LineBasicMaterial({ color: "#d55e00", toneMapped: false }));
    this.trail.frustumCulled = false;
    stage.root.add(this.trail);
    this.choice = el("select", { "aria-label": "Course", onchange: () => this.fresh() });
    this.button = el("button", { type: "button", class: "play", onclick: () => this.toggle() });
    const moved = () => this.seek(this.bar.valueAsNumber);
    this.bar = el("input", { type: "range", max: 1, step: 0.001, value: 0, "aria-label": "Time", oninput: moved });
    this.note = el("p", { class: "why", role: "status" });
    this.courses = coursesOf(mechanism);
    this.choice.append(...this.courses.map((_, k) => el("option", { value: k })));
    const put = (index) => ((this.choice.value = index), this.fresh());
    this.course = { read: () => Number(this.choice.value), put }; // for a link
    this.named();
    const time = el("div", { class: "time" }, this.button, this.bar);
    this.element = el("div", { class: "player" }, this.choice, time, this.note);
    this.show();
    this.paint();
    mechanism.listen(() => {
      if (!this.own) this.fresh(); // moved by hand: the next course starts from there
    });
  }

  /** Names every course by its size: that in which it is followed, else the largest that is tried. */
  named() {
    this.courses.forEach(({ name, sizes }, k) => {
      const followed = this.known && k === Number(this.choice.value);
      this.choice.options[k].textContent = name(followed ? this.known.size : sizes[0]);
    });
  }

  fresh() {
    this.pause();
    if (this.known) {
      this.known = null;
      this.named();
    }
    this.time = 0;
    this.show();
    this.note.textContent = "";
    if (this.trail.visible) this.stage.invalidate();
    this.trail.visible = false;
  }

  /** Follows the chosen course once, if that was not done yet. */
  prepare() {
    if (this.known) return true;
    this.courses = coursesOf(this.mechanism);
    const course = this.courses[Number(this.choice.value)];
    const found = followedCourse(this.mechanism, course);
    if (found.reason) {
      this.tell("why", `It cannot be followed from here: ${minus(found.reason.text)}.`);
      return false;
    }
    this.known = { course, ...found };
    this.named();
    const [wanted] = course.sizes;
    this.tell("quiet", found.size < wanted ? `${course.amount(wanted)} would be too far from here.` : "");
    const at = (values) => new Vector3(...configurationAt(this.mechanism.model, values).platform.origin);
    this.trail.geometry.setFromPoints(found.samples.map(at));
    this.trail.visible = true;
    return true;
  }

  /** The time, on its bar. */
  show() {
    this.bar.value = this.time;
    this.bar.style.setProperty("--share", `${100 * this.time}%`);
    this.bar.setAttribute("aria-valuetext", `${Math.round(100 * this.time)} %`);
  }

  tell(kind, text) {
    this.note.className = kind;
    this.note.textContent = text;
  }

  seek(t) {
    const followed = this.prepare();
    this.time = followed ? t : 0;
    this.show();
    if (!followed) return;
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
    let last = null; // times of frames only: a slow one may have begun before the button was pressed
    const tick = (now) => {
      if (!this.playing) return;
      this.seek((this.time + Math.min(0.1, (now - (last ?? now)) / 1000) / SECONDS) % 1);
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
