"""`assur view`: a mechanism as a live 3-D view in the browser."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from assur.cli.options import DRAWN_DEFAULTS, Drawn, MechanismName, Outcome


def view(
    mechanism: MechanismName,
    /,
    *,
    host: Annotated[
        str, Parameter(metavar="ADDRESS", help="Where to listen; this machine alone if left out.")
    ] = "127.0.0.1",
    allow_network: Annotated[bool, Parameter(help="Let other machines in: who has the link may use the view.")] = False,
    port: Annotated[int, Parameter(metavar="NUMBER", help="The port; a free one if left out.")] = 0,
    link: Annotated[str, Parameter(metavar="LINK", help="A link that was kept: its dimensions, pose and camera.")] = "",
    mode: Annotated[
        str, Parameter(metavar="NAME", help="Begin in this operation mode, one that `assur topology --modes` names.")
    ] = "",
    no_open: Annotated[bool, Parameter(help="Print the link and open no browser.")] = False,
    shared: Drawn = DRAWN_DEFAULTS,
) -> Outcome:
    """Move a mechanism in the browser, until Ctrl-C.

    Sliders for the inputs and for the platform keep the mode; where they cannot go
    on, they say why. Other modes stand beside as ghosts. The view listens on this
    machine alone and answers only those who have its link.

    For example:
        assur view zeng2019
        assur view fivebar --set l1=110 --no-open
        assur view three_upu --mode 3R
    """
    record = shared.mechanism(mechanism)
    from assur.cli.viewing import link_to_mode, outcome

    link = link_to_mode(record, mode, link) if mode else link
    return outcome(record, host=host, port=port, allow_network=allow_network, link=link, opens=not no_open)
