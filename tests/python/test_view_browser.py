"""The live view in a browser: Debian's chromium without a window, driven by playwright."""

import contextlib
import dataclasses
import os
import re
import shutil
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import pymlt as mlt
from pymlt.algorithms.integrators import integrator_schema
from pymlt.pictures.tonemapping import stops_of
from pymlt.viewing import lecture, shown

pytest.importorskip("viser", reason="the view needs viser (pip install viser)")
playwright = pytest.importorskip("playwright.sync_api", reason="playwright drives the browser")

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PATIENCE = 100  #: seconds: WebGL in software, on a machine that may have more to do
WINDOW = {"width": 1000, "height": 560}
LEFT = {"x": 0, "y": 180, "width": 600, "height": 370}  #: of the window, without messages and panel

pytestmark = [
    pytest.mark.skipif(CHROMIUM is None, reason="there is no chromium (apt-get install chromium)"),
    pytest.mark.filterwarnings("ignore:Queued a .* on a closed connection"),
]


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as play:
        made = play.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield made
        made.close()


def until(page, condition, what: str):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, what
        page.wait_for_timeout(50)


class Tab:
    """A page of the view and its session; renders of other pages are stopped."""

    def __init__(self, browser, view):
        known = view.sessions
        for session in known:
            session.post(session.live.stop)
        self.page = browser.new_page(viewport=WINDOW)
        self.page.set_default_timeout(1000 * PATIENCE)
        self.errors = []
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.goto(view.url)
        self.page.wait_for_selector("p.mlt[data-state]", state="attached")
        (self.session,) = [session for session in view.sessions if session not in known]

    def until(self, condition, what: str):
        until(self.page, condition, what)

    def open(self, name: str):
        self.page.get_by_role("tab", name=name).click()

    def press(self, name: str):
        self.page.get_by_role("button", name=name, exact=True).click()

    def drag(self, x: int, y: int):
        mouse = self.page.mouse
        mouse.move(300, 300)
        mouse.down()
        mouse.move(300 + x, 300 + y, steps=3)
        mouse.up()

    def message(self, text: str):
        """Waits for a message with this text."""
        self.page.get_by_text(re.compile(re.escape(text))).first.wait_for()

    def no_message(self, text: str):
        """Waits until it is gone since it is mended; they all go away after a while."""
        self.until(lambda: not self.session._complaints, f"{text!r} is not mended")
        self.page.get_by_text(re.compile(re.escape(text))).first.wait_for(state="detached")

    def picture(self) -> np.ndarray:
        """The pixels of the left part of the window, linear."""
        return mlt._core.decode_image(self.page.screenshot(clip=LEFT), "screenshot.png")

    def settled_picture(self) -> np.ndarray:
        """One that has not changed for half a second."""
        pictures = [self.picture()]

        def settled() -> bool:
            self.page.wait_for_timeout(500)
            pictures.append(self.picture())
            return np.array_equal(*pictures[-2:])

        self.until(settled, "the picture goes on changing")
        return pictures[-1]

    def samples(self) -> float:
        jobs = self.session.live.jobs
        return jobs[0].samples if jobs else 0.0


@pytest.fixture(scope="module")
def view():
    """Renders on one processor, since the browser draws on the other."""
    scene = mlt.load_dict(mlt.scenes.glass_ball(), size=(96, 96))
    with mlt.view(scene, "path", port=0, threads=1) as made:
        yield made


@pytest.fixture(scope="module")
def tab(browser, view):
    return Tab(browser, view)


def neighbours(picture: np.ndarray) -> float:
    """The median difference of neighbouring pixels: noise, mostly, and no spark."""
    return float(np.median(abs(picture[:, 1:] - picture[:, :-1])))


def test_the_page_opens_and_the_image_refines(tab):
    tab.until(lambda: tab.picture().mean() > 0.02, "the window stays dark")
    tab.session.post(tab.session.restart)
    tab.until(lambda: tab.session.live.small is not None, "no first picture")
    noisy = neighbours(tab.session.live.small)
    early = tab.picture()
    tab.until(lambda: tab.samples() > 30, "no samples")
    assert neighbours(tab.session.live.image()) < 0.8 * noisy
    tab.until(lambda: (tab.picture() != early).any(), "the picture stays as it is")
    assert "spp" in tab.page.locator("p.mlt[data-state] + div").first.inner_text()
    assert not tab.errors


