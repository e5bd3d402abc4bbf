"""A file gives the same hull to the last bit, however many cores a machine has."""

from pathlib import Path

from threadpoolctl import threadpool_limits

import assoc_hull as ah
from tests.long_forms import long_form


@long_form
def test_a_mesh_gives_the_same_bits_with_one_thread_of_linear_algebra_and_with_two(
    data_folder: Path,
) -> None:
    """Sums of a library that divides them among threads round otherwise."""
    path, found = data_folder / "dtc" / "DTC-scaled.stl.gz", set[str]()
    for threads in (1, 2):
        with threadpool_limits(limits=threads):
            found.add(ah.read(path, scale=59.407, draught=14.5).fingerprint)
    assert len(found) == 1
