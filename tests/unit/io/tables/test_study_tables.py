"""Tables of a study: one content as CSV, JSON, structured array, frame and Parquet."""

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from pyarrow import parquet

import assoc_hull as ah
from assoc_hull.io.tables.study import read_rows


@pytest.fixture(scope="module")
def found() -> ah.study.Study:
    """Two variants, and one that is refused."""
    hull = ah.examples.wigley(stations=7, waterlines=5)
    drawn = ah.study.sample({"breadth": (9.5, 10.5)}, 2, seed=1)
    return hull.study(set={"breadth": [*drawn["breadth"], -3.0]}, outputs=["volume", "cb"])


def test_an_array_a_frame_and_a_parquet_file_have_the_table(
    found: ah.study.Study, tmp_path: Path
) -> None:
    """To the last bit, with nan for numbers that are not there, and words as words."""
    path = tmp_path / "study.parquet"
    found.to_parquet(path)
    table, array, frame = found.table(), found.to_array(), found.to_frame()
    read = pd.read_parquet(path)
    assert list(array.dtype.names or ()) == list(table) == list(read)
    assert frame.index.tolist() == [0, 1, 2]
    for name, column in table.items():
        for other in (array[name], read[name].to_numpy()):
            assert [*map(str, column.tolist())] == [*map(str, other.tolist())]
            if column.dtype.kind == "f":
                assert column.tobytes() == np.ascontiguousarray(other).tobytes()
    assert frame.loc[2, "reason"] == found.rows[2].reason
    about = parquet.read_schema(path).metadata
    assert b'"volume": "m3"' in about[b"units"]


@pytest.mark.parametrize(
    ("library", "act"),
    [
        ("pandas", lambda study, path: study.to_frame()),
        ("pyarrow", lambda study, path: study.to_parquet(path)),
    ],
    ids=["pandas", "pyarrow"],
)
def test_a_library_that_is_not_there_is_named(
    found: ah.study.Study,
    library: str,
    act: Callable[[ah.study.Study, Path], object],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """With what to install."""
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ah.errors.MissingExtraError, match=rf"{library}.*assoc-hull\[frame\]"):
        act(found, tmp_path / "study.parquet")


def test_rows_are_read_from_what_a_study_writes(found: ah.study.Study, tmp_path: Path) -> None:
    """Names, units, numbers; twelve digits."""
    path = tmp_path / "rows.csv"
    lines = found.to_csv().splitlines()
    path.write_text("\n".join(",".join(line.split(",")[1:2]) for line in lines))
    rows = read_rows(path)
    assert list(rows) == ["breadth"]
    np.testing.assert_allclose(rows["breadth"], found.table()["breadth"], rtol=1e-11)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "does not name each column"),
        ("breadth,breadth\n1,2\n", "does not name each column"),
        ("breadth\nm\nten\n", "'ten' is no number.*row 3, breadth"),
        ("breadth,draught\n1\n", "row 2 has 1 cells"),
    ],
    ids=["empty", "twice", "word", "short"],
)
def test_what_are_no_rows_is_refused(text: str, words: str, tmp_path: Path) -> None:
    """With the place."""
    path = tmp_path / "rows.csv"
    path.write_text(text)
    with pytest.raises(ah.errors.BadInputError, match=words):
        read_rows(path)
