"""Ships by boundary data: sections anywhere, volumes with their error, lines, the net beside it."""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.creation.classical.classical_net import classical_net
from assoc_hull.creation.classical.middle_body import Midship
from assoc_hull.creation.classical.report import ClassicalReport
from assoc_hull.creation.classical.seaking import Seaking, area_breaks
from assoc_hull.creation.classical.seaking_parts import DeckCamber, MidshipSection, ParallelPart
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.boundary_lines import CodedKnuckleLine, KeelOutline
from assoc_hull.geometry.classical.frame_section import FrameSection
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.splines.distance import closest_points
from assoc_hull.model.tables import Particulars
from assoc_hull.shipped.classical_ships import classical_ship


def body(**changed: object) -> Seaking:
    """Forty metres of one midship section, both ends flat."""
    given = {
        "particulars": Particulars("Middle body", 40, 32, 14, 9, "closed"),
        "keel": KeelOutline.make(0, 40, [(0, 0)], [(40, 0)], [(0, 2), (40, 2)]),
        "waterlines": tuple(
            ParallelWaterline.make(z, [(0, 16), (40, 16)], parallel=(0, 40)) for z in (5, 9)
        ),
        "deck": CodedKnuckleLine.make([0, 40], [(16, 14), (16, 14)], [1]),
        "frames": np.arange(5.0, 40.0, 5.0),
        "parallel": ParallelPart(Midship(16, 2, 0.3, 2.5), 0, 40),
    }
    return Seaking(**(given | changed))  # type: ignore[arg-type]


def wedge() -> Seaking:
    """A hull of which all is known: V-shaped, half-breadth z/2 up to 8 m, over 30 m, a raked stem.

    Keel level to x = 30, then rising at 1 in 1 to the deck at x = 38; half-breadth at (x, z) ahead
    of 30 is half of the height above the keel.
    """
    lines = [
        ParallelWaterline.make(z, [(0, z / 2), (15, z / 2), (30, z / 2), (30 + z, 0)],
                               parallel=(0, 30), method="graph")
        for z in (2.0, 4.0, 6.0)
    ]  # fmt: skip
    return Seaking(
        particulars=Particulars("Wedge", 38, 8, 8, 6, "closed"),
        keel=KeelOutline.make(0, 30, [(0, 0)], [(30, 0), (38, 8)], [(0, 0), (30, 0)]),
        waterlines=tuple(lines),
        deck=CodedKnuckleLine.make([0, 30, 38], [(4, 8), (4, 8), (0, 8)], [1, 1]),
        frames=np.array([5.0, 15, 25, 32, 35]),
    )


@pytest.fixture(scope="module")
def coaster() -> Seaking:
    """The ship that comes with the package."""
    found = classical_ship("seaking_ship")
    assert isinstance(found, Seaking)
    return found


@pytest.fixture(scope="module")
def hull(coaster: Seaking) -> ah.Hull:
    """Its net."""
    return ah.Hull(classical_net(coaster)[0])


@pytest.fixture(scope="module")
def report(coaster: Seaking, hull: ah.Hull) -> ClassicalReport:
    """What it says of itself, beside its net."""
    return coaster.report(hull.state)


def test_a_middle_body_of_boundary_data_has_the_volume_by_hand() -> None:
    """11249.94226 m3 to 9 m, by the definition; its net to 1e-6, without a finding."""
    ship = body()
    assert f"{ship.volume(9.0):.5f}" == "11249.94226"
    hull = ah.Hull(classical_net(ship)[0])
    assert hull.check() == ()
    assert hull.hydrostatics(draught=9.0).volume == pytest.approx(ship.volume(9.0), rel=1e-6)
    worst = ship.report(hull.state).worst
    assert worst is not None
    assert worst.distance < 1e-5


def test_sections_of_the_middle_body_are_the_midship_section() -> None:
    """At any x; with a camber they have the area above the side too, with a corner less."""
    ship = body()
    assert {type(each) for each in ship.sections([0, 7.3, 40])} == {MidshipSection}
    level = ship.section(7.0).area()
    crowned = body(camber=DeckCamber(np.array([(0, 0.3), (40, 0.5)]))).section(20.0)
    assert crowned.area() == pytest.approx(level + 4 * 16 * 0.4 / 3, rel=1e-12)
    rounded = body(camber=DeckCamber(np.zeros((0, 2)), "parabola", np.array([(0, 1), (40, 1)])))
    lost = 2 * (1 - np.pi / 4)
    assert rounded.section(20.0).area() == pytest.approx(level - lost, rel=1e-12)
    assert rounded.section(20.0).area(9.0) == pytest.approx(ship.section(7.0).area(9.0), rel=1e-14)


