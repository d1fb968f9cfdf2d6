#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of `tyndall report` in headless Chromium."""

import os
import unittest

import numpy as np

from browser import CHROMIUM, Browser
from report import ReportTest

# What scenarios use in the page.
HELPERS = """
function key(text, extra = {}) {
  document.body.dispatchEvent(new KeyboardEvent('keydown', {key: text, bubbles: true,
    code: /[0-9]/.test(text) ? 'Digit' + text : '', ...extra}));
}
function slide(viewer, name, value) {
  const input = viewer.element.querySelector(`input[name=${name}]`);
  input.value = value;
  input.dispatchEvent(new Event('input', {bubbles: true}));
}
function point(viewer, type, x, y) {
  const box = viewer.canvas.getBoundingClientRect();
  viewer.canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, bubbles: true,
    clientX: box.left + x * box.width, clientY: box.top + y * box.height}));
}
// The color in the middle of image pixel (x, y).
function color(viewer, x, y) {
  viewer.drawNow();
  const {view, canvas, context} = viewer;
  const px = canvas.width / 2 + (x + 0.5 - view.x) * view.zoom;
  const py = canvas.height / 2 + (y + 0.5 - view.y) * view.zoom;
  return [...context.getImageData(Math.floor(px), Math.floor(py), 1, 1).data].slice(0, 3);
}
"""
# Resolves when the first viewer shows its pictures, to the milliseconds since navigation.
READY = """
new Promise(done => {
  const look = () => document.querySelector('.viewer')?.dataset.ready
    ? requestAnimationFrame(() => done(performance.now())) : setTimeout(look, 5);
  look();
})
"""


def srgb8(x):
    x = np.clip(x, 0, 1)
    return np.round(255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055))


@unittest.skipUnless(CHROMIUM or "CI" in os.environ, "Chromium is not installed")
class BrowserCase(ReportTest):
    def open_page(self, width=1280, height=800, is_phone=False):
        """The page in a browser; `ready` is when it showed its pictures [ms]."""
        self.page()
        browser = Browser(width, height, is_phone)
        self.addCleanup(browser.close)
        browser.open(self.folder / "report.html")
        browser.ready = browser.run(READY)
        browser.run(HELPERS)
        browser.first_exposure = browser.run("viewers[0].view.exposure")
        browser.run("slide(viewers[0], 'exposure', 0)")
        return browser

    def scenario(self, body, **options):
        """What `body`, the inside of a function of the viewer, returns in the page."""
        browser = self.open_page(**options)
        result = browser.run("(async viewer => {\n%s\n})(viewers[0])" % body)
        # The scenarios themselves earn a hint about reading pixels back.
        self.assertEqual([t for t in browser.console if "willReadFrequently" not in t], [])
        return result


