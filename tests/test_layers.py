"""The packages form layers: imports point downward only."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1] / "assoc_hull"

# From the bottom up. Those of one layer never import each other.
LAYERS: tuple[frozenset[str], ...] = (
    frozenset({"errors"}),
    frozenset({"arguments"}),
    frozenset({"tolerance"}),
    frozenset({"geometry"}),
    frozenset({"graph"}),
    frozenset({"model"}),
    frozenset({"analysis"}),
    frozenset({"edit"}),
    frozenset({"variation", "creation", "fairing", "surface"}),
    frozenset({"study"}),
    frozenset({"io"}),
    frozenset({"examples"}),
    frozenset({"hull"}),
    frozenset({"sources", "studies", "variants", "shifts", "production", "plating", "shell"}),
    frozenset({"plot"}),
    frozenset({"page"}),
    frozenset({"cli"}),
    frozenset({"__init__", "__main__"}),
)
HEIGHT = {unit: height for height, layer in enumerate(LAYERS) for unit in layer}


def unit_of(dotted: str, package: str) -> str | None:
    """The package or module right below `package` that a dotted name leads to."""
    top, _, rest = dotted.partition(".")
    if top != package:
        return None
    unit = rest.partition(".")[0]
    return unit if unit in HEIGHT else "__init__"


def absolute_base(node: ast.ImportFrom, inside: list[str]) -> str:
    """What `from ... import` starts from, with its leading dots resolved."""
    ancestors = inside[: len(inside) - node.level + 1] if node.level else []
    return ".".join([*ancestors, *([node.module] if node.module else [])])


def imports_and_calls(tree: ast.Module) -> Iterator[ast.AST]:
    """Every import and every call, wherever it stands; a walk that leaves out all else is quick."""
    waiting: list[ast.AST] = [tree]
    while waiting:
        node = waiting.pop()
        kind = type(node)
        if kind in (ast.Name, ast.Constant):
            continue
        if kind in (ast.Import, ast.ImportFrom):
            yield node
            continue
        if kind is ast.Call:
            yield node
        for name in node._fields:
            child = getattr(node, name, None)
            if isinstance(child, list):
                waiting.extend(each for each in child if isinstance(each, ast.AST))
            elif isinstance(child, ast.AST):
                waiting.append(child)


def imported_names(tree: ast.Module, inside: list[str]) -> Iterator[tuple[int, str]]:
    """Line and dotted name of every import, wherever it stands; `inside` is the package."""
    for node in imports_and_calls(tree):
        match node:
            case ast.Import(names=names):
                yield from ((node.lineno, alias.name) for alias in names)
            case ast.ImportFrom(names=names):
                base = absolute_base(node, inside)
                yield from ((node.lineno, f"{base}.{alias.name}") for alias in names)
            case ast.Call(
                func=ast.Name(id="import_module" | "__import__")
                | ast.Attribute(attr="import_module"),
                args=[ast.Constant(value=str(name)), *_],
            ):
                yield node.lineno, name


def wrong_imports(root: Path) -> list[str]:
    """Every import of the package at `root` that points upward or sideways."""
    found = []
    for path in sorted(root.rglob("*.py")):
        place = path.relative_to(root).with_suffix("")
        unit = place.parts[0]
        if unit not in HEIGHT:
            found.append(f"{place}: {unit} has no place in the layers")
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for line, name in imported_names(tree, [root.name, *place.parts[:-1]]):
            target = unit_of(name, root.name)
            if target is None or target == unit or HEIGHT[target] < HEIGHT[unit]:
                continue
            found.append(f"{place}:{line}: {unit} imports {target}")
    return found


def plant(root: Path, files: dict[str, str]) -> Path:
    """A package of these files, as `assoc_hull` would lie on disk."""
    package = root / "assoc_hull"
    for name, text in files.items():
        path = package / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return package


def test_imports_of_the_package_point_downward_only() -> None:
    """No module imports a higher layer or a sibling, not even in a function or for a type."""
    assert wrong_imports(PACKAGE) == []


@pytest.mark.parametrize(
    ("file", "text", "finding"),
    [
        pytest.param(
            "graph/run.py",
            "import assoc_hull.model.curve",
            "graph/run:1: graph imports model",
            id="plain import",
        ),
        pytest.param(
            "graph/run.py",
            "from assoc_hull.model import Curve",
            "graph/run:1: graph imports model",
            id="name of a higher package",
        ),
        pytest.param(
            "graph/run.py",
            "from assoc_hull import errors, model",
            "graph/run:1: graph imports model",
            id="higher package as a name of the whole",
        ),
        pytest.param(
            "geometry/classical/biarc.py",
            "from ...model.curve import Curve",
            "geometry/classical/biarc:1: geometry imports model",
            id="relative import",
        ),
        pytest.param(
            "geometry/__init__.py",
            "from .. import edit",
            "geometry/__init__:1: geometry imports edit",
            id="relative import in a package's face",
        ),
        pytest.param(
            "edit/move.py",
            "def move():\n    from assoc_hull.hull import Hull\n    return Hull",
            "edit/move:2: edit imports hull",
            id="inside a function",
        ),
        pytest.param(
            "edit/move.py",
            "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from ..hull import Hull",
            "edit/move:3: edit imports hull",
            id="for a type only",
        ),
        pytest.param(
            "study/sweep.py",
            "import importlib\nimportlib.import_module('assoc_hull.plot.lines')",
            "study/sweep:2: study imports plot",
            id="by name at run time",
        ),
        pytest.param(
            "plot/lines.py",
            "import assoc_hull as ah",
            "plot/lines:1: plot imports __init__",
            id="public face",
        ),
        pytest.param(
            "plot/lines.py",
            "from assoc_hull import Hull",
            "plot/lines:1: plot imports __init__",
            id="name of the public face",
        ),
        pytest.param(
            "fairing/solve.py",
            "from assoc_hull.variation import shift",
            "fairing/solve:1: fairing imports variation",
            id="sibling",
        ),
        pytest.param(
            "arguments.py",
            "from assoc_hull.tolerance import Tolerances",
            "arguments:1: arguments imports tolerance",
            id="upward at the bottom",
        ),
        pytest.param(
            "helpers.py",
            "",
            "helpers: helpers has no place in the layers",
            id="module without a layer",
        ),
    ],
)
def test_a_wrong_import_is_found(tmp_path: Path, file: str, text: str, finding: str) -> None:
    """The rule sees every way in which Python can import, and names module and line."""
    assert wrong_imports(plant(tmp_path, {file: text})) == [finding]


def test_downward_and_foreign_imports_are_allowed(tmp_path: Path) -> None:
    """The rule leaves alone lower layers, the own package, and other libraries."""
    package = plant(
        tmp_path,
        {
            "__init__.py": "from assoc_hull.hull import Hull",
            "__main__.py": "from assoc_hull.cli import main",
            "cli.py": "import assoc_hull.plot\nfrom . import hull",
            "model/curve.py": "import numpy\nfrom . import point\nfrom .point import Point",
            "model/point.py": "from ..geometry import spline\nfrom ..errors import RingError",
            "io/names.py": "import assoc_hull_tools.model\nfrom io import StringIO",
        },
    )
    assert wrong_imports(package) == []
