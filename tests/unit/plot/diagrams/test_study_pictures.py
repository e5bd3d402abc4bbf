"""Pictures of a study: each variant once, the front as it is, grey beyond limits."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray

Lines = Callable[[Figure, str], list[FloatArray]]
Boxes = Callable[[Figure], dict[str, FloatArray]]

BETTER = {"kmt": "more", "wetted_surface": "less"}
WITHIN = {"volume": (2500.0, 2760.0)}


@pytest.fixture(scope="module")
def found() -> ah.study.Study:
    """Variants of a hull of few lines, one of which has no hull."""
    parent = ah.examples.wigley(stations=7, waterlines=5)
    drawn = ah.study.sample({"breadth": (9.5, 10.5), "draught": (6.0, 6.4)}, 12, seed=1)
    columns = {name: [*column, -3.0] for name, column in drawn.items()}
    return parent.study(set=columns, outputs=["volume", "kmt", "wetted_surface", "cb"])


def test_each_variant_is_a_dot_of_its_kind(found: ah.study.Study, lines_of: Lines) -> None:
    """Those on the front, those beyond the limits, and the others; their course is the front's."""
    figure = ah.plot.study_scatter(found, "wetted_surface", "kmt", better=BETTER, within=WITHIN)
    table, front = found.table(), found.front(BETTER, WITHIN)
    beyond = int((table["volume"] > 2760.0).sum())
    count = {name: len(lines_of(figure, f"{name}$")[0])
             for name in ("front", "outside", "variants")}  # fmt: skip
    assert count == {
        "front": len(front), "outside": beyond, "variants": 12 - beyond - len(front),
    }  # fmt: skip
    assert 1 < len(front) < 12 - beyond
    course = lines_of(figure, "front/course")[0]
    assert (np.diff(course, axis=0) > 0.0).all()  # more of one is paid for by more of the other


def test_courses_break_off_between_variants(found: ah.study.Study, lines_of: Lines) -> None:
    """Each goes from the first scale to the last, between the least and the greatest value."""
    names = ["breadth", "draught", "volume", "kmt"]
    figure = ah.plot.study_parallel(found, names, better=BETTER, within=WITHIN)
    whole = np.concatenate([lines_of(figure, f"{name}$")[0]
                            for name in ("front", "outside", "variants")])  # fmt: skip
    whole = whole.reshape(12, len(names) + 1, 2)
    assert np.isnan(whole[:, -1, 1]).all()
    heights = whole[:, :-1, 1]
    np.testing.assert_allclose(heights.max(axis=0), heights.max())
    np.testing.assert_allclose(heights.min(axis=0), heights.min())


def test_a_picture_is_the_same_each_time(found: ah.study.Study, tmp_path: Path) -> None:
    """To the byte."""
    for name in ("a.svg", "b.svg"):
        ah.plot.study_scatter(found, "breadth", "kmt", better=BETTER, path=tmp_path / name)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (lambda it: ah.plot.study_scatter(it, "kmf", "kmt"), "'kmt'"),
        (lambda it: ah.plot.study_scatter(it, "reason", "kmt"), "column"),
        (lambda it: ah.plot.study_scatter(it, "kmt", "cb", better={"cb": "high"}), "better of cb"),
        (lambda it: ah.plot.study_scatter(it, "kmt", "cb", within={"cb": 3}), "limits of cb"),
        (lambda it: ah.plot.study_parallel(it, ["kmt"]), "1 columns"),
        (lambda it: ah.plot.study_parallel(it, "kmt"), "give a list of names"),
        (lambda it: ah.plot.study_scatter(it.table(), "kmt", "cb"), "what hull.study gives"),
    ],
    ids=["name", "text", "direction", "limits", "one column", "no list", "no study"],
)
def test_what_cannot_be_drawn_is_refused(
    found: ah.study.Study, draw: Callable[[Any], Figure], words: str
) -> None:
    """With the name of what is wrong."""
    with pytest.raises(ah.AssocHullError, match=words):
        draw(found)
