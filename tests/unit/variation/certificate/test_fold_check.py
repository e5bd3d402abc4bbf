"""The fold check against dense samples of maps drawn at random; what it must not get wrong.

The whole comparison is ``python -m benchmarks.fold_check``; here are some of its maps, on coarser
grids. That it can fail is shown by faults put into the fold check.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.certificate import field_enclosures, field_minors
from assoc_hull.variation.certificate.field_minors import is_level
from assoc_hull.variation.certificate.fold_check import MARGIN
from assoc_hull.variation.fields.field import StackedField
from assoc_hull.variation.fields.layers import FieldLayer, Rake
from benchmarks.fold_check import SURE, Case, Summary, compare, draw
from benchmarks.fold_polish import minors_at

SEED, MAPS, PLACES = 8, 70, 60


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    """Maps drawn by number, with their samples."""
    return [draw(SEED, number, PLACES) for number in range(MAPS)]


@pytest.fixture(scope="module")
def summary(cases: list[Case]) -> Summary:
    """What the fold check says of all of them."""
    found = Summary()
    for number, case in enumerate(cases):
        found.add(number, case.sampled, compare(case))
    return found


def test_fold_check_and_dense_samples_agree(summary: Summary) -> None:
    """None accepted that folds, none refused that is sound, none undecided, no false bound."""
    assert summary.troubles == []
    assert summary.counts["check: undecided"] == 0
    assert summary.sound
    assert summary.undercut >= MARGIN - 1e-9
    assert summary.overcut < SURE


def test_maps_drawn_are_of_every_sort(summary: Summary) -> None:
    """Sound, thin and folding ones are all there in numbers, and every minor is least at times."""
    for reason in ("certified", "thin", "folds"):
        assert summary.counts[f"check: {reason}"] >= 10
    assert min(summary.minors[name] for name in ("X_x", "Y_y", "Z_z", "D")) >= 10


def test_samples_are_what_the_jacobian_gives(cases: list[Case]) -> None:
    """Sums over strips and the derivative at each place's own strip are the same minors."""
    rng = np.random.default_rng(1)
    for case in cases[:40]:
        for layer, samples, strength in zip(
            case.vmap.layers, case.samples, case.strengths, strict=True
        ):
            shape = tuple(len(side) for side in samples.sides)
            chosen = rng.integers(0, shape, (50, 3))
            places = np.stack([samples.sides[axis][chosen[:, axis]] for axis in range(3)], axis=1)
            given = minors_at(layer, samples, samples.places(places))
            for name, values in samples.minors(strength).items():
                whole = np.broadcast_to(values, shape)[tuple(chosen.T)]
                assert given[name] == pytest.approx(whole, rel=1e-9, abs=1e-9)


def contradictions(cases: Sequence[Case], concerns: Callable[[Case], bool]) -> list[str]:
    """What is wrong with the first map that the fold check, as it now is, gets wrong."""
    for case in cases:
        if concerns(case):
            found = compare(case).troubles
            if found:
                return list(found)
    return []


def groups(case: Case) -> list[list[StackedField | Rake]]:
    """The fields of a map that move the same coordinate, layer by layer."""
    layers = [layer for layer in case.vmap.layers if isinstance(layer, FieldLayer)]
    every = [[each for each in layer.fields if each.axis == axis]
             for layer in layers for axis in "xyz"]  # fmt: skip
    return [group for group in every if group]


def alone(case: Case) -> bool:
    """Whether some coordinate is moved by one field, whose boundaries slope."""
    return any(len(group) == 1 and not is_level(group[0]) for group in groups(case))


def beside(case: Case) -> bool:
    """Whether some coordinate is moved by several fields, and boundaries slope."""
    return any(len(group) > 1 and not all(map(is_level, group)) for group in groups(case))


def level(case: Case) -> bool:
    """Whether all boundaries are level."""
    return all(is_level(each) for group in groups(case) for each in group)


@pytest.mark.parametrize("shift", [-1, 1])
def test_bounds_of_the_strip_beside_are_found_out(
    cases: list[Case], monkeypatch: pytest.MonkeyPatch, shift: int
) -> None:
    """Intervals taken from the next strip, up or down, contradict the samples."""
    right = field_enclosures._in_strip

    def wrong(field: Any, k: int, ends: Any, *rest: Any) -> Any:
        return right(field, int(np.clip(k + shift, -1, len(ends) - 1)), ends, *rest)

    monkeypatch.setattr(field_enclosures, "_in_strip", wrong)
    assert contradictions(cases, beside)


@pytest.mark.parametrize("shift", [-1, 1])
def test_pieces_of_the_boundary_beside_are_found_out(
    cases: list[Case], monkeypatch: pytest.MonkeyPatch, shift: int
) -> None:
    """Strips between sloping boundaries that are one off their pieces contradict the samples."""
    right = field_minors._piece

    def wrong(field: Any, k: int, *rest: Any) -> Any:
        return right(field, int(np.clip(k + shift, 0, len(field.pieces) - 1)), *rest)

    monkeypatch.setattr(field_minors, "_piece", wrong)
    assert contradictions(cases, alone)


def test_a_level_boundary_left_out_is_found_out(
    cases: list[Case], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two level strips taken for one contradict the samples."""
    right = field_minors.strip_heights

    def wrong(fields: Any, box: FloatArray) -> FloatArray:
        found = right(fields, box)
        return np.delete(found, len(found) // 2) if len(found) > 2 else found

    monkeypatch.setattr(field_minors, "strip_heights", wrong)
    assert contradictions(cases, level)


def test_a_determinant_left_out_is_found_out(
    cases: list[Case], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without D maps are accepted that fold."""
    right = field_minors._plane

    def wrong(name: str, *rest: Any) -> Any:
        return [] if name == "D" else right(name, *rest)

    monkeypatch.setattr(field_minors, "_plane", wrong)
    folding = [case for case in cases if case.sampled.minor == "D" and case.sampled.value < 0.0]
    found = contradictions(folding, lambda _: True)
    assert any(text.startswith("accepted, but D is -") for text in found)
