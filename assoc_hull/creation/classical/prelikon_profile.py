"""The centre-line profile of a hull of sections: stern, keel and stem, and where it ends flat."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.creation.classical.outline import Outline, Piece, smooth, straight
from assoc_hull.creation.classical.prelikon_pieces import pieces_of
from assoc_hull.creation.classical.prelikon_stations import AT, Station
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_boundary import ArcBoundary
from assoc_hull.geometry.classical.arc_curve import ArcCurve
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.deck_surface import Deck
from assoc_hull.geometry.curves import FloatArray, IntArray

__all__ = ["ENDS", "Profile", "profile_of"]

ENDS = ("stern", "stem")
"""Names of the boundary curves that are parts of the profile."""

_LEVEL = 1e-6
"""A keel whose points (m) lie so near a straight line is one."""


@attrs.frozen(eq=False)
class Profile:
    """The profile, from aft forward.

    Attributes
    ----------
    stern, stem : ArcCurve or None
        (x, z), the stern downward, the stem upward; None where the hull ends at a section.
    keel : (n, 2), m
        Points between them.
    flat : (bool, bool)
        Whether the first and the last section are flat ends of the hull.
    """

    stern: ArcCurve | None
    stem: ArcCurve | None
    keel: FloatArray
    flat: tuple[bool, bool]

    @property
    def outline(self) -> Outline:
        """All of it as points for a line of the net."""
        found = [] if self.stern is None else pieces_of(self.stern)
        found += _keel(self.keel)
        return Outline.of(found if self.stem is None else [*found, *pieces_of(self.stem)])

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """Its after and its fore end, (x, z) each, m."""
        after = self.keel[0] if self.stern is None else self.stern.arcs.start[0]
        fore = self.keel[-1] if self.stem is None else self.stem.arcs.ends()[-1]
        return after, fore

    def heights(self, x: FloatArray) -> list[FloatArray]:
        """Give at each place (m) all heights (m) at which the profile stands there."""
        found = []
        for at in x.tolist():
            here = [each.where(0, at)[:, 1] for each in (self.stern, self.stem) if each is not None]
            if self.keel[0, 0] - AT <= at <= self.keel[-1, 0] + AT:
                here.append(np.interp([at], self.keel[:, 0], self.keel[:, 1]))
            found.append(np.concatenate([*here, np.zeros(0)]))
        return found

    def foremost(self, draught: float) -> float:
        """Give the foremost x (m) of the profile below a height (m)."""
        return self._extreme(self.stem, draught, 1.0, float(self.keel[-1, 0]))

    def aftermost(self, draught: float) -> float:
        """Give the aftermost x (m) of the profile below a height (m)."""
        return self._extreme(self.stern, draught, -1.0, float(self.keel[0, 0]))

    def _extreme(self, curve: ArcCurve | None, draught: float, sign: float, other: float) -> float:
        if curve is None:
            return other
        points = np.vstack([curve.sampled(0.01 * curve.length), curve.where(1, draught)])
        below = points[points[:, 1] <= draught + AT, 0]
        return float(max([*(sign * below), sign * other])) * sign


def profile_of(
    stations: Sequence[Station], boundaries: Sequence[ArcBoundary], deck: Deck | None
) -> Profile:
    """Put a profile together.

    Parameters
    ----------
    stations : sequence of Station
        From aft forward; the keel runs through their first points, where stern and stem are not.
    boundaries : sequence of ArcBoundary
        Those named ``"stern"`` and ``"stem"`` are used, given in either direction.
    deck : Deck or None
        At which stern and stem are cut off.

    Raises
    ------
    GeometryError
        A section that does not begin on it; a stern or stem that does not reach the deck, or
        reaches it beyond sections.
    """
    named = {each.name: each.curve for each in boundaries if each.name in ENDS}
    curves, flat = _ends(named, stations, deck)
    stern, stem = curves["stern"], curves["stem"]
    first = -np.inf if stern is None else float(stern.arcs.ends()[-1, 0])
    last = np.inf if stem is None else float(stem.arcs.start[0, 0])
    keel = [[each.x, each.keel] for each in stations if first + AT < each.x < last - AT]
    if stern is not None:
        keel.insert(0, stern.arcs.ends()[-1].tolist())
    if stem is not None:
        keel.append(stem.arcs.start[0].tolist())
    made = Profile(stern, stem, np.array(keel), flat)
    _require_on(made, stations)
    _require_between(made, stations)
    return made


def _ends(
    named: Mapping[str, ArcCurve], stations: Sequence[Station], deck: Deck | None
) -> tuple[dict[str, ArcCurve | None], tuple[bool, bool]]:
    """Give stern and stem in their directions, cut off; whether the hull ends flat at either."""
    found: dict[str, ArcCurve | None] = {}
    flat = []
    for name, station in (("stern", stations[0]), ("stem", stations[-1])):
        curve = named.get(name)
        if curve is None:
            found[name] = None
            flat.append(True)
            continue
        upward = curve if curve.arcs.start[0, 1] < curve.arcs.ends()[-1, 1] else _turned(curve)
        top = upward.arcs.ends()[-1]
        ends_flat = bool(np.hypot(*(top - [station.x, station.keel])) <= AT)
        if not ends_flat and deck is not None:
            upward = _up_to(upward, deck, name)
        found[name] = upward if name == "stem" else _turned(upward)
        flat.append(ends_flat)
    return found, (flat[0], flat[1])


def _up_to(curve: ArcCurve, deck: Deck, name: str) -> ArcCurve:
    """Cut a curve (x, z) that runs upward where it meets the centre line of a deck."""
    arcs, least, most = curve.arcs, *deck.sheer.range

    def above(points: FloatArray) -> FloatArray:
        centre = deck.height + np.interp(points[:, 0], deck.sheer.x, deck.sheer.rise)
        return np.asarray(points[:, 1] - centre)

    piece: IntArray = np.repeat(np.arange(len(arcs)), 33)
    along = (arcs.length[:, None] * np.linspace(0.0, 1.0, 33)).ravel()
    points = arcs.at(piece, along)
    over = above(points)
    if over.max() < 0.0:
        if over[-1] > -AT:
            return curve
        what = f"boundary {name}: does not reach deck {deck.number}"
        raise GeometryError(what, "extend it", {"boundary": name, "deck": deck.number})
    k = int(np.argmax(over >= 0.0))
    number, t = int(piece[k]), float(along[k])
    if over[k] > 0.0 and t > 0.0:
        t = brentq(
            lambda s: float(above(arcs.at(np.array([number]), [s]))[0]), float(along[k - 1]), t,
            xtol=1e-12,
        )  # fmt: skip
    end = arcs.at(np.array([number]), [t])[0]
    if not least - AT <= end[0] <= most + AT:
        deck.centre(end[0])
    return curve.cut(number, t)


def _turned(curve: ArcCurve) -> ArcCurve:
    """Give a curve in the other direction."""
    arcs = curve.arcs
    back = slice(None, None, -1)
    turned = Arcs(
        arcs.ends()[back].copy(), (arcs.end_angles() + np.pi)[back].copy(),
        -arcs.curvature[back], arcs.length[back].copy(),
    )  # fmt: skip
    knuckles = frozenset(len(arcs) - k for k in curve.knuckles)
    return ArcCurve(turned, curve.points[back].copy(), curve.name, knuckles)


def _require_on(profile: Profile, stations: Sequence[Station]) -> None:
    x = np.array([each.x for each in stations])
    for each, heights in zip(stations, profile.heights(x), strict=True):
        off = np.abs(heights - each.keel).min(initial=np.inf)
        if off > AT:
            lies = ", ".join(figure(z) for z in heights) or "nowhere"
            raise GeometryError(
                f"section at x={figure(each.x)}: begins at z={figure(each.keel)}, off the profile",
                f"the profile lies at {lies} there: change one of them",
                {"x": each.x, "z": each.keel, "off": float(off)},
            )  # fmt: skip


def _require_between(profile: Profile, stations: Sequence[Station]) -> None:
    """Check that stern and stem end beyond all sections, as the deck edge that joins them does."""
    for k, (name, other, way) in enumerate(
        (("stern", "stem", "aft"), ("stem", "stern", "forward"))
    ):
        end, x = float(profile.ends[k][0]), stations[-k].x
        if profile.flat[k] or (x - end if k == 0 else end - x) > AT:
            continue
        raise GeometryError(
            f"boundary {name}: ends at x={figure(end)}, not {way} of the section at x={figure(x)}",
            f"end it {way} of all sections, and give the {other} as a boundary of its own; or let "
            "it end where that section begins: the hull ends flat there",
            {"boundary": name, "end": end, "x": x},
        )


def _keel(points: FloatArray) -> list[Piece]:
    """Give the keel: one straight line if it is one, else smooth through its points."""
    if len(points) < 2 or np.hypot(*(points[-1] - points[0])) <= AT:
        return []
    step = points[-1] - points[0]
    away = points - points[0]
    off = np.abs(away[:, 0] * step[1] - away[:, 1] * step[0]) / np.hypot(*step)
    if off.max() <= _LEVEL:
        return [straight(points[0], points[-1])]
    return [smooth(points)]
