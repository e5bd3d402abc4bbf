"""Addresses: what a designer calls a point, a curve or a line.

=============================  ==========================================================
``WL 0.5``                     the line of this name; ``waterlines/WL 0.5`` where two
                               groups have one
``sections``                   the group
``WL 0.5 [2]``                 the second curve of a line
``WL 0.5 x ST 7``              the point on WL 0.5 where ST 7 crosses it; the other way
                               round, its friend on ST 7
``WL 0.5 x BTK 2 #2``          the second crossing that this pair of lines ever had
``WL 0.5 @ placed 1``          the first placed point along the line
``WL 0.5 @ adopted 2``         the second adopted point
=============================  ==========================================================

A key (`Point.id` and the like) is an address too; it never changes. Where nothing has an address as
it is written, spaces, upper and lower case, a comma for the point and zeros at the end do not
matter: ``wl 0,50 X st07`` is ``WL 0.5 x ST 7``.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cached_property

import attrs
import numpy as np

from assoc_hull.arguments import plain_name, shown_name, word
from assoc_hull.errors import BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.attachments import attachment_named
from assoc_hull.model.kinds import Sort
from assoc_hull.model.tables import HullState

__all__ = ["AddressBook", "ResolvedAddress", "address", "resolve_address"]

_OWN = re.compile(r"(.+) @ (placed|adopted) (\d{1,9})")
_BIRTH = re.compile(r"(.+?) #(\d{1,9})")
_PIECE = re.compile(r"(.+) \[(\d{1,9})\]")
_SIGN = re.compile(r"\s+([x\N{MULTIPLICATION SIGN}@])\s+", re.IGNORECASE)
_CLOSE = re.compile(r"(?:(?<=\d)|\s)\s*([x\N{MULTIPLICATION SIGN}])\s*(?=[^\d\s])", re.IGNORECASE)
_NUMBERED = re.compile(r"(.+?)(?:\s*(\[\d{1,9}\]|#\d{1,9}))?")


@attrs.frozen
class ResolvedAddress:
    """What an address leads to; -1 where it does not go so deep.

    Attributes
    ----------
    group, line, curve : int
        Numbers of the objects; of a point, those it lies on.
    row, side : int
        The point, and on which of its sides the curve stands.
    """

    group: int = -1
    line: int = -1
    curve: int = -1
    row: int = -1
    side: int = -1


class AddressBook:
    """All addresses of a hull as it is now; make another one when it has changed.

    Parameters
    ----------
    state : HullState
        The tables.
    """

    def __init__(self, state: HullState) -> None:
        self.state = state

    @cached_property
    def lines(self) -> dict[str, list[int]]:
        """Live lines by name, and by group and name."""
        table = self.state.lines
        depends_on = table.alive, table.group, table.name, self.state.groups.name
        return self.state.derived(("lines by name",), depends_on, self._lines_by_name)

    def _lines_by_name(self) -> dict[str, list[int]]:
        found: defaultdict[str, list[int]] = defaultdict(list)
        table = self.state.lines
        for line in self.state.live("lines").tolist():
            group = self.state.groups.name[int(table.group[line])]
            for name in {table.name[line], f"{group}/{table.name[line]}"}:
                found[name].append(line)
        return dict(found)

    def crossings(self, one: int, other: int) -> dict[int, int]:
        """Give the live crossings of two lines, the first of lower rank: row by birth."""
        pairs, rows = self._pairs
        code = one * self.state.lines.count + other
        rows = rows[pairs.searchsorted(code) : pairs.searchsorted(code, "right")]
        return dict(zip(self.state.rows.birth[rows].tolist(), rows.tolist(), strict=True))

    @cached_property
    def _pairs(self) -> tuple[IntArray, IntArray]:
        """Live crossings by their two lines: a number for each pair, ascending, and the rows."""
        rows, line = self.state.rows, self.state.curves.line
        depends_on = rows.alive, rows.curve, line, self.state.lines.alive
        return self.state.derived(("crossings by lines",), depends_on, self._find_pairs)

    def _find_pairs(self) -> tuple[IntArray, IntArray]:
        table, line = self.state.rows, self.state.curves.line.data
        rows = np.flatnonzero((table.curve.data[:, 1] >= 0) & table.alive.data)
        a, b = line.take(table.curve.data.take(rows, axis=0).T)
        code = a * self.state.lines.count + b
        order = np.argsort(code, kind="stable")
        return code[order], rows[order]

    @cached_property
    def keys(self) -> dict[str, ResolvedAddress]:
        """Everything alive by its key or label."""
        groups, lines = self.state.groups, self.state.lines
        curves, rows = self.state.curves, self.state.rows
        depends_on = (
            groups.alive, groups.name, lines.alive, lines.key, lines.group, curves.alive,
            curves.key, curves.line, rows.alive, rows.key, rows.label, rows.curve,
        )  # fmt: skip
        return self.state.derived(("by key",), depends_on, self._by_key)

    def _by_key(self) -> dict[str, ResolvedAddress]:
        state = self.state
        found = {
            state.groups.name[group]: ResolvedAddress(group)
            for group in state.live("groups").tolist()
        }
        found |= {
            state.lines.key[line]: self._line_place(line) for line in state.live("lines").tolist()
        }
        found |= {
            state.curves.key[curve]: self._curve_place(curve)
            for curve in state.live("curves").tolist()
        }
        rows = state.live("rows").tolist()
        keys = state.rows.key.data.for_looks(len(rows))
        for row in rows:
            place = found[keys[row]] = self._row_place(row, self.usual_side(row))
            label = state.rows.label[row]
            if label:
                found.setdefault(label, place)
        return found

    def line_name(self, line: int) -> str:
        """Give the name of a line, with its group where another group has the same."""
        name = str(self.state.lines.name[line])
        if len(self.lines.get(name, ())) <= 1:
            return name
        return f"{self.state.groups.name[int(self.state.lines.group.data[line])]}/{name}"

    def curve_name(self, curve: int) -> str:
        """Give the name of a curve: that of its line, with a number if it is one of several."""
        line = self.state.line_of(curve)
        if line < 0:
            return str(self.state.curves.key[curve])
        pieces = self._pieces(line)
        if len(pieces) < 2 or curve not in pieces:
            return self.line_name(line)
        return f"{self.line_name(line)} [{pieces.index(curve) + 1}]"

    def address(self, row: int, side: int | None = None) -> str:
        """Give the address of a point; see the function `address`."""
        at = self.usual_side(row) if side is None else side
        short = self._short(row, at)
        if short is None:
            return str(self.state.rows.key[row])
        return short

    def resolve(self, text: str) -> ResolvedAddress:
        """Find what an address leads to; see the function `resolve_address`."""
        plain = word(text, "the address", "in a look-up").strip()
        groups, lines, curves = self.state.groups, self.state.lines, self.state.curves
        rows = self.state.rows
        depends_on = (
            groups.alive, groups.name, lines.alive, lines.key, lines.group, lines.name,
            lines.curves, curves.alive, curves.key, curves.line, curves.rows, rows.alive, rows.key,
            rows.label, rows.curve, rows.sort, rows.birth,
        )  # fmt: skip
        found = self.state.derived(("looked up", plain), depends_on, lambda: self._lookup(plain))
        if found is None:
            if beside := attachment_named(self.state, plain):
                sort = beside[0].word
                raise WrongTypeError(
                    f"{plain!r} is a {sort}, no line, curve, point or group", "in a look-up",
                    f"look it up in hull.{beside[0].column}; edit.set_{sort} and "
                    f"edit.remove_{sort} change it",
                )  # fmt: skip
            raise UnknownNameError("object", shown_name(text), tuple(self._known(text)))
        return found

    def _lookup(self, text: str) -> ResolvedAddress | None:
        found = self._as_written(text)
        for sign in (_SIGN, _CLOSE):
            if found is None and (proper := self._proper(text, sign)) is not None:
                found = self._as_written(proper)
        return found

    def _as_written(self, text: str) -> ResolvedAddress | None:
        return (
            self._line(text)
            or self._piece(text)
            or self._own(text)
            or self._crossing(text)
            or self.keys.get(text)
        )

    def _proper(self, text: str, sign: re.Pattern[str]) -> str | None:
        """Give an address with its names as the hull has them; None where they are not found."""
        parts = sign.split(text)
        found: list[str] = []
        for at, part in enumerate(parts):
            if at % 2 or (at and parts[at - 1] == "@"):
                found.append(part.casefold().replace("\N{MULTIPLICATION SIGN}", "x"))
                continue
            match = _NUMBERED.fullmatch(part)
            alike = self._plain_names.get(plain_name(match[1]), ()) if match else ()
            if match is None or len(alike) != 1:
                return None
            found.append(f"{alike[0]} {match[2]}" if match[2] else alike[0])
        return " ".join(found)

    @cached_property
    def _plain_names(self) -> dict[str, tuple[str, ...]]:
        """Names of lines and groups by how they are compared."""
        lines, groups = self.state.lines, self.state.groups
        depends_on = lines.alive, lines.group, lines.name, groups.alive, groups.name

        def find() -> dict[str, tuple[str, ...]]:
            found: dict[str, tuple[str, ...]] = {}
            live = [str(groups.name[group]) for group in self.state.live("groups").tolist()]
            for name in (*self.lines, *live):
                plain = plain_name(name)
                found[plain] = (*found.get(plain, ()), name)
            return found

        return self.state.derived(("plain names",), depends_on, find)

    def _line(self, text: str) -> ResolvedAddress | None:
        lines = self.lines.get(text, [])
        if len(lines) > 1:
            names = " or ".join(self.line_name(line) for line in lines)
            raise BadInputError(
                f"{len(lines)} lines have this name", f"in {text!r}", f"say {names}"
            )
        return self._line_place(lines[0]) if lines else None

    def _piece(self, text: str) -> ResolvedAddress | None:
        match = _PIECE.fullmatch(text)
        line = self._line(match[1]) if match else None
        if match is None or line is None:
            return None
        pieces = self._pieces(line.line)
        number = int(match[2])
        return self._curve_place(pieces[number - 1]) if 1 <= number <= len(pieces) else None

    def _own(self, text: str) -> ResolvedAddress | None:
        match = _OWN.fullmatch(text)
        line = self._line(match[1]) if match else None
        if match is None or line is None:
            return None
        rows = self._own_rows(line.line, Sort[match[2].upper()])
        number = int(match[3])
        return self._row_place(rows[number - 1], 0) if 1 <= number <= len(rows) else None

    def _crossing(self, text: str) -> ResolvedAddress | None:
        """Try every place at which the text may fall into two names."""
        parts = text.split(" x ")
        for i in range(1, len(parts)):
            first, second = " x ".join(parts[:i]), " x ".join(parts[i:])
            found = self._meeting(first, second, None)
            match = _BIRTH.fullmatch(second)
            if found is None and match:
                found = self._meeting(first, match[1], int(match[2]))
            if found is not None:
                return found
        return None

    def _meeting(self, first: str, second: str, birth: int | None) -> ResolvedAddress | None:
        one, other = self._line(first), self._line(second)
        if one is None or other is None:
            return None
        for side, pair in enumerate([(one.line, other.line), (other.line, one.line)]):
            rows = self.crossings(*pair)
            if birth is None and len(rows) == 1:
                return self._row_place(next(iter(rows.values())), side)
            if (birth or 1) in rows:
                return self._row_place(rows[birth or 1], side)
        return None

    def _short(self, row: int, side: int) -> str | None:
        """Give the address of a point in names, None if these do not lead to it."""
        table, names = self.state.rows, tuple[str, ...]()
        a, b = table.curve[row].tolist()
        lines = self.state.curves.line.data
        if a < 0 or lines[a] < 0 or (b >= 0 and lines[b] < 0):
            return None
        if b < 0:
            names = (self.line_name(int(lines[a])),)
            sort = Sort(int(table.sort[row]))
            if sort is Sort.CROSSING:
                return None
            rows = self._own_rows(int(lines[a]), sort)
            if row not in rows:
                return None
            text = f"{names[0]} @ {sort.name.lower()} {rows.index(row) + 1}"
        else:
            first, second = (a, b) if side == 0 else (b, a)
            birth = int(table.birth[row])
            number = f" #{birth}" if birth > 1 else ""
            names = (self.line_name(int(lines[first])), self.line_name(int(lines[second])))
            text = f"{names[0]} x {names[1]}{number}"
        return text if self._plain(text, names) or self._leads_to(text, row, side) else None

    def _plain(self, text: str, names: tuple[str, ...]) -> bool:
        """Tell at a glance that an address made of names can be read in one way only."""
        odd = any(mark in name for name in names for mark in (" x ", " @ ", "#", "["))
        taken = {text, text.partition(" x ")[2]} - set(names)
        return not odd and not taken & self.lines.keys()

    def _leads_to(self, text: str, row: int, side: int) -> bool:
        try:
            found = self._line(text) or self._piece(text) or self._own(text) or self._crossing(text)
        except BadInputError:
            return False
        return found is not None and (found.row, found.side) == (row, side)

    def _known(self, text: str) -> Iterator[str]:
        """Give the names that a wrong address may have meant: points of its line, or lines."""
        line = next((part for part in re.split(r" x | @ ", text) if part in self.lines), None)
        if line is None or line == text:
            yield from self.lines
            yield from self.state.groups.name.data
            return
        numbers = set(self.lines[line])
        table = self.state.rows
        for row in self.state.live("rows").tolist():
            for side, curve in enumerate(table.curve[row].tolist()):
                if curve >= 0 and self.state.line_of(curve) in numbers:
                    yield self.address(row, side)

    def _pieces(self, line: int) -> list[int]:
        alive = self.state.curves.alive.data
        return [curve for curve in self.state.lines.curves[line] if alive[curve]]

    def _own_rows(self, line: int, sort: Sort) -> list[int]:
        """Give the placed or adopted points of a line, in order along it."""
        table, own = self.state.rows, self.state.curves.rows
        found = list[int]()
        for curve in self._pieces(line):
            rows = own[curve]
            found += rows[(table.sort.data[rows] == int(sort)) & table.alive.data[rows]].tolist()
        return found

    def usual_side(self, row: int) -> int:
        """Give the side from which a point is named: the line of higher rank first."""
        return int(self.state.rows.curve[row, 1] >= 0)

    def _line_place(self, line: int) -> ResolvedAddress:
        return ResolvedAddress(int(self.state.lines.group[line]), line)

    def _curve_place(self, curve: int) -> ResolvedAddress:
        line = self.state.line_of(curve)
        return attrs.evolve(self._line_place(line), curve=curve)

    def _row_place(self, row: int, side: int) -> ResolvedAddress:
        curve = int(self.state.rows.curve[row, side])
        return attrs.evolve(self._curve_place(curve), row=row, side=side)


def address(state: HullState, row: int, side: int | None = None) -> str:
    """Give the address of a point.

    Parameters
    ----------
    state : HullState
        The tables.
    row : int
        Number of the point.
    side : 0, 1 or None
        The curve named first; None for the one of higher rank.

    Returns
    -------
    str
        `resolve_address` leads back to the same point. The key, where names do not lead there.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import address, resolve_address
    >>> state = wigley()
    >>> address(state, resolve_address(state, "ST 7 x WL 2.5").row)
    'WL 2.5 x ST 7'
    """
    return AddressBook(state).address(row, side)


def resolve_address(state: HullState, text: str) -> ResolvedAddress:
    """Find what an address leads to.

    Parameters
    ----------
    state : HullState
        The tables.
    text : str
        The address, or a key.

    Returns
    -------
    ResolvedAddress

    Raises
    ------
    UnknownNameError
        Nothing has this address; near ones are named.
    BadInputError
        Two groups have a line of this name; both full names are given.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import resolve_address
    >>> resolve_address(wigley(), "waterlines/WL 2.5 x ST 7").side
    1
    """
    return AddressBook(state).resolve(text)
