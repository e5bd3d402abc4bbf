"""The named parameters as tables: `python docs/named_parameters.py` prints them.

What they say comes from the catalogue, from measures and layouts on the bulk carrier, and from its
list of what may be asked. `docs/site_hook.py` puts them at the mark of `docs/named_parameters.md`
when the site is built, so that they are always those of the code.
"""

from __future__ import annotations

import math
from typing import Any

import attrs

import assoc_hull as ah
from assoc_hull.variation.carrying.admissible_values import ListedParameter, list_parameters
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parameter_fields import main_layer
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import Parent, parent_of

PAGE = "named_parameters.md"
MARK = "<!-- named parameters -->\n"
REACHES = [
    field.name for field in attrs.fields(Layout)
    if field.name != "blend" and field.default is not None
]  # fmt: skip


def tables() -> str:
    """Give what the parameters are, and what moves, as Markdown."""
    hull = ah.examples.bulk_carrier_207k()
    found = measure_all(hull.state)
    parent, listed = parent_of(hull.state, found), list_parameters(hull.state)
    lines = ["", "| parameter | in formulas | unit | what it is | how it is measured | not with |"]
    lines += ["|---|---|---|---|---|---|"]
    lines += [_what(each, found.anchors[each.name].how) for each in listed]
    lines += ["", "| parameter | carrier | from | to | how it moves | what moves | keywords |"]
    lines += ["|---|---|---|---|---|---|---|"]
    lines += [_moves(each, parent) for each in listed]
    return "\n".join(lines) + "\n\n"


def _what(each: ListedParameter, how: str) -> str:
    entry = CATALOGUE[each.name]
    apart = ", ".join(f"`{other}`" for other in each.conflicts)
    return _row(f"`{each.name}`", entry.short, entry.unit, entry.meaning, how, apart)


def _moves(each: ListedParameter, parent: Parent) -> str:
    layout = _Told()
    regions = _regions(each, parent, layout)
    reaches = ", ".join(
        f"`{name}={getattr(Layout(), name)}`" for name in REACHES if name in layout.told
    )
    _, now, unit, low, high, *_ = each.words
    ends = ["" if end == "any" else end for end in (low, high)]
    where = "; ".join(dict.fromkeys(map(_where, regions)))
    return _row(
        f"`{each.name}`", f"{now} {unit}", *ends, CATALOGUE[each.name].field, where, reaches
    )


def _regions(each: ListedParameter, parent: Parent, layout: Layout) -> tuple[FieldRegion, ...]:
    """Give the boxes of what moves where a parameter is a little more than it is."""
    value, lays = each.value, CATALOGUE[each.name].lays
    assert value is not None
    more = value + 0.1
    if lays is not None:
        laid = lays(parent, more, layout)
        if isinstance(laid, Share):
            return tuple(field.region() for field in laid.fields)
        return laid.regions()
    main = main_layer(parent, {each.name: more}, layout)
    assert main is not None
    return main.regions()


class _Told(Layout):
    """A layout that keeps which of its reaches were asked for."""

    told: set[str]

    def __init__(self) -> None:
        object.__setattr__(self, "told", set())
        super().__init__()
        self.told.clear()

    def __getattribute__(self, name: str) -> Any:
        if name in REACHES:
            object.__getattribute__(self, "told").add(name)
        return object.__getattribute__(self, name)


def _where(region: FieldRegion) -> str:
    """Give a region in words; a coordinate that does not bound it is not told."""
    parts = [
        words for axis, ends in (("x", region.x), ("z", region.z)) if (words := _span(axis, ends))
    ]
    return ", ".join(parts) or "everywhere"


def _span(axis: str, ends: tuple[float, float]) -> str:
    low, high = ends
    if math.isinf(low) and math.isinf(high):
        return ""
    if math.isinf(high):
        return f"{axis} above {low:.4g}"
    return f"{axis} below {high:.4g}" if math.isinf(low) else f"{axis} {low:.4g} to {high:.4g}"


def _row(*cells: str) -> str:
    return "| " + " | ".join(cells) + " |"


if __name__ == "__main__":
    print(tables())
