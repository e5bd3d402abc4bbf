"""What `mkdocs` does beside building pages: two files of the root join, and all pages the menu.

Pages that the menu of `mkdocs.yml` does not name stand at the end of Theory, so that none is lost.
Tables that are made from the code are put at their marks.
"""

import importlib.util
import re
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
JOINED = ("CHANGELOG.md", "CONTRIBUTING.md")
TABLES = (
    "catalogue",
    "hull_file_columns",
    "hydrostatic_values",
    "named_parameters",
    "commands",
    "parameter_figures",
    "thresholds",
    "table5_values",
    "notebook_cells",
)

LATER = {
    "api.md": 0.1,
    "api_names.md": 0.1,
    "CHANGELOG.md": 0.2,
    "benchmarks.md": 0.2,
    "architecture.md": 0.3,
    "errors.md": 0.4,
    "cli.md": 0.5,
}
"""Pages that hold words of every subject: a search finds the page of a subject before them."""


def on_config(config: Any) -> Any:
    """Add the pages that no part names to Theory."""
    named = str(config["nav"])
    rest = sorted(
        page.name for page in (ROOT / "docs").glob("*.md") if f"'{page.name}'" not in named
    )
    next(part for part in config["nav"] if "Theory" in part)["Theory"] += rest
    return config


def on_files(files: Any, config: Any) -> Any:
    """Let files of the root stand among the pages."""
    from mkdocs.structure.files import File

    for name in JOINED:
        text = (ROOT / name).read_text("utf-8").replace("](docs/", "](")
        files.append(File.generated(config, name, content=text))
    return files


def with_tables(markdown: str, name: str) -> str:
    """Give a page with what is made for its marks; another page as it is.

    A mark is a pattern: what its groups hold are the arguments of the script's `tables`.
    """
    for each in TABLES:
        path = ROOT / "docs" / f"{each}.py"
        spec = importlib.util.spec_from_file_location(each, path)
        assert spec is not None
        assert spec.loader is not None
        script = importlib.util.module_from_spec(spec)
        if f'PAGE = "{name}"' in path.read_text("utf-8"):
            spec.loader.exec_module(script)
            assert re.search(script.MARK, markdown), f"{name} has lost the mark of its tables"
            markdown = re.sub(script.MARK, partial(_made, script), markdown)
    return markdown


def _made(script: ModuleType, mark: re.Match[str]) -> str:
    return str(script.tables(*mark.groups()))


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Point at them where they stand on the site, put tables at their marks, rank the page."""
    if page.file.src_uri in LATER:
        page.meta["search"] = {"boost": LATER[page.file.src_uri]}
    markdown = with_tables(markdown, page.file.src_uri)
    for name in JOINED:
        markdown = markdown.replace(f"](../{name})", f"]({name})")
    return markdown
