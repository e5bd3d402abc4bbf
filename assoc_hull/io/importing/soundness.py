"""What makes an adopted net not sound: lines off their sources, gaps, open ends, findings of check.

Each look notes what it finds in a `Findings`. A line that passes its source by more than it may is
a suspicion that tells place and amount; by far more, or most lines of a hull, are faults. What
cannot be computed is a fault as well, never a traceback.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.edit.adoption.adopt_lines import OVER, AdoptionReport, LineReport
from assoc_hull.edit.adoption.latent_crossings import at_ends
from assoc_hull.edit.checks.hull_findings import check
from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.io.importing.verdict import Findings
from assoc_hull.io.reports import Note
from assoc_hull.io.slicing.boundary_curves import BoundaryCurve
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import gap_at, tangents, watched_on
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.tables import CurveIntersections, HullState
from assoc_hull.surface.cells.net_faces import sound_cells

__all__ = [
    "STUMBLES",
    "deepest_lines",
    "deepest_note",
    "examine_net",
    "greatest_note",
    "look",
    "open_net_note",
    "sampled_places",
]

STUMBLES = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What numerics raise over a hull that is none; errors of this package are among them."""

_FAR = 10.0
"""A line that passes its source by more times its tolerance is another line: good imports have
their farthest point at 2.6 to 5.9 times, bad ones at 10.7 to 900 times."""

_MOST = 0.5
"""Of good imports up to a third of the lines are beyond their tolerance, of bad ones over half."""

_REACH = 0.25
"""Lines that miss one another by less, in breadths of the ship, were to cross."""

_STEEP = 0.02
"""A curve that meets a plane at a smaller angle (sine) runs along it."""

_SAMPLES = 8
"""Places on each segment at which a curve is looked at."""


def examine_net(
    state: HullState,
    adoption: AdoptionReport,
    found: Findings,
    borders: Sequence[BoundaryCurve] = (),
    *,
    drawn: bool = True,
    sized: bool = False,
) -> None:
    """Look at all lines of a hull, and at how they hang together.

    `borders` are those of flats that were drawn; `drawn` says that profile and deck edge are lines
    of the file, and not made of its sections; `sized`: the ship's length was given or stated.
    """
    for each in (
        lambda: _examine_lines(state, adoption.lines, found),
        lambda: _examine_borders(state, adoption.lines, borders, found),
        lambda: _examine_gaps(state, found),
        lambda: _examine_misses(state, found),
        lambda: _examine_centre(state, found),
        lambda: _examine_checks(state, found, sized=sized),
        lambda: _examine_cells(state, found, drawn),
    ):
        look(each, "the net", found)


def look(examine: Callable[[], None], where: str, found: Findings) -> None:
    """Run one look; that it cannot be finished is a fault."""
    try:
        with np.errstate(all="ignore"):
            examine()
    except AssocHullError as error:
        found.fault("not computed", where, str(error))
    except STUMBLES as error:
        reason = f"{type(error).__name__}: {error}"
        what = f"its numbers cannot be computed ({reason}): check unit, scale and frame of the file"
        found.fault("not computed", where, what)


def sampled_places(state: HullState) -> tuple[FloatArray, list[tuple[int, FloatArray]]]:
    """Give places on all curves, (n, 3), m, and those of each curve by its number."""
    curves = state.live("curves").tolist()
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    start, xyz = sample(batch, _SAMPLES)
    parts = zip(curves, start[:-1].tolist(), start[1:].tolist(), strict=True)
    return xyz, [(curve, xyz[a:b]) for curve, a, b in parts]


def _at(place: FloatArray | tuple[float, float, float]) -> str:
    x, y, z = (float(each) for each in place)
    return f"({x:.3f}, {y:.3f}, {z:.3f}) m"


# --------------------------------------------------------------------------------------
# Lines against their sources.


def _is_beyond(line: LineReport) -> bool:
    # Between its points a curve may pass its line by so much more, by the rule of adoption.
    return not line.tolerance_used <= OVER


def _times(line: LineReport, adoption: float) -> float:
    """Give how many times the tolerance of adoption a line is passed.

    Lines whose points are exact, as those of a table, are held closer than that, to a millimetre.
    """
    return line.tolerance_used * min(1.0, line.tolerance / adoption)


