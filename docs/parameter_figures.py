"""Figures of the named parameters as tables: `python docs/parameter_figures.py` prints them.

`python -m benchmarks.vary_all --write docs/variation_figures.json` measures them, which takes an
hour; `docs/site_hook.py` puts them at the mark of `docs/variation_figures.md` when the site is
built.
"""

import json
from pathlib import Path

PAGE = "variation_figures.md"
MARK = "<!-- figures of the named parameters -->\n"
DATA = Path(__file__).with_name("variation_figures.json")


def tables() -> str:
    """Give each table with its title, what it adds up to, and the day of all."""
    data = json.loads(DATA.read_text("utf-8"))
    parts = [f"Measured on {data['day']}.", ""]
    for table in data["tables"]:
        head, *rows = table["rows"]
        parts += [f"## {table['title']}", ""] + ([table["note"], ""] if table["note"] else [])
        parts += [f"| {' | '.join(cells)} |" for cells in (head, ["---"] * len(head), *rows)]
        parts.append("")
    return "\n".join(parts)


if __name__ == "__main__":
    print(tables())