def test_a_move_restarts_the_render_with_a_picture_at_once(tab):
    session, moves = tab.session, []
    restart, send = session.restart, session._send
    session.restart = lambda: (moves.append([time.monotonic(), None]), restart())

    def sent():
        send()
        if moves and moves[-1][1] is None:
            moves[-1][1] = time.monotonic()

    session._send = sent
    before, scene = tab.picture(), session.scene()
    for step in range(3):
        tab.drag(60 + 10 * step, 25)
        tab.until(lambda: tab.samples() > 1, "no render after the move")
    assert session.pose is not None
    assert session.scene().info()["triangles"] == scene.info()["triangles"]
    tab.until(lambda: abs(tab.picture() - before).mean() > 0.005, "the picture is the same")
    waits = [end - start for start, end in moves if end is not None]
    assert waits, "no move had a picture"
    session.restart, session._send = restart, send
    tab.press("Scene's view")
    tab.until(lambda: session.pose is None, "the camera does not come back")


def test_the_keys_that_the_panel_lists_move_the_camera(tab):
    tab.page.get_by_text("Mouse and keys").click()
    for said in ("forward, back", "left, right", "down, up"):
        tab.page.get_by_text(said, exact=True).wait_for()
    tab.page.get_by_text("Mouse and keys").click()
    camera = tab.session.client.camera
    tab.page.mouse.move(300, 300)
    for key in ("w", "a", "e", "ArrowLeft"):
        before = np.array(camera.position)
        tab.page.keyboard.down(key)
        tab.until(lambda at=before: abs(camera.position - at).max() > 0, f"{key} does not move it")
        tab.page.keyboard.up(key)
    tab.press("Scene's view")
    tab.until(lambda: tab.session.pose is None, "the camera does not come back")


def test_a_click_shows_the_paths_through_a_pixel(tab):
    assert tab.page.title() == "pymlt"
    tab.page.mouse.click(300, 400)
    tab.page.get_by_role("tab", name="Paths", selected=True).wait_for()
    tab.until(lambda: tab.session.inspector._found is not None, "no click arrived")
    found = tab.session.inspector._found
    tab.until(lambda: tab.session.inspector._path is not None, "no path")
    x, y = tab.session.camera.pixel(tab.session.frame().place(300 / 616, 400 / 560))
    assert abs(found.pixel[0] - x) <= 2
    assert abs(found.pixel[1] - y) <= 2
    assert tab.session.inspector.pixel == found.pixel  # which has a mark
    tab.page.get_by_text(tab.session.inspector._path.signature).first.wait_for()
    tab.page.get_by_text("found it").first.wait_for()
    tab.session.live.stop()
    with_paths = tab.picture()
    tab.session.post(lambda: [tab.session.inspector._lines.clear(n) for n in ("all", "chosen")])
    tab.until(lambda: abs(tab.picture() - with_paths).mean() > 1e-3, "the path is not drawn")


def test_paths_are_drawn_by_signature(tab):
    inspector = tab.session.inspector
    post, lines = tab.session.post, inspector._lines

    def edges() -> int:
        node = lines._nodes.get("all")
        return 0 if node is None else len(node.batched_positions)

    def tubes(paths) -> int:
        """All edges but those to the lens."""
        return sum(path.edges - 1 for path in paths)

    post(lambda: inspector.inspect((48, 60)))
    tab.until(lambda: inspector._found is not None and edges() > 0, "no paths are drawn")
    most = tubes(inspector._found.some(24))
    tab.until(lambda: edges() == most, "not 24 of them")
    first = next(iter(inspector._found.signatures()))
    few = tubes(inspector._found.of(first)[:24])
    assert few != most
    post(lambda: setattr(inspector._kind, "value", first))
    tab.until(lambda: edges() == few, "not those of one signature")
    post(lambda: setattr(inspector._kind, "value", "none"))
    tab.until(lambda: not lines._nodes, "paths are still drawn")
    post(lambda: setattr(inspector._kind, "value", "all"))
    tab.until(lambda: edges() == most, "the paths do not come back")


def test_paths_are_hidden_while_another_tab_is_open(tab):
    tab.session.live.stop()
    tab.until(lambda: not tab.session.live.running, "no end")
    tab.open("Paths")
    paths = tab.session.inspector._lines._root
    tab.until(lambda: paths.visible, "no paths")
    with_paths = tab.settled_picture()
    tab.open("Render")
    tab.until(lambda: not paths.visible, "the paths stay")
    tab.until(lambda: abs(tab.picture() - with_paths).mean() > 1e-3, "their picture stays")
    tab.open("Paths")
    tab.until(lambda: paths.visible, "they do not come back")
    assert not tab.page.get_by_text("Paths is open").is_visible()


