"""What all tests share: the hypothesis profiles and the folder of published hulls."""

import os
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from assoc_hull.hull import Hull
from assoc_hull.sources import examples
from tests.cases.dtc import read_dtc

# No deadline and no complaint about slow draws: the machine may be busy with other work.
settings.register_profile(
    "default",
    deadline=None,
    max_examples=50,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile(
    "ci",
    settings.get_profile("default"),
    derandomize=True,
    max_examples=100,
    print_blob=True,
)
settings.load_profile("ci" if os.environ.get("CI") else "default")

REPOSITORY = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def data_folder() -> Path:
    """The folder of published hulls; the test skips where it is missing."""
    named = os.environ.get("ASSOC_HULL_DATA")
    folder = Path(named) if named else REPOSITORY.parent / "shared" / "data"
    if not folder.is_dir():
        pytest.skip(f"no published hulls in {folder}: set ASSOC_HULL_DATA to their folder")
    return folder


@pytest.fixture(scope="session")
def series60_60() -> Hull:
    """Series 60 CB .60; a test that edits it undoes its edits."""
    return examples.series60(0.60)


@pytest.fixture(scope="session")
def series60_70() -> Hull:
    """Series 60 CB .70; a test that edits it undoes its edits."""
    return examples.series60(0.70)


@pytest.fixture(scope="session")
def bulk_carrier() -> Hull:
    """The 207,000 TDW bulk carrier; a test that edits it undoes its edits."""
    return examples.bulk_carrier_207k()


@pytest.fixture(scope="session")
def dtc(data_folder: Path) -> Hull:
    """The DTC container ship at 10 mm, from its mesh; a test that edits it undoes its edits."""
    return read_dtc(data_folder)
