#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`tyndall report`: the page without scripts, and messages."""

import base64
import html.parser
import re
import unittest
import xml.etree.ElementTree

import numpy as np

from program import write_pfm
from report import METHODS, ReportTest


class PageTest(ReportTest):
    def test_tells_where_it_is(self):
        result = self.report("-o", "page.html")
        self.assertRegex(result.stdout, r"^wrote page\.html \(0\.\d MB\)\n$")
        self.assertEqual(result.stderr, "")

    def test_takes_a_folder(self):
        result = self.run_program("report", ".", "-o", "page.html")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_writes_plots(self):
        result = self.report("--plots", ".")
        self.assertEqual(result.returncode, 0, result.stderr)
        for axis in ("time", "samples"):
            root = xml.etree.ElementTree.parse(self.folder / f"fog & <lamp>-{axis}.svg").getroot()
            self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
            lines = root.findall(".//{http://www.w3.org/2000/svg}polyline")
            self.assertEqual(len(lines), len(METHODS))

    def test_shows_pictures_of_inspect(self):
        data = b"\x89PNG as it is"
        (self.folder / "fog & <lamp>-inspect-64,32.png").write_bytes(data)
        (self.folder / "other-inspect.png").write_bytes(b"other")
        page = self.page()
        self.assertIn("base64," + base64.b64encode(data).decode(), page)
        self.assertIn("fog &amp; &lt;lamp&gt;-inspect-64,32.png</figcaption>", page)
        self.assertNotIn(base64.b64encode(b"other").decode(), page)

    def test_needs_no_network(self):
        page = self.page()
        self.assertNotRegex(page, r"https?://")
        self.assertNotRegex(page, r"<(script|link|img)[^>]+(src|href)=\"(?!data:)")

    def test_is_well_formed(self):
        open_tags, void = [], {"meta", "link", "img", "br", "path", "polyline", "polygon", "input"}

        class Parser(html.parser.HTMLParser):
            def handle_starttag(self, tag, attributes):
                if tag not in void:
                    open_tags.append(tag)

            def handle_endtag(parser, tag):
                if tag not in void:
                    self.assertEqual(open_tags.pop(), tag)

        Parser().feed(self.page())
        self.assertEqual(open_tags, [])

    def test_reads_without_scripts(self):
        text = re.sub(r"<script.*?</script>", "", self.page(), flags=re.DOTALL)
        for expected in ("fog &amp; &lt;lamp&gt;", "<td>learned &lt;new&gt;</td>", "relMSE",
                         "tyndall render fog.pbrt --seed 2", "tyndall bench fog.pbrt",
                         "learned &lt;new&gt;: learning took a while", "path.length.mean",
                         "15 (11.8 to 19)", "<td>0.1</td><td>-</td><td>1</td>", "the true ratios are further from 1", "<svg",
                         "data:image/png;base64,"):
            self.assertTrue(expected in text, expected)
        self.assertFalse("<lamp>" in text)


class MessageTest(ReportTest):
    def check(self, code, message, *arguments):
        result = self.run_program("report", *(arguments or ("results.json",)))
        self.assertEqual((result.returncode, result.stderr), (code, f"error: {message}\n"))
        self.assertFalse((self.folder / "report.html").exists())

    def test_missing_results(self):
        self.check(2, "x.json: cannot read: No such file or directory", "x.json")

    def test_other_json(self):
        self.write("x.json", "{}")
        self.check(2, 'x.json: not a file of results: "format" is not "tyndall-results"', "x.json")

    def test_no_runs(self):
        self.results["scenes"][0]["methods"] = []
        self.write_results()
        self.check(2, 'results.json: scene "fog & <lamp>" has no finished runs')

    def test_no_scenes(self):
        self.results["scenes"] = []
        self.write_results()
        self.check(2, "results.json: there are no scenes")

    def test_missing_image(self):
        (self.folder / "jis.pfm").unlink()
        self.check(2, "jis.pfm: cannot read: No such file or directory")

    def test_image_of_another_size(self):
        write_pfm(self.folder / "jis.pfm", np.ones((4, 4, 3)))
        self.check(2, "jis.pfm: the image has 4 x 4 pixels, the reference 96 x 54")

    def test_unwritable_page(self):
        result = self.report("-o", "none/a.html")
        self.assertEqual((result.returncode, result.stderr),
                         (5, "error: none/a.html: cannot write: No such file or directory\n"))


if __name__ == "__main__":
    unittest.main()