def test_the_render_tab_explains_and_tells_the_error(tab):
    tab.open("Render")
    about = tab.page.locator("p[data-about]")
    assert about.inner_text() == integrator_schema("path")["doc"]
    status = tab.page.locator("p.mlt[data-state] + div").first
    tab.session.post(tab.session.restart)
    tab.until(lambda: re.search(r"± [\d.e-]+ %", status.inner_text()), "no error")
    tab.page.get_by_text("Compare with").wait_for()


def test_the_exposure_fits_the_picture(tab):
    live, controls = tab.session.live, tab.session.controls
    tab.until(lambda: live.image() is not None, "no picture")
    stops = stops_of("auto", live.image())
    tab.session.post(lambda: setattr(controls._exposure, "value", -8.0))
    tab.until(lambda: controls.look().exposure == -8, "the slider has no effect")
    tab.press("Fit exposure")
    tab.until(lambda: abs(controls.look().exposure - stops) < 1, "the exposure does not fit")
    tab.session.post(lambda: setattr(controls._exposure, "value", 0.0))
    tab.until(lambda: controls.look().exposure == 0, "the slider does not return")


def test_a_picture_can_be_denoised(tab):
    pytest.importorskip("pyoidn", reason="denoising needs pyoidn (pip install pyoidn)")
    live, pictures, look = tab.session.live, tab.session.pictures, tab.session.controls.look()
    tab.until(lambda: live.image() is not None, "no picture")
    live.stop()
    tab.until(lambda: not live.running, "no end")
    noisy = pictures.make(look, None).astype(float)
    tab.session.post(lambda: setattr(tab.session.controls._denoise, "value", True))
    tab.until(lambda: tab.session.controls.look().denoise, "the box has no effect")
    clean = pictures.make(tab.session.controls.look(), None).astype(float)
    assert (clean != noisy).any()
    expected = shown.picture(live.jobs[0].denoised(), look.exposure, look.curve)
    assert clean == pytest.approx(expected, abs=1)
    tab.session.post(lambda: setattr(tab.session.controls._denoise, "value", False))
    tab.session.post(tab.session.restart)
    tab.open("Paths")


def test_a_lamp_can_be_dimmed_and_coloured_without_a_render(tab):
    live, pictures, lamps = tab.session.live, tab.session.pictures, tab.session.controls.lamps
    tab.session.post(lambda: setattr(lamps._asked, "value", True))
    tab.until(lambda: lamps.factors() and live.image() is not None, "no lamps")
    live.stop()
    tab.until(lambda: not live.running, "no end")
    (name,) = live.jobs[0].light_groups
    look = tab.session.controls.look()
    before = pictures.make(look, None)
    assert np.array_equal(before, pictures.make(look._replace(lamps=None), None))
    stops, colour = lamps._fields[name]
    samples = live.jobs[0].samples
    tab.session.post(lambda: (setattr(stops, "value", -2.0), setattr(colour, "value", (255, 0, 0))))
    tab.until(lambda: lamps.factors()[name] == (0.25, 0, 0), "the sliders have no effect")
    expected = live.jobs[0].image * np.float32([0.25, 0, 0])
    look = tab.session.controls.look()
    found = pictures.make(look, None).astype(int)
    assert abs(found - shown.picture(expected, look.exposure, look.curve)).max() <= 1
    assert live.jobs[0].samples == samples
    tab.session.post(lambda: setattr(lamps._asked, "value", False))
    tab.until(lambda: not lamps.factors(), "the sliders stay")
    tab.open("Paths")


def test_shapes_can_be_turned_with_the_paths(tab):
    picture = tab.picture()
    tab.page.get_by_role("checkbox").first.check(force=True)
    tab.until(lambda: tab.session.inspector.shows_meshes, "the box has no effect")
    tab.until(lambda: abs(tab.picture() - picture).mean() > 0.01, "no shapes")
    still = tab.picture()
    tab.drag(80, 40)
    tab.until(lambda: abs(tab.picture() - still).mean() > 0.005, "they do not turn")
    tab.page.get_by_role("checkbox").first.uncheck(force=True)
    tab.until(lambda: tab.session.live.running, "the render does not come back")
    tab.until(lambda: tab.session.inspector.pixel is None, "a pixel of another view is marked")


def test_a_chain_walks_and_is_watched(tab):
    inspector = tab.session.inspector
    tab.press("Run")
    tab.until(lambda: inspector._walk is not None and inspector._walk.steps > 3, "no steps")
    tab.press("Pause")
    tab.until(lambda: inspector.pause() is None, "no pause")
    steps = inspector._walk.steps
    tab.press("Step")
    tab.until(lambda: inspector._walk.steps == steps + 1, "no step")
    tab.page.get_by_text(f"Step {steps + 1}.").wait_for()


