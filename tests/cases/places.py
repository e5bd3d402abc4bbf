"""Seeded places on a ship, the edits that are tried at them, and a table of how they went."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

import assoc_hull as ah
from assoc_hull.edit.displacement_field import on_flat
from assoc_hull.edit.hull_normals import free_normals, hull_normals
from assoc_hull.edit.session import Edit
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.geometry.splines.curve_order import curve_folds
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.objects import Curve, Point

PAIRS = (("sections", "waterlines"), ("sections", "buttocks"), ("waterlines", "buttocks"))
BoolArray = np.typing.NDArray[np.bool_]
Act = Callable[[Edit, int], None]


@attrs.frozen
class Row:
    """One line of the table of edits.

    `relofts` and `inflections` are means over the accepted edits, `mended` counts curves that
    were given a point, `wide` gaps that are over their limit after an accepted edit.
    """

    kind: str
    places: int
    accepted: int
    refused: tuple[str, ...]
    relofts: float
    largest_gap: float
    wide: int
    mended: int
    inflections: float
    folds: int

    def __str__(self) -> str:
        return (
            f"{self.kind:24s} {self.accepted:3d}/{self.places:<3d} {self.relofts:8.1f} "
            f"{1e3 * self.largest_gap:8.2f} {self.wide:5d} {self.mended:7d} "
            f"{self.inflections:11.2f} {self.folds:6d}"
        )


HEAD = "edit                     accepted re-lofts   gap mm  over  mended inflections  folds"


def table(rows: list[Row]) -> str:
    """Put lines of the table together, with the reasons of all refusals."""
    told = [f"  {row.kind} refused: {reason}" for row in rows for reason in row.refused]
    return "\n".join(["", HEAD, *map(str, rows), *told])


def family(hull: ah.Hull, curve: int) -> str:
    """Name the family of a curve."""
    return hull.state.family(hull.state.line_of(curve)).name


def shared_rows(hull: ah.Hull, pair: tuple[str, str]) -> IntArray:
    """Give the shared crossings of a pair of families that lie on no flat, by key."""
    rows, half = hull.state.rows, hull.particulars.breadth / 2.0
    live = rows.alive.data & (rows.sort.data == Sort.CROSSING) & (rows.role.data == Role.SHARED)
    live &= ~rows.contact.data & ~on_flat(hull.state)
    live &= (np.abs(rows.xyz[:, 1] - half) > 1e-9) & (rows.xyz[:, 2] > 1e-9)
    names = {curve: family(hull, curve) for curve in hull.state.live("curves").tolist()}
    shared = np.flatnonzero(live)
    curves = rows.curve[shared].tolist()
    found = [
        row
        for row, (a, b) in zip(shared.tolist(), curves, strict=True)
        if (names[a], names[b]) == pair
    ]
    return np.array(sorted(found, key=rows.key.data.__getitem__), np.int64)


def at_ends(hull: ah.Hull, rows: IntArray) -> BoolArray:
    """Tell which crossings lie within 5 % of the length from either end."""
    x, length = hull.state.rows.xyz[rows, 0], hull.particulars.length
    return np.asarray((x < 0.05 * length) | (x > 0.95 * length))


def at_bilge(hull: ah.Hull, rows: IntArray) -> BoolArray:
    """Tell which lie amidships in the lower quarter, outside two thirds of the half-breadth."""
    xyz, ship = hull.state.rows.xyz[rows], hull.particulars
    middle = np.abs(xyz[:, 0] - 0.5 * ship.length) < 0.25 * ship.length
    return np.asarray(middle & (xyz[:, 2] < 0.25 * ship.depth) & (xyz[:, 1] > ship.breadth / 3.0))


def places(hull: ah.Hull, pairs: tuple[tuple[str, str], ...], count: int, seed: int) -> list[int]:
    """Draw places evenly from the pairs: of each, one at the ends, one at the bilge, the rest."""
    rng = np.random.default_rng(seed)
    found: list[int] = []
    for pair in pairs:
        rows = rng.permutation(shared_rows(hull, pair))
        first = [rows[there(hull, rows)][:1] for there in (at_ends, at_bilge)]
        chosen = np.concatenate([*first, rows])
        once = chosen[np.sort(np.unique(chosen, return_index=True)[1])]
        found += once[: count // len(pairs)].tolist()
    return found


def normal_step(hull: ah.Hull, row: int) -> FloatArray:
    """Give the unit direction of a crossing's freedom, outward."""
    rows = np.array([row])
    free = free_normals(hull.state, rows, hull_normals(hull.state)[rows])[0]
    found: FloatArray = free / np.linalg.norm(free)
    return found


