"""Fairness of the lines of a hull as numbers, also as pieces of the classical curves.

Lines of a net are judged besides by the loftsman's batten: how far it springs off each point, and
where it does so more than on the lines beside. That is the only verdict on a net: a good hull has
jumps of curvature where straight runs end, and lines whose look no limit can judge.

A knuckle of the net is a joint that may bend. Offsets of a line are the watched crossings on it,
those that define neither of their lines: their gap, over the limit of the gap. A `FairnessTable`
holds a record per curve, and compares those before and after an edit; numbers are never put into
one score.

Classical curves as the criteria of fairness look at them.
"""

from __future__ import annotations

from collections.abc import (
    Iterable,
    Iterator,
    Mapping,
    Sequence,
)
from typing import TYPE_CHECKING, Any, cast

import attrs
import numpy as np
from numpy.typing import ArrayLike, NDArray

from assoc_hull.arguments import positive, shown
from assoc_hull.display import ShownAsText
from assoc_hull.errors import (
    BadInputError,
    GeometryError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.elastica import Elastica
from assoc_hull.geometry.curves import (
    FloatArray,
    IntArray,
    PointKind,
    SplineBatch,
)
from assoc_hull.geometry.fairness.criteria import FairnessRecord, OffsetDeviations, criteria
from assoc_hull.geometry.fairness.inflections import LOBE
from assoc_hull.geometry.splines.curve_pieces import (
    PieceDerivatives,
    PiecewiseCurves,
    SplinePieces,
    searched_distance,
)
from assoc_hull.model.gaps import watched_on
from assoc_hull.model.objects import Curve, Line
from assoc_hull.model.tables import HasState, HullState, state_of

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from assoc_hull.analysis.fairness.unfair_places import BattenFigures, UnfairPlace
    from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower

__all__ = [
    "ArcFairnessPieces",
    "ElasticaFairnessPieces",
    "FairnessPair",
    "FairnessTable",
    "chord_spline_pieces",
    "fairness",
    "hull_fairness",
]

_UP = np.array([0.0, 0.0, 1.0])


def chord_spline_pieces(spline: ChordSpline) -> SplinePieces:
    """Give a chord spline as pieces: it is a composite cubic.

    Examples
    --------
    >>> from assoc_hull.geometry.classical.chord_spline import ChordSpline
    >>> from assoc_hull.fairing.line_fairness import chord_spline_pieces
    >>> from assoc_hull.geometry.fairness.criteria import criteria
    >>> batten = ChordSpline.through([(0, 0), (2, 1), (4, 1.5), (7, 1.2), (9, 0)])
    >>> criteria(chord_spline_pieces(batten))[0].failed
    ()
    """
    return SplinePieces.of(spline.batch, _UP)


def _seen(
    angle: FloatArray, curvature: FloatArray, rate: FloatArray, speed: FloatArray
) -> PieceDerivatives:
    """Put together what is seen from direction, curvature and its slope."""
    tangent = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    left = np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)
    return PieceDerivatives(tangent, curvature, rate, speed, curvature[..., None] * left, rate)


