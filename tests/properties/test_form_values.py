"""Whatever values definitions have: points come of them, or an error that says what is wrong."""

from __future__ import annotations

import numpy as np
import pytest

from assoc_hull.errors import AssocHullError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import generated_points, marks_for
from assoc_hull.model.forms.line_layout import layout_at
from tests.form_ship import AREAS, COURSES, PARTICULARS, WATERLINE

ODD = (0.0, -1.0, 1.0, 1e-9, 1e6, -1e6, 90.0, 180.0, -90.0, 1e-3, 5.0, None)
FACTORS = (1.3, 0.7, -1.0, 1.01, 0.99)
LINES = ("section", "section", "profile", "deck edge", "flat of side", "waterline", "transom")


def changed(rng: np.random.Generator, given: FormDefinition) -> FormDefinition:
    """The same definition with one odd value."""
    name = str(rng.choice(given.names))
    old = given.value(name)
    if old is None or rng.random() < 0.4:
        return given.having({name: ODD[rng.integers(len(ODD))]})
    return given.having({name: old * FACTORS[rng.integers(len(FACTORS))]})


def points_of(forms: Forms, what: str, place: float) -> FloatArray:
    """The generated points of a line."""
    layout, ends = layout_at(forms, what, place), None
    if what == "section":
        y, z = (float(forms.value(use, place)[0]) for use in ("deck_side", "deck_height"))
        ends = np.array([[place, 0.0, forms.contour(place)[0]], [place, y, z]])
    marks = marks_for(forms, what, layout, place, ends)[0]
    curve = GeneratedCurve("", 0, what, layout, (), marks)
    held = np.zeros((1, 2, 3)) if ends is None else ends[None]
    return generated_points(forms, [curve], np.array([place]), held)[0]


@pytest.mark.parametrize("seed", range(3))
def test_points_or_an_error_of_the_family(seed: int) -> None:
    """No odd value ends in a traceback of numpy, a warning, or points that are no numbers."""
    rng = np.random.default_rng(seed)
    made = 0
    for _ in range(14):
        definitions = [AREAS, WATERLINE, *COURSES]
        number = int(rng.integers(len(definitions)))
        definitions[number] = changed(rng, definitions[number])
        forms = Forms.of(definitions, PARTICULARS)
        try:
            forms.chain(definitions[number].use)
        except AssocHullError:
            continue
        for what in LINES:
            place = float(rng.uniform(-5.0, 182.0 if what != "waterline" else 17.0))
            try:
                found = points_of(forms, what, place)
            except AssocHullError:
                continue
            assert np.isfinite(found).all()
            made += 1
    assert made > 35
