"""What all tests share: the hypothesis profiles and the folder of published hulls."""

import gc
import os
import shutil
import tempfile
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import cache, partial
from pathlib import Path
from typing import Any

import pytest
from _pytest.pathlib import import_path
from hypothesis import HealthCheck, settings

from assoc_hull.hull import Hull
from assoc_hull.hull.results import HullSurface
from assoc_hull.hull.sources import Examples, examples
from assoc_hull.io.slicing.net import SliceReport
from tests.cases.dtc import read_dtc_with_report
from tests.long_forms import LONG
from tests.taken_back import taken_back
from tests.twins import let_examples_give_twins, made_once, packed, twin

# No deadline and no complaint about slow draws: the machine may be busy with other work.
settings.register_profile(
    "default",
    deadline=None,
    max_examples=50 if LONG else 10,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "ci",
    settings.get_profile("default"),
    derandomize=True,
    print_blob=True,
)
settings.load_profile("ci" if os.environ.get("CI") else "default")


# They need a browser, and what drives it: `make test-page`.
collect_ignore = [] if os.environ.get("ASSOC_HULL_BROWSER") else ["browser"]

IN_MEMORY = Path("/dev/shm")
ROOM = 4_000_000_000
"""Bytes that must be free in memory before files of tests are laid there."""


gc.disable()  # while tests are collected: a third of that time, and hardly any of it is garbage


def pytest_configure(config: pytest.Config) -> None:
    """Let all processes of a run share temporary files in memory, and compiled modules.

    A hull file waits at every edit until the disk has it: tests that edit hulls in files take
    twice as long on a disk. Modules are shared where none may lie beside the sources, and kept
    with what pytest keeps: each process, and each Python that a test starts, would compile the
    package and what it imports anew, for half a minute.
    """
    config.addinivalue_line("markers", "slow: takes some seconds; runs all the same")
    if "PYTEST_XDIST_WORKER" in os.environ:
        return
    if "TMPDIR" not in os.environ and os.access(IN_MEMORY, os.W_OK) and _room(IN_MEMORY) > ROOM:
        os.environ["TMPDIR"] = tempfile.tempdir = _folder(config, "files", IN_MEMORY)
    if os.environ.pop("PYTHONDONTWRITEBYTECODE", ""):
        cache: pytest.Cache | None = getattr(config, "cache", None)
        kept = _folder(config, "pycache") if cache is None else cache.mkdir("pycache")
        os.environ["PYTHONPYCACHEPREFIX"] = str(kept)


def pytest_collection_finish() -> None:
    """Make hulls once, and take tests and modules out of what the garbage collector goes through.

    Both would be done thousands of times.
    """
    let_examples_give_twins()
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)
    gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection(session: pytest.Session) -> None:
    """Let the second process load the modules of tests from the last to the first.

    Each compiles one half and finds the other half compiled. A run of a part of the tests does
    not need them all.
    """
    config = session.config
    whole = [str(config.rootpath / path) for path in config.getini("testpaths")]
    given = [str(config.invocation_params.dir / path) for path in config.args]
    if os.environ.get("PYTEST_XDIST_WORKER", "gw0") == "gw0" or given != whole:
        return
    for path in sorted((config.rootpath / "tests").rglob("test_*.py"), reverse=True):
        with suppress(Exception, pytest.skip.Exception, pytest.fail.Exception):
            # What fails here is told when this module is collected.
            import_path(
                path, mode="importlib", root=config.rootpath, consider_namespace_packages=False
            )


def _room(folder: Path) -> int:
    return shutil.disk_usage(folder).free


