"""A table whose ends are flat, or points: what is advised fits the ship, and following it works."""

from __future__ import annotations

from pathlib import Path

import pytest

from assoc_hull.errors import BadInputError
from assoc_hull.io.importing.import_hull import import_hull
from assoc_hull.io.importing.options import ImportOptions
from assoc_hull.io.offsets.read import read_offsets

LEVELS = (0.0, 1.0, 2.0, 3.0, 4.0)
BOX = "x_m," + ",".join(f"{z:g} m" for z in LEVELS) + "\n" + "".join(
    f"{x},6,6,6,6,6\n" for x in range(0, 70, 10)
)  # fmt: skip


def _suspected(text: str, **options: float) -> list[str]:
    _, report = read_offsets(text, **options)  # type: ignore[arg-type]
    return [str(each) for each in report.suspicions]


def test_a_box_given_as_a_table_is_told_that_tables_state_no_flat_ends() -> None:
    """At both ends, each with the name of the curve that it takes as lines."""
    told = "\n".join(_suspected(BOX, draught=2.5))
    assert "that end as a curve 'transom'" in told
    assert "that end as a curve 'bow end'" in told
    assert "1e+02" not in told


def test_no_ship_of_sixty_metres_is_taken_for_a_model(tmp_path: Path) -> None:
    """Her folds are no matter of scale."""
    path = tmp_path / "box.csv"
    path.write_text(BOX)
    notes = import_hull(path, ImportOptions(draught=2.5, accept=True))[1]
    assert "scale=" not in str(notes)


def test_a_unit_in_the_heads_of_columns_is_not_said_to_stand_in_comments() -> None:
    """The table has none."""
    _, report = read_offsets(BOX, draught=2.5)
    [unit] = [str(each) for each in report.assumptions if "heights m" in str(each)]
    assert "names of its columns" in unit
    assert "the comments" not in unit


def test_a_station_that_closes_an_end_as_advised_is_no_blank() -> None:
    """A keel as high as the deck and blank half-breadths are what the note asks for."""
    rows = [
        (x, 0.0, *((3.0 - abs(x - 30) / 10.0 + z / 4.0) for z in LEVELS)) for x in range(0, 61, 5)
    ]
    text = "x_m,keel," + ",".join(f"{z:g} m" for z in LEVELS) + "\n-2,4,,,,,\n"
    text += "".join(",".join(f"{each:.4f}" for each in row) + "\n" for row in rows)
    assert not [each for each in _suspected(text, draught=2.0) if "no offset" in each]
    low = text.replace("-2,4,", "-2,2,")
    assert [each for each in _suspected(low, draught=2.0) if "no offset" in each]


def test_a_chine_among_the_lines_is_answered_with_leaving_it_out(tmp_path: Path) -> None:
    """Knuckles are found; none can be named."""
    path = tmp_path / "boat.csv"
    sections = "".join(
        f"ST {x},{x},{y},{z}\n" for x in (1, 5, 9) for y, z in ((0, 0), (2, 1), (2.5, 2))
    )
    chine = "".join(f"chine,{x},{2 - x / 30},{1 + x / 20}\n" for x in (1, 5, 9))
    path.write_text("line,x,y,z\n" + sections + chine)
    with pytest.raises(BadInputError, match="leave a chine or knuckle line out"):
        import_hull(path, ImportOptions(draught=1.0))
