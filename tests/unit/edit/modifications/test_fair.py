"""Fairing is an edit like any other, counts noise once, and leaves alone what it must."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import even_keel_displacement
from assoc_hull.edit.net_battens import fairable_rows, net_battens
from assoc_hull.errors import (
    AssocHullError,
    BadInputError,
    RefusedEditError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.model.address import address
from tests.conftest import Shipped
from tests.long_forms import LONG
from tests.noisy_nets import error_left, put_noise, rms, sign_changes

WIDTH = 5e-3
NOISE = WIDTH / np.sqrt(3.0)
SHIPS = ["wigley", "series60_70", *(["bulk_carrier"] if LONG else [])]
LEFT = {"wigley": 0.48, "series60_70": 0.73, "bulk_carrier": 0.72}


def displaced(hull: ah.Hull, before: np.typing.NDArray[np.float64]) -> float:
    """How far the points that can be faired have moved along the normal, rms, m."""
    problem = net_battens(hull.state)
    step = hull.state.rows.xyz[problem.rows] - before[problem.rows]
    square = (problem.moves**2).sum(axis=1)
    return rms((step * problem.moves).sum(axis=1) / square)


@pytest.mark.parametrize("name", SHIPS)
def test_a_noisy_hull_is_faired(name: str, shipped: Shipped) -> None:
    """The published net, not the plan: error, sign changes, bounds, features, what stays, undo."""
    hull = shipped(name)
    before, true = hull.state.rows.xyz.data.copy(), sign_changes(hull.state)
    clean = put_noise(hull, WIDTH)
    noisy, print_, features = hull.state.rows.xyz.data.copy(), hull.fingerprint, [*hull.features]
    error, excess = error_left(clean, before, hull), sign_changes(hull.state) - true
    report = hull.fair(noise=NOISE, tolerance=WIDTH)
    now = hull.state.rows.xyz.data
    assert error_left(clean, before, hull) <= (LEFT[name] + 0.03) * error
    left = np.maximum(sign_changes(hull.state) - true, 0).sum()
    assert left <= 0.25 * np.maximum(excess, 0).sum()
    assert [*hull.features] == features
    # what may not move has the same bits, unless it is computed from what did
    rows = hull.state.rows
    computed = (rows.driver.data >= 0) | np.isfinite(rows.gap.data)
    stays = np.ones(len(noisy), np.bool_)
    stays[clean.rows] = False
    stays &= rows.alive.data[: len(noisy)] & ~computed[: len(noisy)]
    stays &= ~(rows.anchor.data[: len(noisy)] >= 0).any(axis=1)
    assert np.array_equal(now[: len(noisy)][stays], noisy[stays])
    along = np.linalg.norm(now[clean.rows] - noisy[clean.rows], axis=1)
    assert along.max() <= WIDTH + 1e-9
    far = {address(hull.state, row) for row in clean.rows[along > WIDTH - 1e-9].tolist()}
    assert {point.point for point in report.at_bound} == far
    assert hull.check() == ()
    hull.undo()
    assert hull.fingerprint == print_


@pytest.mark.parametrize("name", SHIPS)
def test_fairing_again_is_fairing_once(name: str, shipped: Shipped) -> None:
    """A second one moves hardly anything, a third nothing, and the error stays that of the first.

    Counted from the last state each time, six of them were worse than the noise.
    """
    hull = shipped(name)
    truth = hull.state.rows.xyz.data.copy()
    clean = put_noise(hull, 1.6e-3)
    noise, moved, errors = 1.6e-3 / np.sqrt(3.0), list[float](), list[float]()
    for _ in range(6 if LONG else 3):
        before = hull.state.rows.xyz.data.copy()
        hull.fair(noise=noise)
        moved.append(displaced(hull, before[: len(truth)]))
        errors.append(error_left(clean, truth, hull))
    assert moved[1] < 0.02 * noise
    assert moved[2] < 0.002 * noise
    assert max(errors) <= 1.01 * errors[0]


@pytest.mark.parametrize("name", ["plain_ship", *(["bulk_carrier_180m"] if LONG else [])])
def test_points_that_a_feature_is_computed_from_stay(name: str, shipped: Shipped) -> None:
    """A straight run whose crossings other lines carry was bent off itself by 32 micrometres."""
    hull = shipped(name)
    features = [*hull.features]
    report = hull.fair(noise=1e-3)
    assert [*hull.features] == features
    assert report.found.stayed["that lead points of a feature"] > 5


def test_the_order_of_creation_changes_no_bit(shipped: Shipped, tmp_path: Path) -> None:
    """A hull from text has its points in another order, and comes out the same."""
    hull = shipped("series60_70")
    hull.save(tmp_path / "ship.hull.json")
    other = ah.open(tmp_path / "ship.hull.json")
    assert not np.array_equal(fairable_rows(hull.state), fairable_rows(other.state))
    for each in (hull, other):
        each.fair(noise=1e-3, tolerance=2e-3)
    assert hull.fingerprint == other.fingerprint


def test_given_values_are_kept_by_files_and_undo(tmp_path: Path) -> None:
    """Faired, saved, opened and faired again: as without the file in between."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    hull.fair(noise=NOISE)
    for ending in ("hull", "hull.json"):
        hull.save(tmp_path / f"ship.{ending}")
        again = ah.open(tmp_path / f"ship.{ending}")
        assert again.fingerprint == hull.fingerprint
        assert again.verify() == ()
        assert np.array_equal(
            np.sort(again.state.rows.faired.data, axis=0),
            np.sort(hull.state.rows.faired.data, axis=0),
        )
        again.close()
    assert hull.state.rows.faired.data.any()
    hull.undo()
    assert not hull.state.rows.faired.data.any()
    hull.redo()
    again = ah.open(tmp_path / "ship.hull.json")
    for each in (hull, again):
        each.fair(noise=NOISE)
    assert hull.fingerprint == again.fingerprint


