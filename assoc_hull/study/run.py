"""The rows of a study: one variant each, made here or in processes side by side, and their table.

A row has the values, the outputs, and the reason where there is no hull. Rows are the same to the
last bit, whatever the number of processes: each process prepares the hull for itself, from the
same tables, and each variant begins at the parent.
"""

from __future__ import annotations

import pickle
import signal
import tempfile
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, ProcessPoolExecutor, wait
from multiprocessing import get_context, parent_process
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    FoldError,
    OutOfRangeError,
    RefusedEditError,
)
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HullState, copy_state
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.prepared_parent import StudyParent
from assoc_hull.study.target_search import NotReachedError, QuadraticModel, search_variant

__all__ = [
    "StudyRow",
    "StudyRun",
    "Tell",
    "failure_kind",
    "make_row",
    "run_study",
    "study_columns",
]


def failure_kind(error: AssocHullError) -> str:
    """Give the kind of a failure in a word or two, by which failed variants are counted.

    Examples
    --------
    >>> from assoc_hull.errors import RefusedEditError
    >>> from assoc_hull.study.run import failure_kind
    >>> failure_kind(RefusedEditError("x", ("a line folds",)))
    'refused'
    """
    words: tuple[tuple[type[AssocHullError], str], ...] = (
        (FoldError, "map folds"),
        (OutOfRangeError, "out of range"),
        (RefusedEditError, "refused"),
        (NotReachedError, "not reached"),
    )
    return next((word for kind, word in words if isinstance(error, kind)), "no hull")


Tell = Callable[[str, int, int], None]
"""Takes what is being done, how many variants are done, and of how many."""

_AHEAD = 4
"""Variants handed out ahead for each process: enough to keep it at work."""


@attrs.frozen(eq=False)
class StudyRow:
    """What became of a variant.

    Attributes
    ----------
    number : int
        Which variant; the first is 0.
    values : (p,)
        Of all parameters: m, degrees, or factors on layers; nan for free ones without a hull.
    outputs : (o,)
        Measured of the variant; nan without a hull.
    margin : float
        The least minor of its map, which is one to one where that is positive; nan without.
    shift : float, m
        The largest movement of a point; nan without a hull.
    residual : float
        The largest residual of a target, in parts of the parent's value; nan without a hull.
    trials : int
        Hulls that were made for it; 0 without one.
    anew : bool
        Whether its lines were cut anew, as in `vary`: the parent's structure would not do.
    failure, reason : str
        What went wrong, in a word and in a line; empty if nothing did.
    """

    number: int
    values: FloatArray
    outputs: FloatArray
    margin: float
    shift: float
    residual: float
    trials: int
    failure: str = ""
    reason: str = ""
    anew: bool = False

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.outputs)


