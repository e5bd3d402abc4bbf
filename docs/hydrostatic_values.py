"""The values of the hydrostatic record as a table: `python docs/hydrostatic_values.py` prints it.

`docs/site_hook.py` puts it at the mark of `docs/hydrostatic_values.md` when the site is built.
"""

from __future__ import annotations

from assoc_hull.analysis.hydrostatics.record import FIELDS

PAGE = "hydrostatic_values.md"
MARK = "<!-- hydrostatic values -->\n"


def tables() -> str:
    """Give name, symbol, unit, meaning and formula of each value, as Markdown."""
    rows = ["", "| field | symbol | unit | what it is | formula |", "|---|---|---|---|---|"]
    rows += [
        f"| `{each.name}` | {each.symbol} | {each.unit} | {each.title} | {each.formula} |"
        for each in FIELDS.values()
    ]
    return "\n".join(rows) + "\n\n"


if __name__ == "__main__":
    print(tables())
