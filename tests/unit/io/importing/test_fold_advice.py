"""What an import says of a line that folds: an option that helps, as nothing was edited."""

import pytest

import assoc_hull as ah
from assoc_hull.edit.checks.finding import Finding
from assoc_hull.io.importing import soundness
from assoc_hull.io.importing.verdict import Findings


@pytest.mark.parametrize(
    ("length", "sized", "scale"), [(100.0, False, False), (6.0, False, True), (6.0, True, False)]
)
def test_a_fold_is_told_with_what_an_import_can_do(
    length: float, sized: bool, scale: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Undo is no remedy of an import; of a hull as short as models are their scale is asked for.

    Not where her length is known.
    """
    fold = Finding(
        "fold", "BTK 1", (1.0, 2.0, 3.0), -0.3, "folds back (cosine -0.3): move the points, or undo"
    )
    monkeypatch.setattr(soundness, "check", lambda _: (fold,))
    state = ah.examples.wigley(length=length, breadth=0.1 * length, draught=0.0625 * length).state
    found = Findings()
    soundness._examine_checks(state, found, sized=sized)
    (told,) = found.faults
    assert "folds back (cosine -0.3): " in told.what
    assert "undo" not in told.what
    assert ("give scale=" in told.what) == scale