def _passes(line: LineReport) -> str:
    return (
        f"{line.line} by {1e3 * line.deviation:.1f} mm at {_at(line.place)}, "
        f"{line.tolerance_used:.1f} times what is allowed"
    )


def _examine_lines(state: HullState, lines: tuple[LineReport, ...], found: Findings) -> None:
    allowed = state.tolerances.adoption
    far = [each for each in lines if not _times(each, allowed) <= _FAR]
    for line in far:
        what = (
            f"passes its source {1e3 * line.deviation:.1f} mm off, {_times(line, allowed):.1f} "
            f"times the tolerance of {1e3 * allowed:.3g} mm across the hull: it is not the line of "
            "the file; check unit, scale and axes, or mend the line there"
        )
        found.fault("off its source", f"{line.line} at {_at(line.place)}", what, line.deviation)
    most = [each for each in lines if not _times(each, allowed) <= OVER]
    if len(most) > _MOST * len(lines):
        worst = max(most, key=lambda each: each.tolerance_used)
        what = (
            f"are farther off their sources than the {1e3 * allowed:.3g} mm across the hull that "
            f"they may be, the farthest {_passes(worst)}: check unit and scale, or give a coarser "
            "tolerance where the file is no better"
        )
        where = f"{len(most)} of {len(lines)} lines"
        found.fault("off their sources", where, what, worst.deviation)
        return
    rest = [line for line in filter(_is_beyond, lines) if line not in far]
    if rest:
        rest.sort(key=lambda each: -each.tolerance_used)
        what = f"pass their sources by more than is allowed: {'; '.join(map(_passes, rest))}"
        where = f"{len(rest)} of {len(lines)} lines"
        found.suspect("off their sources", where, what, rest[0].deviation)


def _examine_borders(
    state: HullState,
    lines: tuple[LineReport, ...],
    borders: Sequence[BoundaryCurve],
    found: Findings,
) -> None:
    """Borders of flats have an allowance of their own, since all lines end in them tangent."""
    number = {key: i for i, key in enumerate(state.curves.key.data)}
    for line in filter(_is_beyond, lines):
        boundary = int(state.lines.boundary[state.line_of(number[line.curve])])
        allowed = max(line.tolerance, _doubt_there(line, borders))
        part = line.tolerance_used * line.tolerance / allowed
        if boundary == BoundaryKind.FLAT and not part <= OVER:
            what = (
                f"the border passes its marks {1e3 * line.deviation:.1f} mm off, "
                f"{part:.1f} times its own allowance: give more lines that cross it, or draw the "
                "border as a line of the file"
            )
            where = f"{line.line} at {_at(line.place)}"
            found.fault("border of a flat", where, what, line.deviation)


def _doubt_there(line: LineReport, borders: Sequence[BoundaryCurve]) -> float:
    """Give the doubt (m) of the mark of a drawn border where it is passed; 0 if it was drawn."""
    mine = [each for each in borders if each.name == line.line]
    if not mine:
        return 0.0
    away = np.concatenate([np.abs(each.places - line.place).sum(axis=1) for each in mine])
    return float(np.concatenate([each.doubt for each in mine])[int(away.argmin())])


# --------------------------------------------------------------------------------------
# The net by itself.


def _examine_gaps(state: HullState, found: Findings) -> None:
    """Watched crossings that gape: their limits grow with the gaps found at adoption."""
    rows = watched_on(state, state.live("curves"))
    rows = rows[np.isfinite(state.rows.parameter[rows]).all(axis=1)]
    if not len(rows):
        return
    gap, limit = gap_at(state, rows), _FAR * state.tolerances.adoption
    book = AddressBook(state)
    for i in np.flatnonzero(~(gap <= limit)).tolist():
        what = (
            f"its lines pass each other {1e3 * gap[i]:.1f} mm apart, where {1e3 * limit:.3g} mm is "
            "the limit: one of the two is wrong; mend it, or leave it out"
        )
        where = f"{book.address(int(rows[i]))} at {_at(state.rows.xyz[rows[i]])}"
        found.fault("gap", where, what, float(gap[i]))


