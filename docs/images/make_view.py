"""Makes the pictures of the page on the live view: python docs/images/make_view.py

Needs chromium and playwright; the page has 1280 x 800 pixels.
"""

import shutil
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

import pymlt as mlt

HERE = Path(__file__).parent
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PATIENCE = 120_000  # milliseconds


def wait_for(page, condition):
    end = time.monotonic() + PATIENCE / 1000
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError
        page.wait_for_timeout(100)


def quiet(page):
    """Take away what the browser says about its graphics."""
    page.add_style_tag(content=".mantine-Notifications-root { display: none }")
    page.wait_for_timeout(1500)


def main():
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(256, 256))
    with sync_playwright() as play, mlt.view(scene, "path", port=0) as view:
        browser = play.chromium.launch(executable_path=chromium, args=FLAGS)
        page = browser.new_page(viewport={"width": 1280, "height": 800})
        page.set_default_timeout(PATIENCE)
        page.goto(view.url)
        page.wait_for_selector("p.mlt[data-state]", state="attached")
        (session,) = view.sessions
        wait_for(page, lambda: session.live.jobs and session.live.jobs[0].samples > 16)
        session.post(session.live.stop)
        page.get_by_role("tab", name="Paths").click()
        session.post(lambda: session.inspector.inspect((90, 218)))
        wait_for(page, lambda: session.inspector._path is not None)
        quiet(page)
        page.screenshot(path=HERE / "view.jpg", type="jpeg", quality=85)
        page.get_by_role("tab", name="Lecture").click()
        page.locator("p[data-example]").wait_for()
        session.lecture._choice.value = "Mixture"
        wait_for(page, lambda: len(session.lecture._charts) == 2)
        quiet(page)
        page.screenshot(
            path=HERE / "view-lecture.png", clip={"x": 893, "y": 0, "width": 387, "height": 800}
        )
        browser.close()


if __name__ == "__main__":
    main()
