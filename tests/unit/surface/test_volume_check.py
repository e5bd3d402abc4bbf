"""A mesh or surface of another volume than hydrostatics find is not written without a word."""

from pathlib import Path

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.net.curve_net import gather_net
from assoc_hull.errors import NotSoundError
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.surface.cells.closed_mesh import ClosedMesh, examine_mesh, fine_mesh_of_state
from assoc_hull.surface.volume_check import displaced_of, extent_faults, mesh_faults
from tests.cases.test_box_with_bilges import round_box
from tests.drawn_hulls import half_chined


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A Wigley hull of few lines."""
    return ah.examples.wigley(stations=9, waterlines=6)


def pressed(mesh: ClosedMesh, part: float) -> ClosedMesh:
    """Make a mesh narrower by a part between x = 20 and 40 m: closed all the same."""
    xyz = mesh.xyz.copy()
    xyz[(xyz[:, 0] > 20.0) & (xyz[:, 0] < 40.0), 1] *= 1.0 - part
    return attrs.evolve(mesh, xyz=xyz, report=examine_mesh(xyz, mesh.triangle))


def test_a_mesh_of_the_right_volume_is_written_with_both(hull: ah.Hull, tmp_path: Path) -> None:
    """The report tells the volume of hydrostatics beside that of the file."""
    report = hull.export(tmp_path / "a.stl")
    level, mine, theirs = report.displaced
    assert theirs == pytest.approx(hull.hydrostatics(draught=level).volume, rel=1e-9)
    assert mine == pytest.approx(theirs, rel=4e-3)
    assert report.faults == ()


def test_a_pressed_mesh_is_refused_with_its_place(hull: ah.Hull, tmp_path: Path) -> None:
    """By how much its volume is off and where stands in the error; nothing is written."""
    mesh, net, by_lines = (
        pressed(hull.mesh(), 0.2),
        gather_net(hull.state),
        displaced_of(hull.state),
    )
    (fault,) = mesh_faults(mesh, by_lines, net)
    part = mesh.below(6.25).volume / hull.hydrostatics(draught=6.25).volume - 1.0
    assert f"{100.0 * part:+.2f} %" in fault
    at = float(fault.split("x = ")[1].split(" m")[0])
    assert 20.0 <= at <= 40.0
    with pytest.raises(NotSoundError, match="accept"):
        write_mesh(mesh, tmp_path / "b.stl", by_lines=by_lines, net=net)
    assert not (tmp_path / "b.stl").exists()
    taken = write_mesh(mesh, tmp_path / "b.stl", by_lines=by_lines, net=net, accept=True)
    assert taken.faults == (fault,)


def test_a_pressed_half_is_refused_as_the_whole_is(hull: ah.Hull, tmp_path: Path) -> None:
    """Its both sides hold as much as the whole; a half of the right volume tells both volumes."""
    net, by_lines = gather_net(hull.state), displaced_of(hull.state)
    half, whole = pressed(hull.mesh(half=True), 0.2), pressed(hull.mesh(), 0.2)
    assert mesh_faults(half, by_lines, net) == mesh_faults(whole, by_lines, net)
    with pytest.raises(NotSoundError, match="where hydrostatics find"):
        write_mesh(half, tmp_path / "b.stl", by_lines=by_lines, net=net)
    assert not (tmp_path / "b.stl").exists()
    report = hull.export(tmp_path / "a.stl", half=True)
    assert report.displaced == pytest.approx(hull.export(tmp_path / "c.stl").displaced, rel=1e-9)
    assert "both sides hold" in str(report)


@pytest.mark.parametrize("half", [False, True], ids=["both sides", "the port half"])
def test_too_few_points_are_told_to_be_more(hull: ah.Hull, tmp_path: Path, half: bool) -> None:
    """Two chords between crossings cut 0.8 % off this hull; with more the mesh is written."""
    with pytest.raises(NotSoundError) as refused:
        hull.export(tmp_path / "a.stl", half=half, points=2)
    assert refused.value.findings[0].endswith(": give more points, or draw stations or waterlines "
                                              "there")  # fmt: skip
    assert hull.export(tmp_path / "a.stl", half=half, points=6).faults == ()


@pytest.mark.parametrize("half", [False, True], ids=["both sides", "the port half"])
def test_a_hull_of_few_lines_gets_the_points_that_its_volume_takes(
    tmp_path: Path, half: bool
) -> None:
    """Four chords to an edge would cut off 1.1 % of it, eight 0.4 %."""
    hull = ah.examples.wigley(stations=5, waterlines=3)
    _, mine, theirs = hull.export(tmp_path / "a.stl", half=half).displaced
    assert mine == pytest.approx(theirs, rel=5e-3)
    with pytest.raises(NotSoundError, match="give more points"):
        hull.export(tmp_path / "b.stl", half=half, points=4)


def test_a_volume_that_points_do_not_mend_is_not_cut_ever_finer(hull: ah.Hull) -> None:
    """Chords are halved once to see that they are not the reason."""
    assert fine_mesh_of_state(hull.state, lambda _: 0.0).steps == 4
    assert fine_mesh_of_state(hull.state, lambda _: 9.0).steps == 8


@pytest.mark.parametrize("axis", ["x", "z"])
def test_too_full_here_and_too_fine_there_is_refused(hull: ah.Hull, axis: str) -> None:
    """The volume of such a mesh agrees within 0.1 %; its centre does not."""
    mesh, by_lines = hull.mesh(points=8), displaced_of(hull.state)[:1]
    xyz = mesh.xyz.copy()
    # Wigley's hull is the same fore and aft; about z = 3.9 m moments of the breadth cancel.
    away = (xyz[:, 0] - 50.0) / 50.0 if axis == "x" else (xyz[:, 2] - 3.905) / 6.25
    xyz[:, 1] *= 1.0 + 0.1 * away
    wrong = attrs.evolve(mesh, xyz=xyz, report=examine_mesh(xyz, mesh.triangle))
    part = wrong.below(by_lines[0].level).volume / by_lines[0].volume - 1.0
    assert abs(part) <= 1e-3
    fault = mesh_faults(wrong, by_lines, gather_net(hull.state))[0]
    assert f"at {axis} = " in fault
    assert "though the volume agrees" in fault


def test_a_mesh_that_nothing_holds_says_so(hull: ah.Hull, tmp_path: Path) -> None:
    """Hydrostatics may refuse lines that part a hull into cells all the same."""
    report = write_mesh(hull.mesh(), tmp_path / "a.stl", net=gather_net(hull.state))
    assert "not compared with hydrostatics" in str(report)


def test_a_vertex_beyond_all_lines_is_told(hull: ah.Hull) -> None:
    """A metre before the stem of a hull of 100 m."""
    net, xyz = gather_net(hull.state), hull.mesh().xyz
    beyond = np.concatenate([xyz, [[101.0, 0.0, 6.0]]])
    (fault,) = extent_faults(beyond, net)
    assert "1.000 m beyond" in fault
    assert "(101.00, 0.00, 6.00)" in fault


def test_the_report_of_a_surface_tells_both_volumes(hull: ah.Hull) -> None:
    """And a volume that is off is a fault, for which no file is written."""
    surface = hull.surface()
    wrong = attrs.evolve(
        surface, displaced=tuple(attrs.evolve(d, volume=0.9 * d.volume) for d in surface.displaced)
    )
    assert "by hydrostatics of the lines" in str(surface)
    with pytest.raises(NotSoundError, match="where hydrostatics find"):
        wrong.write("never.step")


def test_a_round_bilge_without_waterlines_is_cut_finely(tmp_path: Path) -> None:
    """Four chords to a whole section would cut the bilge off: 4.8 % of the volume."""
    report = round_box().export(tmp_path / "box.stl")
    _, mine, theirs = report.displaced
    assert mine == pytest.approx(theirs, rel=4e-3)


def test_cells_between_a_round_and_a_chined_frame_are_filled_as_drawn(tmp_path: Path) -> None:
    """A chine that ends on a frame leaves a cell of four lines, not one of five cut across."""
    hull = half_chined(tmp_path)
    mesh = hull.mesh(points=16)
    for each in displaced_of(hull.state):
        assert mesh.below(each.level).volume == pytest.approx(each.volume, rel=5e-3)
    assert mesh.xyz[:, 0].min() >= -1e-9
    assert mesh.xyz[:, 0].max() <= 60.0 + 1e-9
