"""Options that are text: what is none is refused before a file is opened, whatever it holds."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah


@pytest.mark.parametrize("name", ["unit", "axes", "origin", "deck", "station_zero", "deck_edge"])
@pytest.mark.parametrize("bad", [np.array([1.0, 2.0]), b"mm", 3], ids=["array", "bytes", "number"])
def test_a_text_option_that_is_no_text_is_refused(name: str, bad: Any, tmp_path: Path) -> None:
    """An array had ended in an error of numpy where the table was there to be read."""
    table = tmp_path / "table.csv"
    table.write_text("station,wl_0,wl_1\n0,1,2\n1,2,3\n")
    with pytest.raises(ah.errors.WrongTypeError, match=f"{name} is"):
        ah.read(table, **{name: bad})
