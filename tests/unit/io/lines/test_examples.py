"""What the parts of `io.lines` give, one small example of each."""

from __future__ import annotations

import numpy as np

from assoc_hull.io.lines.mend_lines import put_in_order
from assoc_hull.io.reports import Notebook


def test_points_out_of_order_lines_that_cross_themselves_joins() -> None:
    """Points out of order, lines that cross themselves, joins and gaps: mended or named."""
    book = Notebook()
    line = np.array([[0.0, 0, 0], [2, 1, 0], [1, 0.4, 0], [3, 1.8, 0], [4, 3, 0]])
    assert put_in_order("WL 0", line, book)[:, 0].tolist() == [0.0, 1.0, 2.0, 3.0, 4.0]
    assert (
        str(book.report().repairs[0])
        == "order: WL 0: turned back at (2, 1, 0) m; 2 of 5 points put in order along the line"
    )
