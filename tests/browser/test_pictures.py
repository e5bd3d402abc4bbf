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


def test_a_point_that_is_dragged_is_a_short_moving_picture(open_page: Open, hull: ah.Hull) -> None:
    """Out and back: what follows moves in each frame, and in the last it is as in the first."""
    hand = open_page(hull, viewport={"width": 1280, "height": 760})
    hand.page.get_by_role("button", name="Fine").click()
    x, y = hand.press(POINT)
    frames = list[Image.Image]()
    for away in (0, 5, 10, 14, 10, 5):
        hand.to(x + away, y)
        shot = Image.open(io.BytesIO(hand.page.screenshot())).convert("RGB")
        frames.append(shot.crop((0, 40, 1016, 735)).resize((680, 465), Image.Resampling.LANCZOS))
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    assert len({each.tobytes() for each in frames}) > 3
    FOLDER.mkdir(parents=True, exist_ok=True)
    path, colours = FOLDER / "page_drag.gif", frames[3].quantize(56, dither=Image.Dither.NONE)
    small = [each.quantize(palette=colours, dither=Image.Dither.NONE) for each in frames]
    small[0].save(path, save_all=True, append_images=small[1:], duration=220, loop=0, optimize=True)
    assert path.stat().st_size < LARGEST
