"""The command `study`: many variants of a hull, of values that are given, drawn or laid out."""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit, progress_bar
from assoc_hull.cli.problems import UsageError, check_other_target, check_target
from assoc_hull.errors import UnknownNameError
from assoc_hull.hull import Hull
from assoc_hull.hull.sources import open as open_hull

if TYPE_CHECKING:
    from assoc_hull.hull.studies import Study
    from assoc_hull.study.design import Sample

__all__ = ["add_study"]

_ENDINGS = (".csv", ".json", ".parquet")
_KEYS = ("set", "reach", "free", "bounds", "layers", "outputs", "layout")
_GRID = 1000
"""Values along one side of a grid."""
_SHOWN = 5
"""So many reasons are told."""


def add_study(commands: Commands) -> None:
    """Add ``study``."""
    parser = add_command(
        commands, "study", _study,
        """assoc-hull study ship.hull --set breadth=31:33 --count 50 -o breadths.csv
        assoc-hull study ship.hull --reach volume=51000:53000 --reach lcb=110:112
            --free fore_shift=-4:4 --free aft_shift=-4:4 --count 200 --seed 1 -o variants.csv
        assoc-hull study ship.hull --set breadth=31:33:9 --set draught=11:12:5 -o grid.parquet
        assoc-hull study ship.hull --script study.json --cluster local --file study.sqlite

        study.json: {"set": {"draught": 11.0}, "reach": {"volume": [52000, 52500]},
        "free": ["breadth"], "bounds": {"breadth": [31, 33]}}
        (m, or degrees where a name ends in _deg; LOW:HIGH is drawn, one value per variant;
        LOW:HIGH:N are N values, each with each of the others)""",
    )  # fmt: skip
    add_hull(parser)
    _add_design(parser)
    parser.add_argument("--script", metavar="FILE.json", type=Path, help="all of it as a file")
    parser.add_argument(
        "--file", metavar="FILE.sqlite", type=Path,
        help="rows are added to it as they are made; the same command goes on where it stopped",
    )  # fmt: skip
    parser.add_argument(
        "--workers", type=int, metavar="N", help="processes (default: 1; of a local cluster: cores)"
    )
    parser.add_argument(
        "--cluster",
        metavar="WHERE",
        help="make rows by Dask: 'local', or the address of a scheduler",
    )
    parser.add_argument(
        "-o", "--out", metavar="FILE", type=Path, help="a .csv, .json or .parquet file"
    )
    add_json(parser)


def _add_design(parser: argparse.ArgumentParser) -> None:
    value = "a value, LOW:HIGH to draw one per variant, or LOW:HIGH:N for a grid"
    several = "; may be given more than once"
    parser.add_argument(
        "--set", metavar="NAME=VALUE", action="append", default=[],
        help=f"a named parameter: {value}{several}",
    )  # fmt: skip
    parser.add_argument(
        "--reach", metavar="NAME=VALUE", action="append", default=[],
        help=f"a target, of hydrostatics or form parameters: {value}{several}",
    )  # fmt: skip
    parser.add_argument(
        "--free", metavar="NAME[=LOW:HIGH]", action="append", default=[],
        help=f"a parameter whose value is sought, between bounds{several}",
    )  # fmt: skip
    parser.add_argument(
        "--rows", metavar="FILE.csv", type=Path,
        help="a variant per row: a column for each named parameter, below its name",
    )  # fmt: skip
    parser.add_argument("--outputs", metavar="NAME", nargs="+", help="what is told of each variant")
    parser.add_argument(
        "--count", type=int, default=10, metavar="N",
        help="variants, where values are drawn (default: 10)",
    )  # fmt: skip
    parser.add_argument(
        "--seed", type=int, default=0, metavar="N", help="of what is drawn (default: 0)"
    )
    parser.add_argument(
        "--method", choices=("sobol", "latin", "uniform"), default="sobol",
        help="how values are drawn (default: sobol)",
    )  # fmt: skip


def _study(arguments: argparse.Namespace) -> int:
    from assoc_hull.io.tables.study import study_document

    if arguments.out is not None:
        check_target(arguments.out, _ENDINGS)
        check_other_target(arguments.out, arguments.hull)
    asked = _asked(arguments)
    hull = open_hull(arguments.hull)
    with progress_bar("study", hidden=False) as tell:
        found = hull.study(
            file=arguments.file, workers=arguments.workers, cluster=arguments.cluster,
            progress=tell, **asked,
        )  # fmt: skip
    saved = _saved(arguments.out, found)
    document = dict(study_document(found.run, found.table())) | {
        "interrupted": found.interrupted, "saved": saved,
    }  # fmt: skip
    emit(arguments, document, "\n".join(_words(found, saved)))
    return 0 if len(found.failed) < len(found) else 1


