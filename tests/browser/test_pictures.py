"""Pictures for the documentation, made by the page itself: they are left in build/page."""

import io
from pathlib import Path

from PIL import Image

import assoc_hull as ah
from tests.browser.conftest import Open

POINT = "WL 0.75 x ST 15"
FOLDER = Path(__file__).resolve().parents[2] / "build" / "page"
LARGEST = 150_000  # bytes of an image of the documentation


def test_a_shoulder_in_hand_is_drawn_for_the_documentation(open_page: Open, hull: ah.Hull) -> None:
    """With what follows in red, its combs and its numbers; small enough to be kept."""
    hand = open_page(hull, viewport={"width": 1280, "height": 760})
    hand.page.get_by_role("button", name="Fine").click()
    x, y = hand.press(POINT)
    hand.to(x + 9.0, y)
    assert hand.ask("p => p.store.overlay.frame.curves.size") > 10
    image = Image.open(io.BytesIO(hand.page.screenshot())).convert("RGB")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    seen = image.crop((0, 60, 1000, 740)).getcolors(1 << 20) or []
    reds = sum(n for n, c in seen if isinstance(c, tuple) and c[0] > 180 and max(c[1:]) < 110)
    assert reds > 300
    FOLDER.mkdir(parents=True, exist_ok=True)
    path = FOLDER / "page.png"
    image.quantize(96, dither=Image.Dither.NONE).save(path, optimize=True)
    assert path.stat().st_size < LARGEST
