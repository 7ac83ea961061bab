/** The camera, the pose and the mode in the address's hash, so that a link restores them. */

const REST = 350;

/** Numbers as short text that an address may hold: 32-bit floats in base64. @param {number[]} values */
export function packed(values) {
  const bytes = new Uint8Array(Float32Array.from(values).buffer);
  return btoa(String.fromCharCode(...bytes))
    .replace(/\+/g, "-")
    .replace(/\//g, "_")
    .replace(/=+$/, "");
}

/** The same back; null for what is no such text. @param {string} text @param {number} count @returns {number[]|null} */
export function unpacked(text, count) {
  try {
    const raw = atob(text.replace(/-/g, "+").replace(/_/g, "/"));
    if (raw.length !== 4 * count) return null;
    const values = [...new Float32Array(Uint8Array.from(raw, (letter) => letter.charCodeAt(0)).buffer)];
    return values.every(Number.isFinite) ? values : null;
  } catch {
    return null;
  }
}

/** The hash of a state. @param {{branch: number, values: number[], camera: number[]}} state */
export function hashOf({ branch, values, camera }) {
  return `#mode=${branch}&joints=${packed(values)}&view=${camera.map((value) => Number(value.toFixed(3))).join(",")}`;
}

/** @returns {{branch: number|null, values: number[]|null, camera: number[]|null}} what of a hash makes sense */
export function readHash(hash, { count, branches }) {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const branch = Number(given.get("mode") ?? NaN);
  const camera = (given.get("view") ?? "").split(",").map(Number);
  return {
    branch: Number.isInteger(branch) && branch >= 0 && branch < branches ? branch : null,
    values: given.has("joints") ? unpacked(given.get("joints"), count) : null,
    camera: camera.length === 6 && camera.every(Number.isFinite) && camera[2] > 0 ? camera : null,
  };
}

/** Restores what the address says and keeps it up to date. @returns {() => string} the address now */
export function linked(mechanism, stage) {
  const restore = () => {
    const found = readHash(location.hash, { count: mechanism.model.count, branches: mechanism.assembly.length });
    if (found.values) mechanism.restore(found.values, found.branch ?? 0);
    if (found.camera) stage.view.set(found.camera);
  };
  const address = () => {
    const hash = hashOf({ branch: mechanism.branch, values: mechanism.values, camera: stage.view.numbers() });
    return location.href.split("#")[0] + hash;
  };
  let timer = 0;
  let own = "";
  const write = () => {
    clearTimeout(timer);
    timer = setTimeout(() => {
      own = address();
      history.replaceState(null, "", own);
    }, REST);
  };
  restore();
  mechanism.listen(write);
  stage.view.controls.addEventListener("end", write);
  addEventListener("hashchange", () => location.href !== own && restore());
  return address;
}