def _examine_misses(state: HullState, found: Findings) -> None:
    """Lines that pass each other farther apart than a crossing could be: they have none.

    By less than the least limit of a gap they touch, and there is nothing to mend.
    """
    book, seen = AddressBook(state), set[tuple[int, int]]()
    latent = _latent_places(state)
    for (curve, line), places in sorted(latent.items()):
        for other in state.lines.curves[line]:
            back = latent.get((other, state.line_of(curve)))
            pair = (min(curve, other), max(curve, other))
            if back is None or pair in seen:
                continue
            seen.add(pair)
            away = np.sqrt(((places[:, None] - back[None]) ** 2).sum(axis=2))
            # Where both end on a third line, by that line, there is nothing to cross.
            ending = at_ends(state, curve, places)[:, None] & at_ends(state, other, back)[None]
            away[ending & (away <= state.tolerances.adoption)] = 0.0
            i, j = (int(each) for each in np.unravel_index(away.argmin(), away.shape))
            if state.tolerances.gap_floor < away[i, j] < _REACH * state.particulars.breadth:
                what = (
                    f"they pass each other {1e3 * away[i, j]:.3g} mm apart, too far to cross: one "
                    "of the two is wrong; mend it, or leave it out"
                )
                where = f"{book.curve_name(pair[0])} x {book.curve_name(pair[1])}"
                found.fault("gap", f"{where} at {_at(places[i])}", what, float(away[i, j]))


def _latent_places(state: HullState) -> dict[tuple[int, int], FloatArray]:
    """Give, by curve and line, the places (k, 3), m, where curves meet planes and cross nothing."""
    found: dict[tuple[int, int], FloatArray] = {}
    for curve in state.live("curves").tolist():
        meets = state.curves.meets[curve]
        free = (meets.row < 0) & np.isfinite(meets.xyz).all(axis=1)
        if free.any():
            free[free] = _through(state, curve, meets.take(free))
        for line in np.unique(meets.line[free]).tolist():
            found[curve, line] = meets.xyz[free & (meets.line == line)]
    return found


def _through(
    state: HullState, curve: int, meets: CurveIntersections
) -> np.typing.NDArray[np.bool_]:
    """Tell where a curve passes through planes, (k,); along one that it runs in it is chance."""
    slope = tangents(state, np.full(len(meets.line), curve), meets.parameter)
    sine = np.abs((slope * state.lines.normal[meets.line]).sum(axis=1))
    found: np.typing.NDArray[np.bool_] = sine >= _STEEP
    return found


def _examine_centre(state: HullState, found: Findings) -> None:
    """Lines of the port side that run through the centre plane."""
    book, allowed = AddressBook(state), state.tolerances.adoption
    for curve, places in sampled_places(state)[1]:
        deepest = int(np.argmin(places[:, 1]))
        over = -float(places[deepest, 1])
        if over > allowed:
            what = (
                f"runs {1e3 * over:.1f} mm through the centre plane, where {1e3 * allowed:.3g} mm "
                "is allowed: end it on the centre line, or give the place of the centre plane"
            )
            where = f"{book.curve_name(curve)} at {_at(places[deepest])}"
            found.fault("centre plane", where, what, over)


def _examine_checks(state: HullState, found: Findings, *, sized: bool = False) -> None:
    found.faults.extend(_checked(state, sized=sized))


def _checked(state: HullState, *, sized: bool) -> Iterator[Note]:
    """Give the findings of `check`, each with its place."""
    for each in check(state):
        place = "" if each.place is None else f" at {_at(each.place)}"
        what = each.message
        if each.kind in ("fold", "loop"):  # what is imported has had no edit that could be undone
            what = f"{what.partition(': ')[0]}: {_unfold(state, sized=sized)}"
        yield Note(each.kind, f"{each.object}{place}", what, each.amount)


_LONGEST_MODEL = 25.0
"""m: no model of a ship is longer."""


def _unfold(state: HullState, *, sized: bool) -> str:
    """Say what to do about a line that folds: details of a model are finer than a boat's.

    A hull as long as was said is no model.
    """
    remedy = "mend the line there, give it more points, or cut at other places"
    if sized or state.particulars.length > _LONGEST_MODEL:
        return remedy
    return f"if this is the model of a ship give scale=, full scale over it; else {remedy}"


_OUTER = frozenset({"profile", "deck edge"})
"""The lines of the file that enclose half a hull."""


def open_cells(state: HullState) -> str:
    """Say why the lines part the hull into no cells, as mesh and surface need; else nothing."""
    try:
        sound_cells(gather_net(state))
    except AssocHullError as error:
        return str(error)
    return ""


