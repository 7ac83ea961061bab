// Where the contents stand above the text they begin folded, so that the first screen shows the machine.
document.querySelector("nav details").open = matchMedia("(min-width: 68rem)").matches;
