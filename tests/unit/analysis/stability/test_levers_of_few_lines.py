"""Levers of a ship on her side, of a net of few lines."""

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.floating_body import WaterplaneLimits
from assoc_hull.analysis.hydrostatics.flotation import Flotation, body_of, header_of
from assoc_hull.analysis.stability.condition import ConditionRequest, case_of, condition_of
from assoc_hull.analysis.stability.righting_lever import float_at_heels, rough_levers
from assoc_hull.geometry.floating.immersion import (
    FloatingPlanes,
    ImmersedIntegrals,
    integrate_immersed,
)
from tests.trawler import trawler

# KN at 2.25 and 3.1 m, by 32 times as many curves along each strip as the plain rule has.
TRUE = np.array([[2.64009, 2.61020], [2.54751, 2.52816]])


@pytest.fixture(scope="module")
def boat(tmp_path_factory: pytest.TempPathFactory) -> ah.Hull:
    """Read the trawler once."""
    return trawler(tmp_path_factory.mktemp("trawler"))


def test_levers_on_her_side_are_no_noise_of_end_strips(boat: ah.Hull) -> None:
    """KN at 88.5 and 90 degrees is that of a rule twice as fine within .6 mm."""
    found = boat.cross_curves(draughts=[2.25, 3.1], heels=[88.5, 90.0])
    assert np.abs(found.kn - TRUE).max() < 6e-4


@attrs.frozen
class _Plain:
    """The hull by the plain rule of integration at every heel."""

    body: Flotation

    @property
    def limits(self) -> WaterplaneLimits:
        return self.body.limits

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        return integrate_immersed(self.body.prepared, planes)


def test_noise_of_levers_is_told_with_its_size(boat: ah.Hull) -> None:
    """Where the levers that are read on are rough, a note says by how much, and it is enough."""
    body = body_of(boat)
    assert isinstance(body, Flotation)
    terms: dict[str, object] = {
        "rho": 1.025, "shell_factor": 1.0, "kg": None, "appendages": (), "date": None,
    }  # fmt: skip
    header = header_of(boat, body, terms)
    condition = condition_of(body, header, ConditionRequest(draught=2.25))
    case = case_of(body, header, [condition], "fixed")
    case = attrs.evolve(case, afloat=attrs.evolve(case.afloat, body=_Plain(body)))
    found = float_at_heels(case, np.array([60.0, 90.0]))
    off = abs(float(found.kn[1]) - TRUE[0, 1])
    assert off > 0.1
    assert found.doubt[0] == 0.0
    assert off < found.doubt[1] < 2.0 * off
    (note,) = rough_levers(found)
    assert note.startswith("KN and GZ at 90 deg are known to +-")


def test_smooth_levers_have_no_note() -> None:
    """A net of many lines has levers at 90 degrees without a doubt."""
    notes = ah.examples.wigley().cross_curves(draughts=[5.0], heels=[90.0]).notes
    assert not [note for note in notes if "known to" in note]
