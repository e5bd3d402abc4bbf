"""A knuckle line from end to end is a crease: blocks end at it, and share only its places."""

from collections.abc import Callable
from pathlib import Path

import attrs
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.hull.results import HullSurface
from assoc_hull.surface.blocks.block_plan import block_plans
from assoc_hull.surface.blocks.cell_regions import CellRegion
from assoc_hull.surface.blocks.end_cuts import knuckle_cuts
from assoc_hull.surface.blocks.fitted_surface import surface_faults
from assoc_hull.surface.cells.net_faces import sound_cells
from tests.drawn_hulls import box_barge, half_chined, ro_pax, sharpie, transom_boat

HULLS: dict[str, tuple[Callable[[Path], ah.Hull], float]] = {
    "barge": (box_barge, 1e-5), "chine boat": (transom_boat, 5e-4), "ro-pax": (ro_pax, 2e-3),
}  # fmt: skip
"""With the part by which their volumes may be off: less where no side is round."""


@attrs.frozen(eq=False)
class Case:
    """A drawn hull, its surface, and how near the volume comes to that of hydrostatics."""

    hull: ah.Hull
    surface: HullSurface
    within: float


@pytest.fixture(scope="module", params=list(HULLS))
def case(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Case:
    """Fit one of the hulls with a knuckle from end to end."""
    draw, within = HULLS[request.param]
    hull = draw(tmp_path_factory.mktemp("drawn"))
    return Case(hull, hull.surface(), within)


def test_the_surface_encloses_what_hydrostatics_find(case: Case) -> None:
    """Below the draught and below the deck; a smooth block is off by up to 9 %."""
    for held, by_lines in zip(case.surface.held, case.surface.displaced, strict=True):
        assert held.volume == pytest.approx(by_lines.volume, rel=case.within)


def test_both_sides_of_the_crease_are_one_curve(case: Case) -> None:
    """The blocks meet there without a gap, at the angle of the knuckle, and nothing is told of."""
    (border,) = case.surface.borders
    assert border.names == ("body", "body below knuckle 1")
    assert border.joined_gap < 1e-9
    assert border.angle[0] > 10.0
    assert not [note for note in case.surface.notes if "normals differ" in note]


def test_it_is_written_without_being_accepted(case: Case, tmp_path: Path) -> None:
    """As STEP: its halves meet, and the solid has the volume of the surface below the deck."""
    assert surface_faults(case.surface) == ()
    report = case.surface.write(tmp_path / "hull.step")
    assert "1 shell" in str(report)
    assert "the solid, closed by deck and transom" in str(report)


def cuts_of(net: CurveNet) -> list[str]:
    """Name the knuckle lines along which a net is cut."""
    cuts, _ = knuckle_cuts(CellRegion.whole(sound_cells(net)))
    return [cut.name for cut in cuts]


def told_of(net: CurveNet) -> str:
    """Give what is told of knuckle lines along which a net is not cut."""
    return "\n".join(knuckle_cuts(CellRegion.whole(sound_cells(net)))[1])


def test_a_chine_that_dies_out_is_no_crease(tmp_path: Path) -> None:
    """It begins amidships and runs to the bow: there is one block, as before."""
    hull = half_chined(tmp_path)
    net = gather_net(hull.state)
    assert net.knuckle.any()
    assert cuts_of(net) == []
    plans = block_plans(sound_cells(net), hull.particulars.length)
    assert [plan.name for plan in plans] == ["body"]
    (told,) = plans[0].notes
    assert "knuckle 1 is no crease" in told
    assert "from end to end" in told


def test_a_line_at_which_a_section_is_smooth_is_no_crease(tmp_path: Path) -> None:
    """One section of the barge without its corner, and the bilge is no crease any more."""
    net = gather_net(box_barge(tmp_path).state)
    assert cuts_of(net) == ["knuckle 1"]
    row = int(net.batch.start[net.name.index("ST 30.0")]) + 1
    leave = net.batch.leave.copy()
    leave[row] = net.batch.arrive[row]
    smooth = attrs.evolve(net, batch=attrs.evolve(net.batch, leave=leave))
    assert cuts_of(smooth) == []
    assert "not every section has a knuckle where it crosses it" in told_of(smooth)


def test_a_knuckle_of_less_than_a_degree_stays_within_its_block() -> None:
    """The upper knuckle of the supply ship, at which sections turn by 0.7 degrees amidships."""
    net = gather_net(ah.examples.prelikon_ship().state)
    assert net.knuckle.any()
    assert cuts_of(net) == []
    assert "upper knuckle is no crease" in told_of(net)
    assert "sections turn by 0." in told_of(net)


def test_a_chine_is_one_side_of_its_block_where_it_ends_on_the_keel(tmp_path: Path) -> None:
    """The bottom of a sharpie has two sides, chine and keel: corners lie on the keel only."""
    hull = sharpie(tmp_path)
    _, bottom = block_plans(sound_cells(gather_net(hull.state)), hull.particulars.length)
    place = bottom.core.region.graph.place[list(bottom.core.corner)]
    assert place[:, 0].tolist() == pytest.approx([0.0, 12.0, 11.0, 1.0], abs=1e-3)
    assert bottom.core.side("v0").tolist() == list(bottom.seams[0].half)
    assert len(bottom.rails) == 11
