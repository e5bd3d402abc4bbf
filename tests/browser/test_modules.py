"""Modules of the page that need no browser, run by node's own test runner."""

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np

import assoc_hull as ah
from assoc_hull.geometry.splines.segments import evaluate
from assoc_hull.page.app import static_files
from assoc_hull.page.wire import Frame, FrameKind, pack

TESTS = Path(__file__).parent / "modules"


def test_pure_modules_agree_with_the_library(hull: ah.Hull, tmp_path: Path) -> None:
    """Frames, places along curves, foresight, keys: against values of Series 60."""
    node = shutil.which("node")
    assert node is not None, "node is missing: apt-get install nodejs"
    for name, (body, _) in static_files().items():
        if name.endswith(".js"):
            (tmp_path / name).write_bytes(body)
    for each in TESTS.iterdir():
        shutil.copy(each, tmp_path)
    (tmp_path / "package.json").write_text('{"type": "module"}')
    state, shapes = hull.state, hull.shapes()
    rows, spline = state.live("rows"), shapes.spline
    frame = Frame(FrameKind.NET, state.number, shapes.curves, spline, rows, state.rows.xyz[rows])
    (tmp_path / "net.frame").write_bytes(pack(frame))
    rng, counts = np.random.default_rng(3), np.diff(spline.start)
    at = rng.integers(0, spline.count, 200)
    segment, u = rng.integers(0, counts[at] - 1), rng.random(200)
    first = spline.start[at] + segment
    knots = spline.knot
    places = evaluate(spline, at, knots[first] + u * (knots[first + 1] - knots[first]))
    given = {
        "curves": shapes.curves.tolist(), "counts": counts.tolist(), "rows": rows.tolist(),
        "places": [
            {"id": int(shapes.curves[i]), "segment": int(j), "u": float(w), "place": p.tolist()}
            for i, j, w, p in zip(at, segment, u, places, strict=True)
        ],
    }  # fmt: skip
    (tmp_path / "given.json").write_text(json.dumps(given))
    done = subprocess.run(
        [node, "--test", "pure.test.js"], cwd=tmp_path, capture_output=True, text=True, timeout=60,
        check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout
