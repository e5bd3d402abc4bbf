"""The rows of a comparison as they are printed, on a terminal as on paper."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from assoc_hull.model.features import Place
from assoc_hull.variation.comparing.lines import LineComparison
from assoc_hull.variation.comparing.number_comparison import NumberComparison
from assoc_hull.variation.comparing.object_comparison import FeatureComparison

if TYPE_CHECKING:
    from assoc_hull.variation.comparing.compare import ComparedHull, HullComparison

__all__ = [
    "LINE_HEAD",
    "NUMBER_HEAD",
    "PRINCIPAL",
    "amount",
    "counts",
    "hull_words",
    "line_cells",
    "line_words",
    "number_cells",
    "object_words",
    "reason_words",
]

PRINCIPAL = (
    "volume", "displacement", "lcb", "lcb_percent", "kb", "kmt", "kml", "waterplane_area", "lcf",
    "tpc", "mtc", "wetted_surface", "lwl", "bwl", "a_max", "a_midship", "cb", "cm", "cp", "cw",
)  # fmt: skip
"""The values of hydrostatics that are printed."""

LINE_HEAD = (
    "line", "shift mm", "direction", "at x, y, z (m)", "plane mm", "signs", "comb", "points",
)  # fmt: skip
"""Over `line_cells`: the largest shift, where it is on the variant, that of the plane alone;
changes of sign of curvature, ratio of the comb integrals, points that define the line."""

NUMBER_HEAD = ("", "unit", "parent", "variant", "difference", "%")
"""Over `number_cells`."""

_TOLD = 10
"""At most so many points are listed."""

_WHATS = ("same", "moved", "came", "went")


def hull_words(hull: ComparedHull) -> str:
    """Tell name and dimensions of a hull, and at which draught it was measured."""
    ship = hull.particulars
    sizes = f"Lpp {ship.length:.3f}, B {ship.breadth:.3f}, D {ship.depth:.3f}, T {ship.draught:.3f}"
    return f"{ship.name}: {sizes} m; measured at {hull.draught:.3f} m"


def counts(found: HullComparison) -> str:
    """Tell how many lines moved, came and went."""
    return ", ".join(f"{len(found.of(what))} {what}" for what in _WHATS)


def line_cells(line: LineComparison) -> list[str]:
    """Give the row of a line, below `LINE_HEAD`."""
    shift, fair, ratio = line.shift, line.fairness, line.comb_ratio
    plane = None if shift is None else shift.plane
    return [
        line.name,
        f"{1e3 * line.length:.1f}",
        "-" if shift is None else shift.direction,
        "-" if shift is None else ", ".join(f"{each:.2f}" for each in shift.after),
        "-" if plane is None else f"{1e3 * plane:+.1f}" if plane else "0",
        "-" if fair is None else f"{fair.before.sign_changes} > {fair.after.sign_changes}",
        "-" if ratio is None else f"{ratio:.3f}",
        f"{line.points[0]} > {line.points[1]}",
    ]


def line_words(found: HullComparison) -> Iterator[str]:
    """Tell which lines came, went, and were renamed, and how fair all are together."""
    for what in ("came", "went"):
        names = ", ".join(each.name for each in found.of(what))
        if names:
            yield f"{what}: {names}"
    for each in found.lines:
        if each.was not in (None, each.name):
            yield f"renamed: {each.was} > {each.name}"
    fair = found.fairness
    if fair.changed:
        worst = fair.worst_line
        yield (
            f"fairness of {len(fair.changed)} lines that changed: {fair.before} > {fair.after} "
            f"changes of sign, comb ratio {fair.median:.3f}"
            + ("" if worst is None else f", worst {fair.worst:.3f} ({worst.name})")
        )


def number_cells(number: NumberComparison) -> list[str]:
    """Give the row of a number, below `NUMBER_HEAD`."""
    digits, difference, percent = number.digits, number.difference, number.percent
    return [
        number.symbol,
        number.unit,
        amount(number.before, digits),
        amount(number.after, digits),
        "-" if difference is None else f"{round(difference, digits) + 0.0:+.{digits}f}",
        "-" if percent is None else f"{round(percent, 3) + 0.0:+.3f}",
    ]


def amount(value: float | None, digits: int) -> str:
    """Give a number as it is printed; a dash where there is none."""
    return "-" if value is None else f"{round(value, digits) + 0.0:.{digits}f}"


def reason_words(numbers: Sequence[NumberComparison]) -> Iterator[str]:
    """Tell why numbers are missing, each reason once."""
    reasons = dict[str, list[str]]()
    for each in numbers:
        if each.reason is not None:
            reasons.setdefault(each.reason, []).append(each.symbol)
    yield from (f"{', '.join(symbols)}: {reason}" for reason, symbols in reasons.items())


def object_words(found: HullComparison) -> Iterator[str]:
    """Tell which points came and went, and which features changed."""
    points = found.points
    yield "points: " + ", ".join(
        f"{count} > {points.after[sort]} {sort}" for sort, count in points.before.items()
    )
    for what, names in (("came", points.came), ("went", points.went)):
        if names:
            more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
            yield f"{len(names)} {what}: {', '.join(names[:_TOLD])}{more}"
    for each in found.features:
        if each.what != "same":
            yield f"feature {each.name} ({each.kind}) {each.what}{_parameters(each)}"


def _parameters(feature: FeatureComparison) -> str:
    """Tell the parameters of a feature that differ."""
    old, new = feature.before, feature.after
    if old is None or new is None:
        return ""
    told = [
        f"{name} {_value(old[name])} > {_value(new[name])}"
        for name in new
        if name in old and old[name] != new[name]
    ]
    return f": {', '.join(told)}" if told else ""


def _value(value: float | Place) -> str:
    if isinstance(value, tuple):
        return f"({', '.join(f'{each:g}' for each in value)})"
    return f"{value:g}"