def test_breaks_of_the_curve_of_areas_are_found() -> None:
    """Corners of lines and of the deck; where the keel passes a waterline, and the level."""
    found = area_breaks(wedge(), [5.0])
    assert {0.0, 15.0, 30.0, 32.0, 34.0, 35.0, 36.0, 38.0} <= set(found.round(9).tolist())


def test_sections_abaft_and_over_the_level_keel_are_built_otherwise(coaster: Seaking) -> None:
    """Over the level keel a frame leaves its flat; ahead and abaft it begins at the keel."""
    after, middle, ahead = coaster.sections([5.0, 25.0, 106.0])
    assert isinstance(after, FrameSection)
    assert isinstance(middle, FrameSection)
    assert isinstance(ahead, FrameSection)
    assert (after.flat, ahead.flat) == (0.0, 0.0)
    assert middle.flat > 3.0
    assert middle.level_start
    assert after.keel == pytest.approx(float(coaster.keel.height(5.0)), abs=1e-12)
    assert isinstance(coaster.section(53.0), MidshipSection)


def test_a_volume_is_the_sum_of_its_sections_and_states_its_error(
    coaster: Seaking, report: ClassicalReport
) -> None:
    """Beside a sum over 300 sections; the stated error is small, the sum's larger."""
    first, last = coaster.ends
    found = report.figure("volume below 6.6 m")
    x = first + (np.arange(300) + 0.5) * (last - first) / 300
    rough = coaster.areas(x, 6.6).mean() * (last - first)
    assert found.value == pytest.approx(rough, rel=2e-4)
    assert found.error is not None
    assert 0.0 < found.error < 1e-6 * found.value


def test_the_net_of_the_coaster_is_sound_and_close_to_its_definition(
    hull: ah.Hull, report: ClassicalReport
) -> None:
    """No finding; volume to 5e-4, centres to 5 mm, waterplane to 1e-4; frames to 5 cm."""
    assert hull.check() == ()
    draught = "below 6.6 m"
    volume = report.figure(f"volume {draught}")
    assert volume.net == pytest.approx(volume.value, rel=5e-4)
    for axis in ("x", "z"):
        centre = report.figure(f"centre of volume {draught}, {axis}")
        assert centre.net == pytest.approx(centre.value, abs=5e-3)
    plane = report.figure("waterplane area at 6.6 m")
    assert plane.net == pytest.approx(plane.value, rel=1e-4)
    assert report.worst is not None
    assert report.worst.distance < 0.05
    wet = [each for each in report.departures if each.name not in ("FR -2", "FR 0", "FR 2")]
    assert max(abs(each.net / each.area - 1) for each in wet) < 5e-3


def test_the_net_passes_the_points_of_waterlines(coaster: Seaking, hull: ah.Hull) -> None:
    """Each given point lies on its line to 1 mm, the tolerance of adoption."""
    for line in coaster.waterlines:
        curve = hull.lines[f"WL {line.z:g}"].curves[0]
        spline = hull.state.spline(curve.row)
        given = np.column_stack([line.points, np.full(len(line.points), line.z)])
        assert closest_points(spline, 0, given)[2].max() < 1.05e-3


def test_a_report_tells_the_corrugation_and_calls_no_frame_fair(
    coaster: Seaking, report: ClassicalReport
) -> None:
    """The largest jump stands among the numbers and in a note."""
    jump = report.figure("largest tangent jump of a frame").value
    assert jump == max(each.largest_jump for each in coaster.sections(coaster.frames))
    assert any("frames are continuous only" in each for each in report.notes)
    assert " fair" not in str(report)


