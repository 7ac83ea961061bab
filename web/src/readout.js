/** Live numbers: what the page can say of the present configuration. */

import { el, figures, spelt } from "./dom.js";

const REST = 120; // milliseconds without motion after which the distance is computed

/** Each number: its name, and what it means. */
export const NUMBERS = {
  condition: [
    "condition number",
    "of the map from the inputs' rates to the platform's, lengths in units of the mechanism's size; 1 is best, infinite at a singularity",
  ],
  smallest: [
    "parallel measure",
    "smallest singular value of Jp, of orthonormal relations Jp v = Jq q'; 0 at a parallel singularity",
  ],
  serial: ["serial measure", "smallest singular value of Jq; 0 at a serial singularity"],
  distance: ["to singularity, about", "to first order, the platform's orientation held: far from it, a rough guess"],
  factor: ["closest factor", "the factor of the closed form that is nearest to zero, as a share of its own scale"],
  residual: ["residual", "largest gap of the loops"],
};

/** A factor as a share of its own scale. */
const signed = ({ value, share }) => Math.sign(value) * share;

/** @returns {{element: HTMLElement}} a list of numbers that follows the mechanism */
export function readout(mechanism) {
  const { scene } = mechanism;
  const rows = {};
  const list = el("dl");
  for (const [key, [name, title]] of Object.entries(NUMBERS)) {
    if (key === "factor" && !mechanism.kernel) continue;
    rows[key] = el("dd");
    list.append(el("div", { title }, el("dt", {}, name), rows[key]));
  }
  let timer = 0;
  const show = () => {
    const state = mechanism.state();
    rows.condition.textContent = figures(state.condition, 3);
    rows.smallest.textContent = figures(state.smallest, 3);
    rows.serial.textContent = figures(state.serial, 3);
    rows.smallest.parentElement.classList.toggle("near", state.smallest < 0.03);
    rows.serial.parentElement.classList.toggle("near", state.serial < 0.03);
    rows.residual.textContent = `${figures(state.residual, 2)} ${scene.unit}`;
    if (rows.factor)
      rows.factor.replaceChildren(
        ...(state.factor ? [spelt(state.factor.name), ` ${figures(signed(state.factor), 3)}`] : ["–"]),
      );
    clearTimeout(timer);
    timer = setTimeout(() => {
      const { amount, kind } = mechanism.state().far();
      rows.distance.textContent = Number.isNaN(amount)
        ? "–"
        : amount > scene.extent
          ? `> ${figures(scene.extent, 2)} ${scene.unit}`
          : `${figures(amount, 2)} ${scene.unit}, ${kind}`;
    }, REST);
  };
  mechanism.listen(show);
  show();
  return {
    element: el(
      "details",
      { class: "numbers", open: matchMedia("(min-width: 821px)").matches },
      el("summary", {}, "Numbers"),
      list,
    ),
  };
}
