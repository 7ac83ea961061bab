/** Scenes as a page makes them of what Python has written: their programs run. */

const PROGRAMS = ["configuration", "kernel", "resize"];

/** The scene with its programs as functions. */
export const compiled = (scene) => ({
  ...scene,
  ...Object.fromEntries(PROGRAMS.map((name) => [name, scene[name] ? new Function(`return ${scene[name]}`)() : null])),
});
