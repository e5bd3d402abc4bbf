"""Tables spoilt by chance are refused, read right, or suspected at the place of the damage."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError
from assoc_hull.io.offsets.read import read_offsets
from tests import damaged_imports
from tests.damaged_tables import (
    DAMAGES,
    PlainTable,
    exported_table,
    harmless,
    series60_table,
    sysser_table,
    volume,
    wigley_table,
)
from tests.long_forms import LONG, long_form

MOST_OFF = 0.005


def outcome(table: PlainTable, truth: float, n: int, random: np.random.Generator) -> str:
    """What becomes of one damage: refused, right or wrong; with a suspicion of its place or not."""
    damage = DAMAGES[n % len(DAMAGES)]
    text, options, places = damage(table, random)
    try:
        found, report = read_offsets(text, **table.options | options)
    except AssocHullError:
        return "refused"
    notes = [f"{note.kind} {note.where}: {note.what}" for note in report.suspicions]
    notes += [f"{note.kind} {note.where}: {note.what}" for note in report.faults]
    named = any(re.search(place, note) for place in places for note in notes)
    right = abs(volume(found) / truth - 1.0) <= MOST_OFF
    word = "named" if named else f"not named ({damage.__name__} of {table.name}, {notes[:2]})"
    return f"{'right' if right else 'wrong'}, {word}" if named or not right else "right"


def tried(tables: Sequence[PlainTable], damages: int, changes: int) -> tuple[Counter[str], int]:
    """Outcomes of damages by kind, and how many harmless changes raised anything."""
    random = np.random.default_rng(1962)
    truth = [volume(read_offsets(each.text(), **each.options)[0]) for each in tables]
    found: Counter[str] = Counter()
    for n in range(damages):
        # Steps that share no factor lead through all pairs of a table and a damage.
        k = int(random.integers(len(tables)))
        found[outcome(tables[k], truth[k], n, random)] += 1
    raised = 0
    for n in range(changes):
        k = n % len(tables)
        table, report = read_offsets(harmless(tables[k], random), **tables[k].options)
        raised += bool(report.suspicions or report.faults)
        assert volume(table) == pytest.approx(truth[k], rel=1e-9)
    return found, raised


def check(tables: Sequence[PlainTable], damages: int, changes: int) -> None:
    """None is wrong without a suspicion of the place; nothing harmless raises one."""
    for each in tables:
        report = read_offsets(each.text(), **each.options)[1]
        assert report.suspicions == report.faults == (), each.name
    found, raised = tried(tables, damages, changes)
    print(f"{damages} damages: {dict(sorted(found.items()))}; {raised} of {changes} false")
    assert not [word for word in found if word.startswith("wrong, not named")]
    assert found["wrong, named"] + found["right, named"] + found["refused"] > damages // 2
    assert raised == 0


def test_damages_of_shipped_tables_are_seen_where_they_are() -> None:
    """Some of each kind, on Series 60 and on the Wigley hull; volumes from the table itself."""
    check([wigley_table(), series60_table("060"), series60_table("070")], 54, 15)


@long_form
def test_damages_of_all_tables_are_seen_where_they_are(data_folder: Path, tmp_path: Path) -> None:
    """Three hundred damages of seven tables; volumes from the table itself."""
    tables = [wigley_table(), series60_table("060"), series60_table("070")]
    tables.append(sysser_table(data_folder))
    for ship in ("bulk_carrier_207k", "container_ship_225m", "wigley"):
        folder = tmp_path / ship
        folder.mkdir()
        tables.append(exported_table(getattr(ah.examples, ship)(), folder))
    check(tables, 360, 105)


def test_a_slip_of_the_decimal_point_is_a_fault_of_the_hull(tmp_path: Path) -> None:
    """15.2 typed for 1.52 makes no ship 30 m broad: import refuses it, with station and column."""
    rows = [0.0, 0.5, 1.0, 1.4, 1.52, 1.6, 1.55, 1.5, 1.1, 0.6, 0.0]
    lines = ["# 0 = AP; Lpp = 10 m", "station,0,0.3,0.6,0.9"]
    for k, y in enumerate(rows):
        third = "15.2" if y == 1.52 else f"{y:.2f}"
        lines.append(f"{k},{0.2 * y:.3f},{0.8 * y:.3f},{third},{1.02 * y:.3f}")
    path = tmp_path / "boat.csv"
    path.write_text("\n".join(lines))
    table, report = read_offsets(path)
    assert table.breadth == pytest.approx(3.264)
    assert [note.kind for note in report.faults] == ["outlier"]
    with pytest.raises(ah.AssocHullError, match=r"station 4\), column '0\.6'.*15\.2 m"):
        ah.read(path)


def test_damages_are_seen_by_who_reads_a_hull() -> None:
    """Each kind of damage once, through `ah.read`: none wrong and quiet; nothing needless."""
    tables = damaged_imports.shipped_tables()[:: 3 if LONG else 4]
    rates = damaged_imports.run(tables, len(DAMAGES), 3, seed=27)
    print("\n".join(rates.lines()))
    assert rates.wrong == rates.needless == []
    assert rates.damaged.total() == len(DAMAGES)
    assert rates.unharmed["clean"] == 3 + len(tables)


@long_form
def test_two_hundred_damages_are_seen_by_who_reads_a_hull(
    data_folder: Path, tmp_path: Path
) -> None:
    """Seven tables, 200 damages, 100 harmless changes, through `ah.read`; the rates are printed."""
    tables = damaged_imports.all_tables(data_folder, tmp_path)
    rates = damaged_imports.run(tables, 200, 100, damaged_imports.SEED)
    print("\n".join(rates.lines()))
    assert rates.wrong == rates.needless == []
    seen = sum(n for word, n in rates.damaged.items() if word != "right, quiet")
    assert seen > 140
    assert rates.unharmed["clean"] == 100 + len(tables)
