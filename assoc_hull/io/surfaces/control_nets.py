r"""Control nets as a table: a row a point, ``patch,i_u,j_v,x,y,z``, and ``w`` for weights.

Each patch is a Bezier surface; its rows may come in any order. Rows that begin with ``#`` are
comments. Semicolons or tabs may stand for commas, and then commas for decimal points.

Examples
--------
>>> from assoc_hull.io.surfaces.control_nets import nets_of_table
>>> rows = [f"deck,{i},{j},{2 * i},{j},0" for i in (0, 1) for j in (0, 1)]
>>> surfaces, _ = nets_of_table("\n".join(["patch,i_u,j_v,x,y,z", *rows]), "deck.csv")
>>> surfaces[0].name, surfaces[0].degrees, surfaces[0].net[1, 1].tolist()
('deck', (1, 1), [2.0, 1.0, 0.0])
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.arguments import all_of, shown
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.patches.spline_surface import HIGHEST_DEGREE, SplineSurface
from assoc_hull.io.units import METRES

__all__ = ["COLUMNS", "looks_like_nets", "nets_of_table", "table_of_nets"]

COLUMNS = ("patch", "i_u", "j_v", "x", "y", "z")
_WEIGHT = "w"
_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]{1,3})?")
_INDEX = re.compile(r"[0-9]{1,4}")


@attrs.frozen
class _Row:
    """A point: where it stands, to which net it belongs, its numbers."""

    line: int
    patch: str
    place: tuple[int, int]
    numbers: tuple[float, ...]


def looks_like_nets(text: str) -> bool:
    r"""Tell whether a text begins with the header of such a table.

    Examples
    --------
    >>> from assoc_hull.io.surfaces.control_nets import looks_like_nets
    >>> looks_like_nets("# plates\npatch,i_u,j_v,x,y,z,w"), looks_like_nets("station,wl_0")
    (True, False)
    """
    head = _head(text)
    return tuple(_cell(each) for each in head.split(_mark(head)))[:3] == COLUMNS[:3]


def _head(text: str) -> str:
    """Give the first line that is no comment."""
    return next((line for line in io.StringIO(text) if not _is_comment(line)), "")


def _mark(head: str) -> str:
    """Tell what stands between cells."""
    return max(",;\t", key=head.count)


def nets_of_table(
    text: str, source: str, unit: str | None = None
) -> tuple[list[SplineSurface], str]:
    """Read control nets.

    Parameters
    ----------
    text : str
        The table.
    source : str
        Its name, for messages.
    unit : str or None
        The unit of its lengths; m if None.

    Returns
    -------
    surfaces : list of SplineSurface
        In the order in which their names first occur; m.
    unit : str
        The unit.

    Raises
    ------
    BadInputError
        No header, a cell that is no number, points that are missing or come twice; each with its
        line.
    """
    unit = unit or "m"
    rows = list(_rows(text, source))
    if not rows:
        raise BadInputError("there are no points", f"in {source}", "give a row for each")
    nets: dict[str, list[_Row]] = {}
    for row in rows:
        nets.setdefault(row.patch, []).append(row)
    return [_surface(name, each, METRES[unit], source) for name, each in nets.items()], unit


def _rows(text: str, source: str) -> Iterator[_Row]:
    """Take the table apart."""
    mark = _mark(_head(text))
    reader = csv.reader(io.StringIO(text), delimiter=mark, strict=True)
    head: list[str] | None = None
    try:
        for cells in reader:
            if not any(cells) or cells[0].lstrip()[:1] == "#":
                continue
            if head is None:
                head = _header(cells, f"{source}, line {reader.line_num}")
                continue
            numbers = cells if mark == "," else [each.replace(",", ".") for each in cells]
            yield _row([cells[0], *numbers[1:]], len(head), reader.line_num, source)
    except csv.Error as error:
        where = f"{source}, line {reader.line_num}"
        raise BadInputError(f"this is no table ({error})", where, "mend the quotation") from None
    if head is None:
        raise _no_header(f"in {source}", "")


def _header(cells: list[str], where: str) -> list[str]:
    names = [_cell(each) for each in cells]
    if tuple(names) not in (COLUMNS, (*COLUMNS, _WEIGHT)):
        raise _no_header(where, f"; the first row is {shown(','.join(cells))}")
    return names


def _no_header(where: str, more: str) -> BadInputError:
    remedy = f"begin with the row {','.join(COLUMNS)} (and ,w for weights)"
    return BadInputError(f"the header of control nets is missing{more}", where, remedy)


def _row(cells: list[str], width: int, line: int, source: str) -> _Row:
    where = f"{source}, line {line}"
    if len(cells) != width:
        what = f"the row has {len(cells)} cells, and the header {width}"
        raise BadInputError(what, where, "give each row a cell for each column")
    name, *rest = (each.strip() for each in cells)
    if not name:
        raise BadInputError("the name of the patch is empty", where, "give it a name")
    for text, column in zip(rest[:2], COLUMNS[1:3], strict=True):
        if not _INDEX.fullmatch(text):
            what = f"{column} is {text[:20]!r}"
            raise BadInputError(what, where, "number the points of a row from 0")
    for text, column in zip(rest[2:], (*COLUMNS[3:], _WEIGHT), strict=False):
        if not _NUMBER.fullmatch(text):
            raise BadInputError(f"{column} is {text[:20]!r}", where, "give a number")
    return _Row(line, name, (int(rest[0]), int(rest[1])), tuple(float(each) for each in rest[2:]))


def _surface(name: str, rows: list[_Row], metres: float, source: str) -> SplineSurface:
    """Give the surface of one patch."""
    first: dict[tuple[int, int], _Row] = {}
    for row in rows:
        if row.place in first:
            what = f"point {row.place[0]},{row.place[1]} of patch {name!r} is there already"
            where = f"{source}, line {row.line} (first in line {first[row.place].line})"
            raise BadInputError(what, where, "give each point once")
        first[row.place] = row
    places = np.array(list(first))
    nu, nv = (int(each) + 1 for each in places.max(axis=0))
    _require_whole(name, first, (nu, nv), source)
    values = np.array([first[i, j].numbers for i in range(nu) for j in range(nv)])
    net = values[:, :3].reshape(nu, nv, 3)
    weights = values[:, 3].reshape(nu, nv) if values.shape[1] == 4 else None
    try:
        return SplineSurface.bezier(net if metres == 1.0 else net * metres, name, weights)
    except BadInputError as error:
        lines = f"{source}, lines {rows[0].line} to {rows[-1].line}, {error.where}"
        raise BadInputError(error.what, lines, error.remedy) from error


def _require_whole(
    name: str, first: dict[tuple[int, int], _Row], size: tuple[int, int], source: str
) -> None:
    """See that a net has two points each way, not too many, and none is missing."""
    nu, nv = size
    lines = sorted(row.line for row in first.values())
    where = f"{source}, lines {lines[0]} to {lines[-1]}"
    if min(size) < 2:
        what = f"patch {name!r} has {nu} x {nv} points"
        raise BadInputError(what, where, "give two or more each way")
    if max(size) > HIGHEST_DEGREE + 1:
        what = f"patch {name!r} has {nu} x {nv} points, of degree {nu - 1} and {nv - 1}"
        remedy = (
            f"a table holds Bezier nets of degree {HIGHEST_DEGREE} at most; give B-splines, with "
            "their knots, as JSON or IGES"
        )
        raise BadInputError(what, where, remedy)
    missing = [(i, j) for i in range(nu) for j in range(nv) if (i, j) not in first]
    if missing:
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        what = f"patch {name!r} has no point {missing[0][0]},{missing[0][1]}{more} of {nu} x {nv}"
        raise BadInputError(what, where, "give all points of the net")


def table_of_nets(surfaces: Sequence[SplineSurface]) -> str:
    """Lay out Bezier surfaces as a table, all digits, m.

    Parameters
    ----------
    surfaces : sequence of SplineSurface
        Of one patch each, with names of their own.

    Raises
    ------
    BadInputError
        A surface of several patches, or with a name that another has.

    Examples
    --------
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> from assoc_hull.io.surfaces.control_nets import table_of_nets
    >>> plate = SplineSurface.bezier([[[0, 0, 0], [0, 1, 0]], [[2, 0, 0], [2, 1, 0]]], "plate")
    >>> print(table_of_nets([plate]).splitlines()[1])
    plate,0,0,0.0,0.0,0.0
    """
    given = all_of(surfaces, SplineSurface, "surfaces", "in table_of_nets")
    weighted = any(each.weights is not None for each in given)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow((*COLUMNS, _WEIGHT) if weighted else COLUMNS)
    known: set[str] = set()
    for each in given:
        _require_own_net(each, known)
        known.add(each.name)
        weights = np.ones(each.net.shape[:2]) if each.weights is None else each.weights
        for i, j in np.ndindex(*weights.shape):
            numbers = [*each.net[i, j].tolist(), *([float(weights[i, j])] if weighted else [])]
            writer.writerow([each.name, i, j, *(repr(value + 0.0) for value in numbers)])
    return out.getvalue()


def _require_own_net(surface: SplineSurface, known: set[str]) -> None:
    where = f"surface {surface.name!r}"
    if tuple(each + 1 for each in surface.degrees) != surface.net.shape[:2]:
        what = "a table holds surfaces of one patch, and this one has more"
        raise BadInputError(what, where, "write JSON or IGES")
    if not surface.name.strip() or surface.name.startswith("#") or surface.name in known:
        what = "a table needs a name for each surface, once"
        raise BadInputError(what, where, "name it otherwise, or write JSON or IGES")


def _is_comment(text: str) -> bool:
    return not text.strip() or text.lstrip().startswith("#")


def _cell(text: str) -> str:
    return text.strip().strip('"').lower()
