"""Lines of a hull from a file of its surfaces: IGES by our own reader or OpenCASCADE, and STEP.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
>>> from assoc_hull.io.surfaces.surface_file import write_surfaces
>>> from assoc_hull.io.slicing.surface_hull import cad_kind
>>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
>>> with tempfile.TemporaryDirectory() as folder:
...     path = Path(folder) / "plate.igs"
...     write_surfaces([plate], path)
...     cad_kind(path)
'iges'
"""

from __future__ import annotations

from pathlib import Path

from assoc_hull.errors import BadInputError, MissingExtraError, NeedsCadError
from assoc_hull.io.cad.hull_faces import Faces
from assoc_hull.io.iges.curves import holds_surfaces
from assoc_hull.io.iges.file import UNITS, IgesFile
from assoc_hull.io.iges.read import surfaces_of_iges
from assoc_hull.io.iges.text import looks_like_iges
from assoc_hull.io.lines.slices import Gaps, Slices
from assoc_hull.io.progress import Tell, silent
from assoc_hull.io.slicing.cut_planes import Places
from assoc_hull.io.slicing.surface_slices import slice_surfaces
from assoc_hull.io.units import checked_unit

__all__ = ["cad_kind", "faces_of_file", "read_surface_lines"]

_MOST_BYTES = 200_000_000
_HEAD = 2000
_WHERE = "as an argument"


def cad_kind(path: Path) -> str | None:
    """Tell by its content what a file of CAD is: "iges", "step", or None for anything else.

    IGES without surfaces is something else: its curves are digitised lines.
    """
    try:
        with path.open("rb") as file:
            head = file.read(_HEAD).decode("latin-1")
            if looks_like_iges(head):
                text = head + file.read(_MOST_BYTES).decode("latin-1")
                return "iges" if holds_surfaces(text) else None
    except OSError:
        return None
    if head.lstrip("\ufeff\u00ef\u00bb\u00bf \t\r\n").startswith("ISO-10303-21"):
        return "step"
    return None


def faces_of_file(path: Path, unit: str = "auto") -> Faces:
    """Read the surfaces of a file.

    Untrimmed spline surfaces of IGES need no extra; anything else does.

    Parameters
    ----------
    path : Path
        IGES or STEP.
    unit : str
        The unit of its lengths; "auto": as the file says.

    Raises
    ------
    BadInputError
        A file that is damaged or too large, tells no unit, or holds no surface.
    MissingExtraError
        It needs OpenCASCADE, which is not installed.
    """
    given = None if unit == "auto" else checked_unit(unit, _WHERE)
    kind = cad_kind(path)
    text = _text(path)
    if kind == "step":
        from assoc_hull.io.cad.kernel import require_opencascade
        from assoc_hull.io.cad.read import read_faces
        from assoc_hull.io.cad.step_text import require_sound, step_unit

        require_opencascade()
        require_sound(text, path.name)
        return read_faces(path, "step", step_unit(text), given)
    try:
        surfaces, used, notes = surfaces_of_iges(text, path.name, given)
    except NeedsCadError as error:
        return _through_cad(path, text, given, error)
    return Faces.of(surfaces, used, notes)


def _through_cad(path: Path, text: str, unit: str | None, why: NeedsCadError) -> Faces:
    """Read what our own reader leaves to OpenCASCADE; without it, tell why it is needed."""
    from assoc_hull.io.cad.read import read_faces

    told = UNITS.get(IgesFile.of_text(text, path.name).unit)
    try:
        return read_faces(path, "iges", told[0] if told else None, unit)
    except MissingExtraError as error:
        raise NeedsCadError(why.what, why.where, f"{why.remedy}: {error}") from error


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
    except OSError as error:
        what = f"the file cannot be read ({error.strerror or error})"
        raise BadInputError(what, f"at {path}", "check name and permissions") from error
    if len(data) > _MOST_BYTES:
        what = f"the file has more than {_MOST_BYTES / 1e6:g} MB"
        raise BadInputError(what, f"at {path}", "export the hull only")
    return data.decode("latin-1")


def read_surface_lines(
    path: Path,
    *,
    stations: Places = 41,
    waterlines: Places = 20,
    buttocks: Places = 12,
    scale: float = 1.0,
    unit: str = "auto",
    axes: str = "auto",
    gaps: Gaps | None = None,
    tell: Tell = silent,
) -> Slices:
    """Read surfaces and cut them; arguments as for `assoc_hull.io.slicing.mesh.read_mesh`.

    Raises
    ------
    BadInputError, NoMeetingError, MissingExtraError
        As for `faces_of_file` and `slice_surfaces`.
    """
    tell("reading the surfaces", 0, 0)
    faces = faces_of_file(path, unit)
    return slice_surfaces(
        faces, stations=stations, waterlines=waterlines, buttocks=buttocks, scale=scale,
        axes=axes, gaps=gaps, name=path.stem, tell=tell,
    )  # fmt: skip
