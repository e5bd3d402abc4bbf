"""The command that tells of shell plates how they are curved, and how they may be formed.

Plates are surfaces of a file, or the plates that seams cut from a hull; options of one are
refused for the other. It writes tables, maps, developments and books of plates.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import PICTURE_ENDINGS, Commands, add_command, add_json
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import HULL_ENDINGS, UsageError, check_target
from assoc_hull.errors import BadInputError

if TYPE_CHECKING:
    from assoc_hull.hull.results import HullPlates, Plates
    from assoc_hull.surface.plating.hull_seams import HullSeams

__all__ = [
    "add_plates",
    "add_seams",
    "is_hull",
    "refuse_seams",
    "seams_of",
]

# --------------------------------------------------------------------------------------
# Plates of a hull at the command line: what goes with a hull, and what is told of it.

_OF_SURFACES = ("unit", "development", "surfaces", "delta", "area_tol", "seams_u", "seams_v")
"""Options that go with a file of surfaces only."""

_MOST = 10_000
"""Places of a range, at most."""


def add_seams(parser: argparse.ArgumentParser) -> None:
    """Add what cuts a hull."""
    group = parser.add_argument_group("of a hull")
    for name, what in (
        ("butts", "butts, planes across the ship at these x from AP, m"),
        ("seams-z", "seams, level planes at these heights over the base line, m"),
        ("seams-girth", "seams, at these girths from the lowest point of each section, m"),
    ):
        group.add_argument(
            f"--{name}", type=_places, nargs="+", default=[], metavar="M",
            help=f"{what}; 24:300:12 for 24, 36 ... 300",
        )  # fmt: skip
    group.add_argument(
        "--inside", action="store_true", help="leave out what lies beyond the outermost places"
    )
    group.add_argument(
        "--one-fit", action="store_true",
        help="do not fit the hull twice more to tell what its net leaves open",
    )  # fmt: skip


def _places(words: str) -> list[float]:
    """Take a place, or a range with its step."""
    try:
        found = [float(each) for each in words.split(":")]
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{words!r} is no place in m, and no range") from error
    if len(found) == 1:
        return found
    if len(found) != 3 or not found[2] > 0.0 or not found[1] - found[0] < _MOST * found[2]:
        raise argparse.ArgumentTypeError(f"{words!r} is no range: give LOW:HIGH:STEP, m")
    low, high, step = found
    return [low + step * k for k in range(int((high - low) / step + 1e-9) + 1)]


def seams_of(arguments: argparse.Namespace) -> HullSeams | None:
    """Give the seams that are named; None where nothing is."""
    from assoc_hull.surface.plating.hull_seams import HullSeams

    x, z, girth = (
        tuple(place for each in given for place in each)
        for given in (arguments.butts, arguments.seams_z, arguments.seams_girth)
    )
    return HullSeams(x, z, girth, arguments.inside) if x or z or girth else None


def is_hull(path: Path) -> bool:
    """Tell whether a file is meant as a hull, by its ending.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.cli.plates import is_hull
    >>> is_hull(Path("ship.hull")), is_hull(Path("ship.hull.json")), is_hull(Path("shell.json"))
    (True, True, False)
    """
    return path.name.endswith(HULL_ENDINGS)


def refuse_seams(arguments: argparse.Namespace) -> None:
    """Refuse, with a file of surfaces, what goes with a hull only.

    Raises
    ------
    UsageError
        Such an option.
    """
    for name in ("butts", "seams_z", "seams_girth", "inside", "one_fit"):
        if getattr(arguments, name):
            option = name.replace("_", "-")
            raise UsageError(f"--{option} goes with a hull; {arguments.file} holds surfaces")


def _require_seams(arguments: argparse.Namespace) -> HullSeams:
    """Give the seams; refuse what goes with surfaces only, and a hull that nothing cuts."""
    for name in _OF_SURFACES:
        if getattr(arguments, name):
            option = name.replace("_", "-")
            raise UsageError(f"--{option} does not go with a hull; it is for files of surfaces")
    if arguments.zero == "exact" or arguments.breadth == "own":
        what = "--zero exact" if arguments.zero == "exact" else "--breadth own"
        raise UsageError(f"{what} does not go with a hull: all its plates share one band")
    seams = seams_of(arguments)
    if seams is None:
        raise UsageError(
            "nothing cuts the hull into plates; give --butts, --seams-z or --seams-girth"
        )
    return seams


def _hull_plates(arguments: argparse.Namespace) -> HullPlates:
    """Find plates of a hull."""
    from assoc_hull.hull.results import plates
    from assoc_hull.hull.sources import open as open_hull

    seams = _require_seams(arguments)
    options = _given(arguments, "strain_tol", "k0", "share", "sagitta_tol", "breadth")
    if arguments.one_fit:
        options["others"] = ()
    hull = open_hull(arguments.file)
    with progress("fitting the surface, finding regions"):
        return plates(hull, seams, zero=arguments.zero, **options)


def _given(arguments: argparse.Namespace, *names: str) -> dict[str, Any]:
    """Give the options that are named at the command line."""
    found: dict[str, Any] = {name: getattr(arguments, name) for name in names}
    return {name: value for name, value in found.items() if value is not None}


# --------------------------------------------------------------------------------------
# The command that tells of shell plates how they are curved, and how they may be formed.

_OUT = (".csv", ".json", ".pdf")
_UNITS = ("m", "mm", "cm", "ft", "in")
_OWN = "own"


def add_plates(commands: Commands) -> None:
    """Add ``plates``."""
    parser = add_command(
        commands, "plates", _plates,
        """assoc-hull plates plates.csv
        assoc-hull plates shell.igs -o plates.json --picture map.png
        assoc-hull plates shell.igs --seams-u 0.25 0.5 0.75 --breadth own -o plates.pdf
        assoc-hull plates plates.csv --strain-tol 0.002 --development flat.csv --json
        assoc-hull plates ship.hull --butts 24:300:12 --seams-girth 2.5:40:2.5 -o plates.pdf
        assoc-hull plates ship.hull --butts 240 252 --seams-z 4 8 --inside --picture map.png""",
    )  # fmt: skip
    parser.add_argument(
        "file", metavar="FILE", type=Path,
        help="surfaces: control nets (.csv, .json) or untrimmed IGES 128 (.igs); or a hull",
    )  # fmt: skip
    parser.add_argument(
        "--unit", choices=_UNITS, help="of lengths in FILE (default: as it says; m of a table)"
    )
    _add_options(parser)
    add_seams(parser)
    parser.add_argument(
        "-o", "--out", type=Path, metavar="TABLE", help="write a .csv, .json or .pdf file"
    )
    parser.add_argument(
        "--picture", type=Path, metavar="MAP", help="draw the regions: .pdf, .svg or .png"
    )
    parser.add_argument(
        "--development", type=Path, metavar="FLAT",
        help="lay the plates flat, and write nodes and strains to a .csv file",
    )  # fmt: skip
    parser.add_argument(
        "--surfaces", type=Path, metavar="NETS",
        help="write the surfaces, cut at seams, in m: .csv (Bezier only), .json or .igs",
    )  # fmt: skip
    add_json(parser)


def _add_options(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--zero", choices=("strain", "absolute", "exact"), default="strain",
        help="what counts as no Gaussian curvature (default: strain)",
    )  # fmt: skip
    parser.add_argument(
        "--strain-tol", type=float, metavar="E", help="strain that is neglected (default: 0.001)"
    )
    parser.add_argument(
        "--breadth", type=_breadth, metavar="M",
        help=f"breadth that has this strain, m, or {_OWN}: that of each plate (default: 2.5)",
    )  # fmt: skip
    parser.add_argument(
        "--k0", type=float, metavar="K", help="with --zero absolute: curvature neglected, 1/m2"
    )
    parser.add_argument(
        "--delta", type=float, metavar="M", help="what control points may be off by, m"
    )
    parser.add_argument(
        "--share", type=float, metavar="PART", help="part that makes the class (default: 0.95)"
    )
    parser.add_argument(
        "--sagitta-tol", type=float, metavar="M",
        help="sagitta over the breadth that counts as flat, m (default: 0.003)",
    )  # fmt: skip
    parser.add_argument(
        "--area-tol", type=float, metavar="PART", help="error of areas, of all (default: 1e-6)"
    )
    for name in ("u", "v"):
        parser.add_argument(
            f"--seams-{name}", type=float, nargs="+", default=[], metavar="P",
            help=f"cut every surface at these parameters {name}",
        )  # fmt: skip


def _breadth(text: str) -> float | str:
    """Take a breadth, or the word for each plate's own."""
    if text == _OWN:
        return text
    try:
        return float(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is no length, and not {_OWN!r}") from error


def _plates(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.tables.plates import plates_document

    _check_targets(arguments)
    found: Plates | HullPlates
    notes: tuple[str, ...] = ()
    if is_hull(arguments.file):
        found = _hull_plates(arguments)
    else:
        found, notes = _surface_plates(arguments)
    saved = [str(path) for path in _saved(found, arguments)]
    document = plates_document(found)
    document["notes"] = [*notes, *document["notes"]]
    words = [str(found), *notes, *(f"written: {each}" for each in saved)]
    emit(arguments, {**document, "saved": saved}, "\n".join(words))
    return 0


def _check_targets(arguments: argparse.Namespace) -> None:
    """Refuse, before anything is computed, what could not be written."""
    from assoc_hull.io.write_file import require_no_hull_file

    targets = ((arguments.out, _OUT), (arguments.picture, PICTURE_ENDINGS),
               (arguments.development, (".csv",)),
               (arguments.surfaces, (".csv", ".json", ".igs", ".iges")))  # fmt: skip
    known = {arguments.file.resolve()}
    for path, endings in targets:
        if path is None:
            continue
        check_target(path, endings)
        require_no_hull_file(path)
        if path.resolve() in known:
            what = "another file of this command has this name"
            raise BadInputError(what, f"at {path}", "give another name")
        known.add(path.resolve())
    sheet = arguments.out is not None and arguments.out.suffix == ".pdf"
    if arguments.picture is not None or sheet:
        from assoc_hull.plot.sheet.sheet_figure import require_matplotlib

        require_matplotlib()


def _surface_plates(arguments: argparse.Namespace) -> tuple[Plates, tuple[str, ...]]:
    """Find plates of the surfaces in a file; give notes on the file, too."""
    from assoc_hull.hull.results import plates
    from assoc_hull.io.surfaces.surface_file import read_surface_file
    from assoc_hull.surface.plating.surface_plates import Seams

    refuse_seams(arguments)
    with progress(f"reading {arguments.file}"):
        surfaces = read_surface_file(arguments.file, arguments.unit)
    options = _given(
        arguments, "strain_tol", "k0", "delta", "share", "sagitta_tol", "area_tol", "breadth"
    )
    if arguments.breadth == _OWN:
        options["breadth"] = None
    with progress("finding regions"):
        seams = Seams(arguments.seams_u, arguments.seams_v)
        return plates(surfaces, seams or None, arguments.zero, **options), tuple(surfaces.notes)


def _saved(found: Plates | HullPlates, arguments: argparse.Namespace) -> Iterator[Path]:
    """Write what was asked for; name the files. Plates of a hull are not laid flat."""
    if arguments.out is not None:
        with progress(f"writing {arguments.out}"):
            if arguments.out.suffix == ".pdf":
                _write_sheet(found, arguments)
            else:
                found.save(arguments.out)
        yield arguments.out
    if arguments.picture is not None:
        with progress(f"drawing {arguments.picture}"):
            _draw_map(found, arguments)
        yield arguments.picture
    if arguments.development is not None:
        from assoc_hull.io.tables.plates import development_csv
        from assoc_hull.io.write_file import write_whole

        with progress("laying plates flat"):
            text = development_csv([plate.development() for plate in found])
        write_whole(arguments.development, text.encode())
        yield arguments.development
    if arguments.surfaces is not None:
        from assoc_hull.io.surfaces.surface_file import write_surfaces

        write_surfaces(found.surfaces, arguments.surfaces)
        yield arguments.surfaces


def _write_sheet(found: Plates | HullPlates, arguments: argparse.Namespace) -> None:
    """Write the table with maps as a PDF."""
    from assoc_hull.plot.plates.plate_book import plate_sheet

    flat = arguments.development is not None
    plate_sheet(found, arguments.out, **_title(arguments), developments=flat)


def _draw_map(found: Plates | HullPlates, arguments: argparse.Namespace) -> None:
    """Draw the regions: of each plate, or of the hull with its plates."""
    from assoc_hull.hull.results import HullPlates

    if isinstance(found, HullPlates):
        from assoc_hull.plot.plates.hull_map import hull_map

        hull_map(found, arguments.picture, **_title(arguments))
    else:
        from assoc_hull.plot.plates.curvature_map import curvature_figure

        curvature_figure(found, arguments.picture)


def _title(arguments: argparse.Namespace) -> dict[str, Any]:
    """Give the title of pictures of a hull; those of surfaces have the usual one."""
    return {"title": f"Plates of {arguments.file.name}"} if is_hull(arguments.file) else {}
