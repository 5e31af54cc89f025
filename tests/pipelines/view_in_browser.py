# SPDX-License-Identifier: BSD-3-Clause
"""Opens a page of `posevote view` in headless Chromium, turns, ticks, filters and clicks as a user
would. view_in_browser.py PAGE PICTURES [--without-webgl]; exit status 1 and words where it fails.

The page shows a run of two models on three scans with true poses and votes: both are found in the
first, obj_000001 alone in the second; the third failed."""
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from webdriver import Browser  # noqa: E402

SOFTWARE = ["--use-angle=swiftshader", "--use-gl=angle", "--enable-unsafe-swiftshader"]
STAGE = ".stage canvas"


def check(holds, words):
    if not holds:
        raise AssertionError(words)


def wait_for(test, words, seconds=20):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if test():
            return
        time.sleep(0.1)
    raise AssertionError(words)


def load(browser, page):
    begin = time.monotonic()
    browser.open(page.resolve().as_uri())
    wait_for(lambda: browser.count(".panel h4"), "no scan is shown")
    return time.monotonic() - begin


def settled(browser):
    """The picture of the scan once it is drawn."""
    before, now = None, browser.picture(STAGE)
    while before != now:
        time.sleep(0.3)
        before, now = now, browser.picture(STAGE)
    return now


def check_turning(browser):
    before = settled(browser)
    browser.drag(STAGE, 120, 40)
    wait_for(lambda: before != browser.picture(STAGE), "dragging does not turn the view")


def check_ticks(browser):
    browser.rest()  # what the mouse points to is lit up
    for kind in ("found", "scan", "truth", "votes"):
        before = settled(browser)
        for change in (lambda now: now != before, lambda now: now == before):
            browser.click(f".panel label[data-kind={kind}] input")
            browser.rest()
            wait_for(lambda: change(browser.picture(STAGE)),
                     f"ticking {kind} does not take it away and bring it back")


def check_cards(browser):
    cards = browser.count(".card")
    check(cards == 3, f"{cards} cards, not 3")
    choose = ("const select = document.querySelectorAll('.filters select')[arguments[0]];"
              "select.value = arguments[1]; select.dispatchEvent(new Event('change'))")
    browser.run(choose, 0, "failed")
    check(browser.count(".card") == 1, "the filter leaves no single failed scan")
    browser.click(".card")
    check("Failed in load_scene" in browser.text(".panel"), "a failure is not told")
    browser.run(choose, 0, "not found")
    browser.run(choose, 1, "1")
    check(browser.count(".card") == 1, "the filter by model leaves no single card")
    browser.click(".card")
    check("obj_000002" in browser.text(".panel .missing-models"), "a model not found is not told")
    browser.run(choose, 0, "all")
    browser.run(choose, 1, "-1")
    browser.type(".filters input", "no such scan")
    check(browser.count(".card") == 0, "the text does not filter")
    browser.run("const box = document.querySelector('.filters input'); box.value = '';"
                "box.dispatchEvent(new Event('input'))")
    browser.run(choose, 2, "failures first")
    check("failed" in browser.text(".card"), "the order does not put the failure first")
    browser.run(choose, 2, "as they came")


def check_details(browser):
    browser.click(".card")
    browser.click(".panel details summary")
    details = browser.text(".panel details")
    for words in ("T_scene_model", "quaternion", "confidence", "agreement"):
        check(words in details, f"the details say nothing of {words}")
    check("of" in browser.text(".shown") and "points" in browser.text(".shown"),
          "the true count of points is not told")


def check_thumbnails(browser):
    drawn = ("return [...document.querySelectorAll('.card canvas')].filter(canvas => "
             "new Set(canvas.getContext('2d').getImageData(0, 0, 256, 192).data).size > 20).length")
    browser.run("document.querySelector('.cards').scrollIntoView()")
    wait_for(lambda: browser.run(drawn) >= 2, "the thumbnails are not drawn")


def use(page, pictures):
    with Browser(SOFTWARE) as browser:
        print(f"opens in {load(browser, page):.2f} s")
        check_turning(browser)
        check_ticks(browser)
        pictures.joinpath("view.png").write_bytes(browser.picture(".view"))
        check_thumbnails(browser)
        pictures.joinpath("cards.png").write_bytes(browser.picture())
        check_details(browser)
        check_cards(browser)
        check(not browser.complaints(), "the console is not empty")


def use_without_webgl(page, pictures):
    with Browser(["--disable-gpu", "--disable-3d-apis"]) as browser:
        load(browser, page)
        check("no WebGL" in browser.text(".missing"), "it is not told that there is no WebGL")
        check(browser.count(".panel label[data-kind=found]") > 0, "what was found is not told")
        pictures.joinpath("without_webgl.png").write_bytes(browser.picture())


def main():
    page, pictures = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    pictures.mkdir(parents=True, exist_ok=True)
    try:
        (use_without_webgl if "--without-webgl" in sys.argv else use)(page, pictures)
    except AssertionError as error:
        sys.exit(f"{page}: {error}")


main()
