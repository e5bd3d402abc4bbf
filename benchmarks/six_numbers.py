"""Ships from six numbers: how many of those drawn over the ranges are made, and how fair they are.

``python -m benchmarks six_numbers``; ``python -m benchmarks.six_numbers COUNT`` prints each ship
and each refusal as well, below three parents counted alike. Numbers are drawn evenly over the
ranges, with seeds. Sign changes of curvature are those between lobes of .2 degree, 1.5 m and more
from the ends of waterlines and buttocks.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.net_battens import net_battens
from assoc_hull.geometry.fairness.inflections import inflections
from benchmarks.clock import Figure

__all__ = ["RANGES", "Drawn", "drawn_ships", "figures", "parents", "sign_changes", "turned"]

RANGES: Mapping[str, tuple[tuple[float, float], ...]] = {
    "bulk carrier": ((100, 320), (5.5, 7.0), (2.3, 3.1), (1.3, 1.6), (0.78, 0.85), (0.0, 3.5)),
    "tanker": ((100, 320), (5.5, 7.0), (2.3, 3.1), (1.3, 1.6), (0.78, 0.85), (0.0, 3.5)),
    "container ship": ((120, 360), (6.3, 8.2), (2.4, 3.6), (1.5, 2.1), (0.58, 0.70), (-3.0, 0.0)),
    "general cargo": ((70, 160), (5.5, 7.0), (2.2, 2.9), (1.3, 1.7), (0.68, 0.80), (-1.0, 2.0)),
    "ro-ro": ((100, 220), (5.5, 7.5), (3.3, 4.5), (1.8, 2.6), (0.52, 0.66), (-4.0, -1.0)),
    "yacht canoe body": ((8, 30), (2.9, 4.2), (4.0, 8.0), (2.4, 4.0), (0.36, 0.43), (-6.0, -2.0)),
    "trawler": ((20, 70), (3.2, 5.0), (2.0, 2.8), (1.4, 1.9), (0.50, 0.62), (-4.0, -0.5)),
}
"""Lpp (m), L/B, B/T, D/T, CB, LCB (% of Lpp) from and to."""


@attrs.frozen
class Drawn:
    """One ship: what was asked for, and what came of it.

    Attributes
    ----------
    kind, asked : str
        Type, and numbers in words.
    refusal : str
        Empty where it was made.
    cb, lcb : float
        Misses, the latter in parts of the length.
    changes : mapping of str to list of int
        Sign changes of curvature by line, of sections, waterlines, buttocks.
    turned : mapping of str to float, deg
        Batten residual over spacing, which 95 % of the points stay below, of the same.
    lowest : float, m
        Of all points of lines.
    """

    kind: str
    asked: str
    refusal: str = ""
    cb: float = np.nan
    lcb: float = np.nan
    changes: Mapping[str, list[int]] = attrs.field(factory=dict)
    turned: Mapping[str, float] = attrs.field(factory=dict)
    lowest: float = np.nan


_FAMILIES = ("sections", "waterlines", "buttocks")

_END = 1.5
"""m: what lies nearer to the end of a waterline or a buttock is not counted."""


def sign_changes(hull: ah.Hull) -> dict[str, list[int]]:
    """Count the sign changes of curvature of each line of each family."""
    found: dict[str, list[int]] = {each: [] for each in _FAMILIES}
    for line in hull.lines.values():
        family = line.group.family
        if family not in found:
            continue
        total = 0
        for curve in line.curves:
            spline = hull.state.spline(curve.row)
            _, places = inflections(spline, hull.state.lines.normal[line.row])
            x = np.interp(places.t, spline.knot, spline.xyz[:, 0])
            if family != "sections":
                x = x[np.abs(x[:, None] - spline.xyz[[0, -1], 0]).min(axis=1) > _END]
            total += len(x)
        found[family].append(total)
    return found


def turned(hull: ah.Hull) -> dict[str, float]:
    """Give the batten residual over spacing, deg, that 95 % of the points stay below."""
    state, found = hull.state, net_battens(hull.state)
    families = {name: number for number, name in enumerate(state.groups.name.data)}
    spacing = np.empty(len(found.residual))
    for curve in np.unique(found.curve).tolist():
        mine = np.flatnonzero(found.curve == curve)
        rows = state.curves.rows[curve]
        order = np.argsort(rows)
        place = order[np.searchsorted(rows, found.centre[mine], sorter=order)]
        knot = state.spline(curve).knot
        spacing[mine] = 0.25 * (knot[place + 2] - knot[place - 2])
    angle = np.degrees(np.abs(found.residual) / spacing)
    group = state.lines.group[state.curves.line[found.curve]]
    return {each: float(np.percentile(angle[group == families[each]], 95.0)) for each in _FAMILIES}


def parents() -> dict[str, ah.Hull]:
    """Give ships that nobody created, to set beside."""
    return {
        "207k carrier": ah.examples.bulk_carrier_207k(),
        "Series 60 .70": ah.examples.series60(0.70),
    }


def _told(changes: Mapping[str, list[int]], angles: Mapping[str, float]) -> str:
    return ", ".join(
        f"{family} {np.median(counts):g}/{max(counts)} {angles[family]:.2f} deg"
        for family, counts in changes.items()
    )


def _draw(kind: str, seed: int) -> dict[str, float]:
    """Draw six numbers."""
    random = np.random.default_rng([seed, list(RANGES).index(kind)])
    length, slender, beam, deep, cb, lcb = (float(random.uniform(*each)) for each in RANGES[kind])
    breadth = length / slender
    draught = breadth / beam
    return {
        "length": round(length, 1), "breadth": round(breadth, 2), "draught": round(draught, 2),
        "depth": round(draught * deep, 2), "cb": round(cb, 3), "lcb_percent": round(lcb, 2),
    }  # fmt: skip


def _made(kind: str, seed: int) -> Drawn:
    six = _draw(kind, seed)
    asked = ", ".join(f"{name} {value:g}" for name, value in six.items())
    try:
        hull = ah.create(type=kind, **six)  # type: ignore[call-overload, arg-type, unused-ignore]
        found = hull.hydrostatics()
    except ah.errors.AssocHullError as error:
        return Drawn(kind, asked, f"{type(error).__name__}: {error}")
    miss = found.lcb / six["length"] - 0.5 - 0.01 * six["lcb_percent"]
    lowest = min(float(point.position[2]) for line in hull.lines.values() for point in line.points)
    return Drawn(
        kind, asked, "", found.cb - six["cb"], miss, sign_changes(hull), turned(hull), lowest
    )


def drawn_ships(count: int) -> list[Drawn]:
    """Make so many ships of each type."""
    return [_made(kind, seed) for kind in RANGES for seed in range(count)]


def figures(quick: bool = False) -> list[Figure]:
    """Measure the share made, the misses and the sign changes."""
    found = []
    for name, hull in parents().items():
        changes, angles = sign_changes(hull), turned(hull)
        for family in _FAMILIES:
            title = f"{name}: {family}"
            counts = changes[family]
            found.append(Figure(f"{title}, sign changes, median", float(np.median(counts)), ""))
            found.append(Figure(f"{title}, sign changes, worst", float(max(counts)), ""))
            found.append(Figure(f"{title}, residual over spacing, p95", angles[family], "deg"))
    return found + _summary(drawn_ships(2 if quick else 12))


def _summary(ships: list[Drawn]) -> list[Figure]:
    found = []
    for kind in RANGES:
        some = [each for each in ships if each.kind == kind]
        made = [each for each in some if not each.refusal]
        found.append(Figure(f"{kind}: made", len(made) / len(some), "", 0.95, "least"))
        if not made:
            continue
        for name, misses in (("CB", [each.cb for each in made]), ("LCB/L", [e.lcb for e in made])):
            found.append(Figure(f"    {name}, worst", max(map(abs, misses)), "", 1e-6, "most"))
        for group in ("sections", "waterlines", "buttocks"):
            medians = [float(np.median(each.changes[group])) for each in made]
            worst = [max(each.changes[group]) for each in made]
            title = f"    sign changes, {group}"
            found.append(Figure(f"{title}, median", float(np.median(medians)), ""))
            found.append(Figure(f"{title}, worst", float(max(worst)), ""))
            angles = float(np.median([each.turned[group] for each in made]))
            found.append(Figure(f"    residual over spacing, p95, {group}", angles, "deg"))
    return found


if __name__ == "__main__":
    for name, hull in parents().items():
        print(f"{name}\n    {_told(sign_changes(hull), turned(hull))}", flush=True)
    for each in drawn_ships(int(sys.argv[1]) if len(sys.argv) > 1 else 2):
        words = each.refusal or (
            f"CB {each.cb:+.1e}, LCB {each.lcb:+.1e}, lowest {each.lowest:.3f}, "
            + _told(each.changes, each.turned)
        )
        print(f"{each.kind}: {each.asked}\n    {words}", flush=True)
