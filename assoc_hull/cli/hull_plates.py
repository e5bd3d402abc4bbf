"""Plates of a hull at the command line: what goes with a hull, and what is told of it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assoc_hull.cli.arguments import HULL_ENDINGS
from assoc_hull.cli.output import emit, progress
from assoc_hull.cli.problems import UsageError

if TYPE_CHECKING:
    from assoc_hull.plating import HullPlates

__all__ = ["add_seams", "hull_plates", "is_hull", "refuse_seams"]

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


def is_hull(path: Path) -> bool:
    """Tell whether a file is meant as a hull, by its ending.

    Examples
    --------
    >>> from pathlib import Path
    >>> from assoc_hull.cli.hull_plates import is_hull
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


def hull_plates(arguments: argparse.Namespace) -> int:
    """Find plates of a hull, write what is asked for, and tell of them."""
    from assoc_hull.io.tables.hull_plates_file import hull_plates_document
    from assoc_hull.sources import open as open_hull

    _refuse_others(arguments)
    hull = open_hull(arguments.file)
    with progress("fitting the surface, finding regions"):
        found = _found(hull, arguments)
    saved = _saved(found, arguments)
    words = [str(found), *(f"written: {each}" for each in saved)]
    emit(arguments, {**hull_plates_document(found), "saved": saved}, "\n".join(words))
    return 0


def _refuse_others(arguments: argparse.Namespace) -> None:
    """Refuse what goes with surfaces only, and a hull that nothing cuts."""
    for name in _OF_SURFACES:
        if getattr(arguments, name):
            option = name.replace("_", "-")
            raise UsageError(f"--{option} does not go with a hull; it is for files of surfaces")
    if arguments.zero == "exact" or arguments.breadth == "own":
        what = "--zero exact" if arguments.zero == "exact" else "--breadth own"
        raise UsageError(f"{what} does not go with a hull: all its plates share one band")
    if not (arguments.butts or arguments.seams_z or arguments.seams_girth):
        raise UsageError(
            "nothing cuts the hull into plates; give --butts, --seams-z or --seams-girth"
        )


def _found(hull: Any, arguments: argparse.Namespace) -> HullPlates:
    """Find the plates, by the options that are given."""
    from assoc_hull.plating import plates
    from assoc_hull.surface.plates.hull_seams import HullSeams

    x, z, girth = (
        tuple(place for each in given for place in each)
        for given in (arguments.butts, arguments.seams_z, arguments.seams_girth)
    )
    names = ("strain_tol", "k0", "share", "sagitta_tol", "breadth")
    given: dict[str, Any] = {name: getattr(arguments, name) for name in names}
    options = {name: value for name, value in given.items() if value is not None}
    if arguments.one_fit:
        options["others"] = ()
    return plates(hull, HullSeams(x, z, girth, arguments.inside), zero=arguments.zero, **options)


def _saved(found: HullPlates, arguments: argparse.Namespace) -> list[str]:
    """Write what was asked for; name the files."""
    saved: list[Path] = []
    title = f"Plates of {arguments.file.name}"
    if arguments.out is not None:
        with progress(f"writing {arguments.out}"):
            if arguments.out.suffix == ".pdf":
                from assoc_hull.plot.plates.hull_sheet import hull_sheet

                hull_sheet(found, arguments.out, title=title)
            else:
                found.save(arguments.out)
        saved.append(arguments.out)
    if arguments.picture is not None:
        from assoc_hull.plot.plates.hull_map import hull_map

        with progress(f"drawing {arguments.picture}"):
            hull_map(found, arguments.picture, title=title)
        saved.append(arguments.picture)
    return [str(each) for each in saved]
