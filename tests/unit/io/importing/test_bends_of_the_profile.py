"""Where hydrostatics will be refused, import says so and names the corners of the profile."""

from pathlib import Path

import pytest

from assoc_hull.errors import BadInputError
from tests.drawn_hulls import raked_barge


def test_import_names_the_corners_at_which_stations_are_too_few(tmp_path: Path) -> None:
    """Hydrostatics of a raked barge with no stations close to where she turns are refused."""
    hull = raked_barge(tmp_path)
    with pytest.raises(BadInputError, match="by waterplanes"):
        hull.hydrostatics()
    assert hull.adoption is not None
    (note,) = [each for each in hull.adoption.notes if "by waterplanes" in each]
    assert "corners at x = 6.00, 50.00 m: give stations close before and behind" in note
