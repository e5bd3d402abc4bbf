"""What a notebook shows of a hull: three views, and its particulars.

Both are plain SVG and HTML, so that they are still seen when a saved notebook is opened without a
kernel.
"""

from __future__ import annotations

from html import escape

from assoc_hull.display import html_table
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState
from assoc_hull.plot.lines_plan.plain_svg import plain_svg

__all__ = ["mimebundle_of"]


def mimebundle_of(state: HullState, text: str) -> dict[str, str]:
    """Give a published hull as text, HTML and SVG, by the names of these kinds."""
    picture, ship = plain_svg(state), state.particulars
    sizes = (
        ("length between perpendiculars", ship.length), ("breadth, moulded", ship.breadth),
        ("depth, moulded", ship.depth), ("design draught, moulded", ship.draught),
    )  # fmt: skip
    rows = [(name, f"{size:.3f} m") for name, size in sizes]
    live = state.live("rows")
    crossings = int((state.rows.sort[live] == Sort.CROSSING).sum())
    rows += [("lines", str(len(state.live("lines")))), ("crossings", str(crossings))]
    table = html_table((ship.name, ""), rows, right=(1,))
    html = f'<div aria-label="{escape(ship.name)}">{picture}{table}</div>'
    return {"text/plain": text, "text/html": html, "image/svg+xml": picture}
