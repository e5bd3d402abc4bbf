"""The rows of a study: one variant each, here or in processes side by side."""

from __future__ import annotations

import pickle
import signal
import tempfile
from collections.abc import Callable, Generator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from multiprocessing import get_context, parent_process
from pathlib import Path

import attrs
import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.copy import copy_of
from assoc_hull.model.state import HullState
from assoc_hull.study.design import Design
from assoc_hull.study.failure import kind_of
from assoc_hull.study.model import Model
from assoc_hull.study.prepared_parent import Ground
from assoc_hull.study.search import searched

__all__ = ["Row", "Run", "Tell", "row_of", "run_study"]

Tell = Callable[[str, int, int], None]
"""Takes what is being done, how many variants are done, and of how many."""

_AHEAD = 4
"""So many variants a process are handed out before their turn: enough to keep it at work."""


@attrs.frozen(eq=False)
class Row:
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
        The largest part of a target that is lacking; nan without a hull.
    trials : int
        Hulls that were made for it; 0 without one.
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

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.outputs)


@attrs.frozen(eq=False)
class Run:
    """A hull and a design, ready to make any row.

    Attributes
    ----------
    design : Design
    ground : Ground
    model : Model or None
        Of the outputs that are aimed at, if there are any.
    """

    design: Design
    ground: Ground
    model: Model | None

    @classmethod
    def of(cls, state: HullState, design: Design) -> Run:
        """Prepare a hull.

        Raises
        ------
        AssocHullError
            It has not what the design changes, or cannot be changed so at all.
        """
        ground = Ground.of(state, design)
        return cls(design, ground, Model.of(ground) if design.aims else None)

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns of the table that have one."""
        ground = self.ground
        told = dict(zip(ground.outputs.names, ground.outputs.units, strict=True))
        asked = {f"asked {name}": told[name] for name in ground.aims.names}
        return {each.name: each.unit for each in ground.maps.free} | told | asked | {"shift": "m"}


def row_of(run: Run, number: int) -> Row:
    """Make one variant, and tell what became of it."""
    design = run.design
    try:
        found = searched(run.ground, run.model, design, number)
    except AssocHullError as error:
        values = np.full(len(design.names), np.nan)
        values[: len(design.given)] = design.values[number]
        return Row(
            number, values, np.full(len(design.outputs), np.nan), np.nan, np.nan, np.nan, 0,
            kind_of(error), " ".join(str(error).split()),
        )  # fmt: skip
    return Row(
        number, found.values, found.outputs,
        found.variant.certificate.least, found.variant.shift, found.residual, found.trials,
    )  # fmt: skip


def run_study(
    run: Run, numbers: Sequence[int], *, workers: int = 1, tell: Tell | None = None
) -> tuple[tuple[Row, ...], bool]:
    """Make variants, in their order.

    Parameters
    ----------
    run : Run
        The hull and the design.
    numbers : sequence of int
        Which variants.
    workers : int
        Processes; with one, all is done in this one. The rows are the same to the last bit.
    tell : callable or None
        Is told how many are done.

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
    rows = dict[int, Row]()
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


def _one_by_one(run: Run, numbers: Sequence[int]) -> Generator[Row]:
    for number in numbers:
        yield row_of(run, number)


def _side_by_side(run: Run, numbers: Sequence[int], workers: int) -> Generator[Row]:
    """Hand variants out to processes, a few at a time, so that no more are held than are worked on.

    Each process prepares the hull for itself, of the same tables: so it has the same bits.
    """
    if parent_process() is not None:
        raise _unguarded()
    given = pickle.dumps((copy_of(run.ground.maps.state), run.design, run.model))
    # in a file: a process that ends before it has read a long message would block this one
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "study.pickle"
        file.write_bytes(given)
        yield from _handed_out(numbers, workers, str(file))


def _handed_out(numbers: Sequence[int], workers: int, file: str) -> Generator[Row]:
    pool = ProcessPoolExecutor(workers, get_context("spawn"), _begin, (file,))
    waiting, running = iter(numbers), set[Future[Row]]()
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
    return BadInputError(
        "a process of the study began another study, or came to an end", "in study",
        "begin the program under if __name__ == '__main__':, or give workers=1",
    )  # fmt: skip


_own: Run | None = None
"""What a process of a study works on."""


def _begin(file: str) -> None:
    """Prepare a process; an interrupt is for the one that began it."""
    global _own
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    state, design, model = pickle.loads(Path(file).read_bytes())
    _own = Run(design, Ground.of(state, design), model)


def _row(number: int) -> Row:
    assert _own is not None
    return row_of(_own, number)
