"""Studies on a cluster: the bits of one process, whatever dies; what has landed stays."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from distributed import Client, LocalCluster

import assoc_hull as ah
from assoc_hull.study import Study, dask_cluster

OUTPUTS = ["volume", "kmt"]
ASKED: dict[str, Any] = {
    "set": ah.study.sample({"breadth": (9.5, 10.5), "draught": (6.0, 6.4)}, 70, seed=3),
    "outputs": OUTPUTS,
}


@pytest.fixture(scope="module")
def hull() -> ah.Hull:
    """A hull of few lines; no test changes it."""
    return ah.examples.wigley(stations=7, waterlines=5)


@pytest.fixture(scope="module")
def here(hull: ah.Hull) -> Study:
    """The study in this process."""
    return hull.study(**ASKED)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LocalCluster]:
    """Two workers, with a scheduler that the last test which asks for it closes."""
    with LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=":0", silence_logs=50,
        local_directory=str(tmp_path_factory.mktemp("dask")),
    ) as made:  # fmt: skip
        yield made


def test_workers_that_die_lose_no_row_and_double_none(
    hull: ah.Hull, here: Study, cluster: LocalCluster, tmp_path: Path
) -> None:
    """One is killed while it works, then all: with them goes what was sent to them."""
    with Client(cluster, set_as_default=False) as client:
        kills = [1, 2]

        def kill(what: str, done: int, of: int) -> None:
            if kills and done >= 20 * (3 - len(kills)):
                pids = list(client.run(os.getpid).values())
                for pid in pids[: kills.pop(0)]:
                    os.kill(pid, signal.SIGKILL)

        found = hull.study(**ASKED, cluster=client, file=tmp_path / "a.sqlite", progress=kill)
        assert not kills
        assert client.status == "running"
    assert found.rows == here.rows
    assert not found.interrupted


def test_workers_that_say_nothing_are_not_waited_for(
    hull: ah.Hull, here: Study, cluster: LocalCluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    """They stand still, and the scheduler believes that they work; later all goes on."""
    with Client(cluster, set_as_default=False) as client:
        pids = list(client.run(os.getpid).values())

        def stop(what: str, done: int, of: int) -> None:
            for pid in pids:
                os.kill(pid, signal.SIGSTOP)

        said = pytest.raises(ah.errors.ClusterError, match=r"said nothing \d times over rows")
        try:
            # Impatient until then: on a busy machine workers that go on may say nothing as long.
            with monkeypatch.context() as impatient, said:
                impatient.setattr(dask_cluster, "_STALL", 0.2)
                impatient.setattr(dask_cluster, "_SLOWER", 1.0)
                hull.study(**ASKED, cluster=client, progress=stop)
        finally:
            for pid in pids:
                os.kill(pid, signal.SIGCONT)
        assert hull.study(**ASKED, cluster=client).rows == here.rows


def test_a_hull_that_is_lost_without_a_word_is_sent_again(
    hull: ah.Hull, here: Study, cluster: LocalCluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The scheduler waits for what no worker has, and nobody says a word: batches bring it."""
    monkeypatch.setattr(dask_cluster, "_STALL", 0.5)
    with Client(cluster, set_as_default=False) as client:
        nowhere = "tcp://127.0.0.1:9"

        def lost(hands: dask_cluster._Hands) -> None:
            hands.sent = client.submit(bytes, workers=[nowhere], pure=False)

        give_up = dask_cluster._Hands._give_up_waiting

        def once(hands: dask_cluster._Hands) -> None:
            give_up(hands)
            monkeypatch.setattr(dask_cluster, "_STALL", 300.0)

        monkeypatch.setattr(dask_cluster._Hands, "send_parent", lost)
        monkeypatch.setattr(dask_cluster._Hands, "_give_up_waiting", once)
        assert hull.study(**ASKED, cluster=client).rows == here.rows


def test_a_scheduler_that_goes_away_is_told_and_the_same_call_goes_on(
    hull: ah.Hull, here: Study, cluster: LocalCluster, tmp_path: Path
) -> None:
    """With the rows that have landed; elsewhere, if need be."""
    path, landed = tmp_path / "study.sqlite", []

    def stop(what: str, done: int, of: int) -> None:
        landed.append(done)
        if done >= 10:
            cluster.close()

    with pytest.raises(ah.errors.ClusterError, match=r"gone away.*the same call goes on") as caught:
        hull.study(**ASKED, cluster=cluster.scheduler_address, file=path, progress=stop)
    assert cluster.scheduler_address in str(caught.value)
    assert max(landed) < 70
    told: list[int] = []
    found = hull.study(**ASKED, file=path, progress=lambda what, done, of: told.append(done))
    assert min(told) > max(landed)
    assert found.rows == here.rows


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"cluster": "tcp://127.0.0.1:9", "workers": 2}, "the cluster has its own"),
        ({"cluster": "nowhere://x"}, "no scheduler answers"),
        ({"cluster": 3}, "cluster is 3"),
    ],
    ids=["workers", "address", "number"],
)
def test_what_is_no_cluster_is_refused(hull: ah.Hull, given: dict[str, Any], words: str) -> None:
    """Before a row is made."""
    with pytest.raises(ah.AssocHullError, match=words):
        hull.study(set={"breadth": 10.0}, outputs=["volume"], **given)


def test_a_program_without_a_guard_is_told_so(tmp_path: Path) -> None:
    """New processes would begin the study again."""
    program = tmp_path / "program.py"
    program.write_text(
        "import assoc_hull as ah\n"
        "hull = ah.examples.wigley(stations=7, waterlines=5)\n"
        "hull.study(set={'breadth': [10.0, 10.1]}, cluster='local', workers=1)\n"
    )
    folder = str(Path(ah.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, str(program)], capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": folder},
    )  # fmt: skip
    assert done.returncode == 1
    last = done.stderr.splitlines()[-1]
    assert "BadInputError" in last
    assert "if __name__ == '__main__'" in last


def test_a_local_cluster_is_begun_and_ended(hull: ah.Hull, here: Study) -> None:
    """It makes the rows of one process, held in memory as those are."""
    short = {**ASKED, "set": {name: column[:6] for name, column in ASKED["set"].items()}}
    found = hull.study(**short, cluster="local", workers=1)
    assert found.rows == here.rows[:6]
