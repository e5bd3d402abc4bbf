"""What the parts of `io.dxf` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.io.dxf.entities import RawSpline, drawing_entities
from assoc_hull.io.dxf.lines_plan import PlanView, lay_out


def test_the_entities_of_an_ascii_dxf_drawing_group_codes() -> None:
    """The entities of an ASCII DXF drawing: group codes with their values, one entity after
    another."""
    rows = [
        "0",
        "SECTION",
        "2",
        "HEADER",
        "9",
        "$INSUNITS",
        "70",
        "4",
        "0",
        "ENDSEC",
        "0",
        "LINE",
        "8",
        "WL",
        "10",
        "3",
        "0",
        "EOF",
    ]
    found = drawing_entities("\n".join(rows), "text")
    assert ([each.kind for each in found], found[2].word(8), found[2].place(10)) == (
        ["SECTION", "ENDSEC", "LINE", "EOF"],
        "WL",
        [3.0, 0.0, 0.0],
    )


def test_b_splines_of_drawings_as_points_of_digitised_lines() -> None:
    """B-splines of drawings as points of digitised lines."""
    knots, arch = np.repeat([0.0, 2.0], 3), np.array([[0.0, 0, 1], [2, 4, 1], [4, 0, 1]])
    assert RawSpline(2, knots, arch, "line 9").points(0.6).tolist() == [
        [0.0, 0.0, 1.0],
        [2.0, 2.0, 1.0],
        [4.0, 0.0, 1.0],
    ]


def test_the_views_of_a_lines_plan_in_a_drawing() -> None:
    """The views of a lines plan in a drawing: which coordinates each shows, and where it lies."""
    view = PlanView("aft body", (60.0, 40.0))
    flat = view.flat(np.array([[10.0, 3.0, 7.0]]))
    assert (flat.tolist(), view.in_space(flat, 10.0).tolist()) == (
        [[57.0, 47.0]],
        [[10.0, 3.0, 7.0]],
    )


def test_where_the_views_of_a_lines_plan_lie() -> None:
    """Where the views of a lines plan lie in a drawing, and how large its letters are."""
    plan = lay_out(np.array([[-5.0, 0, 0], [305, 25, 27]]), 150.0, 0.0, None)
    assert (plan.scale, plan.letter, plan.view("half-breadth").origin) == (
        500.0,
        1.25,
        (0.0, -42.5),
    )
