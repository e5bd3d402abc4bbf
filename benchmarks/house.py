"""The shape of the source tree: sizes, circles, names with two homes, modules a call enters.

`python -m benchmarks.house` prints the figures; nothing is timed and nothing is asserted. The
limits on what a call enters stand in `tests/test_paths.py`.
"""

from __future__ import annotations

import ast
import io
import sys
import tokenize
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

import networkx as nx

import assoc_hull as ah
from assoc_hull.edit.program_edit import ProgramEdit

__all__ = ["TRIPS", "entered", "main"]

ROOT = Path(ah.__file__).parent
NAME = ROOT.name
Act = Callable[[], object]


def modules() -> dict[str, ast.Module]:
    """Every module by its dotted name, parsed; a package by the name of its folder."""
    found = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = [NAME, *path.relative_to(ROOT).with_suffix("").parts]
        if parts[-1] == "__init__":
            parts.pop()
        found[".".join(parts)] = ast.parse(path.read_text(encoding="utf-8"))
    return found


def imports(trees: dict[str, ast.Module]) -> nx.DiGraph[str]:
    """Who imports whom, imports for types and inside functions counted."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    graph.add_nodes_from(trees)
    for module, tree in trees.items():
        for target in _targets(tree):
            while target not in trees and "." in target:
                target = target.rpartition(".")[0]
            if target in trees and target != module:
                graph.add_edge(module, target)
    return graph


def _targets(tree: ast.Module) -> Iterator[str]:
    """Give the dotted names a module imports, wherever the import stands."""
    for node in ast.walk(tree):
        match node:
            case ast.ImportFrom(module=str(base), names=names) if base.startswith(NAME):
                yield from (f"{base}.{each.name}" for each in names)
            case ast.Import(names=names):
                yield from (each.name for each in names if each.name.startswith(NAME))


def public_names(trees: dict[str, ast.Module]) -> dict[str, list[tuple[str, bool]]]:
    """Homes of each public function and class of a module: (module, is it a class)."""
    homes = defaultdict(list)
    for module, tree in trees.items():
        for node in tree.body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
                homes[node.name].append((module, isinstance(node, ast.ClassDef)))
    return homes


def out_of_reach(graph: nx.DiGraph[str], trees: dict[str, ast.Module]) -> list[str]:
    """Modules that neither the public face nor a command leads to."""
    roots = {NAME, f"{NAME}.__main__", *(m for m in graph if m.startswith(f"{NAME}.cli"))}
    # The face imports on first use: its table of names holds the modules as strings.
    for node in ast.walk(trees[NAME]):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            roots.add(f"{NAME}.{node.value}")
    roots &= set(graph)
    seen = roots.union(*(nx.descendants(graph, root) for root in roots))
    packages = {module.rpartition(".")[0] for module in graph}
    return sorted(set(graph) - seen - packages)


def line_counts() -> Counter[str]:
    """Lines of code, docstrings, comments and nothing in the whole package."""
    count: Counter[str] = Counter()
    for path in ROOT.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        documented = _docstring_lines(ast.parse(text))
        code, comments = set[int](), set[int]()
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            rows = range(token.start[0], token.end[0] + 1)
            if token.type == tokenize.COMMENT:
                comments.update(rows)
            elif token.type not in (tokenize.NL, tokenize.NEWLINE, tokenize.ENDMARKER):
                code.update(rows)
        code -= documented
        total = text.count("\n")
        count["lines"] += total
        count["docstrings"] += len(documented)
        count["code"] += len(code)
        count["comments"] += len(comments)
        count["comment lines of their own"] += len(comments - code)
    return count


def _docstring_lines(tree: ast.Module) -> set[int]:
    kinds = ast.Module | ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
    found: set[int] = set()
    for node in ast.walk(tree):
        if isinstance(node, kinds) and ast.get_docstring(node, clean=False) is not None:
            first = node.body[0]
            found.update(range(first.lineno, (first.end_lineno or first.lineno) + 1))
    return found


def entered(act: Act) -> list[str]:
    """Modules of the package whose functions a call runs, in the order of first entry."""
    seen: dict[str, None] = {}
    prefix = f"{ROOT}/"

    def watch(frame: object, event: str, _: object) -> None:
        code = getattr(frame, "f_code", None)
        if event == "call" and code is not None and code.co_filename.startswith(prefix):
            seen.setdefault(code.co_filename[len(prefix) :])

    sys.setprofile(watch)
    try:
        act()
    finally:
        sys.setprofile(None)
    return list(seen)


def _move() -> Act:
    hull = ah.examples.wigley()
    start, step = hull.half_breadth(70.0, 2.5), iter(range(1, 9))

    def act() -> None:
        number = next(step)
        with hull.edit(f"move {number}") as edit:
            edit.move("WL 2.5 x ST 7", y=start + 0.001 * number)

    return act


def _move_by_program() -> Act:
    act = _move()

    def by_program() -> None:
        with mock.patch.object(ProgramEdit, "of", ProgramEdit.begun):
            act()

    return by_program


def _pull() -> Act:
    hull, step = ah.examples.wigley(), iter(range(1, 9))

    def act() -> None:
        with hull.edit(f"pull {next(step)}") as edit:
            edit.pull("WL 2.5 x ST 7", 0.005, radius=(15.0, 4.0))

    return act


def _hydrostatics() -> Act:
    hull = ah.examples.wigley()
    return lambda: hull.hydrostatics(draught=6.0)


def _vary() -> Act:
    hull = ah.examples.wigley()
    return lambda: hull.vary(set={"breadth": 10.2})


TRIPS: dict[str, Callable[[], Act]] = {
    "a moved point": _move,
    "a moved point, by the program": _move_by_program,
    "a pull": _pull,
    "hydrostatics": _hydrostatics,
    "a variation of the breadth": _vary,
}
"""Acts whose way through the package a reader follows; each is made, run once, then watched."""


def main() -> None:
    """Print the figures."""
    trees = modules()
    graph = imports(trees)
    real = [module for module, tree in trees.items() if len(tree.body) > 1]
    print(f"modules {len(list(ROOT.rglob('*.py')))} (with more than a docstring {len(real)})")
    for kind, count in line_counts().items():
        print(f"{kind} {count}")
    one = [module for module in graph if graph.in_degree(module) == 1]
    print(f"modules with one importer {len(one)}")
    lost = out_of_reach(graph, trees)
    print(f"modules out of reach {len(lost)}", *lost)
    homes = {name: where for name, where in public_names(trees).items() if len(set(where)) > 1}
    twice = {
        name: where
        for name, where in homes.items()
        if max(Counter(module.split(".")[1] for module in {each for each, _ in where}).values()) > 1
    }
    classes = [name for name, where in homes.items() if sum(kind for _, kind in set(where)) > 1]
    print(f"public names with two homes {len(homes)}, in one package {len(twice)}", *sorted(twice))
    print(f"classes with two homes {len(classes)}", *sorted(classes))
    circles = [sorted(each) for each in nx.strongly_connected_components(graph) if len(each) > 1]
    print(f"circles of modules {len(circles)}")
    for circle in circles:
        print("   ", *(module.removeprefix(f"{NAME}.") for module in circle))
    print(f"longest chain of imports {nx.dag_longest_path_length(nx.condensation(graph))}")
    for name, make in TRIPS.items():
        act = make()
        act()  # what is imported or made once is not the trip
        print(f"modules entered by {name}: {len(entered(act))}")


if __name__ == "__main__":
    main()