def test_a_waterline_beside_the_midship_section_is_told() -> None:
    """With its distance; so is a flat of bottom that is not that of the midship section."""
    lines = (ParallelWaterline.make(5, [(0, 15.9), (40, 15.9)], parallel=(0, 40)),)
    notes = body(waterlines=lines).notes
    assert "waterline z=5: lies up to 100.0 mm off the midship section" in "\n".join(notes)
    keel = KeelOutline.make(0, 40, [(0, 0)], [(40, 0)], [(0, 2.5), (40, 2.5)])
    assert "lies up to 500.0 mm off the edge of the flat" in "\n".join(body(keel=keel).notes)


def test_a_deck_with_a_step_is_built_section_by_section() -> None:
    """Right of the step sections are higher; the volume of the whole is that of both parts."""
    deck = CodedKnuckleLine.make([0, 25, 25, 40], [(16, 14)] * 2 + [(16, 16)] * 2, [1, 0, 1])
    ship = body(deck=deck)
    low, high = ship.sections([24.999, 25.0])
    assert (low.area() + 2 * 32) == pytest.approx(high.area(), rel=1e-12)
    assert ship.volume() == pytest.approx(25 * low.area() + 15 * high.area(), rel=1e-9)
    assert "deck side: it steps at x=25; near there the net is" in "\n".join(ship.notes)
    clear = body(deck=deck, frames=np.array([5.0, 15, 22, 28, 35]))
    hull = ah.Hull(classical_net(clear)[0])
    assert hull.check() == ()
    assert hull.hydrostatics(draught=9.0).volume == pytest.approx(ship.volume(9.0), rel=2e-4)


REFUSED: dict[str, tuple[str, Callable[[], object]]] = {
    "waterlines downward": (
        "waterline z=5: stands at or below the one before it",
        lambda: body(waterlines=body().waterlines[::-1]),
    ),
    "deck too short": (
        "deck side: must cover [0, 40]",
        lambda: body(deck=CodedKnuckleLine.make([0, 30], [(16, 14), (16, 14)], [1])),
    ),
    "deck of one column": (
        "deck side: has one column of values",
        lambda: body(deck=CodedKnuckleLine.make([0, 40], [16, 16], [1])),
    ),
    "deck of negative breadth": (
        "deck side: negative half-breadth at row 1",
        lambda: body(deck=CodedKnuckleLine.make([0, 40], [(16, 14), (-1, 14)], [1])),
    ),
    "deck below the keel": (
        "deck side: z=-1 at x=0 lies below the contour",
        lambda: body(deck=CodedKnuckleLine.make([0, 40], [(16, -1), (16, 14)], [1])),
    ),
    "frames in disorder": (
        "frames: x not strictly increasing at row 1", lambda: body(frames=np.array([5.0, 3.0])),
    ),
    "a frame beyond the ends": (
        "frames: x=41 outside [0, 40]", lambda: body(frames=np.array([5.0, 41.0])),
    ),
    "midship beyond the keel": (
        "midship: its part [0, 41] leaves the level keel",
        lambda: body(parallel=ParallelPart(Midship(16, 2, 0.3, 2.5), 0, 41)),
    ),
    "midship of another breadth": (
        "midship: the deck side at x=0 has y=16, not a=15",
        lambda: body(parallel=ParallelPart(Midship(15, 2, 0.3, 2.5), 0, 40)),
    ),
    "bilge above the deck": (
        "midship: bilge centre z=14.28531716 above the side height 14",
        lambda: body(parallel=ParallelPart(Midship(16, 0, 0.3, 14.25), 0, 40)),
    ),
    "camber runs back": (
        "camber: x not strictly increasing at row 1",
        lambda: DeckCamber(np.array([(5, 0.3), (5, 0.4)])),
    ),
    "corner larger than the side": (
        "frame x=5: corner radius 13 does not fit",
        lambda: body(
            camber=DeckCamber(corner=np.array([(0.0, 13), (40, 13)]))
        ).section(5.0),
    ),
    "a section beyond the ends": ("frame: x=41 outside [0, 40]", lambda: body().section(41.0)),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_makes_no_ship_is_refused(case: str) -> None:
    """With the line, the place and the numbers."""
    message, make = REFUSED[case]
    with pytest.raises(GeometryError) as caught:
        make()
    assert caught.value.what.startswith(message), caught.value.what


def test_a_definition_is_a_value(coaster: Seaking) -> None:
    """Frozen, arrays and all."""
    with pytest.raises(attrs.exceptions.FrozenInstanceError):
        coaster.frames = np.zeros(2)  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        coaster.frames[0] = 1.0
