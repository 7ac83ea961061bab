/** Live numbers: what the page can say of the present configuration. */

import { el, figures, shownUnit, spelt } from "./dom.js";
import { NEAR } from "./explain.js";
import { NearestSingular } from "./solver/distance.js";
import { isLength } from "./solver/pose.js";

const REST = 120; // milliseconds without motion after which the distance is looked for
const PORTION = 8; // milliseconds of that at a time, so that the page stays awake
const PATIENCE = 3000; // and all together: what was found until then is said

/** Each number: its name, and what it means. */
export const NUMBERS = {
  condition: [
    "condition number",
    "of the map from the inputs' rates to the platform's, one over the local condition index; where lengths and angles mix, lengths are divided by the characteristic length L; 1 is best, infinite at a singularity",
  ],
  smallest: [
    "parallel measure",
    "smallest singular value of Jp, of orthonormal relations Jp v = Jq q'; 0 at a parallel singularity",
  ],
  serial: ["serial measure", "smallest singular value of Jq; 0 at a serial singularity"],
  distance: [
    "to a singularity",
    "distance of the nearest singular pose that was found, the orientation held: along rays, then by Newton's steps; a nearer one may be missed, and after 3 s of search only what was found until then is said",
  ],
  factor: ["closest factor", "the factor of the closed form that is nearest to zero, as a share of its own scale"],
  residual: ["residual", "largest gap of the loops"],
  limits: ["limits", "strokes, limits of joints and cones of the file: which are exceeded here, and by how much"],
};

const KINDS = { parallel: "parallel", serial: "serial", passive: "a passive leg" };

/** The distance of a singularity that was found, and of what kind; `over`: the search came to its end, at that range. */
export function distanceSaid({ amount, kind }, over, range, unit) {
  if (Number.isNaN(amount)) return "–";
  if (amount < Infinity) return `${over ? "" : "at most "}${figures(amount, 3)} ${unit}, ${KINDS[kind]}`;
  return over ? `none seen within ${figures(range, 3)} ${unit}` : "none seen yet";
}

/** The condition number, with its characteristic length where lengths and angles mix. */
export function conditionSaid(condition, { platform, inputs, characteristicLength, unit }) {
  const mixed = (kinds) => new Set(kinds).size > 1;
  const rates = platform.pose.map(isLength);
  const said = figures(condition, 3);
  if (!mixed(rates) && !mixed(inputs.map(({ kind }) => kind))) return said;
  return `${said}, L = ${figures(characteristicLength, 3)} ${unit}`;
}

/** Whether the file's limits are kept, else the one that is exceeded most. */
export function limitsSaid({ stated, exceeded }, scene) {
  if (!stated) return "no limits are stated";
  if (!exceeded.length) return "within";
  const [{ name, angle, by }] = exceeded;
  const more = exceeded.length > 1 ? `, ${exceeded.length - 1} more` : "";
  return `${name} outside by ${figures(by * shownUnit(scene, !angle).factor, 3)} ${angle ? scene.angleUnit : scene.unit}${more}`;
}

/** @returns {HTMLElement} a list of numbers that follows the mechanism */
export function readout(mechanism) {
  const { scene } = mechanism;
  const rows = {};
  const list = el("dl");
  for (const [key, [name, title]] of Object.entries(NUMBERS)) {
    if (key === "factor" && !scene.kernel) continue;
    rows[key] = el("dd");
    list.append(el("div", { title }, el("dt", {}, name), rows[key]));
  }
  let timer = 0;
  /** Looks for the nearest singularity in portions, until the mechanism moves. */
  const look = (found, search, patience) => {
    const start = performance.now();
    let over = false;
    while (!over && performance.now() - start < PORTION) over = search.next().done;
    const left = patience - (performance.now() - start);
    const done = over || left < 0;
    const words = distanceSaid(found, over, mechanism.model.length, scene.unit);
    if (done || found.amount < Infinity) rows.distance.textContent = words; // at once, then better
    if (!done) timer = setTimeout(() => look(found, search, left), 0);
  };
  const show = () => {
    const state = mechanism.state();
    const say = (key, near, ...said) => {
      rows[key].replaceChildren(...said);
      rows[key].parentElement.classList.toggle("near", near);
    };
    say("condition", false, conditionSaid(state.condition, scene));
    for (const key of ["smallest", "serial"]) say(key, state[key] < NEAR, figures(state[key], 3));
    say("residual", false, `${figures(state.residual, 2)} ${scene.unit}`);
    say("limits", state.limits.exceeded.length > 0, limitsSaid(state.limits, scene));
    const { name, value, share } = state.factor ?? {}; // signed, as a share of its own scale
    if (name) say("factor", false, spelt(name), ` ${figures(Math.sign(value) * share, 3)}`);
    else if (rows.factor) say("factor", false, "–");
    clearTimeout(timer);
    rows.distance.textContent = "…";
    if (!details.open) return; // a search that nobody sees costs a phone's battery
    timer = setTimeout(() => {
      const found = new NearestSingular(mechanism.model, state.values);
      look(found, found.search(), PATIENCE);
    }, REST);
  };
  const open = matchMedia("(min-width: 821px)").matches;
  const details = el("details", { class: "numbers", open, ontoggle: show }, el("summary", {}, "Numbers"), list);
  mechanism.listen(show);
  show();
  return details;
}
