"""What the parts of `io.hull_file` give, one small example of each."""

from __future__ import annotations

import sqlite3
from pathlib import Path
from tempfile import TemporaryDirectory

from assoc_hull.edit.document import Document
from assoc_hull.edit.session import Edit
from assoc_hull.edit.step import EditReport
from assoc_hull.graph.journal import Journal
from assoc_hull.io.hull_file.database import SCHEMA, create_tables
from assoc_hull.io.hull_file.saving import close_hull_file, save_hull
from assoc_hull.io.hull_file.steps import pack_change, report_from, report_text, unpack_change
from assoc_hull.io.hull_file.tables import (
    definition_of,
    definition_row,
    feature_of,
    feature_row,
    read_state,
    write_state,
)
from assoc_hull.model.change import change_of
from assoc_hull.model.definition.fingerprint import fingerprint
from assoc_hull.model.features import Feature
from assoc_hull.model.form_definition import FormDefinition
from assoc_hull.shipped.wigley import wigley


def test_a_change_to_bytes_and_back_what_an_edit() -> None:
    """A change to bytes and back: what an edit did, as a hull file keeps it."""
    document = Document(wigley())
    with Edit(document, "move") as edit:
        edit.move("WL 2.5 x ST 7", y=2.95)
    journal = document.history[-1].journal
    assert isinstance(journal, Journal)
    change = change_of(document.state, journal)
    again = unpack_change(pack_change(change))
    assert (
        sorted(again.bits) == sorted(change.bits),
        again.lofted.tolist() == change.lofted.tolist(),
    ) == (True, True)


def test_committed_steps_to_the_rows_of_a_hull_file() -> None:
    """Committed steps to the rows of a hull file, and back."""
    assert report_from(report_text(EditReport("fair", relofted=("WL 1",)))).relofted == ("WL 1",)


def test_the_tables_of_a_hull_file_and_how_files() -> None:
    """The tables of a hull file, and how files of older versions are brought to this one."""
    database = sqlite3.connect(":memory:", isolation_level=None)
    create_tables(database)
    assert database.execute("PRAGMA user_version").fetchone() == (SCHEMA,)


def test_the_features_of_a_hull_to_the_rows() -> None:
    """The features of a hull to the rows of a hull file, and back."""
    run = Feature(key="ST 1 straight", kind="straight", name="run", lines=("ST 1",), points=(3, 4))
    assert feature_of(feature_row(0, True, run)) == run


def test_the_definitions_of_a_hull_and_its_generated_curves() -> None:
    """The definitions of a hull and its generated curves to the rows of a hull file, and back."""
    angle = FormDefinition("flare", "waterline_angle", "course", {"AP_y": 3.0}, nodes=("AP",))
    assert definition_of(definition_row(0, True, angle)) == angle


def test_the_tables_of_a_hull_to_the_rows() -> None:
    """The tables of a hull to the rows of a hull file, and back; nothing is computed but
    splines."""
    database, state = sqlite3.connect(":memory:", isolation_level=None), wigley()
    create_tables(database)
    write_state(database, state, "demo", fingerprint(state))
    assert fingerprint(read_state(database)) == fingerprint(state)


def test_saving_and_opening_a_hull_as_a_hull_file() -> None:
    """Saving and opening a hull: as a hull file that keeps every edit, or as text."""
    with TemporaryDirectory() as folder:
        document = Document(wigley())
        written = save_hull(document, Path(folder) / "ship.hull").written
        again = save_hull(document).written
        close_hull_file(document)
    assert (written, again) == (True, False)