def test_an_edit_adds_its_own_displacement_to_what_was_given() -> None:
    """Fairing, pulling and fairing is pulling and fairing: the noise counts once."""
    hulls = [ah.examples.wigley(), ah.examples.wigley()]
    for hull in hulls:
        put_noise(hull, WIDTH)
    hulls[0].fair(noise=NOISE)
    faired = hulls[0].state.rows.faired.data.copy()
    for hull in hulls:
        with hull.edit("fuller") as edit:
            edit.pull("WL 2.5 x ST 7", 0.05, (30.0, 6.0))
    assert np.array_equal(hulls[0].state.rows.faired.data, faired)
    for hull in hulls:
        hull.fair(noise=NOISE)
    assert displaced(hulls[0], hulls[1].state.rows.xyz.data) < 0.02 * NOISE


def test_a_point_that_is_set_by_hand_is_given_there() -> None:
    """Its neighbours keep their given values."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    hull.fair(noise=NOISE)
    point = hull.points["WL 2.5 x ST 7"]
    faired = hull.state.rows.faired.data.copy()
    assert faired[point.row].any()
    with hull.edit("by hand") as edit:
        edit.move(point, y=point.y + 0.002)
    faired[point.row] = 0.0
    assert np.array_equal(hull.state.rows.faired.data, faired)
    hull.undo()
    assert hull.state.rows.faired.data[point.row].any()


@pytest.mark.parametrize("factor", [2.0, 0.5])
def test_a_transformation_carries_what_was_given(factor: float) -> None:
    """A faired hull of another size is faired by the noise of that size."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    hull.fair(noise=NOISE)
    faired = hull.state.rows.faired.data.copy()
    with hull.edit("another size") as edit:
        edit.transform(scale=[factor] * 3, drivers=["sections", "profile"], planes="follow")
    size = len(faired)
    assert hull.state.rows.faired.data[:size] == pytest.approx(factor * faired, abs=1e-12)
    before = hull.state.rows.xyz.data.copy()
    hull.fair(noise=factor * NOISE)
    assert displaced(hull, before) < 0.02 * factor * NOISE
    hull.undo(2)
    assert np.array_equal(hull.state.rows.faired.data[:size], faired)


def test_since_a_checkpoint_points_are_given_where_they_were_there() -> None:
    """What was done since is noise to it, as far as it looks like noise."""
    hull = ah.examples.wigley()
    hull.checkpoint("as drawn")
    truth = hull.state.rows.xyz.data.copy()
    clean = put_noise(hull, WIDTH)
    hull.fair(noise=0.1e-3, tolerance=0.1e-3, since="as drawn")
    assert error_left(clean, truth, hull) <= 0.1e-3
    with pytest.raises(UnknownNameError, match="nowhere"):
        hull.fair(noise=1e-3, since="nowhere")


def test_it_is_one_operation_of_scripts_previews_and_replay() -> None:
    """And is solved anew on the hull that it is made on."""
    script: list[dict[str, object]] = [
        {"op": "fair", "lines": ["waterlines"], "noise": NOISE, "tolerance": {"WL 2.5": 2e-3}}
    ]
    hull, other = ah.examples.wigley(), ah.examples.wigley()
    for each in (hull, other):
        put_noise(each, WIDTH)
    seen = hull.preview(script)
    assert seen.refused == ()
    assert len(hull.history) == 1
    hull.apply("fair", script)
    assert seen.fingerprint == hull.fingerprint
    steps = hull.document.history[-1].script.edits
    assert steps == ({"op": "fair", **{k: v for k, v in script[0].items() if k != "op"}},)
    other.apply("again", steps)
    assert other.fingerprint == hull.fingerprint


def test_a_trial_changes_nothing_and_tells_the_same() -> None:
    """All but the time."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    print_ = hull.fingerprint
    tried = hull.fair(noise=NOISE, dry_run=True)
    assert hull.fingerprint == print_
    assert not tried.applied
    done = hull.fair(noise=NOISE)
    one, two = tried.data(), done.data()
    assert (one.pop("applied"), two.pop("applied")) == (False, True)
    assert one.pop("seconds") > 0.0
    assert two.pop("seconds") > 0.0
    assert one == two


def test_the_rim_of_a_window_stays() -> None:
    """Nothing moves outside of it, where it fades little, and its middle is faired."""
    hull = ah.examples.wigley()
    truth, clean = hull.state.rows.xyz.data.copy(), put_noise(hull, WIDTH)
    noisy = hull.state.rows.xyz.data.copy()
    report = hull.fair(noise=NOISE, at="WL 3.75 x ST 8", radius=(30.0, 5.0))
    middle = hull.points["WL 3.75 x ST 8"].row
    step = noisy[clean.rows] - truth[middle]
    outside = (np.abs(step[:, 0]) >= 30.0) | (np.hypot(step[:, 1], step[:, 2]) >= 5.0)
    moved = np.linalg.norm(hull.state.rows.xyz.data - noisy, axis=1)[clean.rows]
    assert report.found.unknowns < len(clean.rows)
    assert moved[outside].max() == 0.0
    rim = (np.abs(step[:, 0]) > 24.0) & ~outside
    assert moved[rim].max() < 0.1 * WIDTH
    near = (np.abs(step[:, 0]) < 12.0) & (np.hypot(step[:, 1], step[:, 2]) < 2.0)
    error = [((each - truth)[clean.rows][near] ** 2).sum()
             for each in (noisy, hull.state.rows.xyz.data)]  # fmt: skip
    assert error[1] < 0.5 * error[0]


def test_lines_and_points_that_are_named_to_stay_do() -> None:
    """The rest goes round them."""
    hull = ah.examples.wigley()
    put_noise(hull, WIDTH)
    before = hull.state.rows.xyz.data.copy()
    report = hull.fair(["waterlines"], noise=NOISE, keep=["WL 2.5", "WL 3.75 x ST 7"])
    moved = (hull.state.rows.xyz.data != before).any(axis=1)
    line = hull["WL 2.5"]
    assert isinstance(line, ah.Line)
    for point in (*line.curves[0].points, hull.points["WL 3.75 x ST 7"]):
        assert not moved[point.row]
    assert report.found.stayed["to be kept"] > 10
    assert moved.any()


def test_a_line_alone_is_faired_with_regard_to_those_that_cross_it() -> None:
    """Its own points move, and no others but those that are computed."""
    hull = ah.examples.wigley()
    clean = put_noise(hull, WIDTH)
    before = hull.state.rows.xyz.data.copy()
    report = hull.fair(["WL 3.75"], noise=NOISE)
    line = hull["WL 3.75"]
    assert isinstance(line, ah.Line)
    mine = {point.row for point in line.curves[0].points}
    moved = set(np.flatnonzero((hull.state.rows.xyz.data != before).any(axis=1)).tolist())
    assert moved & set(clean.rows.tolist()) <= mine
    assert report.found.residuals > 2 * report.found.unknowns  # the lines that cross it count too


@pytest.mark.parametrize("name", SHIPS)
def test_volume_and_centre_are_held(name: str, shipped: Shipped) -> None:
    """Volume to 1e-8 of it, LCB to a micrometre; unasked they drift by more."""
    hull = shipped(name)
    put_noise(hull, 1.6e-3)
    before = even_keel_displacement(hull.state)
    hull.fair(noise=1e-3, hold=["volume", "lcb"])
    after = even_keel_displacement(hull.state)
    assert abs(after.volume / before.volume - 1.0) <= 1e-8
    assert abs(after.lcb - before.lcb) <= 1e-6


def test_what_cannot_be_held_is_said_and_the_hull_stays(shipped: Shipped) -> None:
    """A line above the draught moves volume a little, and gives nothing to correct it with."""
    hull = shipped("series60_70")
    print_ = hull.fingerprint
    with pytest.raises(BadInputError, match=r"cannot be held: volume is off by .*let more points"):
        hull.fair(["WL 1.25"], noise=1e-3, hold=["volume", "lcb"])
    assert hull.fingerprint == print_
    before = even_keel_displacement(hull.state)
    report = hull.fair(["WL 0.5"], noise=1e-3, tolerance=0.5e-3, hold=["lcb", "volume"])
    after = even_keel_displacement(hull.state)
    assert report.at_bound
    assert abs(after.volume / before.volume - 1.0) <= 1e-8
    assert abs(after.lcb - before.lcb) <= 1e-6


def test_a_rounded_hull_tells_its_noise() -> None:
    """Half-breadths in whole centimetres: the unit over the root of twelve."""
    hull = ah.examples.wigley()
    rows = fairable_rows(hull.state)
    with hull.edit("rounded") as edit:
        for row in rows.tolist():
            point = ah.Point.of(hull.state, row)
            edit.move(point, y=round(point.y, 2))
    report = hull.fair()
    assert report.found.source == "rounded to 10 mm"
    assert report.noise == pytest.approx(0.01 / np.sqrt(12.0))
    # faired values are given as they were: what is read is still a table in centimetres
    assert hull.fair().found.source == "rounded to 10 mm"


Ask = Callable[[Any], Any]
WRONG: dict[str, tuple[Ask, type[AssocHullError], str]] = {
    "not known": (lambda h: h.fair(), BadInputError, "noise is not known .*0.0.* mm.*auto"),
    "few points": (
        lambda _: ah.examples.wigley(stations=9, waterlines=6).fair(noise="auto"),
        BadInputError, "too few points .*state",
    ),
    "narrow": (
        lambda h: h.fair(noise=0.01, tolerance=0.001), BadInputError,
        "noise is 10 mm and the tolerance 1 mm",
    ),
    "nothing": (
        lambda h: h.fair(noise=0.001, at=(200.0, 0.0, 0.0), radius=(1.0, 1.0)), BadInputError,
        "nothing to move.*on the profile",
    ),
    "all kept": (
        lambda h: h.fair(noise=0.001, keep=[*h.groups["sections"].lines]), BadInputError,
        r"nothing to move.*keep names all 171 points that could move \(.* and 166 more\); keep few",
    ),
    "noise": (lambda h: h.fair(noise=-0.001), BadInputError, "above 0"),
    "word": (lambda h: h.fair(**{"noise": "much"}), BadInputError, "auto"),
    "tolerance": (lambda h: h.fair(noise=0.001, tolerance=0.0), BadInputError, "above 0"),
    "of a line": (lambda h: h.fair(noise=0.001, tolerance={"WL 2.5": -1}), BadInputError, "above"),
    "radius": (lambda h: h.fair(noise=0.001, radius=(9, 9)), BadInputError, "without at"),
    "at": (lambda h: h.fair(noise=0.001, at="WL 2.5 x ST 7"), BadInputError, "without radius"),
    "radii": (
        lambda h: h.fair(noise=0.001, at=(1, 2, 3), radius=(0, 1)), BadInputError, "above 0",
    ),
    "line": (lambda h: h.fair(["WL 99"], noise=0.001), UnknownNameError, "WL 99"),
    "lines": (lambda h: h.fair("WL 2.5", noise=0.001), WrongTypeError, "list"),
    "no lines": (lambda h: h.fair([], noise=0.001), BadInputError, "no line"),
    "hold": (lambda h: h.fair(**{"noise": 0.001, "hold": ["gm"]}), BadInputError, "volume or lcb"),
    "keep": (lambda h: h.fair(noise=0.001, keep=["nobody"]), UnknownNameError, "nobody"),
    "group": (lambda h: h.fair(noise=0.001, keep=["sections"]), AssocHullError, "sections"),
    "trial": (lambda h: h.fair(**{"noise": 0.001, "dry_run": 1}), BadInputError, "dry_run"),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_is_wrong_is_said(case: str) -> None:
    """With what, where and what to do; the hull is as it was."""
    hull = ah.examples.wigley()
    print_ = hull.fingerprint
    ask, kind, words = WRONG[case]
    with pytest.raises(kind, match=words):
        ask(hull)
    assert hull.fingerprint == print_
    assert hull.history == ()


def test_edits_that_since_takes_back_are_named() -> None:
    """Points and edits, not fairing itself; in a window only what lies there."""
    hull = ah.examples.wigley()
    hull.fair(noise=0.2e-3)
    hull.checkpoint("as drawn")
    assert not hull.fair(noise=0.2e-3, since="as drawn", dry_run=True).found.taken_back
    with hull.edit("a fuller shoulder") as edit:
        edit.move("WL 2.5 x ST 7", y=hull.points["WL 2.5 x ST 7"].y + 0.02)
    hull.fair(noise=0.2e-3)
    report = hull.fair(noise=0.2e-3, since="as drawn", dry_run=True)
    (point,) = report.found.taken_back
    assert (point.point, report.found.taken_back_edits) == ("WL 2.5 x ST 7", ("a fuller shoulder",))
    # a point that is put somewhere is given there, whatever fairing had taken it to
    assert point.distance == pytest.approx(0.02, abs=0.1e-3)
    words = "taken back: 1 point moved by 'a fuller shoulder' since the checkpoint"
    assert any(
        note.startswith(words) and "WL 2.5 x ST 7 (20.0 mm)" in note for note in report.notes
    )
    away = hull.fair(noise=0.2e-3, since="as drawn", at="WL 2.5 x ST 16", radius=(10, 2),
                     dry_run=True)  # fmt: skip
    assert not away.found.taken_back
    assert not hull.fair(noise=0.2e-3, dry_run=True).found.taken_back


def test_far_too_much_noise_is_noted() -> None:
    """From three times what the lines look like; what is estimated cannot be."""
    hull = ah.examples.wigley()
    with hull.edit("read off to 5 mm") as edit:
        for crossing in hull.crossings.values():
            if crossing.role == "shared" and crossing.points[0].y > 0.1:
                point = crossing.points[0]
                edit.move(point, y=round(point.y * 200) / 200)
    look = hull.fair(noise="auto", dry_run=True)
    for times, noted in ((2.5, False), (3.5, True)):
        report = hull.fair(noise=times * look.noise, dry_run=True)
        assert any("costs shape" in note for note in report.notes) is noted
    assert not any("costs shape" in note for note in look.notes)


def test_a_hull_that_would_fold_is_refused_with_a_way_out(shipped: Shipped) -> None:
    """Much too much noise: places, and what to do; nothing has changed."""
    hull = shipped("series60_70")
    print_ = hull.fingerprint
    with pytest.raises(RefusedEditError, match="refused") as raised:
        hull.fair(noise=0.1)
    assert "half the noise" in raised.value.findings[-1]
    assert hull.fingerprint == print_


def test_fairing_twice_in_one_edit_is_refused() -> None:
    """Each would be solved for the published hull, and all would move twice."""
    hull = ah.examples.wigley()
    before = hull.fingerprint
    with hull.edit("x") as edit:
        edit.fair(["sections"], noise=0.001)
        with pytest.raises(BadInputError, match="asked for twice"):
            edit.fair(["waterlines"], noise=0.001)
    assert hull.fingerprint != before


def test_a_window_that_is_refused_leaves_the_one_before() -> None:
    """The next step goes on from it; after another edit the window is to be looked at again."""
    hull = ah.examples.wigley()
    window = hull.fair_window(at=(37.0, 3.0, 2.7), radius=(20.0, 4.0))
    points = len(window.to(noise=0.001).rows)
    with pytest.raises(BadInputError, match="nothing to move"):
        window.to(radius=(1e-6, 1e-6))
    assert window.radius == (20.0, 4.0)
    assert len(window.to(noise=0.002).rows) == points
    with hull.edit("between") as edit:
        edit.pull("WL 2.5 x ST 14", 0.01)
    with pytest.raises(BadInputError, match="edited since the last step"):
        window.commit()
    window.to(noise=0.002)
    assert window.commit().found.noise == 0.002
