"""Whatever lines are left out of a ship, the others make a closed mesh of the same volume."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.surface.cells.closed_mesh import mesh_of_net
from tests.long_forms import draws


@pytest.fixture(scope="module")
def net(series60_70: ah.Hull) -> CurveNet:
    """Series 60 CB .70: 73 lines and four boundary curves."""
    return gather_net(series60_70.state)


@settings(max_examples=draws(8))
@given(seed=st.integers(0, 2**20), share=st.floats(0.0, 0.75))
def test_any_choice_of_lines_makes_a_closed_mesh(net: CurveNet, seed: int, share: float) -> None:
    """Up to three of four are left out at random; profile, deck edge and flats stay."""
    names = sorted(
        {name for name, end in zip(net.name, net.family, strict=True) if end != "boundary"}
    )
    drawn = np.random.default_rng(seed).random(len(names)) < share
    without = np.isin(np.array(net.name), np.array(names)[drawn])
    mesh = mesh_of_net(net, points=2, leave_out=without)
    assert mesh.report.sound
    assert all(note.startswith("chords leave") for note in mesh.notes)
    assert mesh.volume == pytest.approx(16_496.0, rel=0.02)
