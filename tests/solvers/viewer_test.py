# SPDX-License-Identifier: BSD-3-Clause
"""Pages in Chromium, drawn by software: turned, clicked, cut and copied; and a case written by pointing alone."""
import json
import pathlib
import shutil
import tempfile
import time
import unittest

import numpy as np
import solver_meshes
from selenium import webdriver
from selenium.common.exceptions import TimeoutException
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait
from solver_meshes import run
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

OPTIONS = (
    "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
    "--disable-dev-shm-usage", "--window-size=1200,900", "--force-device-scale-factor=1",
)  # fmt: skip
PATIENCE_S = 60
AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "-x": (-1, 0, 0)}


def chromium():
    options = webdriver.ChromeOptions()
    options.binary_location = "/usr/bin/chromium"
    for option in OPTIONS:
        options.add_argument(option)
    options.set_capability("goog:loggingPrefs", {"performance": "ALL", "browser": "ALL"})
    service = webdriver.chrome.service.Service("/usr/bin/chromedriver")
    return webdriver.Chrome(service=service, options=options)


def pixels(png):
    """Of a screenshot: shape (height, width, 3), from the top."""
    reader = vtkPNGReader()
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        file.write(png)
        file.flush()
        reader.SetFileName(file.name)
        reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return values.reshape(height, width, -1)[::-1, :, :3].astype(int)


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        options, _ = solver_meshes.arguments()
        cls.tessera = options.tessera
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_viewer_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.model = shutil.copy(options.root / "configs/geometry/two_blocks.step", cls.folder)
        cls.thin = options.root / "configs/geometry/bracket.step"
        cls.browser = chromium()
        cls.addClassCleanup(cls.browser.quit)

    def open(self, file):
        self.browser.get_log("performance")
        self.browser.get(f"file://{file}")
        ready = "return document.getElementById('viewer-canvas').dataset.ready"
        WebDriverWait(self.browser, PATIENCE_S).until(lambda browser: browser.execute_script(ready) == "yes")
        self.canvas = self.element("canvas")
        self.browser.execute_script("document.getElementById('viewer').scrollIntoView({block: 'center'})")

    def tearDown(self):
        for entry in self.browser.get_log("browser"):
            self.assertNotEqual(entry["level"], "SEVERE", entry["message"])
        requests = [
            message["params"]["request"]["url"]
            for entry in self.browser.get_log("performance")
            if (message := json.loads(entry["message"])["message"])["method"] == "Network.requestWillBeSent"
        ]
        self.assertTrue(all(url.startswith(("file:///tmp/", "data:")) for url in requests), requests)

    def element(self, name):
        return self.browser.find_element(By.ID, f"viewer-{name}")

    def text(self, name):
        return self.element(name).get_attribute("textContent")

    def press(self, selector):
        self.browser.find_element(By.CSS_SELECTOR, f"#viewer {selector}").click()

    def seen(self):
        """The canvas, when nothing moves any more and all is drawn."""
        before = b""
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            time.sleep(0.3)
            is_drawn = self.canvas.get_attribute("data-drawn") == "yes"
            try:
                now = self.canvas.screenshot_as_png
            except TimeoutException:  # After 10 s, which a busy machine may take.
                continue
            if is_drawn and now == before:
                return pixels(now)
            before = now if is_drawn else b""
        raise AssertionError("the view does not come to rest")

    def look_from(self, eye):
        self.press(f"[data-eye='{eye}']")
        return self.seen()

    def click_on_middle(self, right=0, up=0):
        ActionChains(self.browser).move_to_element(self.canvas).move_by_offset(right, -up).click().perform()

    def drag(self, right):
        """In steps, as a hand does."""
        hand = ActionChains(self.browser).move_to_element(self.canvas).click_and_hold()
        for step in range(8):
            hand.move_by_offset(right * (step + 1) // 8 - right * step // 8, 0)
        hand.release().perform()
        return self.seen()

    def clipboard(self):
        self.browser.execute_cdp_cmd(
            "Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]}
        )
        return self.browser.execute_async_script("navigator.clipboard.readText().then(arguments[0])")

    def face_in_the_middle(self, eye):
        """Of the model: the outermost face that a ray through the middle of the box meets."""
        told = json.loads(run([self.tessera, "info", self.model, "--json"]))
        axis, sign = next((a, s) for a, s in enumerate(AXES[eye]) if s)
        low, high = (np.array(told["box"][end]) for end in ("low", "high"))
        middle = 0.5 * (low + high)
        across = [a for a in range(3) if a != axis]
        met = [
            face for face in told["faces"]
            if face["normal"] == list(map(float, AXES[eye]))
            and all(face["box"]["low"][a] <= middle[a] <= face["box"]["high"][a] for a in across)
        ]  # fmt: skip
        return max(met, key=lambda face: sign * face["box"]["low"][axis])


class Report(PageTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.hot = cls.face_in_the_middle(cls, "x")
        (cls.folder / "case.toml").write_text(
            "geometry.file = 'two_blocks.step'\nsize.target = 2.0\ndecompose.subdomains = 6\n"
            f"[[geometry.name]]\nname = 'hot end'\npatch = {{ faces = [{cls.hot['number']}] }}\n"
        )
        run([cls.tessera, "mesh", "case.toml", "--output", "out", "-q"], cls.folder)
        cls.page = cls.folder / "out/report.html"
        cls.report = json.loads((cls.folder / "out/report.json").read_text())

    def setUp(self):
        self.open(self.page)

    def test_click_names_the_face_and_the_entries_are_copied(self):
        self.look_from("x")
        self.assertFalse(self.element("picked").is_displayed())
        self.click_on_middle()
        self.assertEqual(self.text("picked-name"), "hot end")
        figures = self.text("picked-figures")
        self.assertIn(f"number {self.hot['number']} ", figures)
        self.assertIn(f"area {self.hot['area']:.5g} mm²", figures)
        self.assertIn("normal (1, 0, 0)", figures)
        entry = f'[[geometry.name]]\nname = "hot end"\npatch = {{ faces = [{self.hot["number"]}] }}\n'
        self.assertEqual(self.text("name-entry"), entry)
        self.press("[data-copies='viewer-name-entry']")
        self.assertEqual(self.clipboard(), entry)
        size = self.element("region-size")
        size.send_keys(Keys.CONTROL, "a")
        size.send_keys("0.25")
        self.press("[data-copies='viewer-region-entry']")
        self.assertEqual(self.clipboard(), '[[size.region]]\npatch = "hot end"\nsize = 0.25\n')

    def test_what_is_dragged_turns(self):
        before = self.look_from("x")
        # Half the width is half of half a turn: from the right comes what is behind on the right.
        after = self.drag(-self.canvas.size["width"] // 2)
        self.assertGreater((before != after).any(axis=2).mean(), 0.02)
        self.click_on_middle()
        self.assertIn("normal (0, 1, 0)", self.text("picked-figures"))
        numbers = {patch["id"]: patch["faces"] for patch in self.report["patches"]}
        self.assertIn([self.face_in_the_middle("y")["number"]], numbers.values())

    def test_wheel_zooms(self):
        before = self.look_from("x")
        white = (before == 255).all(axis=2).mean()
        ActionChains(self.browser).scroll_from_origin(
            webdriver.common.actions.wheel_input.ScrollOrigin.from_element(self.canvas), 0, -500
        ).perform()
        self.assertLess((self.seen() == 255).all(axis=2).mean(), 0.8 * white)

    def test_cut_opens_the_surface(self):
        whole = self.look_from("home")
        Select(self.element("cut")).select_by_visible_text("x")
        cut = self.seen()
        self.assertGreater((whole != cut).any(axis=2).mean(), 0.05)
        self.assertNotEqual(self.text("cut-value"), "")
        # What is on this side of the cut is picked no more.
        self.look_from("x")
        self.click_on_middle()
        self.assertNotIn("hot end", self.text("picked-name"))
        Select(self.element("cut")).select_by_visible_text("nothing")
        self.look_from("x")
        self.click_on_middle()
        self.assertEqual(self.text("picked-name"), "hot end")

    def test_colours_and_lines(self):
        seen = {}
        for label in ("patch", "subdomain", "material", "quality of the tet behind"):
            Select(self.element("colour")).select_by_visible_text(label)
            seen[label] = self.seen()
        pictures = list(seen.values())
        for i, one in enumerate(pictures):
            for other in pictures[:i]:
                self.assertTrue((one != other).any())
        self.assertEqual(len(self.browser.find_elements(By.CSS_SELECTOR, "#viewer-legend li")), 10)
        self.press("#viewer-lines")
        self.assertGreater((self.seen() != pictures[-1]).any(axis=2).mean(), 0.02)

    def test_worst_tets_are_flown_to(self):
        self.look_from("home")
        self.press("#viewer-worst button:nth-of-type(3)")
        seen = self.seen()
        height, width, _ = seen.shape
        np.testing.assert_allclose(seen[height // 2, width // 2], [200, 20, 40], atol=2)

    def test_outside_of_the_model_nothing_is_picked(self):
        self.look_from("x")
        self.click_on_middle()
        self.click_on_middle(right=self.canvas.size["width"] // 2 - 8)
        self.assertFalse(self.element("picked").is_displayed())


class Model(PageTest):
    def setUp(self):
        self.page = self.folder / "model.html"
        run([self.tessera, "info", self.model, "--html", self.page])
        self.open(self.page)

    def set_slider(self, share):
        self.browser.execute_script(
            "const s = document.getElementById('viewer-size'); s.value = arguments[0];"
            "s.dispatchEvent(new Event('input'));", round(1000 * share))  # fmt: skip

    def test_size_says_how_many_tets_and_what_is_short(self):
        run([self.tessera, "info", self.thin, "--html", self.page])
        self.open(self.page)
        self.set_slider(0.0)
        self.assertRegex(self.text("tets"), r"about (19|20)\d million tets")
        self.assertIn("No edges", self.text("short"))
        fine = self.seen()
        self.set_slider(1.0)
        self.assertRegex(self.text("tets"), r"about [12],\d{3} tets")
        self.assertRegex(self.text("short"), r"\d+ edges are shorter")
        self.assertRegex(self.text("narrow"), r"\d+ faces are narrower")
        self.assertTrue((self.seen() != fine).any(), "what is short is not marked")
        self.press("#viewer-short button")
        self.assertIn("length", self.text("picked-figures"))
        self.assertRegex(self.text("region-entry"), r'curve = "\d+"')

    def test_click_near_an_edge_picks_it(self):
        self.look_from("x")
        face = self.face_in_the_middle("x")
        pixel = self.browser.execute_script(
            "return window.tesseraViewer.orbit.pixel(document.getElementById('viewer-canvas').clientHeight)"
        )
        told = json.loads(run([self.tessera, "info", self.model, "--json"]))
        middle = 0.5 * (told["box"]["low"][1] + told["box"]["high"][1])
        self.click_on_middle(right=round((face["box"]["high"][1] - middle) / pixel) - 2)
        self.assertTrue(self.text("picked-name").startswith("edge"), self.text("picked-name"))
        number = self.text("picked-name").split()[1]
        edge = next(edge for edge in told["edges"] if edge["number"] == number)
        self.assertAlmostEqual(edge["box"]["low"][1], face["box"]["high"][1], delta=1e-6)
        self.assertIn(f"length {edge['length']:.5g}", self.text("picked-figures"))

    def test_case_is_written_by_pointing_and_runs(self):
        self.set_slider(0.75)
        names = {}
        for eye, name in (("x", "outlet"), ("-x", "inlet")):
            self.look_from(eye)
            self.click_on_middle()
            box = self.element("new-name")
            box.send_keys(Keys.CONTROL, "a")
            box.send_keys(name)
            self.press("[data-adds='viewer-region-entry']" if eye == "x" else "[data-adds='viewer-name-entry']")
            names[name] = self.face_in_the_middle(eye)
        self.press("[data-copies='viewer-case-text']")
        case = self.clipboard()
        (self.folder / "pointed.toml").write_text(case)
        run([self.tessera, "mesh", "pointed.toml", "--output", "pointed", "-q"], self.folder)
        report = json.loads((self.folder / "pointed/report.json").read_text())
        self.assertEqual(report["status"], "ok")
        areas = {patch["name"]: patch["area"] for patch in report["patches"]}
        for name, face in names.items():
            self.assertAlmostEqual(areas[name] / face["area"], 1.0, delta=1e-3)
        triangles = {patch["name"]: patch["triangles"] / patch["area"] for patch in report["patches"]}
        self.assertGreater(triangles["outlet"], 2 * triangles["inlet"], "the region is not finer")


if __name__ == "__main__":
    solver_meshes.main()
