"""The page as one module: what a notebook loads is the page, whole, and keeps its rules."""

import re
from importlib.resources import files

import pytest

from assoc_hull.page.joined import imports_of, joined_modules, scoped_styles

MODULES = {
    each.name.removesuffix(".js"): each.read_text("utf-8")
    for each in files("assoc_hull.page").joinpath("static").iterdir()
    if each.name.endswith(".js")
}


@pytest.mark.parametrize("name", sorted(MODULES))
def test_modules_import_and_export_by_the_lines_that_can_be_joined(name: str) -> None:
    """Imports of names on a line of their own, exports of declarations, nothing else."""
    for line in MODULES[name].splitlines():
        if re.match(r"\s*import[ {(*]", line):
            assert re.fullmatch(r'import \{[\w, ]+\} from "\./\w+\.js";', line), line
        if line.startswith("export"):
            assert re.match(r"export (async )?(const|function|class) ", line), line


def test_joined_they_hold_each_module_once_after_what_it_needs() -> None:
    """No import is left, and one export: what the notebook asks for."""
    text = joined_modules(MODULES, "widget", ("render",))
    begins = re.findall(r"^const _(\w+) = \(\(\) => \{$", text, re.M)
    wanted, front = set[str](), ["widget"]
    while front:
        wanted.add(name := front.pop())
        front += set(imports_of(MODULES[name])) - wanted
    assert sorted(begins) == sorted(wanted)
    for name in begins:
        needed = imports_of(MODULES[name])
        assert all(begins.index(other) < begins.index(name) for other in needed)
    assert not re.search(r"^\s*import ", text, re.M)
    assert re.findall(r"^export .*$", text, re.M) == ["export default {render: _widget.render};"]


def test_what_the_widget_does_not_need_is_left_out() -> None:
    """The socket and the address bar belong to the page alone."""
    text = joined_modules(MODULES, "widget", ("render",))
    assert "new WebSocket" not in text
    assert "location.hash" not in text


def test_styles_hold_within_the_widget_alone() -> None:
    """The notebook's own page keeps its margins; widths are those of the cell."""
    text = scoped_styles("body { margin: 0; }\n@media (max-width: 9px) { .a { top: 0; } }", "w")
    assert text.startswith(".w {")
    assert "body" not in text
    assert "@container (max-width: 9px)" in text