def test_what_makes_no_sense_gives_a_message(tab):
    tab.session._complaints.clear()  # of other tests
    tab.open("Paths")
    fields = tab.page.locator("form input").locator("visible=true")
    field = fields.nth(0)
    field.fill("1000, 2")
    tab.press("Find its paths")
    tab.message("is beside the image")
    field.fill("here")
    tab.press("Find its paths")
    tab.message("two whole numbers")
    assert len(tab.session._complaints) == 1
    field.fill("48, 60")
    tab.press("Find its paths")
    tab.no_message("two whole numbers")
    tab.press("The chain that was stuck longest")
    tab.message("no chain was stuck")
    tab.open("Render")
    fields.nth(1).fill("max_depht=3")
    fields.nth(1).press("Enter")
    tab.message("max_depth")
    fields.nth(1).fill("")
    fields.nth(1).press("Enter")
    tab.until(lambda: len(tab.session._complaints) == 1, "all or nothing is mended")
    tab.page.get_by_text("max_depht").first.wait_for(state="detached")
    assert not tab.errors


def test_the_lecture_follows_its_sliders(tab):
    assert tab.session.lecture._example is None  # it would delay the first picture
    tab.open("Lecture")
    said = tab.page.locator("p[data-example]")
    said.wait_for()
    tab.session.post(lambda: setattr(tab.session.lecture._choice, "value", "Two states"))
    tab.until(lambda: "90 %" in said.inner_text(), "the example does not come")
    assert "90 %" in said.inner_text()
    tab.page.locator("canvas").nth(1).wait_for()  # the chart
    slider = tab.session.lecture._sliders[0]
    number = tab.page.locator(".mantine-NumberInput-input").locator("visible=true").first
    number.fill("4")
    number.press("Enter")
    tab.until(lambda: slider.value == 4, "the slider does not follow")
    tab.until(lambda: "80 %" in said.inner_text(), "the text does not follow")


def test_the_lecture_needs_no_scene(browser):
    with mlt.view(port=0) as view:
        page = browser.new_page(viewport=WINDOW)
        page.goto(view.url)
        page.locator("canvas").nth(1).wait_for()  # a chart, beside that of the scene
        assert page.get_by_role("tab").count() == 0
        text = page.locator("p[data-example]")
        until(page, lambda: text.bounding_box()["width"] > 500, "the panel stays narrow")
        (session,) = view.sessions
        page.close()
        session.wait(PATIENCE)
        assert not session._thread.is_alive()


def test_a_chosen_example_clears_the_chart_before_the_next_is_computed(browser, monkeypatch):
    ready = threading.Event()
    usual = {example.name: example for example in lecture.EXAMPLES}

    def slow(*values):
        ready.wait(PATIENCE)
        return usual["Two states"].run(*values)

    late = dataclasses.replace(usual["Two states"], run=slow)
    monkeypatch.setattr(lecture, "EXAMPLES", (usual["Parabola"], late))
    with mlt.view(port=0) as view:
        page = browser.new_page(viewport=WINDOW)
        page.goto(view.url)
        charts = page.locator(".uplot")
        charts.nth(1).wait_for()
        page.get_by_role("combobox", name="Example").click()
        page.get_by_role("option", name="Two states").click()
        page.get_by_text("computing …").wait_for()
        charts.first.wait_for(state="detached")
        page.get_by_text("Hastings 1970").wait_for()
        ready.set()
        charts.first.wait_for()
        assert page.get_by_text("computing …").count() == 0
        page.close()


def cpu_seconds() -> float:
    """Of this process's Python threads but the one that tests: what serves the view."""
    total = 0
    for thread in threading.enumerate():
        if thread is not threading.main_thread():
            with contextlib.suppress(OSError):
                fields = Path(f"/proc/self/task/{thread.native_id}/stat").read_text()
                total += sum(map(int, fields.rpartition(")")[2].split()[11:13]))
    return total / os.sysconf("SC_CLK_TCK")


