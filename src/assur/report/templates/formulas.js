// A formula that no line break makes narrow enough is set smaller, and its LaTeX is copied at a click.
const fit = () => {
  for (const box of document.querySelectorAll(".math")) {
    const formula = box.firstElementChild;
    if (!formula || !box.clientWidth) continue;
    formula.style.fontSize = "";
    for (let k = 0; k < 4 && box.scrollWidth > box.clientWidth; k++) {
      const size = parseFloat(getComputedStyle(formula).fontSize);
      formula.style.fontSize = `${0.99 * size * box.clientWidth / box.scrollWidth}px`;
    }
  }
};
const copied = async (text) => {
  if (navigator.clipboard) return navigator.clipboard.writeText(text);
  const field = Object.assign(document.createElement("textarea"), { value: text });
  document.body.append(field);
  field.select();
  document.execCommand("copy");
  field.remove();
};
for (const button of document.querySelectorAll(".copy")) {
  button.hidden = false;
  button.addEventListener("click", async () => {
    await copied(button.closest(".line").querySelector("annotation").textContent);
    button.textContent = "copied";
    setTimeout(() => { button.textContent = "TeX"; }, 1200);
  });
}
addEventListener("resize", fit);
document.addEventListener("toggle", fit, true);
document.fonts.ready.then(fit);
fit();
