"""Studies: many variants of one hull, as rows of a table and as hulls.

Examples
--------
>>> import assoc_hull as ah
>>> parent = ah.examples.wigley()
>>> found = ah.study(parent, set={"breadth": [9.8, 10.2]}, outputs=["volume", "cb"])
>>> found.table()["volume"].round(2).tolist()
[2721.9, 2833.0]
>>> found.hull(1).half_breadth(50.0, 6.25)
5.1
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any

import attrs
from numpy.typing import NDArray

from assoc_hull.arguments import file_path, integer, shown
from assoc_hull.errors import BadInputError, WrongTypeError
from assoc_hull.hull import Hull
from assoc_hull.io.tables.study import study_csv, study_json
from assoc_hull.io.write_file import write_whole
from assoc_hull.model.tables import copy_state, state_of
from assoc_hull.study.design import OUTPUTS, StudyDesign
from assoc_hull.study.run import StudyRow, StudyRun, run_study, study_columns
from assoc_hull.variation.parameters.field_layout import Layout

__all__ = ["Study", "study"]

_WHERE = "in study"
_WORKERS = 256


@attrs.frozen(eq=False)
class Study:
    """Variants of a hull.

    Attributes
    ----------
    run : Run
        What was asked for, and the parent.
    rows : tuple of Row
        What became of each variant, in their order; fewer than were asked for after an interrupt.
    interrupted : bool
        Whether it was interrupted.
    """

    run: StudyRun = attrs.field(repr=False)
    rows: tuple[StudyRow, ...]
    interrupted: bool

    @property
    def design(self) -> StudyDesign:
        """What was asked for."""
        return self.run.design

    def __len__(self) -> int:
        return len(self.rows)

    @property
    def failed(self) -> tuple[StudyRow, ...]:
        """Rows of variants of which there is no hull, each with its reason."""
        return tuple(row for row in self.rows if row.failure)

    def table(self) -> dict[str, NDArray[Any]]:
        """Give all rows as arrays (n,) by name.

        Returns
        -------
        dict of str to (n,)
            ``number``; the parameters by name (m, degrees, factors); ``asked NAME`` of each
            target; the outputs by name; ``margin``, ``shift`` (m), ``residual``, ``trials``;
            ``failure`` and ``reason``. Numbers that a variant does not have are nan.
        """
        return study_columns(self.design, self.rows)

    def hull(self, number: int) -> Hull:
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
        row = next((each for each in self.rows if each.number == wanted), None)
        if row is None or row.failure:
            why = "was not made" if row is None else f"has no hull: {row.reason}"
            raise BadInputError(f"variant {wanted} {why}", "in Study.hull", "take another one")
        return Hull(self.run.ground.variant(row.values, f"variant {wanted}").document)

    def to_csv(self, path: str | PathLike[str] | None = None) -> str:
        """Give the table as comma-separated text, and write it to a file if one is named."""
        return _put(study_csv(self.run, self.rows), path)

    def to_json(self, path: str | PathLike[str] | None = None) -> str:
        """Give the table as JSON, with all digits, and write it to a file if one is named."""
        return _put(study_json(self.run, self.rows), path)

    def __str__(self) -> str:
        good = len(self.rows) - len(self.failed)
        words = [f"{good} of {self.design.count} variants"]
        counts = Counter(row.failure for row in self.failed)
        words += [f"{count} {kind}" for kind, count in sorted(counts.items())]
        return ", ".join(words) + (", interrupted" if self.interrupted else "")


def _put(text: str, path: str | PathLike[str] | None) -> str:
    if path is not None:
        write_whole(file_path(path, _WHERE), text.encode())
    return text


def study(
    hull: Hull,
    *,
    set: Mapping[str, object] | None = None,
    reach: Mapping[str, object] | Sequence[Mapping[str, object]] | None = None,
    free: object = (),
    bounds: Mapping[str, object] | None = None,
    layers: Sequence[object] = (),
    outputs: Sequence[str] = OUTPUTS,
    layout: Mapping[str, Any] | Layout | None = None,
    workers: int = 1,
    progress: Callable[[str, int, int], None] | None = None,
) -> Study:
    """Make many variants of a hull: certified, lofted again, checked, measured.

    All variants have the structure of the parent: its points go where the map of the variant sends
    them, none comes or goes. Where a variant needs other points there is a row with the reason;
    `vary` carries such a hull. The hull itself is not changed.

    Parameters
    ----------
    hull : Hull
        The parent.
    set : mapping of str to float or (n,)
        Values of named parameters (m, degrees), or factors on layers: one, or one per variant.
    reach : mapping of str to float or (n,), or sequence of mappings
        Targets by the names of outputs: one, or one per variant; or a mapping per variant. See
        `assoc_hull.variation.aiming.outputs.Outputs`: fields of hydrostatics, symbols of form
        parameters, areas of sections.
    free : sequence of str or layer
        Parameters whose values are sought, as in `vary`; as many as there are targets, or more:
        then the variant is one of nearly the least change.
    bounds : mapping of str to (float, float)
        Least and greatest values of free parameters.
    layers : sequence
        Raw layers, as in `vary`, which `set` and `free` may name; one that they do not name acts
        as it is.
    outputs : sequence of str
        What is told of each variant, by the same names.
    layout : mapping or Layout
        How far the fields of named parameters reach.
    workers : int
        Processes. The rows are the same to the last bit, whatever their number. A program that
        asks for more than one begins under ``if __name__ == "__main__":``, as new processes
        import it.
    progress : callable
        Is called with what is done, how many variants are, and of how many.

    Returns
    -------
    Study
        A row per variant. After an interrupt (Ctrl-C) those that were finished.

    Raises
    ------
    UnknownNameError, WrongTypeError, BadInputError
        What is asked for cannot be understood, or does not fit the hull.

    See Also
    --------
    sample : values drawn within intervals.
    vary : one variant, with the structure that it needs.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> parent = ah.examples.wigley()
    >>> asked = ah.sample({"volume": (2760.0, 2800.0)}, 2, seed=1)
    >>> found = ah.study(parent, reach=asked, free=["breadth"])
    >>> print(found)
    2 of 2 variants
    >>> bool((abs(found.table()["volume"] - asked["volume"]) < 1e-6).all())
    True
    """
    state_of(hull, _WHERE)
    hull.document.require_ended("study")
    count = integer(workers, "workers", _WHERE, least=1, most=_WORKERS)
    if progress is not None and (isinstance(progress, type) or not callable(progress)):
        raise WrongTypeError(f"progress is {shown(progress)}", _WHERE, "give a function")
    design = StudyDesign.of(
        set=set, reach=reach, free=free, bounds=bounds, layers=layers, outputs=outputs,
        layout=layout,
    )  # fmt: skip
    run = StudyRun.of(copy_state(hull.state), design)
    rows, interrupted = run_study(run, range(design.count), workers=count, tell=progress)
    return Study(run, rows, interrupted)
