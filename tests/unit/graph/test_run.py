"""The update engine on a spreadsheet of sums: it knows nothing of hulls."""

from __future__ import annotations

import random
from collections.abc import Iterator

import attrs
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from assoc_hull.errors import AssocHullError, TooFewPointsError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.run_update import (
    Evaluation,
    FailurePolicy,
    Readers,
    UpdatePass,
    levels,
    run_update,
)
from assoc_hull.graph.table import NumberColumn, Table, numbers

Formulas = dict[int, tuple[int, ...]]


@attrs.frozen(eq=False)
class Cells(Table):
    """What the cells hold."""

    value: NumberColumn[np.float64] = numbers(np.float64)


@attrs.define(eq=False)
class Sheet:
    """Cells that are sums of others, rounded down to whole steps; the others hold numbers.

    A cell in `broken` cannot be evaluated. `batches` lists what was evaluated together.
    """

    formulas: Formulas
    count: int
    step: float = 0.0
    broken: set[int] = attrs.field(factory=set)
    batches: list[list[int]] = attrs.field(factory=list)
    table: Cells = attrs.field(init=False)
    rank: IntArray = attrs.field(init=False)

    def __attrs_post_init__(self) -> None:
        self.table = Cells()
        self.table.resize(self.count)
        source, reader = self.edges()
        self.rank = levels(self.count, source, reader, str)
        for cell in np.argsort(self.rank, kind="stable").tolist():
            self.table.value.store[cell] = self.wanted(cell)

    def edges(self) -> tuple[list[int], list[int]]:
        """All pairs of a cell and one that reads it."""
        pairs = [(a, b) for b, cells in self.formulas.items() for a in cells]
        return [a for a, _ in pairs], [b for _, b in pairs]

    def wanted(self, cell: int) -> float:
        """What a cell should hold now."""
        value = self.table.value.data
        if cell not in self.formulas:
            return float(value[cell])
        total = sum(float(value[each]) for each in self.formulas[cell])
        return total // self.step * self.step if self.step else total

    def level(self, nodes: IntArray) -> IntArray:
        """Levels."""
        return self.rank[nodes]

    def readers(self, nodes: IntArray) -> Readers:
        """Readers."""
        source, reader = (np.array(part, np.int64) for part in self.edges())
        mine = np.isin(source, nodes)
        return Readers(reader[mine], source[mine])

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Sums."""
        self.batches.append(nodes.tolist())
        old = self.table.value.data[nodes].copy()
        new = np.array([self.wanted(cell) for cell in nodes.tolist()])
        # Written before the failure: a batch may break off half done.
        journal.put(self.table.value, nodes, new)
        if self.broken & set(nodes.tolist()):
            raise TooFewPointsError(f"cell {min(self.broken & set(nodes.tolist()))}", 0)
        changed = old != new
        return Evaluation(nodes[changed], np.abs(new - old)[changed])

    def name(self, node: int) -> str:
        """The name of a cell."""
        return f"cell {node}"

    def set(self, journal: Journal, cell: int, value: float) -> IntArray:
        """Set a number; gives the seed."""
        journal.put(self.table.value, [cell], [value])
        return np.array([cell])

    def values(self) -> list[float]:
        """All values."""
        return [float(value) for value in self.table.value.data]


@st.composite
def sheets(draw: st.DrawFn, step: float = 0.0) -> Sheet:
    """Give sheets: the first three cells hold numbers, others read cells before them."""
    count = draw(st.integers(4, 14))
    formulas: Formulas = {}
    for cell in range(3, count):
        cells = draw(st.lists(st.integers(0, cell - 1), min_size=1, max_size=3, unique=True))
        formulas[cell] = tuple(cells)
    return Sheet(formulas, count, step)


def downstream(sheet: Sheet, cells: set[int]) -> set[int]:
    """All cells made from some, at any distance."""
    found: set[int] = set()
    while True:
        more = {b for b, read in sheet.formulas.items() if set(read) & (cells | found)}
        if more <= found:
            return found
        found |= more


def changes() -> Iterator[tuple[int, float]]:
    """Some numbers to set."""
    rng = random.Random(4)
    while True:
        yield rng.randrange(3), float(rng.randrange(-3, 4))


@given(sheets())
def test_everything_that_reads_a_change_is_brought_up_to_date(sheet: Sheet) -> None:
    """Each cell at most once, after all it reads; cells that nothing reaches are left alone."""
    for (cell, value), _ in zip(changes(), range(5), strict=False):
        before, journal = sheet.values(), Journal()
        found = run_update(sheet, sheet.set(journal, cell, value), journal)
        order = found.evaluated.tolist()
        assert len(order) == len(set(order))
        assert (np.diff(sheet.rank[order]) >= 0).all()
        assert set(order) <= downstream(sheet, {cell})
        assert [sheet.wanted(each) for each in range(sheet.count)] == sheet.values()
        changed = {i for i, (a, b) in enumerate(zip(before, sheet.values(), strict=True)) if a != b}
        assert changed == set(found.changed.tolist()) - ({cell} if before[cell] == value else set())
        journal.back()
        assert sheet.values() == before
        journal.forth()


@given(sheets(step=2.0))
def test_a_value_that_comes_out_as_it_was_stops_there(sheet: Sheet) -> None:
    """Early cut-off: a cell is evaluated exactly if something it reads changed."""
    journal = Journal()
    before = sheet.values()
    found = run_update(sheet, sheet.set(journal, 0, 1.0), journal)
    moved = {i for i, (a, b) in enumerate(zip(before, sheet.values(), strict=True)) if a != b}
    wanted = {cell for cell, read in sheet.formulas.items() if set(read) & moved}
    assert set(found.evaluated.tolist()) == wanted
    assert set(found.cut_off.tolist()) == wanted - moved
    assert not set(found.cut_off.tolist()) & set(found.changed.tolist())


@given(sheets())
def test_every_evaluation_has_its_causes(sheet: Sheet) -> None:
    """Pushes are pairs of a cell that changed and one that reads it, and all of them."""
    journal = Journal()
    found = run_update(sheet, sheet.set(journal, 1, 5.0), journal)
    pairs = set(zip(found.cause.source.tolist(), found.cause.reader.tolist(), strict=True))
    changed = set(found.changed.tolist())
    assert pairs == {(a, b) for b, read in sheet.formulas.items() for a in read if a in changed}
    assert {reader for _, reader in pairs} == set(found.evaluated.tolist())
    moved = dict(zip(found.changed.tolist(), found.moved.tolist(), strict=True))
    assert np.isnan(moved.pop(1))
    assert all(amount > 0.0 for amount in moved.values())


def chain_of(count: int) -> Sheet:
    """Each cell reads the one before."""
    return Sheet({cell: (cell - 1,) for cell in range(1, count)}, count)


def test_a_failure_is_let_out_and_the_journal_takes_all_back() -> None:
    """All or nothing."""
    sheet, journal = chain_of(6), Journal()
    sheet.broken = {4}
    with pytest.raises(AssocHullError, match="cell 4"):
        run_update(sheet, sheet.set(journal, 0, 3.0), journal)
    assert sheet.values()[3] == 3.0
    journal.undo()
    assert sheet.values() == [0.0] * 6


@given(sheets(), st.sets(st.integers(3, 13), min_size=1, max_size=4))
def test_going_on_blocks_readers_only(sheet: Sheet, broken: set[int]) -> None:
    """Failed cells and all made from them keep their values; everything else is up to date."""
    before, journal = sheet.values(), Journal()
    sheet.broken = {cell for cell in broken if cell < sheet.count}
    found = run_update(sheet, sheet.set(journal, 0, 1.0), journal, FailurePolicy.KEEP_GOING)
    failed = set(found.failed)
    assert failed <= sheet.broken
    assert set(found.blocked.tolist()) == downstream(sheet, failed)
    kept = failed | set(found.blocked.tolist())
    for cell in range(sheet.count):
        assert sheet.values()[cell] == (before[cell] if cell in kept else sheet.wanted(cell))
    assert all(f"cell {cell}" in text for cell, text in found.failed.items())
    assert not failed & set(found.cut_off.tolist())
    journal.undo()
    assert sheet.values() == before


def fan(width: int) -> Sheet:
    """Many cells that read one, and each of these has a reader."""
    first: dict[int, tuple[int, ...]] = {cell: (0,) for cell in range(1, width + 1)}
    return Sheet(first | {width + cell: (cell,) for cell in first}, 2 * width + 1)


def test_a_failing_batch_is_halved_until_the_guilty_are_alone() -> None:
    """All others of the batch are evaluated; few batches are tried."""
    sheet, journal = fan(16), Journal()
    sheet.broken = {3, 12}
    found = run_update(sheet, sheet.set(journal, 0, 2.0), journal, FailurePolicy.KEEP_GOING)
    assert set(found.failed) == {3, 12}
    assert set(found.blocked.tolist()) == {19, 28}
    kept = {3, 12, 19, 28}
    assert sheet.values() == [0.0 if cell in kept else 2.0 for cell in range(33)]
    tried = [batch for batch in sheet.batches if 3 in batch]
    assert [len(batch) for batch in tried] == [16, 8, 4, 2, 1]
    assert len(sheet.batches) <= 20


def test_arithmetic_errors_count_as_failures_and_defects_do_not() -> None:
    """A defect is let out under both policies."""
    sheet = chain_of(3)
    for error, goes_on in ((ZeroDivisionError("zero"), True), (RuntimeError("defect"), False)):
        journal = Journal()
        seed = sheet.set(journal, 0, 1.0)
        bad = Failing(sheet, error)
        if goes_on:
            assert run_update(bad, seed, journal, FailurePolicy.KEEP_GOING).failed == {1: "zero"}
        else:
            with pytest.raises(RuntimeError, match="defect"):
                run_update(bad, seed, journal, FailurePolicy.KEEP_GOING)
        journal.undo()


@attrs.frozen(eq=False)
class Failing:
    """A sheet of which nothing can be evaluated."""

    sheet: Sheet
    error: Exception

    def level(self, nodes: IntArray) -> IntArray:
        """Levels."""
        return self.sheet.level(nodes)

    def readers(self, nodes: IntArray) -> Readers:
        """Readers."""
        return self.sheet.readers(nodes)

    def evaluate(self, nodes: IntArray, journal: Journal) -> Evaluation:
        """Nothing."""
        raise self.error

    def name(self, node: int) -> str:
        """The name of a cell."""
        return self.sheet.name(node)


def outcome(found: UpdatePass) -> tuple[list[int], list[int], list[int]]:
    """What was evaluated, what changed, what was cut off."""
    return found.evaluated.tolist(), found.changed.tolist(), found.cut_off.tolist()


def test_nodes_whose_recipe_changed_are_evaluated_without_a_cause() -> None:
    """And pass on what they become."""
    sheet, journal = chain_of(4), Journal()
    sheet.table.value.store[:4] = [5.0, 0.0, 0.0, 0.0]
    nothing = np.zeros(0, np.int64)
    found = run_update(sheet, nothing, journal, also=np.array([1, 1]))
    assert outcome(found) == ([1, 2, 3], [1, 2, 3], [])
    assert found.cause.reader.tolist() == [2, 3]


def test_held_nodes_are_left_alone_whatever_they_read() -> None:
    """And what reads them through them."""
    sheet, journal = chain_of(4), Journal()
    found = run_update(sheet, sheet.set(journal, 0, 7.0), journal, held=np.array([2]))
    assert outcome(found) == ([1], [0, 1], [])
    assert sheet.values() == [7.0, 7.0, 0.0, 0.0]


def test_nothing_to_do_is_done() -> None:
    """No seeds, or seeds that nothing reads."""
    sheet, journal = chain_of(3), Journal()
    nothing = np.zeros(0, np.int64)
    assert outcome(run_update(sheet, nothing, journal)) == ([], [], [])
    assert outcome(run_update(sheet, np.array([2]), journal)) == ([], [2], [])


@given(sheets(), st.randoms(use_true_random=False))
def test_the_order_of_the_seeds_says_nothing(sheet: Sheet, rng: random.Random) -> None:
    """Same cells evaluated, in the same order."""
    found = []
    for _ in range(2):
        journal = Journal()
        for cell in range(3):
            sheet.set(journal, cell, 1.0 + cell)
        seeds = [0, 1, 2]
        rng.shuffle(seeds)
        found.append(run_update(sheet, np.array(seeds), journal).evaluated.tolist())
        journal.undo()
    assert found[0] == found[1]