class BrowserTest(BrowserCase):
    def test_pictures_are_the_images(self):
        radiances = self.scenario("""
          return viewer.scene.pictures.map(p =>
            [...Array(%d).keys()].map(i => p.radiance(i).map(v => isNaN(v) ? null : v)));
        """ % (self.SIZE[0] * self.SIZE[1]))
        self.assertEqual(len(radiances), 4)
        for (name, image), shown in zip(self.images.items(), radiances):
            shown = np.array(shown, float).reshape(image.shape)
            floor = np.median(self.images["reference"] @ [0.2126, 0.7152, 0.0722]) / 256
            np.testing.assert_allclose(shown, image, rtol=0.011, atol=0.011 * floor, err_msg=name)

    def test_keys_and_sliders_change_what_is_drawn(self):
        shown = self.scenario("""
          const at = () => color(viewer, 60, 30), out = {};
          key('f'); key('r');
          out.reference = at();
          key('3');
          out.learned = at();
          key(' ');
          out.back = at();
          key(']'); key(']');
          out.brighter = at();
          slide(viewer, 'exposure', -2);
          out.darker = at();
          slide(viewer, 'exposure', 0);
          key('e');
          out.zeroError = at();
          key('1');
          out.error = at();
          key('e'); key('r');
          out.zeroDifference = at();
          key('e'); key('e'); key('t');
          out.filmic = at();
          key('h');
          out.help = document.getElementById('help').open;
          return out;
        """)
        pixel = self.images["reference"][30, 60]

        def check(name, values):
            np.testing.assert_allclose(shown[name], srgb8(values), atol=3, err_msg=name)

        check("reference", pixel)
        check("learned", self.images["learned <new>"][30, 60])
        check("back", pixel)
        check("brighter", 2 * pixel)
        check("darker", pixel / 4)
        check("filmic", pixel * (2.51 * pixel + 0.03) / (pixel * (2.43 * pixel + 0.59) + 0.14))
        self.assertEqual(shown["zeroError"], [0, 0, 4])
        self.assertGreater(sum(shown["error"]), 100)
        self.assertEqual(shown["zeroDifference"], [255, 255, 255])
        self.assertTrue(shown["help"])

    def test_bright_pictures_begin_darker(self):
        browser = self.open_page()
        mean = (self.images["reference"] @ [0.2126, 0.7152, 0.0722]).mean()
        self.assertAlmostEqual(browser.first_exposure, np.log2(0.18 / mean), delta=0.13)

    def test_not_a_number_is_magenta(self):
        self.assertEqual(self.scenario("key('f'); key('1'); return color(viewer, 5, 3);"),
                         [255, 0, 255])

    def test_split_follows_slider_and_pointer(self):
        shown = self.scenario("""
          const at = x => color(viewer, x, 30), out = {};
          viewer.canvas.setPointerCapture = () => {};  // knows no synthetic pointers
          key('s'); key('1'); key('3', {shiftKey: true});
          slide(viewer, 'split', 0.5);
          out.left = at(40); out.right = at(56);
          slide(viewer, 'split', 0.9);
          out.afterSlider = at(56);
          point(viewer, 'pointerdown', 0.9, 0.5); point(viewer, 'pointermove', 0.1, 0.5);
          point(viewer, 'pointerup', 0.1, 0.5);
          out.afterPointer = at(40);
          return out;
        """)
        for name, image, x in (("left", "volpath", 40), ("right", "learned <new>", 56),
                               ("afterSlider", "volpath", 56),
                               ("afterPointer", "learned <new>", 40)):
            np.testing.assert_allclose(shown[name], srgb8(self.images[image][30, x]), atol=3,
                                       err_msg=name)

    def test_zoom_and_pan_move_all_pictures(self):
        shown = self.scenario("""
          viewer.canvas.setPointerCapture = () => {};
          key('g');
          viewer.drawNow();
          const panes = viewer.panes().length, before = {...viewer.view};
          const box = viewer.canvas.getBoundingClientRect();
          viewer.canvas.dispatchEvent(new WheelEvent('wheel', {deltaY: -200, cancelable: true,
            clientX: box.left + 5, clientY: box.top + 5}));
          const zoomed = {...viewer.view};
          point(viewer, 'pointerdown', 0.2, 0.2); point(viewer, 'pointermove', 0.3, 0.2);
          point(viewer, 'pointerup', 0.3, 0.2);
          const panned = {...viewer.view};
          document.querySelector('[data-inset]').click();
          return {panes, before, zoomed, panned, inset: {...viewer.view},
                  place: document.querySelector('[data-inset]').dataset.inset};
        """)
        self.assertEqual(shown["panes"], 4)
        self.assertAlmostEqual(shown["zoomed"]["zoom"], 2 * shown["before"]["zoom"])
        self.assertLess(shown["panned"]["x"], shown["zoomed"]["x"])
        self.assertEqual(shown["panned"]["y"], shown["zoomed"]["y"])
        x, y, size = map(int, shown["place"].split(","))
        self.assertEqual((shown["inset"]["x"], shown["inset"]["y"]), (x + size / 2, y + size / 2))

    def test_false_colors_have_a_scale_and_a_mean(self):
        shown = self.scenario("""
          key('f'); key('3'); key('e');
          viewer.drawNow();
          const picture = viewer.scene.pictures[3];
          return {legend: viewer.legend.textContent, label: viewer.label(picture)};
        """)
        reference, image = self.images["reference"], self.images["learned <new>"]
        mean = ((image - reference) ** 2 / (reference**2 + 0.01)).mean()
        self.assertTrue(shown["legend"].startswith("relative square error"), shown)
        name, value = shown["label"].split(": mean ")
        self.assertEqual(name, "learned <new>")
        self.assertAlmostEqual(float(value) / mean, 1, delta=0.05)

    def test_blinks(self):
        shown = self.scenario("""
          key('1'); key('2'); key('b');
          const seen = new Set();
          for (let i = 0; i < 30; ++i) {
            await new Promise(done => setTimeout(done, 100));
            seen.add(viewer.view.left);
          }
          key('b');
          return [...seen].sort();
        """)
        self.assertEqual(shown, [1, 2])

    def test_methods_can_be_hidden(self):
        shown = self.scenario("""
          const box = document.querySelector('input[data-method="1"]');
          const visible = () => [...document.querySelectorAll('section [data-method="1"]')]
            .filter(e => e.tagName !== 'INPUT' && getComputedStyle(e).display !== 'none').length;
          const before = visible();
          box.click();
          return [before, visible()];
        """)
        self.assertGreater(shown[0], 4)
        self.assertEqual(shown[1], 0)

    def check_width(self, **options):
        shown = self.scenario("""
          return {page: document.documentElement.scrollWidth, window: innerWidth,
                  canvas: viewer.canvas.clientWidth, height: viewer.canvas.clientHeight};
        """, **options)
        self.assertLessEqual(shown["page"], shown["window"])
        self.assertGreater(shown["canvas"], 0.9 * shown["window"])
        self.assertGreater(shown["height"], 150)

    def test_fits_a_small_screen(self):
        self.check_width(width=1280, height=800)

    def test_fits_the_width_of_a_phone(self):
        self.check_width(width=390, height=844, is_phone=True)


class FullHdTest(BrowserCase):
    """Four pictures of 1920x1080; processor time, which other programs do not change."""

    SIZE = (1920, 1080)

    def test_four_pictures_load_and_flip_without_delay(self):
        browser = self.open_page()
        loading = browser.busy_seconds()
        browser.run("key('f'); for (const i of '123') { key(i); viewers[0].drawNow(); }")
        before = browser.busy_seconds()
        milliseconds = browser.run("""(viewer => {
          const start = performance.now();
          for (let i = 0; i < 20; ++i) { key('12'[i % 2]); viewer.drawNow(); }
          viewer.context.getImageData(0, 0, 1, 1);  // waits for what was drawn
          return (performance.now() - start) / 20;
        })(viewers[0])""")
        flip = (browser.busy_seconds() - before) / 20
        print(f"loads in {browser.ready / 1e3:.2f} s, {loading:.2f} s of them at work; a flip "
              f"takes {milliseconds:.1f} ms, {1e3 * flip:.1f} ms of them at work")
        self.assertLess(loading, 4)
        self.assertLess(flip, 0.1)


if __name__ == "__main__":
    unittest.main()
