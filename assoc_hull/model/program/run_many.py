"""Runs of the program of a net for many variants at once: the bits of `run_program`, one by one.

Values get a leading axis of variants. A few variants at a time are run as one net: their structures
stand one behind the other (`tile_program`), so that `run_tile` needs no arithmetic of its own, and
one call of numpy does for a level of all of them. What can be said of a variant is said of it
alone: one that meets other planes, or folds, stops where its own run would, and the others go on.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.model.program.run_program import ProgramRun, run_tile, write_points
from assoc_hull.model.program.structure import CompiledFeatures, Program, Values

__all__ = ["ManyPrograms", "many_values", "run_many", "tile_program", "variant", "write_many"]

_TOGETHER = 12
"""Variants that are run as one: more of them no longer stay in the fast memory."""


def many_values(values: Values, count: int) -> Values:
    """Give numbers of a net for each of some variants: arrays with a leading axis, all alike."""
    names = [each.name for each in attrs.fields(Values)]
    return Values(*(np.repeat(getattr(values, name)[None], count, axis=0) for name in names))


def variant(values: Values, number: int) -> Values:
    """Give the numbers of one variant: views that are written to with the others."""
    return Values(*(getattr(values, each.name)[number] for each in attrs.fields(Values)))


def write_many(values: Values, rows: IntArray, places: FloatArray) -> list[IntArray]:
    """Put points (k,) to places (v, k, 3), m; give for each variant those that differ by a bit."""
    return [write_points(variant(values, v), rows, each) for v, each in enumerate(places)]


def run_many(
    program: Program,
    values: Values,
    before: Values,
    rows: Sequence[IntArray],
    held: Sequence[IntArray],
    curves: IntArray | None = None,
) -> tuple[ProgramRun, ...]:
    """Bring the numbers of variants up to date with points that were written, as `run_program`.

    Parameters
    ----------
    program : Program
        The structure that all have in common.
    values : Values
        The numbers with a leading axis of v variants; they are written to, whatever comes of it.
    before : Values
        The published ones, with which what was doubtful already is compared; of one net.
    rows, held : v times (k,) int
        Points that were written and differ by a bit, and riding points that stay where they were
        put.
    curves : (c,) int, optional
        Curves to make anew whatever has changed; nothing is doubted of them beforehand.

    Returns
    -------
    v ProgramRun
        What `run_program` gives for each variant alone.
    """
    together = max(1, min(_TOGETHER, len(rows)))
    return ManyPrograms.of(program, together).run(values, before, rows, held, curves)


@attrs.frozen(eq=False)
class ManyPrograms:
    """A program so many times as variants are run at once."""

    program: Program
    tile: Program
    together: int

    @classmethod
    def of(cls, program: Program, together: int = _TOGETHER) -> ManyPrograms:
        """Put the structure of a net one behind the other."""
        return cls(program, tile_program(program, together), together)

    def run(
        self, values: Values, before: Values, rows: Sequence[IntArray], held: Sequence[IntArray],
        curves: IntArray | None = None,
    ) -> tuple[ProgramRun, ...]:  # fmt: skip
        """Bring the numbers of variants up to date: as `run_many`."""
        found, count = list[ProgramRun](), len(rows)
        for first in range(0, count, self.together):
            stop = min(first + self.together, count)
            part = _flat(values, first, stop)
            old = attrs.evolve(
                before, folds=np.tile(before.folds, stop - first),
                lowest=np.tile(before.lowest, stop - first),
            )  # fmt: skip
            found += run_tile(
                self.tile, part, old, _joined(rows[first:stop], len(before.xyz)),
                _joined(held[first:stop], len(before.xyz)),
                None if curves is None else _joined([curves] * (stop - first), self.program.curves),
                stop - first,
            )  # fmt: skip
        return tuple(found)


def _flat(values: Values, first: int, stop: int) -> Values:
    """Give the numbers of some variants one behind the other; what is written there counts."""
    parts = [getattr(values, each.name)[first:stop] for each in attrs.fields(Values)]
    shapes = [(each.shape[0] * each.shape[1], *each.shape[2:]) for each in parts]
    flat = [each.view() for each in parts]
    for each, shape in zip(flat, shapes, strict=True):
        each.shape = shape  # never a copy, as `reshape` may give
    return Values(*flat)


def _joined(items: Sequence[IntArray], size: int) -> IntArray:
    """Count the items of variants on from one variant to the next."""
    parts = [np.asarray(each, np.int64) + v * size for v, each in enumerate(items)]
    return np.concatenate([np.zeros(0, np.int64), *parts])


_ON = {
    "row": "points", "rider": "points", "riding": "points", "anchor": "points", "watch": "points",
    "meet_row": "points", "meet_curve": "curves", "reader": "curves", "drive": "meets",
    "watch_a": "meets", "watch_b": "meets", "pair_a": "meets", "pair_b": "meets", "sense": "meets",
    "watched": "watches", "paired": "pairs",
}  # fmt: skip
"""Numbers that are counted on from one variant to the next, and what they count."""

_FIRST = (
    "start", "rider_start", "riding_start", "set_start", "meet_start", "drive_start",
    "watch_start", "pair_start", "sense_start",
)  # fmt: skip
"""Where lists begin in arrays that are put one behind the other."""

_AGAIN = (
    "number", "kind", "direction", "end_kind", "end_vector", "own_axis", "own_offset", "weight",
    "sets", "meet_plane", "meet_sign", "limit", "unsure", "unsure_row",
)  # fmt: skip


def tile_program(program: Program, count: int) -> Program:
    """Put the structure of a net one behind the other; levels and planes stay those of one.

    Fewer variants than `count` can be run on it too. What numpy does not read stays that of one.
    """
    sizes = {
        "points": len(program.reader), "curves": program.curves, "meets": len(program.meet_row),
        "watches": len(program.watch), "pairs": len(program.pair_a),
    }  # fmt: skip
    arrays: dict[str, NDArray[np.generic]] = {
        name: _counted_on(getattr(program, name), sizes[of], count) for name, of in _ON.items()
    }
    arrays |= {name: _begins(getattr(program, name), count) for name in _FIRST}
    arrays |= {name: np.concatenate([getattr(program, name)] * count) for name in _AGAIN}
    one = program.features
    features = CompiledFeatures(
        _begins(one.owner_start, count), _counted_on(one.owner, len(one.shape), count),
        _begins(one.start, count), _counted_on(one.point, sizes["points"], count),
        np.tile(one.shape, count), np.tile(one.numbers, (count, 1)), np.tile(one.limit, count),
    )  # fmt: skip
    freeze(*arrays.values(), *attrs.astuple(features, recurse=False))
    return attrs.evolve(program, features=features, **arrays)  # type: ignore[arg-type]


def _counted_on(numbers: IntArray, size: int, count: int) -> IntArray:
    """Count numbers (n, ...) on from one variant to the next; -1 stands for none."""
    shift = size * np.arange(count).reshape(-1, *(1,) * numbers.ndim)
    found: IntArray = np.where(numbers >= 0, numbers + shift, numbers)
    return found.reshape(-1, *numbers.shape[1:])


def _begins(start: IntArray, count: int) -> IntArray:
    """Give where lists begin, of all variants; the last entry is where the last one ends."""
    return np.append(_counted_on(start[:-1], int(start[-1]), count), count * start[-1])
