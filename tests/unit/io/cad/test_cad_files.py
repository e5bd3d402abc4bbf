"""Surfaces for CAD programs: read back by OpenCASCADE they are what was written, to the digit."""

from __future__ import annotations

import hashlib
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import attrs
import numpy as np
import pytest

from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.check_file import (
    WrittenFile,
    area_of,
    faults_of,
    measure_file,
    require_written,
)
from assoc_hull.io.cad.faces import SewnShell, face_of
from assoc_hull.io.cad.kernel import require_opencascade
from assoc_hull.io.cad.write import CAD_FORMS, both_sides, cad_bytes, step_bytes, write_cad
from assoc_hull.io.iges.surfaces import surfaces_of_iges
from tests.cut_hulls import half_hull, three_blocks
from tests.rational_surfaces import revolved

BLOCKS = three_blocks()
CASES = [(form, *each) for form in CAD_FORMS for each in (("m", True), ("mm", False))]


def kind_of(form: str) -> str:
    """What OpenCASCADE is to read."""
    return "step" if form == "step" else "iges"


@pytest.fixture(scope="module")
def written() -> dict[tuple[str, str, bool], tuple[bytes, WrittenFile]]:
    """Each form in each unit, half and whole: its bytes, and what OpenCASCADE reads."""
    found = {}
    for form, unit, half in CASES:
        data, _ = cad_bytes(BLOCKS, form, unit=unit, half=half)
        found[form, unit, half] = data, measure_file(data, kind_of(form))
    return found


@pytest.mark.parametrize(("form", "unit", "half"), CASES)
def test_every_form_holds_what_was_written(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
    form: str,
    unit: str,
    half: bool,
) -> None:
    """Control points to 1e-5 mm, faces, the unit as declared, areas to 1e-6, sound topology."""
    _, found = written[form, unit, half]
    given = BLOCKS if half else both_sides(BLOCKS)
    assert len(found.surfaces) == len(given)
    for one, other in zip(found.surfaces, given, strict=True):
        assert np.abs(one.net - other.net).max() < 1e-8
        for knots, wanted in ((one.knots_u, other.knots_u), (one.knots_v, other.knots_v)):
            assert knots == pytest.approx(wanted, abs=1e-9)
    assert found.unit == unit
    assert found.area == pytest.approx(sum(map(area_of, given)), rel=1e-7)
    assert found.valid
    assert found.turned == ()


@pytest.mark.parametrize(
    ("unit", "half", "joined", "free"),
    [("m", True, 3, 7), ("mm", False, 10, 6)],
    ids=["half", "whole"],
)
@pytest.mark.parametrize("form", ["step", "iges-brep"])
def test_faces_of_a_shell_share_their_edges(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
    form: str,
    unit: str,
    half: bool,
    joined: int,
    free: int,
) -> None:
    """The long side beside two blocks is two edges; deck edge and transom are free.

    So is the centre line of a half: keel and stem, which join both sides of the whole.
    """
    _, found = written[form, unit, half]
    assert (found.shells, found.joined, found.free, found.seams) == (1, joined, free, 0)


def test_a_rational_surface_keeps_its_weights() -> None:
    """A quarter of a pipe, whose area is known."""
    net, weights = revolved(np.array([[1.0, 0.0], [1.0, 2.0]]), np.ones(2), 0.0, np.pi / 2)
    pipe = SplineSurface.bezier(net, "pipe", weights)
    assert area_of(pipe) == pytest.approx(np.pi, rel=1e-9)
    for form in ("step", "iges"):
        (back,) = measure_file(cad_bytes([pipe], form, half=True)[0], kind_of(form)).surfaces
        assert back.weights == pytest.approx(weights, abs=1e-9)


def test_faces_keep_order_and_names_where_sewing_turns_them_over() -> None:
    """As where the first two do not touch: each name stands with its own control points."""
    whole = half_hull()
    cuts = {"bow": (0.0, 30.0), "stern": (75.0, 100.0), "body": (30.0, 75.0)}
    given = [whole.restricted(u, (0.0, 20.0), name) for name, u in cuts.items()]
    text = cad_bytes(given, "step", half=True)[0].decode()
    assert re.findall(r"ADVANCED_FACE\('(.*?)'", text) == list(cuts)
    found = surfaces_of_iges(cad_bytes(given, "iges", half=True)[0].decode(), "hull.igs")[0]
    assert [each.name for each in found] == list(cuts)
    assert [len(each.net) for each in found] == [len(each.net) for each in given]


