"""Variations of random nets between random edits: what must hold, holds, or all is refused."""

from __future__ import annotations

import attrs
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.strategies import SearchStrategy

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.io.hull_json import dumps_hull_json, read_hull_json
from assoc_hull.model.kinds import Sort
from assoc_hull.variation.fields.anchor_fields import hat_field
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.request import Stations
from tests.independent import lost_meetings, trouble
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Task, carry_out, fresh, hulls, tasks

NAMED = ("length", "breadth", "draught", "depth", "stem_rake_deg")


@attrs.frozen
class Wish:
    """A variation: ratios of named parameters, a rise of the keel aft (parts of T), and how."""

    ratios: tuple[tuple[str, float], ...]
    rise: float
    stations: str

    def carry_out(self, hull: ah.Hull) -> bool:
        """Vary a hull in place; tell whether that was refused, which leaves it as it was."""
        measures, before, done = hull.measure(only=NAMED), hull.fingerprint, len(hull.history)
        flush = measures.get("depth", 0.0) <= hull.particulars.draught
        values = {
            name: ratio * measures[name] for name, ratio in self.ratios
            if name in measures and not (name == "depth" and flush)
        }  # fmt: skip
        try:
            found = hull.vary(
                set=values, layers=self._layers(hull), stations=_STATIONS[self.stations],
                in_place=True,
            )  # fmt: skip
        except AssocHullError:
            assert hull.fingerprint == before
            assert len(hull.history) == done
            return False
        again = hull.measure(only=values)
        assert all(abs(again[name] - value) <= 1e-6 for name, value in values.items())
        assert all(abs(each.reached - each.asked) <= 1e-6 for each in found.report.targets)
        return True

    def _layers(self, hull: ah.Hull) -> tuple[FieldLayer, ...]:
        if self.rise == 0.0:
            return ()
        size = hull.particulars
        aft = BlendChain.through([0.1 * size.length, 0.5 * size.length], [1.0, 0.0])
        anchors = [("low", 0.3 * size.draught, self.rise * size.draught), ("T", size.draught, 0.0)]
        return (FieldLayer("raw", (hat_field("rise", anchors, aft),)),)


_STATIONS: dict[str, Stations] = {"number": "number", "x": "x"}


def wishes() -> SearchStrategy[Wish]:
    """Give variations of up to three named parameters by some per cent, and of a raw field."""
    ratio = st.tuples(st.sampled_from(NAMED), st.floats(0.93, 1.08))
    return st.builds(
        Wish,
        st.lists(ratio, min_size=1, max_size=3, unique_by=lambda each: each[0]).map(tuple),
        st.just(0.0) | st.floats(-0.05, 0.05),
        st.sampled_from(("number", "number", "x")),
    )


def sound(hull: ah.Hull) -> None:
    """See that crossings lie where curves meet, that none is missing, and that all is rebuilt."""
    assert list(trouble(hull)) == []
    assert list(lost_meetings(hull)) == []
    assert hull.verify() == ()


@settings(max_examples=draws(8))
@given(hulls(), tasks(SHAPES + STRUCTURE, most=1), wishes(), tasks(SHAPES, most=1), wishes())
def test_a_varied_net_is_sound_and_stays_associative(
    hull: ah.Hull, edits: list[Task], wish: Wish, later: list[Task], another: Wish
) -> None:
    """Asked values are met, links hold, a rebuild has the same bits; so after edits, and again."""
    for task in edits:
        carry_out(hull, task)
    start, steps = hull.fingerprint, len(hull.history)
    rows, live = hull.state.rows, hull.state.live("rows")
    placed = [row for row in live.tolist() if rows.sort[row] == Sort.PLACED]
    names = sorted(hull.lines)
    varied = wish.carry_out(hull)
    assert rows.alive[placed].all()
    assert sorted(hull.lines) == names
    if varied:
        sound(hull)
    for task in later:
        carry_out(hull, task)
    another.carry_out(hull)
    sound(hull)
    end, done = hull.fingerprint, len(hull.history) - steps
    assert ah.Hull(read_hull_json(dumps_hull_json(hull.state))).fingerprint == end
    if done:
        hull.undo(done)
        assert hull.fingerprint == start
        hull.redo(done)
        assert hull.fingerprint == end


@settings(max_examples=5)
@given(st.integers(0, POOL - 1), wishes())
def test_one_wish_gives_one_hull(number: int, wish: Wish) -> None:
    """The same parent and the same wish give the same bytes, whatever was tried before."""
    one, other = fresh(number), fresh(number)
    Wish((("breadth", 1.05),), 0.02, "number").carry_out(other)
    if other.history:
        other.undo()
    assert wish.carry_out(one) == wish.carry_out(other)
    assert one.fingerprint == other.fingerprint