@attrs.frozen(eq=False)
class ArcFairnessPieces:
    """One chain of arcs and straight lines."""

    arcs: PlaneArcs

    @property
    def owner(self) -> IntArray:
        """All arcs belong to one curve."""
        return np.zeros(len(self.arcs), np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Curvature has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Only the steps of curvature count."""
        return True

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all arcs at parameters u (k,)."""
        arcs = self.arcs
        shape = (len(arcs), len(u))
        angle = arcs.angle[:, None] + (arcs.curvature * arcs.length)[:, None] * u
        curvature, speed = (
            np.broadcast_to(each[:, None], shape) for each in (arcs.curvature, arcs.length)
        )
        return _seen(angle, curvature, np.zeros(shape), speed)

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the chain, (k,)."""
        arc = np.tile(np.arange(len(self.arcs)), len(points))
        each = self.arcs.distance(arc, np.repeat(points, len(self.arcs), axis=0))
        return np.asarray(each.reshape(len(points), -1).min(axis=1))


@attrs.frozen(eq=False)
class ElasticaFairnessPieces:
    """A chain of elastica, joined end to end; each is looked at in `parts` pieces."""

    segments: tuple[Elastica, ...]
    parts: int = 8

    @property
    def owner(self) -> IntArray:
        """All pieces belong to one curve."""
        return np.zeros(self.parts * len(self.segments), np.int64)

    @property
    def signed(self) -> np.typing.NDArray[np.bool_]:
        """Curvature has a sign."""
        return np.ones(1, np.bool_)

    @property
    def of_arcs(self) -> bool:
        """Curvature changes along an elastica."""
        return False

    def seen(self, u: FloatArray) -> PieceDerivatives:
        """Look at all pieces at parameters u (k,)."""
        rows = [self._one(each, u) for each in self.segments]
        angle, curvature, rate, speed = (np.concatenate(each) for each in zip(*rows, strict=True))
        return _seen(angle, curvature, rate, speed)

    def _one(self, rod: Elastica, u: FloatArray) -> tuple[FloatArray, ...]:
        step = rod.length / self.parts
        s = np.minimum((np.arange(self.parts)[:, None] + u) * step, rod.length)
        speed = np.full(s.shape, step)
        return rod.direction(s), rod.curvature(s), rod.curvature_rate(s), speed

    def distance(self, curve: IntArray, points: FloatArray) -> FloatArray:
        """Give the distance (m) of points (k, 2) from the chain, (k,)."""
        away = [
            searched_distance(rod.at, np.linspace(0.0, rod.length, self.parts + 1), points)
            for rod in self.segments
        ]
        return np.asarray(np.min(away, axis=0))


# --------------------------------------------------------------------------------------
# Tables of records.

_LOOK = ("bending", "variation", "support_jumps", "extrema")
_HEADS = {
    "bending": "E2", "variation": "E3", "support_jumps": "J3 1/m2", "extrema": "extremes",
    "inflections": "inflections",
}  # fmt: skip


@attrs.frozen(eq=False)
class FairnessPair:
    """A curve before and after an edit."""

    before: FairnessRecord
    after: FairnessRecord

    def ratio(self, number: str) -> float | None:
        """Give after over before of a number of the record; None where it has none or was 0."""
        before, after = getattr(self.before, number), getattr(self.after, number)
        return None if not before or after is None else float(after / before)

    @property
    def changed(self) -> bool:
        """Whether any number differs."""
        return self.before != self.after


@attrs.frozen(eq=False, repr=False)
class FairnessTable(ShownAsText):
    """Records of curves of a net, line by line.

    Attributes
    ----------
    records : tuple of FairnessRecord
        One per curve.
    keys : tuple of str
        The curves, as the hull names them.
    lines : tuple of str
        The line that each belongs to.
    battens : tuple of BattenFigures or None
        How far battens spring off the points of each; None where no point may move.
    unfair : tuple of UnfairPlace
        Where they spring more than on the lines beside, the worst place first.
    """

    records: tuple[FairnessRecord, ...]
    keys: tuple[str, ...]
    lines: tuple[str, ...]
    battens: tuple[BattenFigures | None, ...] = ()
    unfair: tuple[UnfairPlace, ...] = ()

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[FairnessRecord]:
        return iter(self.records)

    def __getitem__(self, line: str) -> tuple[FairnessRecord, ...]:
        """Give the records of the curves of a line, by its name."""
        found = tuple(
            each for each, name in zip(self.records, self.lines, strict=True) if name == line
        )
        if not found:
            raise UnknownNameError("line", str(line), tuple(dict.fromkeys(self.lines)))
        return found

    @property
    def failures(self) -> dict[str, tuple[str, ...]]:
        """By criterion that has a limit, the curves that do not keep it."""
        kinds = ("first derivative", "second derivative", "inflections", "deviation")
        return {
            kind: tuple(each.name for each in self.records if each.passed[kind] is False)
            for kind in kinds
        }

    def pairs(self, after: FairnessTable) -> tuple[FairnessPair, ...]:
        """Give the curves that this and another table have, this one before."""
        other = dict(zip(after.keys, after.records, strict=True))
        return tuple(
            FairnessPair(record, other[key])
            for key, record in zip(self.keys, self.records, strict=True)
            if key in other
        )

    def data(self) -> dict[str, Any]:
        """Give all as plain values."""
        rows = zip(self.keys, self.lines, self.records, self._battens, strict=True)
        return {
            "curves": [
                {"key": key, "line": line, **_row(each),
                 "batten": None if batten is None else attrs.asdict(batten)}
                for key, line, each, batten in rows
            ],
            "failures": {kind: list(names) for kind, names in self.failures.items()},
            "unfair": [attrs.asdict(place) for place in self.unfair],
        }  # fmt: skip

    @property
    def _battens(self) -> tuple[BattenFigures | None, ...]:
        return self.battens or (None,) * len(self.records)

    def compared(self, after: FairnessTable) -> dict[str, Any]:
        """Give what both have side by side as plain values."""
        return {
            "curves": [
                {"before": _row(pair.before), "after": _row(pair.after),
                 "ratios": {name: pair.ratio(name) for name in _LOOK}}
                for pair in self.pairs(after)
            ],
            "failures_before": {k: list(v) for k, v in self.failures.items()},
            "failures_after": {k: list(v) for k, v in after.failures.items()},
        }  # fmt: skip

    def __str__(self) -> str:
        """Give the curves whose battens spring most, against the usual, first."""
        worst = [0.0 if each is None else each.ratio for each in self._battens]
        order = np.argsort([-each for each in worst], kind="stable").tolist()
        lines = [_HEAD, *(_text(self.records[i], self._battens[i]) for i in order), ""]
        return "\n".join([*lines, *self._words()])

    def _words(self) -> Iterator[str]:
        """Say where lines are unfair, and what the count is of."""
        yield (
            "inflections: all changes of the sign of curvature, also those of the faintest waves; "
            f"`fair` counts those between bends of {LOBE:g} degree or more"
        )
        names = set(self.lines)
        if not self.unfair:
            yield f"no line of {len(names)} is unfair: battens spring as on the lines beside"
            return
        called = len({place.line for place in self.unfair})
        verb = "is" if called == 1 else "are"
        yield f"{called} of {len(names)} lines {verb} unfair, the worst place first"
        yield from map(str, self.unfair)

    def comparison(self, after: FairnessTable) -> str:
        """Write what both have side by side: the look of lines has no limit but this.

        Curves whose numbers are the same are counted only.
        """
        pairs = self.pairs(after)
        rows = [pair for pair in pairs if pair.changed]
        wide = {name: 24 for name in _HEADS}
        lines = [f"{'curve':16}" + "".join(f"{_HEADS[name]:>{wide[name]}}" for name in _HEADS)]
        for pair in rows:
            cells = (
                f"{_figure(getattr(pair.before, name))} > {_figure(getattr(pair.after, name))}"
                for name in _HEADS
            )
            lines.append(f"{pair.before.name:16}" + "".join(f"{each:>24}" for each in cells))
        lines.append(f"{len(pairs) - len(rows)} of {len(pairs)} curves are the same")
        alone = len(self) + len(after) - 2 * len(pairs)
        if alone:
            lines.append(f"{alone} curves are in one hull only")
        return "\n".join(lines)


_HEAD = (
    f"{'curve':16}{'L m':>9}{'J1 rad':>10}{'J2':>10}{'inflections':>13}{'D max':>8}{'D rms':>8}"
    f"{'E2':>10}{'E3':>12}{'J3 1/m2':>11}{'extremes':>10}"
    f"{'knuckles':>10}{'batten mm':>11}{'usual x':>9}  most unusual at"
)


def _text(each: FairnessRecord, batten: BattenFigures | None) -> str:
    bends = _figure(each.inflections)
    if each.inflections_allowed:
        bends += f" ({each.inflections_allowed})"
    return (
        f"{each.name:16}{each.length:9.3f}{_jump(each.angle_jump):>10}{_jump(each.curvature_jump):>10}"
        f"{bends:>13}{_short(each.deviation_max):>8}{_short(each.deviation_rms):>8}"
        f"{each.bending:10.4g}{each.variation:12.5g}{_figure(each.support_jumps):>11}"
        f"{each.extrema:10d}{each.knuckles:10d}{_springs(batten)}"
    )


def _springs(batten: BattenFigures | None) -> str:
    if batten is None:
        return f"{'-':>11}{'-':>9}"
    ratio = f"{batten.ratio:.1f}" if batten.ratio else "-"
    return f"{1e3 * batten.largest:11.2f}{ratio:>9}  {batten.at}"


def _jump(value: float) -> str:
    """Write a jump; below 1e-11 it is rounding, and written as 0."""
    return f"{value:.2g}" if value > 1e-11 else "0"


def _short(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"


def _figure(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g}"


def _row(each: FairnessRecord) -> dict[str, Any]:
    """Give a record as plain values, with what it kept."""
    told = attrs.asdict(each, filter=lambda field, _: field.name != "limits")
    return told | {"unwanted_inflections": each.unwanted_inflections, "passed": each.passed}


# --------------------------------------------------------------------------------------
# Measuring.

if TYPE_CHECKING:
    Single = PPoly | PlaneArcs | ChordSpline | Elastica | TruncatedPower

_WHERE = "in fairness"


def fairness(
    of: HasState | Line | Curve | Single,
    *,
    lines: Iterable[str] | None = None,
    allowed: int | Mapping[str, int] = 0,
    offsets: ArrayLike | None = None,
    tolerances: ArrayLike = 0.005,
    noise: float | None = None,
) -> FairnessTable | FairnessRecord:
    """Take the five criteria of fairness as numbers; they are never put into one score.

    Parameters
    ----------
    of : Hull, Line, Curve or a plane curve
        What is looked at. A plane curve is a chord spline, an elastica, a chain of arcs, a
        truncated-power spline or a piecewise polynomial y(x) of scipy.
    lines : iterable of str, optional
        Names of lines of the hull; all of them by default.
    allowed : int or mapping of str to int
        Inflections that are wanted: of each curve, or by name of line (others: none).
    offsets : (k, 2), m, optional
        Points that a plane curve is meant to pass. Lines of a hull bring theirs along: the
        crossings that define neither line, and how wide their gaps may be.
    tolerances : float or (k,), m
        How far it may pass them.
    noise : float or None, m
        Of the source of a hull, as a standard deviation: battens that spring by so little are not
        judged. None: 2e-6 of Lpp.

    Returns
    -------
    FairnessTable or FairnessRecord
        A table, a record for each curve, of a hull, a line or one of its curves; one record of
        a plane curve.

    Raises
    ------
    GeometryError
        ``"fairness: curve has no length"``, ``"fairness: offsets and tolerances differ in
        length"``.
    UnknownNameError
        There is no such line.
    BadInputError
        A number of wanted inflections that is none.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> found = ah.form.fairness(ah.examples.wigley())
    >>> found["WL 2.5"][0].failed
    ()
    """
    if isinstance(of, Line | Curve) or isinstance(getattr(of, "state", None), HullState):
        if offsets is not None:
            what, remedy = "lines of a hull bring their offsets", "leave offsets out"
            raise BadInputError(what, _WHERE, remedy)
        return hull_fairness(cast("HasState | Line | Curve", of), lines, allowed, noise)
    if lines is not None:
        raise BadInputError("lines of one curve", _WHERE, "give names of lines with a hull only")
    if noise is not None:
        what, remedy = "noise of one curve", "give noise with a hull or its lines only"
        raise BadInputError(what, _WHERE, remedy)
    pieces, name = _pieces_of(of)
    points = None if offsets is None else OffsetDeviations.measured(pieces, offsets, tolerances)
    wanted = _count(allowed)
    return criteria(pieces, names=(name,), allowed=wanted, offsets=points)[0]


def _count(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < 0:
        raise BadInputError(f"allowed is {shown(value)}", _WHERE, "give a whole number from 0")
    if value > 10**9:
        raise BadInputError(f"allowed is {shown(value)}", _WHERE, "give a number below 1e9")
    return int(value)


def _pieces_of(curve: object) -> tuple[PiecewiseCurves, str]:
    """Look at a plane curve in pieces, and name its kind."""
    # Only who asks for these curves waits for scipy's interpolation.
    from scipy.interpolate import PPoly

    from assoc_hull.geometry.classical.chord_spline import ChordSpline
    from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
    from assoc_hull.geometry.classical.elastica import Elastica
    from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower
    from assoc_hull.geometry.splines.curve_pieces import GraphPieces

    if isinstance(curve, ChordSpline):
        return chord_spline_pieces(curve), "chord spline"
    if isinstance(curve, Elastica):
        return ElasticaFairnessPieces((curve,)), "elastica"
    if isinstance(curve, PlaneArcs):
        if not len(curve):
            raise GeometryError("fairness: curve has no length", "give one arc or more")
        return ArcFairnessPieces(curve), "arcs"
    if isinstance(curve, TruncatedPower):
        return GraphPieces.of(curve.curve), "truncated powers"
    if isinstance(curve, PPoly):
        return GraphPieces.of(curve), "graph"
    raise WrongTypeError(
        f"{shown(curve)} is no curve that can be looked at", _WHERE,
        "give a Hull, a Line, a Curve, a classical plane curve or a PPoly of scipy",
    )  # fmt: skip


def hull_fairness(
    of: HasState | Line | Curve,
    lines: Iterable[str] | None = None,
    allowed: int | Mapping[str, int] = 0,
    noise: float | None = None,
) -> FairnessTable:
    """Look at curves of a net in one batch; arguments as of `fairness`."""
    # who looks at a plane curve needs no net
    from assoc_hull.analysis.fairness.unfair_places import judge_battens
    from assoc_hull.edit.net_battens import net_battens

    if noise is not None:
        noise = positive(noise, "noise", _WHERE)
    state = of.tables if isinstance(of, Line | Curve) else state_of(of, _WHERE)
    chosen = _chosen(of, state, lines)
    if not chosen:
        return FairnessTable((), (), ())
    curves = np.array(chosen, np.int64)
    batch = SplineBatch.join([state.spline(curve) for curve in chosen])
    line = state.curves.line[curves]
    flat = state.lines.planar[line][:, None]
    pieces = SplinePieces(batch, np.where(flat, state.lines.normal[line], np.nan))
    names = [str(state.lines.name[each]) for each in line.tolist()]
    titles = [Curve.of(state, curve).name for curve in chosen]
    records = criteria(
        pieces,
        names=titles,
        knuckles=_knuckles(state, chosen),
        allowed=_wanted(allowed, names, state),
        offsets=_watched(state, curves),
    )
    keys = tuple(str(state.curves.key[curve]) for curve in chosen)
    judged = judge_battens(state, net_battens(state), noise)
    return FairnessTable(
        records, keys, tuple(names), judged.figures(state, curves),
        tuple(place for place in judged.places(state) if place.line in set(names)),
    )  # fmt: skip


def _chosen(
    of: HasState | Line | Curve, state: HullState, lines: Iterable[str] | None
) -> list[int]:
    """Give the numbers of the curves that are asked for, those with a shape."""
    if isinstance(of, Curve):
        which = [of.row]
    elif isinstance(of, Line):
        which = state.curves_of(of.row)
    else:
        which = [c for line in _lines(state, lines) for c in state.curves_of(line)]
    if lines is not None and isinstance(of, Line | Curve):
        raise BadInputError("lines of one line", _WHERE, "give names of lines with a hull only")
    return which


def _lines(state: HullState, lines: object) -> list[int]:
    live = [int(line) for line in state.live("lines")]
    if lines is None:
        return live
    if isinstance(lines, str) or not isinstance(lines, Iterable):
        raise WrongTypeError(f"lines is {shown(lines)}", _WHERE, "give a list of names")
    names = [str(state.lines.name[line]) for line in live]
    found = []
    for each in lines:
        if not isinstance(each, str):
            raise WrongTypeError(f"lines holds {shown(each)}", _WHERE, "give names")
        if each not in names:
            raise UnknownNameError("line", each, tuple(names))
        found += [line for line, name in zip(live, names, strict=True) if name == each]
    return found


def _wanted(allowed: int | Mapping[str, int], names: Sequence[str], state: HullState) -> IntArray:
    if not isinstance(allowed, Mapping):
        return np.full(len(names), _count(allowed))
    known = {str(state.lines.name[line]) for line in state.live("lines").tolist()}
    for each in allowed:
        if each not in known:
            raise UnknownNameError("line", str(each), tuple(known))
    return np.array([_count(allowed.get(name, 0)) for name in names])


def _knuckles(state: HullState, curves: Sequence[int]) -> NDArray[np.bool_]:
    """Tell for each segment but the last of all whether it ends at a knuckle of its curve."""
    kind, found = state.rows.kind.data, []
    for curve in curves:
        rows, side = state.curves.rows[curve], state.curves.side[curve]
        bent = kind[rows, side] == PointKind.KNUCKLE
        bent[-1] = False
        found.append(bent[1:])
    return np.concatenate(found)[:-1]


def _watched(state: HullState, curves: IntArray) -> OffsetDeviations:
    """Give the gaps of watched crossings as offsets of both lines, over their limits."""
    rows = watched_on(state, curves)
    gap, limit = state.rows.gap[rows], state.rows.limit[rows]
    told = np.isfinite(gap) & (limit > 0.0)
    rows, gap, limit = rows[told], gap[told], limit[told]
    place = np.full(state.curves.count, -1)
    place[curves] = np.arange(len(curves))
    owner = place[state.rows.curve[rows]]
    mine = owner >= 0
    return OffsetDeviations(
        owner[mine], np.repeat(gap[:, None], 2, axis=1)[mine],
        np.repeat(limit[:, None], 2, axis=1)[mine],
    )  # fmt: skip