def _folder(config: pytest.Config, name: str, below: Path | None = None) -> str:
    """Make a folder that goes when the run is over."""
    folder = tempfile.mkdtemp(prefix=f"assoc-hull-{name}-", dir=below)
    config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
    return folder


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Give every process its run of neighbouring tests; whoever is done early takes from others.

    So what a module computes once is computed by one process, mostly, and none stands idle
    while another has a queue.
    """
    from xdist.scheduler import WorkStealingScheduling

    return WorkStealingScheduling(config, log) if config.getvalue("dist") == "load" else None


REPOSITORY = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def data_folder() -> Path:
    """The folder of published hulls; the test skips where it is missing."""
    named = os.environ.get("ASSOC_HULL_DATA")
    folder = Path(named) if named else REPOSITORY.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"no published hulls in {folder}: set ASSOC_HULL_DATA to their folder")
    return folder


Shipped = Callable[[str], Hull]
"""Gives a hull that ships by the name of its fixture, at every call a new one."""


@pytest.fixture(scope="session")
def shipped(tmp_path_factory: pytest.TempPathFactory) -> Shipped:
    """Hulls that ship, as they are made: each call gives one of the caller's own."""
    makers: dict[str, Callable[[], Hull]] = {
        "wigley": examples.wigley,
        "series60_60": partial(examples.series60, 0.60),
        "series60_70": partial(examples.series60, 0.70),
        "bulk_carrier": examples.bulk_carrier_207k,
        "bulk_carrier_180m": examples.bulk_carrier_180m,
        "container_ship_225m": examples.container_ship_225m,
        "plain_ship": examples.plain_ship,
        "seaking_ship": examples.seaking_ship,
        "sfolds_ship": examples.sfolds_ship,
        "prelikon_ship": examples.prelikon_ship,
    }

    @cache
    def pack(name: str) -> bytes:
        return made_once(tmp_path_factory, name, lambda: packed(makers[name]()))

    def give(name: str) -> Hull:
        found: Hull = twin(pack(name))
        return found

    return give


@pytest.fixture
def made_already(shipped: Shipped, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the examples give hulls that were made once, the same to the last bit."""
    made, make = {0.60: "series60_60", 0.70: "series60_70"}, Examples.series60

    def series60(self: Examples, cb: float = 0.70) -> Hull:
        return shipped(made[cb]) if cb in made else make(self, cb)

    monkeypatch.setattr(Examples, "series60", series60)
    monkeypatch.setattr(Examples, "bulk_carrier_207k", lambda _: shipped("bulk_carrier"))
    created = ("bulk_carrier_180m", "container_ship_225m", "plain_ship")
    for name in (*created, "seaking_ship", "sfolds_ship", "prelikon_ship"):
        monkeypatch.setattr(Examples, name, lambda _, name=name: shipped(name))


@pytest.fixture(scope="session")
def series60_60(shipped: Shipped) -> Hull:
    """Series 60 CB .60; a test that edits it undoes its edits."""
    return shipped("series60_60")


@pytest.fixture(scope="session")
def series60_70(shipped: Shipped) -> Hull:
    """Series 60 CB .70; a test that edits it undoes its edits."""
    return shipped("series60_70")


@pytest.fixture
def fresh_series60_70(series60_70: Hull) -> Iterator[Hull]:
    """Series 60 CB .70, to be edited at will: it is taken back when the test is over."""
    with taken_back(series60_70) as hull:
        yield hull


@pytest.fixture(scope="session")
def bulk_carrier(shipped: Shipped) -> Hull:
    """The 207,000 TDW bulk carrier; a test that edits it undoes its edits."""
    return shipped("bulk_carrier")


@pytest.fixture(scope="session")
def dtc_with_report(
    data_folder: Path, tmp_path_factory: pytest.TempPathFactory
) -> tuple[Hull, SliceReport]:
    """The DTC container ship at 10 mm, from its mesh, and the report of it."""
    return made_once(tmp_path_factory, "dtc", lambda: read_dtc_with_report(data_folder))


@pytest.fixture(scope="session")
def dtc(dtc_with_report: tuple[Hull, SliceReport]) -> Hull:
    """The DTC container ship; a test that edits it undoes its edits."""
    return dtc_with_report[0]


@pytest.fixture(scope="session")
def surface_of() -> Callable[[Hull], HullSurface]:
    """Give the surface of a hull, fitted once: of a hull that nobody has edited since."""
    known: dict[int, tuple[Hull, HullSurface]] = {}

    def give(hull: Hull) -> HullSurface:
        if id(hull) not in known:
            known[id(hull)] = hull, hull.surface()
        return known[id(hull)][1]

    return give
