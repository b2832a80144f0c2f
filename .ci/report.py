"""Opens the reports in folders of FOLDER with Chromium: no error on the console, no request but the file itself,
figures that are there and not empty, histories that zoom and tell values. Leaves a screen of each page, wide and
narrow.

    report.py FOLDER
"""

import pathlib, re, shutil, sys

from playwright.sync_api import Page, sync_playwright

# folder, figures, those over time, what the page says
PAGES = [
    ("frame", 6, 3, "It rocks and stands"),
    ("overturns", 4, 3, "The structure overturns at t = 4.4"),
    ("stands", 4, 3, "The record does not lift the structure"),
    ("kaikoura", 4, 3, "leaves the ground"),
    ("without_figures", 0, 0, "It rocks and stands"),
    ("without_record", 0, 0, "without a record"),
]
LARGEST = 2_000_000


def figures(page: Page, name: str, wanted: int) -> None:
    all = page.locator("figure svg.sheet")
    assert all.count() == wanted, f"{name}: {all.count()} figures, {wanted} wanted"
    for i in range(wanted):
        figure = all.nth(i)
        figure.scroll_into_view_if_needed()
        box = figure.bounding_box()
        assert box and box["width"] > 500 and box["height"] > 250, f"{name}: figure {i} is {box}"
        drawn = figure.evaluate(
            """svg => [...svg.querySelectorAll(":scope > polyline, :scope > circle, :scope > polygon")]\
.filter(shape => {
                const box = shape.getBoundingClientRect();
                return box.width + box.height > 2;
            }).length"""
        )
        assert drawn > 10, f"{name}: figure {i} shows {drawn} shapes"


def shown(figure) -> tuple[float, float]:
    return float(figure.get_attribute("data-from")), float(figure.get_attribute("data-to"))


def history(page: Page, name: str, figure) -> None:
    """Values under the pointer, zoom by a drag, by the wheel, by buttons, and back."""
    svg = figure.locator("svg.sheet")
    svg.scroll_into_view_if_needed()
    box = svg.bounding_box()
    # the whole first panel in view
    page.mouse.wheel(0, box["y"] - 80)
    page.wait_for_timeout(150)
    box = svg.bounding_box()
    x = lambda share: box["x"] + share * box["width"]
    y = box["y"] + 0.35 * box["height"]
    whole = shown(figure)
    page.mouse.move(x(0.5), y)
    tip = figure.locator(".tip")
    assert tip.is_visible(), f"{name}: no values under the pointer"
    text = tip.inner_text()
    assert re.search(r"t = \d+\.\d+ s", text) and re.search(r"[\d.]{4,}", text.split("\n", 1)[1]), f"{name}: {text!r}"
    page.mouse.down()
    page.mouse.move(x(0.6), y, steps=4)
    page.mouse.up()
    dragged = shown(figure)
    assert whole[0] < dragged[0] < dragged[1] < whole[1], f"{name}: {whole} stays {dragged} after a drag"
    assert figure.locator("g.zoomed polyline").count() >= 2, f"{name}: nothing is drawn zoomed"
    page.keyboard.down("Control")
    page.mouse.wheel(0, -100)
    page.keyboard.up("Control")
    page.wait_for_timeout(100)
    wheeled = shown(figure)
    assert wheeled[1] - wheeled[0] < dragged[1] - dragged[0], f"{name}: {dragged} stays {wheeled} after the wheel"
    page.mouse.move(x(0.4), y)
    assert re.search(r"t = \d", tip.inner_text())
    page.screenshot(path=f"{page.screens}/{name}-zoomed.png")
    figure.get_by_role("button", name="Later").click()
    assert shown(figure)[0] > wheeled[0], f"{name}: later is not later"
    figure.get_by_role("button", name="Show all").click()
    assert shown(figure) == whole and figure.locator("g.zoomed *").count() == 0
    svg.dblclick(position={"x": 0.5 * box["width"], "y": 0.35 * box["height"]})
    page.mouse.move(2, 2)
    assert not tip.is_visible(), f"{name}: the values stay when the pointer goes"


def check(browser, folder: pathlib.Path, name: str, wanted: int, live: int, words: str) -> None:
    file = folder / name / "report.html"
    size = file.stat().st_size
    assert size < LARGEST, f"{name}: {size} bytes"
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    page.screens = folder
    errors, requests = [], []
    page.on("console", lambda message: errors.append(message.text) if message.type in ("error", "warning") else None)
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("request", lambda request: requests.append(request.url))
    page.goto(file.resolve().as_uri())
    assert words in page.inner_text("body"), f"{name}: {words!r} is not said"
    assert page.locator("#verdict").is_visible() and page.locator("#springs table").is_visible()
    figures(page, name, wanted)
    histories = page.locator("figure.live")
    assert histories.count() == live, f"{name}: {histories.count()} figures over time"
    for i in range(live):
        history(page, f"{name}-{i}", histories.nth(i))
    page.screenshot(path=folder / f"{name}.png", full_page=True)
    page.set_viewport_size({"width": 480, "height": 900})
    wide = page.evaluate("document.documentElement.scrollWidth")
    assert wide <= 480, f"{name}: {wide} pixels wide on a small screen"
    page.screenshot(path=folder / f"{name}-narrow.png", full_page=True)
    page.pdf(path=folder / f"{name}.pdf", format="A4", prefer_css_page_size=True)
    asked = [url for url in requests if url != file.resolve().as_uri() and not url.startswith("data:")]
    assert not asked, f"{name}: asks for {asked}"
    assert not errors, f"{name}: {errors}"
    page.close()
    print(f"{name}: {size // 1000} kB, {wanted} figures, {live} of them zoom; no error, no request")


def main() -> None:
    folder = pathlib.Path(sys.argv[1])
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        for page in PAGES:
            check(browser, folder, *page)
        browser.close()


main()
