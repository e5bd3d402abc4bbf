"""The documentation: its code runs and prints what it shows, its links lead somewhere."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

import assoc_hull as ah
from assoc_hull.edit.session import Edit

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", ROOT / "CONTRIBUTING.md"]
PAGES += sorted((ROOT / "docs").glob("*.md"))
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"```.*?```", re.DOTALL)
LARGEST_IMAGE = 150_000


def _script(name: str) -> ModuleType:
    """A program of `docs`; the folder is no package."""
    spec = importlib.util.spec_from_file_location(name, ROOT / "docs" / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


BLOCKS = _script("blocks")


METHODS = {
    f"{each.__module__}.{each.__qualname__}.{name}"
    for each in (ah.Hull, Edit)
    for name in vars(each)
}
FACES = (
    ah.hydro, ah.form, ah.variation, ah.creation, ah.surface, ah.study, ah.classical, ah.plot
)  # fmt: skip
REFERENCE = {
    "api.md": METHODS,
    "api_names.md": {f"{face.__name__}.{name}" for face in FACES for name in face.__all__},
}
"""Anchors of the generated reference: the site makes one for each name."""


def _name(page: Path) -> str:
    return page.relative_to(ROOT).as_posix()


def _headings(page: Path) -> set[str]:
    """The anchors of a page, as the usual renderers of Markdown make them."""
    lines = FENCE.sub("", page.read_text("utf-8")).splitlines()
    titles = [line.lstrip("#").strip() for line in lines if re.match(r"#+ ", line)]
    named = {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}
    return named | REFERENCE.get(page.name, set())


@pytest.mark.usefixtures("made_already")
@pytest.mark.parametrize("page", BLOCKS.pages(), ids=_name)
def test_code_runs_and_prints_what_the_page_shows(page: Path, tmp_path: Path) -> None:
    """Each block runs after those before it; `python docs/blocks.py` renews what is shown."""
    for block, printed in BLOCKS.run(page, tmp_path):
        if block["shown"] is not None:
            assert printed == block["shown"], "if the page is out of date: python docs/blocks.py"


@pytest.mark.usefixtures("made_already")
@pytest.mark.parametrize(
    ("name", "entry"),
    [
        ("parameters.md", "| `Cb` |"),
        ("named_parameters.md", "| `entrance_deg` |"),
        ("hydrostatic_values.md", "| `kmt` | KM_T | m |"),
        ("cli.md", "usage: assoc-hull jumboise"),
        ("variation_figures.md", "| bilge_radius | 3 |"),
        ("features_of_lines.md", "| `ArcRule` |"),
        ("table5.md", "| `KMT` |"),
        ("file_format.md", "| `gap_limit` |"),
    ],
    ids=[
        "form parameters",
        "named parameters",
        "hydrostatic values",
        "commands",
        "figures of the parameters",
        "thresholds",
        "table 5",
        "columns of the hull file",
    ],
)
def test_tables_that_are_made_from_the_code_stand_on_the_site(name: str, entry: str) -> None:
    """The site puts them at a mark of the page."""
    hook = _script("site_hook")
    page = (ROOT / "docs" / name).read_text("utf-8")
    assert entry not in page
    assert entry in hook.with_tables(page, name)
    assert hook.with_tables("# Another\n", "index.md") == "# Another\n"


@pytest.mark.parametrize("page", PAGES, ids=_name)
def test_links_lead_somewhere(page: Path) -> None:
    """A link within the repository leads to a file, and its anchor to a heading there."""
    broken = []
    for target in LINK.findall(FENCE.sub("", page.read_text("utf-8"))):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = page if not path else (page.parent / path).resolve()
        if not file.exists() or (anchor and anchor not in _headings(file)):
            broken.append(target)
    assert broken == []


def test_every_picture_is_shown_and_small() -> None:
    """No picture lies about that no page shows, and none weighs more than 150 kB."""
    shown = {
        (page.parent / target).resolve()
        for page in PAGES
        for target in LINK.findall(page.read_text("utf-8"))
    }
    pictures = sorted((ROOT / "docs" / "images").iterdir())
    assert [path.name for path in pictures if path.resolve() not in shown] == []
    assert [path.name for path in pictures if path.stat().st_size > LARGEST_IMAGE] == []


def test_the_authors_of_the_ship_hull_representations_are_named_right() -> None:
    """Where initials stand they are those of K.W. Kim and S. Chang."""
    files = [*PAGES, *sorted((ROOT / "assoc_hull").rglob("*.py")), *ROOT.glob("tests/**/*.py")]
    paper = re.compile(r"((?:[A-Z]\.\s?)*)Kim\s+(?:&|and)\s+((?:[A-Z]\.\s?)*)Chang\b")
    named = {
        (first.strip(), second.strip())
        for file in files
        for first, second in paper.findall(" ".join(file.read_text("utf-8").split()))
    }
    assert named == {("", ""), ("K.W.", "S.")}