def test_our_own_reader_reads_what_both_writers_make(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
) -> None:
    """Trimmed surfaces with natural borders to 1e-12, bare ones to the digit; with names."""
    for (form, unit, half), (data, _) in written.items():
        if form not in ("iges", "iges-surfaces"):
            continue
        given = BLOCKS if half else both_sides(BLOCKS)
        found, told, notes = surfaces_of_iges(data.decode(), "hull.igs")
        assert (told, notes) == (unit, ())
        assert [each.name for each in found] == [each.name for each in given]
        for one, other in zip(found, given, strict=True):
            largest = 1e-12 * np.abs(other.net).max() if form == "iges" else 2e-14
            assert np.abs(one.net - other.net).max() <= largest


def test_the_header_says_what_and_from_whom(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
) -> None:
    """AP214, the name of the part, names of faces, a fixed time, and no name of a user."""
    text = written["step", "m", True][0].decode()
    assert "FILE_SCHEMA(('AUTOMOTIVE_DESIGN" in text
    assert "FILE_NAME('hull','2000-01-01T00:00:00',(''),('')" in text
    assert re.findall(r"PRODUCT\('(.*?)','(.*?)'", text) == [("hull", "hull")]
    assert re.findall(r"ADVANCED_FACE\('(.*?)'", text) == [each.name for each in BLOCKS]
    assert "LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.)" in text


def test_the_same_surfaces_give_the_same_bytes() -> None:
    """Written again by the same process, after others, and by another one."""
    script = (
        "import sys, hashlib\n"
        "from assoc_hull.io.cad.write import cad_bytes\n"
        "from tests.cut_hulls import three_blocks\n"
        "for form in ('step', 'iges'):\n"
        "    print(hashlib.sha256(cad_bytes(three_blocks(), form, half=True)[0]).hexdigest())\n"
    )
    here = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True
    )
    assert here.stderr == ""
    wanted = [
        hashlib.sha256(cad_bytes(BLOCKS, form, half=True)[0]).hexdigest()
        for form in ("step", "iges")
    ]
    assert here.stdout.split() == wanted


