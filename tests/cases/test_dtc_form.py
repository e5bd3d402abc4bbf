"""Bulb and stern of the Duisburg Test Case as its lines have them, and as its mesh has them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.form_parameters import CATALOGUE, shape_of
from assoc_hull.analysis.form.parameter import FormValue, evaluate
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.mesh.read import read_triangles

LENGTH, DRAUGHT = 355.0, 14.5
"""Published; a mesh does not tell where its perpendiculars are."""


@pytest.fixture(scope="module")
def found(dtc: ah.Hull) -> Mapping[str, FormValue]:
    """Entries with the published length."""
    shape = shape_of(dtc, draught=DRAUGHT)
    header = attrs.evolve(shape.header, length=LENGTH)
    wanted = ["BL", "BH", "BW", "SO", "TH"]
    return evaluate(
        CATALOGUE, wanted, FloatingShape(shape.body, header, shape.position, shape.depth), {}
    )


@pytest.fixture(scope="module")
def places(data_folder: Path) -> FloatArray:
    """The vertices of the mesh, (n, 3), m."""
    return 59.407 * read_triangles(data_folder / "dtc" / "DTC-scaled.stl.gz").xyz


def number(found: Mapping[str, FormValue], symbol: str) -> float:
    """The number of an entry, which must be there."""
    value = found[symbol]
    assert value.number is not None, value.reason
    return value.number


def test_bulb_and_transom_are_those_of_the_mesh(
    found: Mapping[str, FormValue], places: FloatArray
) -> None:
    """BL, BH, SO, TH within the 10 mm to which lines are adopted; the tip is round."""
    low = places[places[:, 2] < DRAUGHT]
    tip = low[int(low[:, 0].argmax())]
    aft = places[places[:, 0] <= places[:, 0].min() + 1e-3]
    assert number(found, "BL") == pytest.approx(tip[0] - LENGTH, abs=0.02)
    assert number(found, "BH") == pytest.approx(tip[2], abs=0.5)
    assert number(found, "SO") == pytest.approx(-places[:, 0].min(), abs=0.01)
    assert number(found, "TH") == pytest.approx(aft[:, 2].min(), abs=0.02)


def test_the_section_at_fp_is_as_broad_as_the_mesh(
    found: Mapping[str, FormValue], places: FloatArray
) -> None:
    """BW, against vertices within 0.4 m of FP, over which the bulb is even."""
    near = places[(np.abs(places[:, 0] - LENGTH) < 0.4) & (places[:, 2] < DRAUGHT)]
    assert number(found, "BW") == pytest.approx(2.0 * near[:, 1].max(), abs=0.02)