def _asked(arguments: argparse.Namespace) -> dict[str, Any]:
    """Put together what is asked for; options go before what the file says."""
    from assoc_hull.io.tables.study import read_rows
    from assoc_hull.study.design import Sample
    from assoc_hull.variation.request import read_script

    asked: dict[str, Any] = read_script(arguments.script) if arguments.script else {}
    asked.pop("name", None)  # that of the file: a study has none
    for key in asked:
        if key not in _KEYS:
            raise UnknownNameError("part of a study", key, _KEYS)
    given = {key: _pairs(getattr(arguments, key), key) for key in ("set", "reach")}
    if arguments.rows is not None:
        given["set"] = {**read_rows(arguments.rows), **given["set"]}
    drawn = {
        (key, name): value
        for key, pairs in given.items() for name, value in pairs.items() if isinstance(value, tuple)
    }  # fmt: skip
    if drawn:
        # One draw spreads all of them evenly together; one name may be set and be reached.
        ranges = {f"{key} {name}": value for (key, name), value in drawn.items()}
        found = _drawn(ranges, arguments)
        for (key, name), column in zip(drawn, found.values(), strict=True):
            given[key][name] = column
    for key, pairs in given.items():
        if pairs:
            before = asked.get(key, {})
            if not isinstance(before, dict):
                raise UsageError(f"{arguments.script} gives {key} row by row: leave --{key} out")
            asked[key] = Sample({**before, **pairs}, found.drawn if drawn else "")
    free = _free(arguments.free)
    if free:
        asked["free"] = list(free)
        # Bounds of the file belong to what it frees, which has been replaced.
        asked["bounds"] = {name: ends for name, ends in free.items() if ends is not None}
    if arguments.outputs:
        asked["outputs"] = arguments.outputs
    return asked


def _drawn(ranges: dict[str, tuple[float, ...]], arguments: argparse.Namespace) -> Sample:
    """Draw values, or lay them out as a grid, where all ask for one."""
    from assoc_hull.study.design import grid, sample

    grids = [name for name, ends in ranges.items() if len(ends) > 2]
    if not grids:
        whole = {name: (ends[0], ends[1]) for name, ends in ranges.items()}
        return sample(whole, arguments.count, seed=arguments.seed, method=arguments.method)
    for name in ranges:
        if name not in grids:
            raise UsageError(
                f"--{name} is drawn, and {grids[0]} is a grid: give LOW:HIGH:N for all"
            )
    axes = {name: np.linspace(ends[0], ends[1], int(ends[2])) for name, ends in ranges.items()}
    return grid(axes)


def _pairs(given: list[str], option: str) -> dict[str, Any]:
    """Take ``NAME=VALUE``, ``NAME=LOW:HIGH`` and ``NAME=LOW:HIGH:N``."""
    found: dict[str, Any] = {}
    for each in given:
        name, equals, value = each.partition("=")
        if not equals or not name:
            raise UsageError(f"--{option} {each}: give NAME=VALUE or NAME=LOW:HIGH")
        if name in found:
            raise UsageError(f"--{option} {name} is given twice")
        found[name] = _axis(value, f"--{option} {each}") if ":" in value else _number(value, each)
    return found


def _free(given: list[str]) -> dict[str, tuple[float, float] | None]:
    found: dict[str, tuple[float, float] | None] = {}
    for each in given:
        name, equals, ends = each.partition("=")
        if name in found:
            raise UsageError(f"--free {name} is given twice")
        found[name] = _ends(ends, f"--free {each}") if equals else None
    return found


def _axis(text: str, option: str) -> tuple[float, ...]:
    """Take two ends, and into how many values they are parted where that is said."""
    ends, _, count = text.rpartition(":")
    if ":" not in ends:
        return _ends(text, option)
    if not count.isdecimal() or not 2 <= int(count) <= _GRID:
        raise UsageError(f"{option}: {count!r} is no number of values; give 2 to {_GRID}")
    return *_ends(ends, option), float(count)


def _ends(text: str, option: str) -> tuple[float, float]:
    low, colon, high = text.partition(":")
    if not colon:
        raise UsageError(f"{option}: give LOW:HIGH")
    return _number(low, option), _number(high, option)


def _number(text: str, option: str) -> float:
    try:
        found = float(text)
    except ValueError:
        found = math.nan
    if not math.isfinite(found):
        raise UsageError(f"{option}: {text!r} is no number")
    return found


def _saved(out: Path | None, found: Study[Hull]) -> str | None:
    if out is None:
        return None
    if out.suffix == ".json":
        found.to_json(out)
    elif out.suffix == ".parquet":
        found.to_parquet(out)
    else:
        found.to_csv(out)
    return str(out)


def _words(found: Study[Hull], saved: str | None) -> list[str]:
    """Say what came of it: how many, why not the others, where it is."""
    words = [str(found)]
    words += [f"  variant {row.number}: {row.reason}" for row in found.failed[:_SHOWN]]
    more = len(found.failed) - _SHOWN
    if more > 0:
        words.append(f"  and {more} more without a hull")
    return [*words, f"written: {saved}"] if saved else words
