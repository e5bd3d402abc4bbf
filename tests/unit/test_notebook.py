"""What a notebook shows: views and particulars of a hull, figures, results as text."""

from __future__ import annotations

import io
import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import assoc_hull as ah
from assoc_hull.display import ShownAsText, html_table
from assoc_hull.edit.step import EditReports
from tests.conftest import Shipped

ROOT = Path(__file__).resolve().parents[2]
SVG = "{http://www.w3.org/2000/svg}"


@pytest.mark.parametrize("name", ["wigley", "bulk_carrier", "series60_70"])
def test_a_hull_shows_three_views_and_its_particulars(shipped: Shipped, name: str) -> None:
    """Everything drawn lies on the picture; the name is told to who only hears it."""
    hull = shipped(name)
    bundle = hull._repr_mimebundle_()
    picture = ElementTree.fromstring(bundle["image/svg+xml"])
    size = np.array(picture.attrib["viewBox"].split()[2:], float)
    title = picture.find(f"{SVG}title")
    assert title is not None
    assert str(title.text).startswith(hull.particulars.name)
    for path in picture.iter(f"{SVG}path"):
        for run in path.attrib["d"].split("M")[1:]:
            begin, steps = run.split("c")
            place = np.array(begin.split(), float)
            for segment in np.array(steps.split(), float).reshape(-1, 3, 2):
                place = place + segment[-1]
                assert (place >= 0.0).all()
                assert (place <= size).all()
    assert f"{hull.particulars.length:.3f} m" in bundle["text/html"]
    assert bundle["text/plain"] == repr(hull)


def test_a_name_with_markup_is_text() -> None:
    """It is shown as it was given."""
    assert '<th style="text-align:left">&lt;b&gt;</th>' in html_table(("<b>", ""), [])


def test_figures_show_themselves() -> None:
    """Without a magic, whether pyplot was imported or not."""
    figure = ah.examples.wigley().plot.lines_plan(paper="A4")
    shown = Image.open(io.BytesIO(figure._repr_png_()))  # type: ignore[attr-defined]
    assert shown.width > 800
    assert len(shown.convert("L").getcolors() or []) > 2


def test_names_are_completed_in_brackets() -> None:
    """Of a hull: lines, then groups; of what it holds: the names."""
    hull = ah.examples.wigley()
    found = hull._ipython_key_completions_()
    assert {"WL 2.5", "waterlines"} <= set(found)
    assert hull.lines._ipython_key_completions_() == list(hull.lines)  # type: ignore[attr-defined]
    assert hull.points._ipython_key_completions_() == list(hull.points)


def test_results_are_shown_as_they_are_printed() -> None:
    """At a prompt of IPython and in a notebook."""
    hull = ah.examples.wigley()
    with hull.edit("a pull") as edit:
        edit.pull("WL 2.5 x ST 5", 0.02)
    shown = list[str]()

    class Printer:
        def text(self, obj: str, /) -> None:
            shown.append(obj)

    shown_results = (edit.report, hull.hydrostatics(), hull.fairness(), hull.why("WL 2.5 x ST 5"))
    for each in shown_results:
        assert isinstance(each, ShownAsText)
        each._repr_pretty_(Printer(), cycle=False)
    assert shown == [str(each) for each in shown_results]


@pytest.fixture(scope="module")
def results() -> dict[str, object]:
    """Give what a person asks of a hull, by the name of the question."""
    hull = ah.examples.wigley(stations=9, waterlines=6)
    with hull.edit("a pull") as edit:
        edit.pull("WL 2.5 x ST 5", 0.02)
    wide = hull.vary(set={"breadth": 10.2})
    return {
        "hull": hull,
        "document": hull.document,
        "state": hull.state,
        "history": hull.history,
        "report": hull.history[0],
        "hydrostatics": hull.hydrostatics(),
        "table": hull.hydrostatic_table([3.0, 4.0]),
        "stability": hull.stability(kg=4.0),
        "fairness": hull.fairness(),
        "why": hull.why("WL 2.5 x ST 5"),
        "parameters": hull.form_parameters(),
        "variation": wide,
        "comparison": hull.compare(wide.hull),
        "study": hull.study(set={"breadth": [9.5, 10.5]}),
    }


RESULTS = (
    "hull", "document", "state", "history", "report", "hydrostatics", "table", "stability",
    "fairness", "why", "parameters", "variation", "comparison", "study",
)  # fmt: skip


@pytest.mark.parametrize("name", RESULTS)
def test_every_repr_fits_a_screen(results: dict[str, object], name: str) -> None:
    """In a plain prompt a few lines, in IPython a screen, in a notebook a place that scrolls."""
    found = results[name]
    assert len(repr(found)) <= 200
    assert "\n" not in repr(found)
    shown = list[str]()

    class Printer:
        def text(self, obj: str, /) -> None:
            shown.append(obj)

    if hasattr(found, "_repr_pretty_"):
        found._repr_pretty_(Printer(), cycle=False)
        assert len(shown[0].splitlines()) <= 40
    if hasattr(found, "_repr_html_"):
        html = found._repr_html_()
        assert "max-height" in html or html.count("<tr>") <= 50
        ElementTree.fromstring(f"<div>{html}</div>")


def test_the_history_is_a_table_of_its_edits(results: dict[str, object]) -> None:
    """Number, name, curves that followed, the largest movement in mm; empty it is the tuple ()."""
    history = results["history"]
    assert isinstance(history, EditReports)
    (report,) = history
    assert report.largest is not None
    html = history._repr_html_()
    assert ">a pull<" in html
    assert f">{1e3 * report.largest.distance:.1f}<" in html
    assert ah.examples.wigley().history == ()
    assert repr(EditReports()) == "()"


def test_a_comparison_and_a_study_are_tables(results: dict[str, object]) -> None:
    """Rows of lines that moved and of numbers that differ; a row for each variant, with units."""
    comparison, study = results["comparison"], results["study"]
    assert comparison._repr_html_().count("<table>") == 3  # type: ignore[attr-defined]
    html = study._repr_html_()  # type: ignore[attr-defined]
    assert html.count("<tr>") == 3
    assert ">9.5<" in html
    assert ">volume, m3<" in html


def test_hydrostatics_print_what_they_are_with_unit_and_doubt() -> None:
    """Symbol, value, how far it may be off, and what it is; what has no value is left out."""
    record = ah.examples.wigley().hydrostatics()
    lines = str(record).splitlines()
    assert lines[0].split()[:3] == ["∇", f"{record.volume:,.2f}", "m3"]
    assert record.gmt is None
    assert not any(line.startswith("GM") for line in lines)
    assert record._repr_html_().count("<tr>") == len(lines) + 1


def test_the_example_notebook_holds_what_its_cells_show_now() -> None:
    """Each cell runs, and a result is kept as it shows itself; `make site` writes it anew."""
    kept = json.loads((ROOT / "docs" / "hull.ipynb").read_text("utf-8"))
    space: dict[str, object] = {}
    compared = 0
    for cell in kept["cells"]:
        if cell["cell_type"] != "code" or "raises-exception" in cell["metadata"].get("tags", ()):
            continue
        *before, last = cell["source"].splitlines()
        exec("\n".join(before), space)
        found = eval(last, space)
        (output,) = cell["outputs"]
        if hasattr(found, "_repr_mimebundle_"):
            assert output["data"]["text/html"] == found._repr_mimebundle_()["text/html"]
        elif hasattr(found, "_repr_html_"):
            assert output["data"]["text/html"] == found._repr_html_()
        else:
            assert output["data"]["text/plain"] == repr(found)
        compared += 1
    assert compared >= 5
