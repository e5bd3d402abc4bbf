"""The columns of the hull file as tables: `python docs/hull_file_columns.py` prints them.

`docs/hull_file_columns.csv` says what each column holds, the program which columns there are; a
column that only one of them has is an error. `docs/site_hook.py` puts the tables at the mark of
`docs/file_format.md` when the site is built.
"""

import csv
import sqlite3
from pathlib import Path

from assoc_hull.io.hull_file.database import TABLES

PAGE = "file_format.md"
MARK = "<!-- columns of the hull file -->\n"
DATA = Path(__file__).with_name("hull_file_columns.csv")


def tables() -> str:
    """Give a table for each table of the file."""
    with DATA.open(encoding="utf-8", newline="") as file:
        meanings = {(row["table"], row["column"]): row["meaning"] for row in csv.DictReader(file)}
    columns = {(table, column): kind for table, column, kind in schema()}
    different = set(columns) ^ set(meanings)
    assert not different, f"described and not there, or there and not described: {different}"
    lines: list[str] = []
    for (table, column), kind in columns.items():
        if f"### `{table}`" not in lines:
            lines += ["", f"### `{table}`", "", "| column | type | meaning |", "|---|---|---|"]
        lines.append(f"| `{column}` | {kind} | {meanings[table, column]} |")
    return "\n".join(lines) + "\n"


def schema() -> list[tuple[str, str, str]]:
    """Give table, column and type of all columns, in the order in which they are made."""
    database = sqlite3.connect(":memory:")
    database.executescript(TABLES)
    names = database.execute("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY rowid")
    found = [
        (name, column, kind)
        for (name,) in names.fetchall()
        for _, column, kind, *_ in database.execute(f"PRAGMA table_info({name})")
    ]
    database.close()
    return found


if __name__ == "__main__":
    print(tables())
