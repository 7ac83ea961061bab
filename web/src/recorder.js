/** A recorder: pose and inputs in time, as a table that others read. */

import { el, saved, shownUnit } from "./dom.js";
import { isLength } from "./solver/pose.js";

const DIGITS = 12;

/** A table as text: seconds, then the pose and the inputs in the scene's units, which stand beside their names.
 * @param {number[][]} moments each of seconds, pose, inputs, in lengths and rad */
export function table(scene, moments) {
  const pose = scene.platform.pose.map((name) => [name, isLength(name) ? scene.unit : name[0] === "q" ? "1" : scene.angleUnit]);
  const inputs = scene.inputs.map(({ name, kind }) => [name, kind === "length" ? scene.unit : scene.angleUnit]);
  const columns = [["t", "s"], ...pose, ...inputs];
  const number = (value, k) => (columns[k][1] === "deg" ? value * shownUnit(scene, false).factor : value);
  const rows = moments.map((row) => row.map((value, k) => Number(number(value, k).toPrecision(DIGITS))));
  return [columns.map(([name, unit]) => `${name} [${unit}]`), ...rows].map((row) => `${row.join(",")}\n`).join("");
}

/** @returns {HTMLElement} buttons that record and save; a change of mode or dimensions ends a motion */
export function recorder(mechanism) {
  let [moments, start, on] = [[], 0, false];
  const note = el("span", { class: "quiet", role: "status" });
  const plain = (call, text) => el("button", { type: "button", class: "plain", onclick: call }, text);
  const button = plain(() => turn(!on), "Record");
  const { scene } = mechanism;
  const file = () => saved(`${scene.name}-motion.csv`, new Blob([table(scene, moments)], { type: "text/csv" }));
  const download = plain(file, "Save as CSV");
  const take = () => {
    const t = moments.length ? (performance.now() - start) / 1000 : 0;
    if (moments.length && t <= moments.at(-1)[0]) moments.pop(); // two in one tick of the clock
    moments.push([t, ...mechanism.pose, ...mechanism.inputs]);
    note.textContent = `${moments.length} moments, ${t.toFixed(1)} s`;
  };
  const turn = (now) => {
    if (now && !on) [moments, start] = [[], performance.now()];
    if (now) take();
    on = now;
    button.textContent = on ? "Stop" : "Record";
    download.disabled = on || moments.length < 2;
  };
  mechanism.listen((what) => on && turn(what === "motion"));
  turn(false);
  return el("div", { class: "recorder" }, button, download, note);
}
