/** Everything that is shown, in the address's hash: camera, pose, mode, tab, course and check boxes, so that a link restores it. */

const REST = 350;
const FURTHEST = 50; // sizes of the mechanism that the camera's target may be away
const MODE = /^[\w+~. -]{1,200}$/;
const FLAGS = ["ghosts", "letters", "limits"];

/** Numbers as short text that an address may hold: 32-bit floats in base64. */
export function packed(values) {
  const bytes = new Uint8Array(Float32Array.from(values).buffer);
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The same back; null for what is no such text. @returns {number[]|null} */
export function unpacked(text, count) {
  try {
    const raw = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    if (raw.length !== 4 * count) return null;
    const values = [...new Float32Array(Uint8Array.from(raw, (letter) => letter.charCodeAt(0)).buffer)];
    return values.every(Number.isFinite) ? values : null;
  } catch {
    return null;
  }
}

/** The hash of a state; `mode` is the name of its assembly mode, if it has one. */
export function hashOf({ mode, values, sizes, camera, choices }) {
  const view = camera.map((value) => Number(value.toFixed(3))).join(",");
  const { tab, course, layers } = choices;
  const flags = FLAGS.map((name) => `${name}=${Number(choices[name])}`).join("&");
  const named = mode ? `mode=${encodeURIComponent(mode)}&` : "";
  const sized = sizes ? `sizes=${packed(sizes)}&` : "";
  return `#${named}${sized}joints=${packed(values)}&view=${view}&tab=${tab}&course=${course}&layers=${layers}&${flags}`;
}

/** A whole number below a bound. @returns {number|null} */
const whole = (text, below) => (/^\d{1,5}$/.test(text) && Number(text) < below ? Number(text) : null);

/** Whole numbers with commas between them, or none. @returns {number[]|null} */
function several(text, below) {
  const found = text ? text.split(",").map((part) => whole(part, below)) : [];
  return found.includes(null) ? null : found;
}

function cameraOf(text) {
  const found = text.split(",").map((part) => (part.trim() ? Number(part) : NaN));
  const sound = found.length === 6 && found.every(Number.isFinite) && found[2] > 0;
  return sound && Math.hypot(...found.slice(3)) < FURTHEST ? found : null;
}

/** What of a hash makes sense; the rest is null, as is what it does not say. `damaged`: part of it makes none. Joint values
 * are counted; of tabs are names known, of courses and layers how many there are. */
export function readHash(hash, { count, sizes, tabs, courses, layers }) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  let damaged = false;
  const read = (name, call) => {
    const found = given.has(name) ? call(given.get(name)) : null;
    damaged ||= given.has(name) && found === null;
    return found;
  };
  const flag = (text) => (["0", "1"].includes(text) ? text === "1" : null);
  return {
    mode: read("mode", (text) => (MODE.test(text) ? text : null)),
    values: read("joints", (text) => unpacked(text, count)),
    sizes: read("sizes", (text) => unpacked(text, sizes)),
    camera: read("view", cameraOf),
    choices: {
      tab: read("tab", (text) => (tabs.includes(text) ? text : null)),
      course: read("course", (text) => whole(text, courses)),
      layers: read("layers", (text) => several(text, layers)),
      ...Object.fromEntries(FLAGS.map((name) => [name, read(name, flag)])),
    },
    damaged,
  };
}

/** Restores what the address says and keeps it up to date.
 * @param {Record<string, {read: () => any, put: (value: any) => void}>} choices beside pose and camera
 * @param {(text: string) => void} say a word where an address is damaged
 * @returns {() => string} the address now */
export function linked(mechanism, stage, choices, known, say) {
  const restore = () => {
    const { count, sizes } = mechanism.model;
    const found = readHash(location.hash, { ...known, count, sizes: sizes.length });
    for (const [name, value] of Object.entries(found.choices)) if (value !== null) choices[name].put(value);
    const foreign = found.values && !mechanism.restore(found.values, found.mode, found.sizes);
    if (found.camera) stage.view.set(found.camera);
    if (found.damaged || foreign) say("this link is damaged, or another page's: only what is understood is shown");
  };
  const address = () => {
    const chosen = Object.fromEntries(Object.entries(choices).map(([name, { read }]) => [name, read()]));
    const { mode, values, resized, model } = mechanism;
    const sizes = resized ? model.sizes : null;
    const hash = hashOf({ mode, values, sizes, camera: stage.view.numbers(), choices: chosen });
    return location.href.split("#")[0] + hash;
  };
  let timer = 0;
  let own = "";
  const write = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      const now = address();
      if (now !== location.href) history.replaceState(null, "", now);
      own = location.href;
    }, REST);
  };
  restore();
  mechanism.listen(write);
  stage.view.controls.addEventListener("end", write);
  for (const kind of ["change", "click", "keyup"]) addEventListener(kind, write);
  addEventListener("hashchange", () => location.href !== own && restore());
  return address;
}
