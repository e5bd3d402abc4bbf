"""What `mkdocs` does beside building pages: two files of the root join, and all pages the menu.

Pages that the menu of `mkdocs.yml` does not name stand at the end of Theory, so that none is lost.
"""

from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
JOINED = ("CHANGELOG.md", "CONTRIBUTING.md")


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


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Point at them where they stand on the site."""
    for name in JOINED:
        markdown = markdown.replace(f"](../{name})", f"]({name})")
    return markdown
