"""The catalogue of form parameters as tables: `python docs/catalogue.py` prints it.

`docs/site_hook.py` puts it at the mark of `docs/parameters.md` when the site is built: it is always
that of the code.
"""

from collections.abc import Iterator

from assoc_hull.analysis.form.form_parameters import CATALOGUE, GIVEN, TITLES, by_table
from assoc_hull.analysis.form.parameter import SHAPE, FormParameter

PAGE = "parameters.md"
MARK = "<!-- catalogue of form parameters -->\n"


def tables() -> str:
    """Give the catalogue as Markdown, a table per part, and the sources below them."""
    sources = list(dict.fromkeys(each.source for each in CATALOGUE.values()))
    lines: list[str] = []
    for table, entries in by_table(CATALOGUE.values()).items():
        lines += ["", f"### {TITLES[table]}", ""]
        lines += ["| symbol | ITTC | name | unit | definition; datum | made of | source |"]
        lines += ["|---|---|---|---|---|---|---|"]
        lines += [row(each, sources) for each in entries]
    return "\n".join([*lines, "", *cited(sources)]) + "\n"


def row(entry: FormParameter, sources: list[str]) -> str:
    """Give the line of an entry."""
    datum = "" if entry.datum == "-" else f"; {entry.datum}"
    measured = "given" if entry.table == GIVEN else "the hull"
    needs = ", ".join(measured if need == SHAPE else f"`{need}`" for need in entry.needs)
    cells = [
        f"`{entry.symbol}`", entry.ittc or "", entry.name, entry.unit, entry.definition + datum,
        needs, f"[{sources.index(entry.source) + 1}](#sources)",
    ]  # fmt: skip
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def cited(sources: list[str]) -> Iterator[str]:
    """List the sources."""
    yield "### Sources"
    yield ""
    yield from (f"{k}. {words}" for k, words in enumerate(sources, 1))


if __name__ == "__main__":
    print(tables())
