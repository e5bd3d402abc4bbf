"""A stern that ends on the design waterline at AP: one number at the last station makes a hull."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import OpenNetError
from assoc_hull.hull import Hull

HEAD = """# unit: m
# station 0 = AP
# Lpp = 45 m, B = 9 m, T = 3.2 m
station,wl_0,wl_0.4,wl_0.8,wl_1.6,wl_2.4,wl_3.2,wl_4
"""
BODY = """
1,0.100,0.180,0.260,0.480,1.150,2.350,3.300
2,0.250,0.700,1.050,1.750,2.600,3.450,3.950
3,0.600,1.500,2.050,2.900,3.550,4.000,4.250
4,1.300,2.380,2.950,3.650,4.080,4.300,4.420
6,2.800,3.720,4.120,4.420,4.500,4.500,4.500
8,3.500,4.200,4.420,4.500,4.500,4.500,4.500
10,3.700,4.300,4.470,4.500,4.500,4.500,4.500
12,3.600,4.250,4.440,4.500,4.500,4.500,4.500
14,2.950,3.820,4.180,4.420,4.480,4.500,4.500
16,1.550,2.560,3.080,3.580,3.820,3.980,4.120
17,0.850,1.720,2.240,2.780,3.080,3.300,3.540
18,0.350,0.950,1.350,1.830,2.130,2.400,2.700
19,0.080,0.360,0.590,0.900,1.120,1.330,1.630
20,0.000,0.000,0.000,0.000,0.000,0.050,0.350
"""


def coaster(folder: Path, last: str, head: str = HEAD, body: str = BODY) -> Hull:
    """Import the table with the row of its last station aft."""
    path = folder / "coaster.csv"
    path.write_text(head + last + body)
    return ah.read(path)


@pytest.mark.parametrize("last", ["0,,,,,,0,1.95", "0,0,0,0,0,0,0,1.95", "0,,,,,,,1.95"])
def test_a_last_station_with_one_number_above_0_is_closed_as_any_other(
    last: str, tmp_path: Path
) -> None:
    """From where the stern passes it to that number; profile, ends and flats are there."""
    hull = coaster(tmp_path, last)
    assert hull.adoption is not None
    assert not [note for note in hull.adoption.notes if "left open" in note]
    assert {"profile", "deck edge", "flat of side", "flat of bottom"} <= set(hull.lines)
    [section] = hull.lines["ST 0"].curves
    ends = section.polyline(4)[[0, -1]]
    assert ends[0, 1] == 0.0
    assert ends[1].tolist() == [0.0, 1.95, 4.0]
    assert hull.check() == ()
    solid = hull.mesh()
    assert solid.volume > hull.hydrostatics().volume > 900.0


def test_lines_that_end_on_no_profile_are_told_how_she_gets_one(tmp_path: Path) -> None:
    """Followed, it works: a column of the keel that goes up to the deck at both ends."""
    sharp = "\n".join(
        f"{each.split(',')[0]},,{','.join(each.split(',')[2:])}" for each in BODY.split()
    )
    hull = coaster(tmp_path, "0,,,,,,0,1.95\n", body=sharp + "\n")
    assert "profile" not in hull.lines
    assert hull.adoption is not None
    [note] = [note for note in hull.adoption.notes if "left open" in note]
    assert note.endswith("or a column keel")
    with pytest.raises(OpenNetError) as caught:
        hull.mesh()
    assert "by a column 'keel' that goes up to the deck at both ends" in str(caught.value)
    rows = [f"{row},0" for row in BODY.split()]
    after = "-0.5,,,,,,,,4\n0,,,,,,0,1.95,3.2\n"
    fore = "\n20.3,,,,,,,,4\n"
    whole = coaster(tmp_path, after, HEAD.replace("wl_4\n", "wl_4,keel\n"), "\n".join(rows) + fore)
    assert whole.mesh().volume > 1000.0


def test_a_sheer_that_is_not_drawn_is_a_suspicion_with_what_to_do(tmp_path: Path) -> None:
    """What somebody typed is not used: that is no assumption; the ways out are told, with cost."""
    head = HEAD.replace("wl_4\n", "wl_4,sheer,y_deck\n")
    body = "".join(f"\n{row},{4.2 + 0.03 * (k - 7) ** 2:.2f},{row.split(',')[-1]}"
                   for k, row in enumerate(BODY.split()))  # fmt: skip
    hull = coaster(tmp_path, "0,,,,,,0,1.95,6.1,2.2", head, body + "\n")
    assert hull.adoption is not None
    [note] = [each for each in hull.adoption.notes if each.startswith("suspicion: deck edge:")]
    assert "its deck at 4.2 to 6.1 m is not used" in note
    assert "at the highest waterline, z = 4 m, as a level deck edge" in note
    assert "stretches all lines above the draught" in note
    assert any(each.startswith("verdict: sound with suspicions") for each in hull.adoption.notes)
    sheered = hull.vary(set={"sheer_fore": 0.5, "sheer_aft": 0.3}).hull
    assert sheered.measure()["sheer_fore"] == pytest.approx(0.5, abs=1e-6)
    plain = coaster(tmp_path, "0,,,,,,0,1.95")
    assert plain.adoption is not None
    assert not [each for each in plain.adoption.notes if "deck edge:" in each]


def test_a_coaster_is_drawn_no_broader_than_she_is(tmp_path: Path) -> None:
    """Neither closed nor open flats let a line bulge between equal greatest breadths."""
    for last in ("0,,,,,,0,1.95", "0,,,,,,0.05,"):
        hull = coaster(tmp_path, last)
        measured = hull.measure(only=["breadth"]).anchors["breadth"]
        assert measured.numbers["drawn"] == pytest.approx(9.0, abs=1e-3)
        assert np.isclose(hull.particulars.breadth, 9.0)
