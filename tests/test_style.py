"""Rules for every file that no linter knows."""

import ast
import os
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parents[1]
MODULES = sorted((REPOSITORY / "assoc_hull").rglob("*.py"))
MADE = frozenset({"build", "dist", "__pycache__"})

# Absolute paths, and where packages come from: true on one machine only. Spelt in pieces,
# so that this file passes its own test.
LOCAL = re.compile(
    "|".join(
        [
            r"(?<![\w.$})>])/(?:work|root|home|farm|tmp)" + "/",
            "shared" + "/spec",
            r"pypi\.(?:org|python)",
            r"pythonhosted" + r"\.org",
            "index" + "-url",
            "find" + "-links",
        ]
    ).encode()
)


def repository_files() -> Iterator[Path]:
    """Every file that people write: nothing made, and of the hidden folders only `.ci`."""
    for folder, folders, names in os.walk(REPOSITORY):
        folders[:] = [name for name in folders if name == ".ci" or name[0] != "."]
        folders[:] = [name for name in folders if name not in MADE]
        yield from (Path(folder, name) for name in names if name != ".git")


def local_places(text: bytes) -> list[str]:
    """What in a file holds on one machine only, each with its line."""
    return [
        f"line {number}: {match.group().decode()}"
        for number, line in enumerate(text.splitlines(), start=1)
        for match in LOCAL.finditer(line)
    ]


def module_id(path: Path) -> str:
    """The module's path in the repository, as the name of its case."""
    return path.relative_to(REPOSITORY).as_posix()


def listed_names(tree: ast.Module) -> list[str] | None:
    """The names in `__all__`, if the module has one."""
    for node in tree.body:
        match node:
            case ast.Assign(targets=[ast.Name(id="__all__")], value=value):
                return list(ast.literal_eval(value))
    return None


def sense(tree: ast.Module) -> list[str]:
    """What makes a module hard to read: names from anywhere, no docstring."""
    stars = [
        node.lineno
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.names[0].name == "*"
    ]
    found = [f"star import in line {number}" for number in stars]
    return found if ast.get_docstring(tree) else [*found, "no docstring"]


def public_names(path: Path, tree: ast.Module) -> list[str]:
    """What is wrong with the list of a module's names."""
    names = listed_names(tree)
    if names is None:
        private = path.stem.startswith("_") and path.stem != "__init__"
        return [] if private or len(tree.body) == 1 else ["no __all__"]
    return [] if len(names) == len(set(names)) else ["__all__ has a name twice"]


@pytest.fixture(scope="module")
def parsed() -> dict[Path, ast.Module]:
    """Every module and its tree."""
    return {path: ast.parse(path.read_text(encoding="utf-8")) for path in MODULES}


def test_a_module_says_what_it_is(parsed: dict[Path, ast.Module]) -> None:
    """A module has a docstring, and imports names one by one."""
    found = {module_id(path): sense(tree) for path, tree in parsed.items()}
    assert found
    assert {name: faults for name, faults in found.items() if faults} == {}


def test_public_names_are_listed(parsed: dict[Path, ast.Module]) -> None:
    """A public module lists its names, once each (ruff sorts them); `__init__` may be empty."""
    found = {module_id(path): public_names(path, tree) for path, tree in parsed.items()}
    assert {name: faults for name, faults in found.items() if faults} == {}


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        pytest.param('"""A module."""\nfrom a import *\n', "star import in line 2", id="star"),
        pytest.param("x = 1\n", "no docstring", id="no docstring"),
    ],
)
def test_a_module_that_is_hard_to_read_is_found(text: str, fault: str) -> None:
    """The rule sees each fault."""
    assert sense(ast.parse(text)) == [fault]


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        pytest.param("x = 1\ny = 2\n", "no __all__", id="no list"),
        pytest.param('__all__ = ["a", "a"]\n', "__all__ has a name twice", id="twice"),
    ],
)
def test_a_bad_list_of_names_is_found(text: str, fault: str) -> None:
    """The rule sees each fault."""
    assert public_names(Path("module.py"), ast.parse(text)) == [fault]


def test_a_public_class_name_stands_once(parsed: dict[Path, ast.Module]) -> None:
    """Who reads a name in a message or a type finds one class of it."""
    homes = dict[str, list[str]]()
    for path, tree in parsed.items():
        for node in tree.body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                homes.setdefault(node.name, []).append(module_id(path))
    assert len(homes) > 1000
    assert {name: where for name, where in homes.items() if len(where) > 1} == {}


def test_what_locks_is_left_open_by_an_interrupt(parsed: dict[Path, ast.Module]) -> None:
    """Between the last statement of a ``with lock`` and the release an interrupt leaves it taken.

    A thread that comes to its own lock once more would wait for itself for ever: `Gate` is what
    locks.
    """
    found = {
        module_id(path)
        for path, tree in parsed.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute | ast.Name) and ast.unparse(node) == "threading.Lock"
    }
    assert found == set()


def test_no_file_holds_on_one_machine_only() -> None:
    """No absolute path and no address of a package registry stands in any file."""
    found = {
        module_id(path): places
        for path in repository_files()
        if (places := local_places(path.read_bytes()))
    }
    assert found == {}


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("open('/" + "work/main/hull.csv')", id="working folder"),
        pytest.param("first line\ncd /" + "root/hulls", id="home folder of root"),
        pytest.param("pip install --index" + "-url somewhere", id="place to install from"),
        pytest.param("https://" + "py" + "pi.org/simple", id="registry"),
    ],
)
def test_a_local_place_is_found(text: str) -> None:
    """The rule sees paths and addresses in any line."""
    assert local_places(text.encode()) != []


@pytest.mark.parametrize(
    "text",
    [
        pytest.param("https://example.org/" + "work/paper.pdf", id="folder of a web site"),
        pytest.param("$HOME/" + "work/hull.csv", id="folder below a variable"),
        pytest.param("from pathlib import Path; Path('build/demo')", id="relative path"),
    ],
)
def test_a_portable_place_is_allowed(text: str) -> None:
    """The rule leaves addresses of papers and relative paths alone."""
    assert local_places(text.encode()) == []
