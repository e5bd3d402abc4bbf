"""Hulls that went out to a file and came back: what is compared, for tests and the table of docs.

`python -m tests.own_files` prints the table: every form that holds splines, every hull that ships.
"""

from __future__ import annotations

import sys
import tempfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.hull import Hull
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import HullState

FORMS = {"dxf": ".dxf", "iges-lines": ".igs", "3dm": ".3dm"}
SHIPS = (
    "wigley", "series60", "bulk_carrier_207k", "bulk_carrier_180m", "container_ship_225m",
    "plain_ship", "seaking_ship", "sfolds_ship", "prelikon_ship",
)  # fmt: skip

Name = tuple[str, str]


@attrs.frozen
class Return:
    """How a hull came back.

    Attributes
    ----------
    lines, curves : int
        Of the hull that went out.
    away : float, m
        Largest distance between curves, at places of equal parameter.
    inflections : int
        More than before, line by line.
    """

    lines: int
    curves: int
    away: float
    inflections: int


def went_and_came(hull: Hull, path: Path, form: str, **options: object) -> tuple[Hull, Return]:
    """Write a hull, read it, and compare the two."""
    hull.export(path, form)
    back = ah.read(path, **options)  # type: ignore[arg-type]
    return back, compared(hull, back)


def compared(hull: Hull, back: Hull) -> Return:
    """Compare all lines of two hulls, curve by curve; names and numbers of curves must be equal."""
    one, other = curves_by_line(hull.state), curves_by_line(back.state)
    assert {name: len(each) for name, each in one.items()} == {
        name: len(each) for name, each in other.items()
    }
    away = max(_apart(*pair) for name in one for pair in _pairs(one[name], other[name]))
    assert back.adoption is not None
    more = back.adoption.inflections[1]
    return Return(len(one), sum(map(len, one.values())), away, more)


def curves_by_line(state: HullState) -> dict[Name, list[SplineBatch]]:
    """Give the curves by group and name of their line."""
    found: dict[Name, list[SplineBatch]] = {}
    for curve in state.live("curves").tolist():
        found.setdefault(line_of(state, curve), []).append(state.spline(curve))
    return found


def line_of(state: HullState, curve: int) -> Name:
    """Give group and name of the line of a curve."""
    line = state.line_of(curve)
    group = state.groups.name[state.lines.group[line]]
    return str(group), str(state.lines.name[line])


def _pairs(
    one: list[SplineBatch], other: list[SplineBatch]
) -> Iterator[tuple[SplineBatch, SplineBatch]]:
    """Pair the curves of a line by their ends: their order is that of their points."""
    for curve in one:
        yield curve, min(other, key=lambda each: float(np.abs(_ends(each) - _ends(curve)).max()))


def _ends(curve: SplineBatch) -> np.typing.NDArray[np.float64]:
    return curve.xyz[[0, -1]]


def _apart(one: SplineBatch, other: SplineBatch) -> float:
    part = np.linspace(0.0, 1.0, 201)
    places = [evaluate(c, np.zeros(201, np.int64), part * c.knot[-1]) for c in (one, other)]
    knots = np.abs(one.xyz - other.xyz).max() if len(one.xyz) == len(other.xyz) else np.inf
    return float(max(np.abs(places[0] - places[1]).max(), knots))


def facts(hull: Hull) -> dict[str, object]:
    """Give what must be the same besides the curves."""
    state = hull.state
    live = state.live("lines").tolist()
    kinds = {
        (str(state.lines.name[i]), BoundaryKind(int(state.lines.boundary[i])).name)
        for i in live if state.lines.boundary[i] >= 0
    }  # fmt: skip
    rows = state.live("rows")
    return {
        "particulars": state.particulars,
        "tolerances": state.tolerances,
        "families": dict(zip(state.groups.name.data, state.groups.family.data, strict=True)),
        "associations": state.associations,
        "boundaries": kinds,
        "features": sorted((each.kind, each.name) for each in state.features),
        "roles": Counter(each.role for each in hull.crossings.values()),
        "sorts": Counter(state.rows.sort[rows].tolist()),
        "kinds": Counter(map(tuple, state.rows.kind[rows].tolist())),
        "volume": hull.hydrostatics().volume,
    }


def table() -> Iterator[str]:
    """Give the table, a row a hull and form."""
    yield "| hull | form | lines | curves | points off, m | new inflections | the same |"
    yield "|---|---|---|---|---|---|---|"
    with tempfile.TemporaryDirectory() as folder:
        for ship in SHIPS:
            hull = getattr(ah.examples, ship)()
            known = facts(hull)
            for form, ending in FORMS.items():
                back, found = went_and_came(hull, Path(folder) / f"{ship}{ending}", form)
                same = facts(back)
                words = [name for name in known if known[name] == same[name]]
                told = "all" if len(words) == len(known) else ", ".join(words)
                yield (
                    f"| {ship} | {form} | {found.lines} | {found.curves} | {found.away:.1e} | "
                    f"{found.inflections} | {told} |"
                )


if __name__ == "__main__":
    for row in table():
        sys.stdout.write(f"{row}\n")
        sys.stdout.flush()
