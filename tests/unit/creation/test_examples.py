"""What the parts of `creation` give, one small example of each."""

from __future__ import annotations

import pytest

import assoc_hull as ah
from assoc_hull.creation.design import Design, design_schema
from assoc_hull.creation.form_definitions import course
from assoc_hull.errors import BadInputError
from assoc_hull.model.tables import Particulars


def test_a_design_the_data_of_which_a_hull() -> None:
    """A design: the data of which a hull is created, and nothing else."""
    with pytest.raises(BadInputError):
        Design(Particulars("ship", 100.0, 16.0, 9.0, 6.0), [course("keel_angle", {"AP": (0, 45)})])


def test_designs_as_json() -> None:
    """Designs as JSON."""
    assert design_schema()["properties"]["schema"] == {"const": 1}


def test_a_form_parameter_curve_made_from_its_parameters_changed() -> None:
    """A form-parameter curve: made from its parameters, changed by its vertices, read back."""
    run = ah.creation.FormCurve.of(
        (-1.0, 0.0),
        (-0.3, 1.0),
        start_angle_deg=60.0,
        start_curvature=-2.0,
        finish_angle_deg=0.0,
        area=0.55,
        centroid=-0.59,
    )
    assert run.vertices[3].round(9).tolist() == [-0.92217359, 0.787861836]
    fuller = run.drag(3, (-0.92, 0.85))
    assert [
        name
        for name, value in fuller.parameters.items()
        if abs(value - run.parameters[name]) > 1e-9
    ] == ["area", "centroid"]
    assert [message.code for message in run.messages] == ["inflections", "C6"]
