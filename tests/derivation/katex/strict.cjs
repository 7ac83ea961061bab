// What KaTeX says of formulas that it does not read strictly; they come as JSON on standard input.
const katex = require("katex");
const formulas = JSON.parse(require("node:fs").readFileSync(0, "utf8"));
const wrong = formulas.flatMap((formula) => {
  try {
    katex.renderToString(formula, { throwOnError: true, strict: "error", displayMode: true });
    return [];
  } catch (error) {
    return [`${formula}: ${error.message}`];
  }
});
console.log(JSON.stringify(wrong));
