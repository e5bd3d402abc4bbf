"""Write the catalogue of form parameters into its page: `python docs/catalogue.py`.

The tables stand at the end of `docs/parameters.md`, below a mark; what stands above is written by
hand. `tests/unit/test_docs.py` compares.
"""

from collections.abc import Iterator
from pathlib import Path

from assoc_hull.analysis.form.catalogue import CATALOGUE, GIVEN, TITLES, by_table
from assoc_hull.analysis.form.parameter import SHAPE, FormParameter

PAGE = Path(__file__).resolve().parent / "parameters.md"
MARK = "<!-- Made by `python docs/catalogue.py`; what stands below is not edited by hand. -->\n"


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


def refreshed(page: str) -> str:
    """Give the page with the tables as they are now."""
    above, mark, _ = page.partition(MARK)
    assert mark, "the page has lost the mark below which the tables stand"
    return above + mark + tables()


if __name__ == "__main__":
    old = PAGE.read_text("utf-8")
    new = refreshed(old)
    PAGE.write_text(new, "utf-8")
    print(f"docs/{PAGE.name}: {'changed' if new != old else 'as it was'}")
