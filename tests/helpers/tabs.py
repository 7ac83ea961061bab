"""Pages in a browser that stay open from one test to the next: to draw the first picture takes seconds."""

from typing import Any

READY = "html[data-ready='1']"

LOOK = """() => JSON.stringify([
  performance.timeOrigin,
  window.assur.state().values,
  document.querySelector(".status").textContent,
  [...document.querySelectorAll("input, select")].map((it) => [it.value, it.checked]),
  [...document.querySelectorAll("button, [role=tab]")].map((it) =>
    [it.ariaLabel ?? it.textContent, it.ariaSelected, it.ariaPressed, it.ariaExpanded]),
  [...document.querySelectorAll("details")].map((it) => it.open),
])"""
"""What a reader sees but for the picture and the numbers that are still being looked for, and which load it is."""


UNDRAWN = """for (const { prototype } of [WebGLRenderingContext, WebGL2RenderingContext])
  for (const name of Object.keys(Object.getOwnPropertyDescriptors(prototype)))
    if (/^draw[A-Z]\\w*s/.test(name)) prototype[name] = () => {};
"""
"""Leaves out the triangles of every picture, which without a graphics card are most of a page's work."""


def load_page(tab: Any, address: str) -> None:
    """Until its first picture has been drawn."""
    tab.goto("about:blank")
    tab.goto(address, wait_until="commit")
    tab.wait_for_selector(READY, state="attached", timeout=60_000)


def listened(browser: Any, width: int, height: int, dark: bool = False, drawn: bool = True) -> tuple[Any, list[str]]:
    """A new tab, and all that it will complain of; one that is not `drawn` is for tests that look at no picture."""
    size = {"width": width, "height": height}
    tab = browser.new_context(viewport=size, color_scheme="dark" if dark else "light").new_page()
    if not drawn:
        tab.add_init_script(UNDRAWN)
    said: list[str] = []
    tab.on("console", lambda message: said.append(f"{message.type}: {message.text}"))
    tab.on("pageerror", lambda error: said.append(f"error: {error}"))
    return tab, said


def look(tab: Any) -> str:
    return str(tab.evaluate(LOOK))


def as_it_opened(tab: Any, before: str) -> bool:
    """Whether the page's own reset brings back what it looked like, in the same load; if not it must be loaded anew."""
    if not tab.evaluate("Boolean(window.assur)"):
        return False
    tab.evaluate("document.activeElement?.blur()")
    tab.mouse.move(0, 0)
    tab.keyboard.press("r")
    return look(tab) == before