def test_opencascade_prints_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    """Neither on writing nor on reading what is damaged: a command prints JSON there."""
    data, _ = cad_bytes(BLOCKS[:1], "step", half=True)
    with pytest.raises(BadInputError, match="OpenCASCADE reads no surface"):
        measure_file(data[: len(data) // 2], "step")
    with pytest.raises(BadInputError):
        measure_file(b"", "step")
    assert capfd.readouterr() == ("", "")


# What makes a file bad, and what is found.


def unsewn() -> SewnShell:
    """The blocks in one shell, with an edge each where they meet."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Shell

    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    faces = [face_of(each) for each in BLOCKS]
    for face in faces:
        builder.Add(shell, face)
    return SewnShell(shell, faces)


def faults(data: bytes, unit: str = "mm", form: str = "step") -> list[str]:
    """What the check says of a file that was to hold the blocks."""
    return faults_of(measure_file(data, kind_of(form)), BLOCKS, unit, shell=form != "iges")


def test_an_unsewn_file_is_found() -> None:
    """Also where a long side meets two short ones: all three lie along another free edge."""
    data = step_bytes(unsewn(), [each.name for each in BLOCKS], "mm", "hull")
    assert "4 edges within the shell are not joined" in " ".join(faults(data))


@pytest.mark.parametrize(
    ("form", "metres", "millimetres"),
    [
        pytest.param("step", b"SI_UNIT($,.METRE.)", b"SI_UNIT(.MILLI.,.METRE.)", id="step"),
        pytest.param("iges", b",1.,6,1HM,", b",1.,2,1HM,", id="iges"),
    ],
)
def test_metres_declared_as_millimetres_are_found(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
    form: str,
    metres: bytes,
    millimetres: bytes,
) -> None:
    """By the unit, by every surface and by the area."""
    data = written[form, "m", True][0]
    assert data.count(metres) == 1
    found = faults(data.replace(metres, millimetres), "m", form)
    assert found[0] == "the unit is mm instead of m"
    assert len([each for each in found if "control points of" in each]) == len(BLOCKS)
    assert found[4].startswith("the area is 0.00")


def test_a_block_that_is_missing_turned_or_moved_is_found(
    written: dict[tuple[str, str, bool], tuple[bytes, WrittenFile]],
) -> None:
    """One by one."""
    _, found = written["step", "m", True]
    assert faults_of(found, BLOCKS, "m", shell=True) == []
    assert faults_of(found, BLOCKS[:2], "m", shell=True) == ["there are 3 faces instead of 2"]
    wrong = faults_of(found, [moved(BLOCKS[0], 2e-8), *BLOCKS[1:]], "m", shell=True)
    assert len(wrong) == 1
    assert wrong[0].startswith("control points of 'stern' are off by 2.000")
    turned = attrs.evolve(found, turned=(1,), shells=2, valid=False)
    with pytest.raises(BadInputError, match=r"unsound; there are 2 shells .* 1 faces have"):
        require_written(turned, BLOCKS, "m", shell=True)


def test_a_bad_file_is_not_left(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What does not come back is refused, and what was there stays."""
    path = tmp_path / "hull.step"
    path.write_bytes(b"before")
    monkeypatch.setattr("assoc_hull.io.cad.write.sew_surfaces", lambda surfaces: unsewn())
    with pytest.raises(BadInputError, match="4 edges within the shell are not joined"):
        write_cad(BLOCKS, path, half=True)
    assert path.read_bytes() == b"before"
    assert [each.name for each in tmp_path.iterdir()] == ["hull.step"]


def moved(surface: SplineSurface, dy: float) -> SplineSurface:
    """A surface moved to port."""
    return attrs.evolve(surface, net=surface.net + np.array([0.0, dy, 0.0]))


def apart() -> list[SplineSurface]:
    """Two blocks with a metre between them."""
    return [BLOCKS[0], moved(BLOCKS[1], 1.0)]


def inside_out() -> list[SplineSurface]:
    """The surface with its normals into the hull."""
    whole = half_hull()
    return [attrs.evolve(whole, net=whole.net[::-1].copy())]


@pytest.mark.parametrize(
    ("surfaces", "half", "what"),
    [
        pytest.param(apart(), True, "they are in 2 parts", id="apart"),
        pytest.param([moved(BLOCKS[2], 1e-5)], False, "is 0.01 mm off it", id="off centre"),
        pytest.param(inside_out(), True, "point into the hull", id="inside out"),
        pytest.param([], True, "there are no surfaces", id="none"),
    ],
)
def test_surfaces_of_no_hull_are_refused(
    surfaces: list[SplineSurface], half: bool, what: str
) -> None:
    """Before anything is written."""
    with pytest.raises(BadInputError, match=what):
        cad_bytes(surfaces, "step", half=half)


@pytest.mark.parametrize(
    ("version", "what"),
    [
        pytest.param("7.9.2", r"8\.0 \(this is 7\.9\.2\) is not installed", id="older"),
        pytest.param("8.1.0", r"8\.0 \(this is 8\.1\.0\) is not installed", id="newer"),
        pytest.param(None, r"8\.0 is not installed", id="missing"),
    ],
)
def test_another_opencascade_is_refused(
    monkeypatch: pytest.MonkeyPatch, version: str | None, what: str
) -> None:
    """In one line that names the extra; our own writer needs none."""
    found = None if version is None else SimpleNamespace(__version__=version)
    monkeypatch.setitem(sys.modules, "OCP", found)
    with pytest.raises(MissingExtraError, match=rf"{what}; run: pip install 'assoc-hull\[cad\]'"):
        require_opencascade()
    with pytest.raises(MissingExtraError):
        cad_bytes(BLOCKS, "step")
    assert cad_bytes(BLOCKS, "iges-surfaces")[1].faces == 6


def test_version_8_0_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """With any number behind."""
    monkeypatch.setitem(sys.modules, "OCP", SimpleNamespace(__version__="8.0"))
    require_opencascade()
