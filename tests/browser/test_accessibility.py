"""Rules of accessibility, by axe-core: the page breaks none, in both themes and in each state."""

import pytest

import assoc_hull as ah
from tests.browser.conftest import AXE, Hand, Open

POINT = "WL 0.625 x ST 16"


LOOKED_AT = {"color-contrast", "button-name", "region", "target-size"}


def findings(hand: Hand, *, behind: bool = False) -> list[str]:
    """What axe finds: the rule, and where; what lies behind a sheet has no contrast to judge."""
    kept, found = hand.page.evaluate(
        "async () => { const r = await axe.run(document, {runOnly:"
        " ['wcag2a', 'wcag2aa', 'wcag21aa',"
        " 'wcag22aa', 'best-practice']}); return [r.passes.map(p => p.id),"
        " r.violations.flatMap(v => v.nodes.map(n => v.id + ' ' + n.target))]; }"
    )
    assert set(kept) >= LOOKED_AT - ({"color-contrast"} if behind else set())
    return [str(each) for each in found]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [1440, 390])
def test_no_rule_is_broken(open_page: Open, hull: ah.Hull, theme: str, width: int) -> None:
    """At the start, with a point chosen, with a refusal, and with the sheet of keys."""
    hand = open_page(hull, color_scheme=theme, viewport={"width": width, "height": 840})
    hand.page.add_script_tag(path=AXE)
    assert findings(hand) == []
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.ask("(p, name) => p.apply('far', [{op: 'move', point: name, y: 400}])", POINT)
    hand.page.wait_for_selector(".bubble")
    hand.ask("p => { for (const t of Object.keys(p.panel.parts)) p.panel.open(t); }")
    hand.page.get_by_text("List the waviest lines").click()
    for title in ("Fair", "Hydrostatics"):
        hand.page.locator(f"details:has(h2:text-is('{title}')) table").wait_for()
    assert findings(hand) == []
    hand.page.get_by_role("button", name="Keys").click()
    assert findings(hand, behind=True) == []