@pytest.mark.long
def test_the_view_costs_the_render_little(browser):
    """Less than 3 % of the time that all processors have; a larger image, as it costs more."""
    scene = mlt.load_dict(mlt.scenes.ring(), size=(640, 360))
    with mlt.view(scene, "path", port=0) as view:
        tab = Tab(browser, view)
        tab.until(lambda: tab.samples() > 1, "no render")
        tab.page.wait_for_timeout(2000)
        before, start = cpu_seconds(), time.monotonic()
        tab.page.wait_for_timeout(10_000)
        spent, passed = cpu_seconds() - before, time.monotonic() - start
        assert tab.session.live.running
        assert spent < 0.03 * passed * os.cpu_count()
        tab.page.close()


@pytest.mark.parametrize("width", [1280, 400])
def test_text_is_readable(tab, width):
    """Letters of 11 pixels and more, and nothing is cut off at the right."""
    tab.page.set_viewport_size({**WINDOW, "width": width})
    tab.session.post(lambda: tab.session.inspector.inspect((48, 60)))
    for name in ("Render", "Paths", "Lecture"):
        tab.open(name)
        tab.page.wait_for_timeout(500)
        sizes = tab.page.evaluate(
            """() => [...document.querySelectorAll('.mlt, .mlt td, label, button')]
                .filter(e => e.offsetParent && e.innerText.trim())
                .map(e => parseFloat(getComputedStyle(e).fontSize))"""
        )
        assert sizes
        assert min(sizes) >= 11, name
        cut = tab.page.evaluate(
            """() => [...document.querySelectorAll('.mlt')].filter(e => e.offsetParent)
                .filter(e => e.getBoundingClientRect().right > innerWidth
                    || e.scrollWidth > e.clientWidth + 60).map(e => e.innerText)"""
        )
        assert not cut, name
    ends = tab.page.locator(".mantine-Slider-markLabel").locator("visible=true")
    thumbs = tab.page.locator(".mantine-Slider-thumb").locator("visible=true")
    thumbs.first.wait_for()
    for end, thumb in zip(ends.all()[::2], thumbs.all(), strict=True):
        below = thumb.bounding_box()
        assert end.bounding_box()["y"] >= below["y"] + below["height"] - 1
    panel = tab.page.get_by_role("tab", name="Render").bounding_box()
    assert 0 <= panel["x"] < width
    tab.page.set_viewport_size(WINDOW)


def test_a_narrow_window_shows_all_of_the_picture_and_takes_clicks(tab):
    tab.page.set_viewport_size({"width": 400, "height": 800})
    tab.open("Render")
    panel = tab.page.locator(".mantine-Paper-root").filter(has=tab.page.get_by_role("tab")).first
    window = tab.page.locator("div[style*='inset: 0px'] > canvas")
    tab.until(
        lambda: window.bounding_box()["height"] <= panel.bounding_box()["y"] + 1,
        "the panel hides a part of the picture",
    )
    tab.until(
        lambda: 0.7 < tab.session.frame().height < 1, "the picture keeps the shape of the window"
    )
    tab.session.inspector._found = None
    tab.page.mouse.click(200, 250)
    tab.page.get_by_role("tab", name="Paths", selected=True).wait_for()
    tab.until(lambda: tab.session.inspector._found is not None, "no click arrived")
    x, y = tab.session.inspector.pixel
    assert max(abs(x - 48), abs(y - 48)) <= 2
    tab.page.set_viewport_size(WINDOW)


def test_two_integrators_stand_side_by_side(tab):
    controls = tab.session.controls
    tab.open("Render")
    tab.session.post(lambda: setattr(controls._other, "value", "mlt"))
    tab.until(lambda: len(tab.session.live.jobs) == 2, "no second render")
    tab.until(lambda: tab.session.live.image(1) is not None, "it shows nothing")
    assert controls.share() == 0.5
    tab.page.get_by_text("Left / right").wait_for()


def test_a_closed_tab_ends_its_render(browser, view):
    tab = Tab(browser, view)
    tab.until(lambda: tab.samples() > 1, "no render")
    session, job = tab.session, tab.session.live.jobs[0]
    tab.page.close()
    end = time.monotonic() + PATIENCE
    while session in view.sessions or not job.ended:
        assert time.monotonic() < end
        time.sleep(0.05)
    session.wait(10)
    assert not session._thread.is_alive()


def test_a_token_opens_the_page_in_a_browser(browser):
    scene = mlt.load_dict(mlt.scenes.cornell_box(), size=(32, 32))
    with mlt.view(scene, port=0, token="let me in", threads=1) as view:
        page = browser.new_page()
        page.goto(view.url.split("?")[0])
        assert "token is needed" in page.content()
        page.close()
        tab = Tab(browser, view)
        tab.until(lambda: tab.samples() > 1, "no render")
        assert "let" not in tab.page.url
        tab.page.close()