@attrs.frozen(eq=False)
class StudyRun:
    """A hull and a design, ready to make any row.

    Attributes
    ----------
    design : StudyDesign
    ground : StudyParent
    model : QuadraticModel or None
        Of the outputs that are aimed at, if there are any.
    """

    design: StudyDesign
    ground: StudyParent
    model: QuadraticModel | None

    @classmethod
    def of(cls, state: HullState, design: StudyDesign) -> StudyRun:
        """Prepare a hull.

        Raises
        ------
        AssocHullError
            It has not what the design changes, or cannot be changed so at all.
        """
        ground = StudyParent.of(state, design)
        return cls(design, ground, QuadraticModel.of(ground) if design.aims else None)

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns of the table that have one."""
        ground = self.ground
        told = dict(zip(ground.outputs.names, ground.outputs.units, strict=True))
        asked = {f"asked {name}": told[name] for name in ground.aims.names}
        return {each.name: each.unit for each in ground.maps.free} | told | asked | {"shift": "m"}


def make_row(run: StudyRun, number: int) -> StudyRow:
    """Make one variant, or give the row that says why there is none."""
    design = run.design
    try:
        found = search_variant(run.ground, run.model, design, number)
    except AssocHullError as error:
        values = np.full(len(design.names), np.nan)
        values[: len(design.given)] = design.values[number]
        return StudyRow(
            number, values, np.full(len(design.outputs), np.nan), np.nan, np.nan, np.nan, 0,
            failure_kind(error), " ".join(str(error).split()),
        )  # fmt: skip
    return StudyRow(
        number, found.values, found.outputs,
        found.variant.certificate.least, found.variant.shift, found.residual, found.trials,
        anew=found.variant.anew,
    )  # fmt: skip


def run_study(
    run: StudyRun, numbers: Sequence[int], *, workers: int = 1, tell: Tell | None = None
) -> tuple[tuple[StudyRow, ...], bool]:
    """Make variants, in their order.

    Parameters
    ----------
    run : StudyRun
        The hull and the design.
    numbers : sequence of int
        Which variants.
    workers : int
        Processes; with one, all is done in this one. The rows are the same to the last bit.
    tell : callable or None
        Called with "variants", how many are done, and of how many.

    Returns
    -------
    tuple of Row
        In the order of `numbers`.
    bool
        Whether it was interrupted: then rows are missing.

    Raises
    ------
    BadInputError
        A process came to an end, as it does where a program begins a study whenever it is imported.
    """
    rows = dict[int, StudyRow]()
    made = _one_by_one(run, numbers) if workers == 1 else _side_by_side(run, numbers, workers)
    interrupted = False
    try:
        for row in made:
            rows[row.number] = row
            if tell is not None:
                tell("variants", len(rows), len(numbers))
    except KeyboardInterrupt:
        interrupted = True
        made.close()
    return tuple(rows[number] for number in numbers if number in rows), interrupted


def _one_by_one(run: StudyRun, numbers: Sequence[int]) -> Generator[StudyRow]:
    for number in numbers:
        yield make_row(run, number)


def _side_by_side(run: StudyRun, numbers: Sequence[int], workers: int) -> Generator[StudyRow]:
    """Hand variants out to processes, a few at a time: no more results wait than are worked on.

    Each process prepares the hull for itself, of the same tables: so it has the same bits.
    """
    if parent_process() is not None:
        raise _unguarded()
    given = pickle.dumps((copy_state(run.ground.maps.state), run.design, run.model))
    # in a file: a process that ends before it has read a long message would block this one
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "study.pickle"
        file.write_bytes(given)
        yield from _handed_out(numbers, workers, str(file))


def _handed_out(numbers: Sequence[int], workers: int, file: str) -> Generator[StudyRow]:
    """Yield rows as they are made, in any order."""
    pool = ProcessPoolExecutor(workers, get_context("spawn"), _begin, (file,))
    waiting, running = iter(numbers), set[Future[StudyRow]]()
    try:
        while True:
            for number in waiting:
                running.add(pool.submit(_row, number))
                if len(running) >= _AHEAD * workers:
                    break
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            for each in done:
                yield attrs.evolve(each.result())  # frozen again
    except BrokenExecutor as error:
        raise _unguarded() from error
    finally:
        pool.shutdown(cancel_futures=True)


def _unguarded() -> BadInputError:
    """Give the error for a process that ended, or began a study itself."""
    return BadInputError(
        "a process of the study began another study, or came to an end", "in study",
        "begin the program under if __name__ == '__main__':, or give workers=1",
    )  # fmt: skip


_own: StudyRun | None = None
"""What a process of a study works on."""


def _begin(file: str) -> None:
    """Prepare a process; an interrupt is left to the process that began it."""
    global _own
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    state, design, model = pickle.loads(Path(file).read_bytes())
    _own = StudyRun(design, StudyParent.of(state, design), model)


def _row(number: int) -> StudyRow:
    """Make one row in a process that `_begin` has prepared."""
    assert _own is not None
    return make_row(_own, number)


def study_columns(design: StudyDesign, rows: Sequence[StudyRow]) -> dict[str, NDArray[Any]]:
    """Give arrays (n,) by name; see `Study.table`."""
    number = np.array([row.number for row in rows], np.int64)
    values = np.array([row.values for row in rows]).reshape(len(rows), len(design.names))
    outputs = np.array([row.outputs for row in rows]).reshape(len(rows), len(design.outputs))
    found: dict[str, NDArray[Any]] = {"number": number}
    found |= dict(zip(design.names, values.T, strict=True))
    found |= {f"asked {name}": design.targets[number, i] for i, name in enumerate(design.aims)}
    found |= dict(zip(design.outputs, outputs.T, strict=True))
    for name in ("margin", "shift", "residual", "trials", "anew"):
        found[name] = np.array([getattr(row, name) for row in rows])
    for name in ("failure", "reason"):
        found[name] = np.array([getattr(row, name) for row in rows], object)
    found = {name: np.array(column) for name, column in found.items()}
    freeze(*found.values())
    return found
