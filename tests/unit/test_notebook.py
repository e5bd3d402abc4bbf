"""What a notebook shows: views and particulars of a hull, figures, results as text."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PIL import Image

import assoc_hull as ah
from assoc_hull.display import ShownAsText, html_table
from tests.conftest import Shipped

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

    results = (edit.report, hull.hydrostatics(), hull.fairness(), hull.why("WL 2.5 x ST 5"))
    for each in results:
        assert isinstance(each, ShownAsText)
        each._repr_pretty_(Printer(), cycle=False)
    assert shown == [str(each) for each in results]


def test_hydrostatics_print_what_they_are_with_unit_and_doubt() -> None:
    """Symbol, value, how far it may be off, and what it is; what has no value is left out."""
    record = ah.examples.wigley().hydrostatics()
    lines = str(record).splitlines()
    assert lines[0].split()[:3] == ["∇", f"{record.volume:,.2f}", "m3"]
    assert record.gmt is None
    assert not any(line.startswith("GM") for line in lines)
    assert record._repr_html_().count("<tr>") == len(lines) + 1
