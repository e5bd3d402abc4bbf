"""Studies of a hull: the call that makes one, and what it gives back.

`Study` is generic in the class of the hulls that it makes, as it stands below it; users meet it
with `assoc_hull.Hull` only.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from itertools import compress
from os import PathLike
from pathlib import Path
from typing import Any, Generic, TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import file_path, integer, shown
from assoc_hull.display import ShownAsText, html_room, html_table, html_text
from assoc_hull.edit.document import Document, HasDocument
from assoc_hull.edit.recording import VariedValues
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.geometry.numeric.blas_threads import one_thread
from assoc_hull.io.tables.study import (
    study_array,
    study_csv,
    study_frame,
    study_json,
    write_parquet,
)
from assoc_hull.io.tables.study_file import StudyFile
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.tables import copy_state, state_of
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.pareto import pareto_front
from assoc_hull.study.run import StudyRow, StudyRun
from assoc_hull.study.run_study import run_study
from assoc_hull.variation.earlier_values import varied_values

__all__ = ["Study", "make_study"]

HullType = TypeVar("HullType")

_WORKERS = 256

_SHOWN = 20
"""Rows that a notebook shows."""


@attrs.frozen(eq=False, repr=False)
class Study(ShownAsText, Generic[HullType]):
    """Variants of a hull.

    Attributes
    ----------
    run : StudyRun
        What was asked for, and the parent.
    file : StudyFile
        What became of each variant; fewer than were asked for after an interrupt.
    interrupted : bool
        Whether it was interrupted.
    before : VariedValues
        What variations had given the parent.
    make : callable
        Makes a hull of a document.
    """

    run: StudyRun = attrs.field(repr=False)
    file: StudyFile = attrs.field(repr=False)
    interrupted: bool
    before: VariedValues = attrs.field(repr=False)
    make: Callable[[Document], HullType] = attrs.field(repr=False)

    @property
    def design(self) -> StudyDesign:
        """What was asked for."""
        return self.run.design

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns of the table that have one."""
        return self.run.units

    @cached_property
    def rows(self) -> tuple[StudyRow, ...]:
        """What became of each variant, in their order; `table` is smaller where they are many."""
        return self.file.rows()

    def __len__(self) -> int:
        return len(self.file)

    @cached_property
    def failed(self) -> tuple[StudyRow, ...]:
        """Rows of variants of which there is no hull, each with its reason."""
        return self.file.rows(failed=True)

    def table(self) -> dict[str, NDArray[Any]]:
        """Give all rows as arrays (n,) by name.

        Returns
        -------
        dict of str to (n,)
            ``number``; the parameters by name (m, degrees, factors); ``asked NAME`` of each
            target; the outputs by name; ``margin``, ``shift`` (m), ``residual``, ``trials``;
            ``failure`` and ``reason``. Numbers that a variant does not have are nan.
        """
        return self.file.columns()

    def to_array(self) -> NDArray[np.void]:
        """Give the table as a structured array, (n,), with a field for each column."""
        return study_array(self.table())

    def to_frame(self) -> Any:
        """Give the table as a frame of pandas, by the number of the variant.

        Raises
        ------
        MissingExtraError
            Pandas is not installed.
        """
        return study_frame(self.table())

    def front(
        self, better: Mapping[str, str], within: Mapping[str, object] | None = None
    ) -> IntArray:
        """Give the variants of which none is better in every respect.

        Parameters
        ----------
        better : mapping of str to {"less", "more"}
            Which direction is better, by the names of the columns that count.
        within : mapping of str to (float or None, float or None)
            Least and greatest value by column; variants outside, and those without a hull, are
            left out. None leaves an end open.

        Returns
        -------
        (f,) int
            Their numbers, rising; `hull` takes them.

        Raises
        ------
        UnknownNameError, BadInputError, WrongTypeError
            No such column, no such direction, or limits that are none.

        Examples
        --------
        >>> import assoc_hull as ah
        >>> parent = ah.examples.wigley(stations=9, waterlines=6)
        >>> found = parent.study(set={"breadth": [9.0, 10.0, 11.0]})
        >>> found.front({"kmt": "more", "wetted_surface": "less"}).tolist()
        [0, 1, 2]
        """
        table = self.table()
        chosen: IntArray = table["number"][pareto_front(table, better, within)]
        return chosen

    def hull(self, number: int) -> HullType:
        """Give a variant as a hull: the parent, and one step that can be undone.

        Its hydrostatics are those of the row.

        Parameters
        ----------
        number : int
            Which variant; the first is 0.

        Raises
        ------
        BadInputError
            There is no such variant, or no hull of it.
        """
        wanted = integer(number, "number", "in Study.hull", least=0, most=self.design.count - 1)
        row = self.file.row(wanted)
        if row is None or row.failure:
            why = "was not made" if row is None else f"has no hull: {row.reason}"
            raise BadInputError(f"variant {wanted} {why}", "in Study.hull", "take another one")
        with one_thread():
            document = self.run.ground.document(row.values, f"variant {wanted}")
        document.varied_before, step = self.before, document.history[-1]
        varied = self.run.varied(row)
        step.script = attrs.evolve(step.script, varied=varied, before=self.before)
        return self.make(document)

    def to_csv(self, path: str | PathLike[str] | None = None) -> str:
        """Give the table as comma-separated text, and write it to a file if one is named."""
        return _put(study_csv(self.run, self.table()), path)

    def to_json(self, path: str | PathLike[str] | None = None) -> str:
        """Give the table as JSON, with all digits, and write it to a file if one is named."""
        return _put(study_json(self.run, self.table()), path)

    def to_parquet(self, path: str | PathLike[str]) -> None:
        """Write the table as a Parquet file; units stand in its metadata.

        Raises
        ------
        MissingExtraError
            PyArrow is not installed.
        BadInputError
            The file cannot be written.
        """
        write_parquet(self.run, self.table(), file_path(path, "in study"))

    def _repr_html_(self) -> str:
        table = self.table()
        columns = [values[:_SHOWN].tolist() for values in table.values()]
        kept = [any(each not in ("", None) and each == each for each in one) for one in columns]
        names = list(compress(table, kept))
        units = self.units
        head = [f"{name}, {units[name]}" if name in units else name for name in names]
        cells = [[_cell(each) for each in column] for column in compress(columns, kept)]
        rows = html_table(head, zip(*cells, strict=True), right=range(len(head)))
        left = len(self) - _SHOWN
        more = [html_text(f"{left} more rows in table()")] if left > 0 else []
        return html_room(html_text(str(self)), rows, *more)

    def __str__(self) -> str:
        counts = self.file.failures()
        words = [f"{counts.pop('', 0)} of {self.design.count} variants"]
        words += [f"{count} {kind}" for kind, count in sorted(counts.items())]
        return ", ".join(words) + (", interrupted" if self.interrupted else "")


def _cell(value: object) -> str:
    """Write a value of the table; nothing where there is none."""
    if isinstance(value, float):
        return "" if value != value else f"{value:.7g}"
    return str(value)


def _put(text: str, path: str | PathLike[str] | None) -> str:
    if path is not None:
        write_whole(file_path(path, "in study"), text.encode())
    return text


def make_study(
    hull: HasDocument,
    design: StudyDesign,
    make: Callable[[Document], HullType],
    *,
    file: str | PathLike[str] | None,
    workers: int | None,
    cluster: object,
    progress: Callable[[str, int, int], None] | None,
) -> Study[HullType]:
    """Run a study of variants of a hull; `make` makes a hull of the document of a variant."""
    where = "in study"
    state_of(hull, where)
    hull.document.require_ended("study")
    count = None if workers is None else integer(workers, "workers", where, least=1, most=_WORKERS)
    if progress is not None and (isinstance(progress, type) or not callable(progress)):
        raise WrongTypeError(f"progress is {shown(progress)}", where, "give a function")
    path = None if file is None else Path(file_path(file, where))
    with one_thread():
        run = StudyRun.of(copy_state(hull.state), design)
    with StudyFile.opened(run, path) as table:
        interrupted = run_study(run, table, workers=count, cluster=cluster, tell=progress)
    return Study(run, table, interrupted, varied_values(hull.document), make)