def _is_enclosed(state: HullState) -> bool:
    """Tell whether the file has the lines that enclose half a hull."""
    return {str(state.lines.name[line]) for line in state.live("lines").tolist()} >= _OUTER


def open_net_note(state: HullState) -> tuple[str, ...]:
    """Tell what cannot be made of lines that no profile and deck edge enclose."""
    if _is_enclosed(state) or not open_cells(state):
        return ()
    return (
        "surface and closed mesh cannot be made: they need lines that meet, a profile and a deck "
        "edge, and the file has not all of them",
    )


_FINE = 32
"""Places on each segment at which a greatest breadth is looked for."""

_NAMED = 6
"""So many lines are named that pass their greatest point."""


def greatest_note(state: HullState, noise: float) -> tuple[str, ...]:
    """Tell which lines are broader between their points than at any of them, the deck edge too.

    `noise` (m) is what the file leaves open anyway. Where the greatest breadth lies between unequal
    offsets, a smooth line passes both.
    """
    passed = _between_points(state, ("sections", "waterlines", "boundary"), 1, 1.0, noise)
    return _told(
        passed, "broader between given points than at the greatest of them", "over {:.6g} m"
    )


def deepest_note(state: HullState, noise: float) -> tuple[str, ...]:
    """Tell which sections run lower between their points than at any of them, as under a flat."""
    passed = _between_points(state, ("sections",), 2, -1.0, noise)
    return _told(
        passed, "lower between given points than at the lowest of them", "under z = {:.6g} m"
    )


def deepest_lines(state: HullState, noise: float, floor: float) -> Iterator[Note]:
    """Give the sections that hang below their own points, and other lines below z = `floor` (m).

    Nothing of a hull lies below its keel: volume and draught would be those of another ship.
    """
    hanging = _between_points(state, ("sections",), 2, -1.0, noise)
    book, named = AddressBook(state), {name for _, name, _, _ in hanging}
    for curve, places in sampled_places(state)[1]:
        lowest = places[int(places[:, 2].argmin())]
        name = book.curve_name(curve)
        if floor - lowest[2] > noise and name not in named:
            hanging.append((floor - float(lowest[2]), name, floor, _at(lowest)))
    for over, name, lowest_given, place in hanging:
        what = (
            f"hangs {1e3 * over:.4g} mm below the lowest height that the table gives it, z = "
            f"{lowest_given:.6g} m, at {place}: give one more waterline close above the keel, or "
            "the heights of the keel in a column 'keel'"
        )
        yield Note("below the keel", name, what, over)


_Passed = list[tuple[float, str, float, str]]
"""By how much a line passes the outermost of its points, m; its name; that point, m; the place."""


def _between_points(
    state: HullState, families: tuple[str, ...], axis: int, sense: float, noise: float
) -> _Passed:
    """Give the lines that go farther along an axis between their points, the farthest first."""
    passed: _Passed = []
    book = AddressBook(state)
    for curve in state.live("curves").tolist():
        if state.family(state.line_of(curve)).name not in families:
            continue
        spline = state.spline(curve)
        places = sample(spline, _FINE)[1]
        farthest = places[int((sense * places[:, axis]).argmax())]
        most = float((sense * spline.xyz[:, axis]).max())
        if sense * farthest[axis] - most > noise:
            over = sense * float(farthest[axis]) - most
            passed.append((over, book.curve_name(curve), sense * most, _at(farthest)))
    return sorted(passed, reverse=True)


def _told(passed: _Passed, what: str, limit: str) -> tuple[str, ...]:
    """Say it in one note, of the first lines by name; none where no line does."""
    if not passed:
        return ()
    some = "; ".join(
        f"{name} by {1e3 * over:.1f} mm {limit.format(most)}, at {place}"
        for over, name, most, place in passed[:_NAMED]
    )
    rest = f"; and {len(passed) - _NAMED} more, by less" if len(passed) > _NAMED else ""
    return (f"{what}: {some}{rest}",)


def _examine_cells(state: HullState, found: Findings, drawn: bool) -> None:
    """Find the hole in a net with profile and deck edge: of lines alone nobody expects cells."""
    why = open_cells(state) if _is_enclosed(state) else ""
    if why:
        what = f"surface and closed mesh cannot be made: {why}"
        # What was lofted through sections is our guess, and their numbers hold without it.
        (found.fault if drawn else found.suspect)("open net", "the net", what)
