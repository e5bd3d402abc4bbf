"""What hydrostatics refuses, by name: doubtful hulls and positions; true shapes it does not."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.slicing.mesh_lines import slice_mesh
from assoc_hull.io.slicing.net import net_from_slices
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Particulars
from assoc_hull.shipped.wigley import wigley_half_breadth
from tests.cases.test_chine_hull import chine_hull, scattered

WIGLEY = 100.0, 10.0, 6.25
TOP = 9.375
Spoil = Callable[[FloatArray], FloatArray]


def level(height: float) -> FloatingPlanes:
    """A plane at even keel."""
    return FloatingPlanes(np.array([height]), np.zeros(1), np.zeros(1))


def points_at(x: FloatArray, z: FloatArray) -> FloatArray:
    """Points of the Wigley hull."""
    return np.column_stack([x, wigley_half_breadth(x, z, *WIGLEY), z])


def spoilt_wigley(spoil: Spoil | None) -> ah.Hull:
    """The Wigley hull whose ST 7 was drawn wrongly."""
    x, z = np.linspace(0.0, 100.0, 21), np.append(np.linspace(0.0, 6.25, 11), TOP)
    corners = np.array([[0, 0, TOP], [0, 0, 0], [100, 0, 0], [100, 0, TOP]], np.float64)
    knuckle = int(PointKind.KNUCKLE)
    lines = [
        LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
            kind=[0, knuckle, knuckle, 0],
        ),
        LineSource.make(
            "boundary", "deck edge", points_at(x, np.full(21, TOP)), plane=((0, 0, 1), TOP),
            boundary=BoundaryKind.END,
        ),
    ]  # fmt: skip
    for i in range(1, 20):
        drawn = points_at(np.full(12, x[i]), z)
        if i == 7 and spoil is not None:
            drawn = spoil(drawn)
        lines.append(LineSource.make("sections", f"ST {i}", drawn))
    lines += [
        LineSource.make("waterlines", f"WL {height:g}", points_at(x, np.full(21, height)))
        for height in z[1:-1].tolist()
    ]
    links = [Association("boundary", "sections"), Association("boundary", "waterlines")]
    links.append(Association("sections", "waterlines"))
    ship = Particulars("Wigley", *WIGLEY[:2], TOP, WIGLEY[2], "closed")
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)


def kinked(drawn: FloatArray) -> FloatArray:
    """One point far inside."""
    return drawn - np.outer(np.arange(12) == 5, [0.0, 1.2, 0.0])


def opened(drawn: FloatArray) -> FloatArray:
    """The lower end off the centre plane."""
    return drawn + np.outer(np.arange(12) == 0, [0.0, 0.6, 0.0])


def looped(drawn: FloatArray) -> FloatArray:
    """Two points that were taken too far out, the first too high."""
    extra = drawn[6] + np.array([[0.0, 0.9, 0.3], [0.0, 0.9, -0.6]])
    return np.concatenate([drawn[:7], extra, drawn[7:]])


def swapped(drawn: FloatArray) -> FloatArray:
    """Two points in the wrong order."""
    return drawn[[0, 1, 2, 3, 4, 6, 5, 7, 8, 9, 10, 11]]


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (kinked, r"ST 7 has a kink of \d+ deg at y 2\.\d+ m, z 2\.500 m"),
        (opened, r"ST 7 is open: it ends 0\.600 m off the centre plane, at z 0\.000 m"),
        (looped, r"ST 7 crosses itself at y \d\.\d+ m, z \d\.\d+ m"),
        (swapped, r"ST 7 (crosses itself|has a kink of \d+ deg) at y"),
    ],
    ids=lambda given: getattr(given, "__name__", ""),
)
def test_a_section_drawn_wrongly_is_refused_by_name(spoil: Spoil, words: str) -> None:
    """What, where and how much; with `on_error="report"` the numbers come with notes."""
    hull = spoilt_wigley(spoil)
    with pytest.raises(ah.errors.BadInputError, match=words + r".*on_error='report'"):
        hull.hydrostatics(draught=5.5)
    with pytest.raises(ah.errors.BadInputError, match=words):
        hull.hydrostatics(draught=5.5, estimate=False)
    table = hull.hydrostatic_table([4.0, 5.5], on_error="report")
    assert "ST 7" in table.notes[0]
    sound = spoilt_wigley(None).hydrostatics(draught=5.5)
    assert table[1].volume == pytest.approx(sound.volume, rel=0.02)


def pinched(drawn: FloatArray) -> FloatArray:
    """Half as broad between the waterlines: nothing but its area is wrong."""
    middle = 0.5 * (drawn[:-1] + drawn[1:]) * [1.0, 0.6, 1.0]
    return np.insert(drawn, np.arange(1, 12), middle, axis=0)


@pytest.mark.parametrize("spoil", [opened, pinched])
def test_levers_are_refused_where_hydrostatics_are(spoil: Spoil) -> None:
    """One rule and one sentence; with `on_error="report"` the doubt stands in the notes of both."""
    hull = spoilt_wigley(spoil)
    with pytest.raises(ah.errors.BadInputError) as refused:
        hull.hydrostatics(draught=5.5)
    levers: dict[str, Callable[..., object]] = {
        "stability": lambda **more: hull.stability(draught=5.5, kg=4.0, heels=[0, 20], **more),
        "cross curves": lambda **more: hull.cross_curves(draughts=[5.5], heels=[20], **more),
        "equilibrium": lambda **more: hull.equilibrium(2300.0, lcg=50.0, kg=3.0, **more),
    }
    for name, compute in levers.items():
        with pytest.raises(ah.errors.BadInputError) as again:
            compute()
        if name != "equilibrium":  # she floats at another draught
            assert again.value.what == refused.value.what, name
        assert again.value.remedy == refused.value.remedy, name
    told = levers["stability"](on_error="report").notes  # type: ignore[attr-defined]
    assert refused.value.what.partition(" (and")[0] in told


def chine_net() -> ah.Hull:
    """A hull with a chine, digitised with noise."""
    stations = [6.0, 12.0, 18.0, 24.0, 30.0, 36.0, 42.0, 48.0]
    slices = slice_mesh(
        chine_hull(), stations=stations, waterlines=[1.3, 2.0, 2.8, 4.0, 5.0], buttocks=[1.5, 3.0]
    )
    return ah.Hull(net_from_slices(read_lines(scattered(slices, 3)))[0])


@pytest.fixture(scope="module")
def ships(
    series60_60: ah.Hull, series60_70: ah.Hull, bulk_carrier: ah.Hull
) -> dict[str, tuple[ah.Hull, float]]:
    """Sound hulls that ship with the package, or are made of a formula; and draughts."""
    return {
        "wigley": (ah.examples.wigley(), 6.25),
        "series 60 .60": (series60_60, series60_60.particulars.draught),
        "series 60 .70": (series60_70, series60_70.particulars.draught),
        "bulk carrier": (bulk_carrier, bulk_carrier.particulars.draught),
        "chine": (chine_net(), 3.0),
    }


SHIPS = ["wigley", "series 60 .60", "series 60 .70", "bulk carrier", "chine"]


@pytest.mark.parametrize("name", SHIPS)
@pytest.mark.parametrize("part", [0.4, 1.0])
def test_true_shapes_raise_no_doubt(
    ships: dict[str, tuple[ah.Hull, float]], name: str, part: float
) -> None:
    """Bulb, bossing, chine and noise of digitised lines are no defects."""
    hull, draught = ships[name]
    body = flotation(hull.state)
    assert body.layout.lost == ()
    heeled = FloatingPlanes(np.array([part * draught]), np.array([0.005]), np.array([0.1]))
    assert body.doubts(level(part * draught)) == ()
    assert body.doubts(heeled) == ()


STATIONS = [0, 3.1, 6.2, 9.3, 12.4, 18.6, 24.8, 31, 37.2, 43.4, 46.5, 49.6, 52.7, 55.8, 58.9]
HEIGHTS = [0, 0.5, 1, 1.5, 2, 3, 4, 5, 6, 6.5]


def supply_vessel(x: float, z: float) -> float:
    """Half-breadth, m: a cutaway aft to a deep transom; of the last station the deck alone."""
    if x > 58.0:
        return 1.2 if z >= 6.5 else 0.0
    aft, fore = max(0.0, 1.0 - x / 18.0), max(0.0, (x - 42.0) / 20.0)
    keel = 2.5 * aft**1.7
    if z < keel:
        return 0.0
    flat = 0.85 * (1.0 - aft**1.3) * (1.0 - min(fore, 1.0) ** 0.8)
    rise = min((z - keel) / (1.5 + 0.5 * aft + 3.5 * fore**1.2), 1.0)
    round_ = flat + (1.0 - flat) * (1.0 - (1.0 - rise) ** 2.2) ** 0.5
    plan = (1.0 - 0.05 * aft**2) * (1.0 - (fore / (0.97 + 0.06 * z / 6.5)) ** 2.2)
    return float(7.0 * max(plan, 0.0) * (round_ if z > keel or flat else 0.0))


def raked_barge(x: float, z: float) -> float:
    """Half-breadth, m, nan below the keel: the bottom rises by 4 m over 6 m at both ends."""
    return 6.0 if z >= max(0.0, 4.0 - min(x, 60.0 - x) / 1.5) else math.nan


Form = Callable[[float, float], float]


def table_file(folder: Path, form: Form, stations: list[float], wrong: float | None) -> Path:
    """A table without a keel column; of station `wrong` all half-breadths are halved."""
    rows = ["x_m," + ",".join(f"wl_{z:g}" for z in HEIGHTS)]
    for x in stations:
        part = 0.5 if x == wrong else 1.0
        cells = ",".join(f"{part * form(x, z):.3f}" for z in HEIGHTS)
        rows.append(f"{x:g}," + cells.replace("nan", ""))
    file = folder / "offsets.csv"
    file.write_text("# unit: m\n" + "\n".join(rows) + "\n")
    return file


@pytest.mark.parametrize(
    ("form", "stations"),
    [(supply_vessel, STATIONS), (raked_barge, [0, 6, 12, 24, 36, 48, 54, 60])],
    ids=["supply vessel", "raked barge"],
)
def test_a_right_table_that_changes_quickly_is_told_and_not_refused(
    tmp_path: Path, form: Form, stations: list[float]
) -> None:
    """A note names the section, and the error bar is wider."""
    file = table_file(tmp_path, form, stations, None)
    hull = ah.read(file, length=60.0, draught=5.0, deck="closed")
    table = hull.hydrostatic_table([1.0, 3.0, 5.0])
    (note, *_) = [each for each in table.notes if "neighbours" in each]
    assert "the shape changes quickly there, or the section is wrong" in note
    stated = table[2].error["volume"]
    assert stated is not None
    assert stated > 0.003 * table[2].volume


def test_a_section_that_stands_alone_is_refused_by_name(tmp_path: Path) -> None:
    """Half as broad as it is, on the slope of the fore body."""
    file = table_file(tmp_path, supply_vessel, STATIONS, 49.6)
    hull = ah.read(file, length=60.0, draught=5.0, deck="closed")
    with pytest.raises(ah.errors.BadInputError, match=r"ST 49\.6 has .* m2 where its neigh"):
        hull.hydrostatics()


def test_a_section_that_stands_alone_among_parallel_ones_is_refused_at_import(
    tmp_path: Path,
) -> None:
    """By name: it does not reach the flat of side; whoever accepts it is told again."""
    file = table_file(tmp_path, supply_vessel, STATIONS, 31.0)
    with pytest.raises(ah.errors.NotSoundError, match="station 31: its section is 50 %"):
        ah.read(file, length=60.0, draught=5.0, deck="closed")
    hull = ah.read(file, length=60.0, draught=5.0, deck="closed", accept=True)
    with pytest.raises(ah.errors.BadInputError, match=r"ST 31 has a kink"):
        hull.hydrostatics()


def test_published_ships_raise_no_doubt(dtc: ah.Hull, data_folder: Path) -> None:
    """The bulb of the container ship, and a yacht from a table of offsets."""
    yacht = ah.read(data_folder / "sysser1" / "sysser01_offsets.csv")
    for hull, draughts in ((dtc, (6.0, 14.5)), (yacht, (0.4, 0.794))):
        body = flotation(hull.state)
        assert body.layout.lost == ()
        for draught in draughts:
            assert body.doubts(level(draught)) == ()


@pytest.mark.parametrize("name", SHIPS)
def test_two_routes_agree_within_what_is_stated(
    ships: dict[str, tuple[ah.Hull, float]], name: str
) -> None:
    """Sections along the ship, and waterplanes upward; the values in brackets are stated."""
    hull, draught = ships[name]
    assert disagreements(hull, draught, name) == []


def test_two_routes_agree_on_the_container_ship(dtc: ah.Hull) -> None:
    """As on all examples."""
    assert disagreements(dtc, 14.5, "DTC") == []


def disagreements(hull: ah.Hull, draught: float, name: str) -> list[str]:
    """What differs by more than is stated, or the volume by 2e-4, at even keel and inclined."""
    body, ship = flotation(hull.state), hull.particulars
    beyond = []
    for trim, heel in ((0.0, 0.0), (0.002 * ship.length, 5.0)):
        draughts = draught + 0.5 * trim, draught - 0.5 * trim
        found = hull.hydrostatics(draughts=draughts, heel_deg=heel)
        tilt = np.array([-trim / ship.length]), np.array([np.tan(np.radians(heel))])
        other = body.by_waterplanes(FloatingPlanes(np.array([draughts[0]]), *tilt))
        volume = float(other.volume[0])
        away = {
            "volume": volume - found.volume,
            "lcb": float(other.moment_x[0]) / volume - found.lcb,
            "kb": float(other.moment_z[0]) / volume - found.kb,
        }
        words = [f"{key} {off:+.1e} ({found.error[key]:.1e})" for key, off in away.items()]
        print(f"\n{name}, heel {heel:g} deg: V {found.volume:.3f} m3,", ", ".join(words))
        for key, off in away.items():
            most = found.error[key]
            assert most is not None, key
            most += 1e-12 * abs(getattr(found, key))
            if key == "volume":
                most = min(most, 2e-4 * volume)
            if abs(off) > most:
                beyond.append(f"{key} at heel {heel:g} deg: {off:+.2e}, at most {most:.2e}")
    return beyond


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"draught": 0.0}, r"mean draught of 0 m lies below the keel.*from 0 to 9\.375 m"),
        ({"draught": -2.0}, r"-2 m lies below the keel.*from 0 to 9\.375 m"),
        ({"draught": 9.5}, r"9\.5 m lies above the deck.*from 0 to 9\.375 m"),
        ({"draughts": (-9.0, -1.0)}, r"-5 m lies below the keel.*T_A -9 m, T_F -1 m.*from -?\d"),
        ({"draughts": (12.0, 30.0)}, r"21 m lies above the deck.*from .* to 18\.375 m"),
        ({"draught": 30.0, "heel_deg": 30.0}, r"30 m lies above the deck.*heel 30 deg"),
        ({"draught": math.nan}, r"draught of nan m is no finite number.*from 0 to 9\.375 m"),
        ({"draughts": (5.0, math.nan)}, r"draught of nan m is no .*from 0 to 9\.375 m"),
        ({"draught": 5.0, "heel_deg": math.nan}, "heel_deg is nan"),
        ({"draught": 5.0, "heel_deg": 90.0}, r"heel of 90 deg.*from -89\.9 to 89\.9"),
        ({"draught": 5.0, "rho": math.nan}, "rho is nan"),
        ({"draught": "deep"}, "draught is 'deep'"),
    ],
    ids=str,
)
def test_a_position_that_cannot_be_is_refused_with_the_range(
    given: dict[str, Any], words: str
) -> None:
    """The error names the value, and what can be."""
    with pytest.raises(ah.AssocHullError, match=words):
        ah.examples.wigley().hydrostatics(**given)


@pytest.mark.parametrize(
    ("draughts", "trims", "words"),
    [
        ([3.0, 5.0, 4.0], [0.0], "draughts does not rise: 4 stands after 5"),
        ([3.0, 3.0], [0.0], "draughts does not rise: 3 stands after 3"),
        ([3.0, math.nan], [0.0], r"draught of nan m is no finite number.*from 0 to 9\.375 m"),
        ([], [0.0], "draughts is empty"),
        ([3.0], [0.5, 0.0], "trims does not rise: 0 stands after 0.5"),
        ([3.0, 9.5], [0.0], r"9\.5 m lies above the deck.*to 9\.375"),
    ],
)
def test_a_table_that_cannot_be_is_refused_by_name(
    draughts: list[float], trims: list[float], words: str
) -> None:
    """Unsorted and doubled draughts, nan, none, and one that is out of range."""
    with pytest.raises(ah.AssocHullError, match=words):
        ah.examples.wigley().hydrostatic_table(draughts, trims)


def test_a_hull_with_one_section_is_refused() -> None:
    """The error says how many there are, and how many there must be."""
    hull = ah.examples.wigley()
    with hull.edit("one left") as edit:
        for name in list(hull.groups["sections"].lines)[1:]:
            edit.remove_line(hull.groups["sections"].lines[name])
    with pytest.raises(ah.errors.BadInputError, match=r"1 section.*two sections or more"):
        hull.hydrostatics(draught=5.0)


def test_an_open_deck_may_not_go_under() -> None:
    """At the draught at which the edge is reached, or heeled; closed, the same ship floats."""
    hull = ah.examples.wigley()
    ship = attrs.evolve(hull.particulars, deck="open")
    opened_ = spoilt_wigley(None)
    assert opened_.particulars.deck == "closed"
    hull.state.settings.particulars.data[0] = ship
    with pytest.raises(ah.errors.OutOfRangeError, match=r"drowns the open deck.*heel 60 deg"):
        hull.hydrostatics(draught=6.0, heel_deg=60.0)
    assert opened_.hydrostatics(draught=6.0, heel_deg=60.0).volume > 0.0
