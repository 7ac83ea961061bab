/** Bundles src/main.js with three.js into the one script that every page carries, with its licences. */

import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFile, readdir, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const assets = "../src/assur/page/assets/";
const MOST = 700_000;

/** A digest of the sources, so that a test can see whether the committed bundle is theirs. */
async function digest() {
  const found = await readdir(here("src"), { recursive: true });
  const paths = [...found.filter((path) => path.endsWith(".js")).map((path) => `src/${path}`), "package.json"].sort();
  const hash = createHash("sha256");
  for (const path of paths) hash.update(`${path}\0`).update(await readFile(here(path)));
  return hash.digest("hex");
}

const three = JSON.parse(await readFile(here("node_modules/three/package.json"), "utf8"));
const licence = await readFile(here("node_modules/three/LICENSE"), "utf8");
const head = `/*!\nassur's page; Apache-2.0; sources ${await digest()}\nInside: three.js ${three.version}\n\n${licence.trim()}\n*/`;

await build({
  entryPoints: [here("src/main.js")],
  outfile: here(`${assets}page.js`),
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  banner: { js: head },
  logLevel: "warning",
});
await writeFile(here(`${assets}LICENSES.txt`), `three.js ${three.version} (in page.js)\n\n${licence}`);
const bundle = await readFile(here(`${assets}page.js`));
const mark = createHash("sha256").update(bundle).digest("hex");
await writeFile(here(`${assets}page.js.sha256`), `${mark}  page.js\n`);
const size = bundle.length;
if (size > MOST) throw new Error(`page.js has ${size} bytes; at most ${MOST} are wanted`);
console.log(`page.js: ${size} bytes`);