def drag(hull: ah.Hull, amount: float) -> Act:
    """Move a crossing along its freedom."""

    def act(edit: Edit, row: int) -> None:
        point = Point.of(hull.state, row)
        target = point.position + amount * normal_step(hull, row)
        edit.move(
            point, lead=False, **{axis: float(target["xyz".index(axis)]) for axis in point.free}
        )

    return act


def pull(hull: ah.Hull, amount: float, radius: tuple[float, float] = (20.0, 8.0)) -> Act:
    """Pull the hull at a crossing."""
    return lambda edit, row: edit.pull(Point.of(hull.state, row), amount, radius)


def reshape(
    hull: ah.Hull, name: str, amount: float, fade: tuple[float, float] | None = (12.0, 8.0)
) -> Act:
    """Re-shape the curve of a family through a crossing that is moved along its freedom."""

    def act(edit: Edit, row: int) -> None:
        curve = next(int(c) for c in hull.state.rows.curve[row] if family(hull, int(c)) == name)
        place = hull.state.rows.xyz[row]
        target = place + amount * normal_step(hull, row)
        axis, reach = (2, 8.0) if name == "sections" else (0, 20.0)
        span = (float(place[axis] - reach), float(place[axis] + reach))
        edit.reshape(Curve.of(hull.state, curve), [target], span=span, fade=fade)

    return act


def reshape_mixed(hull: ah.Hull, at: list[int], amount: float, fade: tuple[float, float]) -> Act:
    """Re-shape through each place the curve of one of its two families, turn about."""
    turn = {row: i % 2 for i, row in enumerate(at)}

    def act(edit: Edit, row: int) -> None:
        curve = int(hull.state.rows.curve[row, turn[row]])
        reshape(hull, family(hull, curve), amount, fade)(edit, row)

    return act


def over_limit(hull: ah.Hull) -> IntArray:
    """Give the watched crossings whose gap is over its limit."""
    rows = hull.state.rows
    watched = rows.alive.data & (rows.sort.data == Sort.CROSSING)
    watched &= rows.role.data == Role.WATCHED
    found: IntArray = np.flatnonzero(watched & (rows.gap.data > rows.limit.data))
    return found


def folded(hull: ah.Hull, names: tuple[str, ...]) -> int:
    """Count the places where re-lofted curves turn back on themselves."""
    number = {key: i for i, key in enumerate(hull.state.curves.key.data)}
    return sum(len(curve_folds(hull.state.spline(number[name])).curve) for name in names)


def run(
    hull: ah.Hull, kind: str, act: Act, at: list[int], check: Callable[[int], None] | None = None
) -> Row:
    """Try an edit at every place, each from the same hull; undo what was accepted.

    `check` is called with the number of the place after every edit that was accepted.
    """
    refused: list[str] = []
    lofted, gap, wide, mended, bent, more = 0, 0.0, 0, 0, 0, 0
    for number, row in enumerate(at):
        try:
            with hull.edit(kind) as edit:
                act(edit, row)
        except ah.errors.RefusedEditError as error:
            refused.append(f"{hull.state.rows.key[row]}: {error}")
            continue
        report = edit.report
        assert report is not None
        lofted, mended = lofted + len(report.relofted), mended + len(report.mended)
        gap, wide = max(gap, report.largest_gap), wide + len(over_limit(hull))
        more += sum(count for _, count in report.inflections)
        bent += folded(hull, report.relofted)
        if check is not None:
            check(number)
        hull.undo()
    accepted = len(at) - len(refused)
    done = max(1, accepted)
    return Row(
        kind, len(at), accepted, tuple(refused), lofted / done, gap, wide, mended, more / done, bent
    )
