"""The values of Table 5 of Son and Kim as a table: `python docs/table5_values.py` prints it.

`docs/site_hook.py` puts it at the mark of `docs/table5.md`; `tests/cases/test_table5.py` computes
each row of `docs/table5.csv`.
"""

import csv
from pathlib import Path

PAGE = "table5.md"
MARK = "<!-- values of table 5 -->\n"
DATA = Path(__file__).with_name("table5.csv")


def tables() -> str:
    """Give a row for each value."""
    with DATA.open(encoding="utf-8", newline="") as file:
        head, *rows = csv.reader(file)
    rows = [[f"`{symbol}`", *rest] for symbol, *rest in rows]
    return "\n".join(f"| {' | '.join(row)} |" for row in (head, ["---"] * len(head), *rows)) + "\n"


if __name__ == "__main__":
    print(tables())
