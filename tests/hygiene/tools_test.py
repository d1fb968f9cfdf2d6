#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants a violation of each rule in a small tree and sees that the checks find it."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
SPDX = "// SPDX-License-Identifier: Apache-2.0\n"


class ToolTest(unittest.TestCase):
    """A tree with one honest file in two layers, to which tests add what is wrong."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.write("src/tyndall/math/CMakeLists.txt", "tyndall_layer(HEADERS vec.h SOURCES)\n")
        self.write("src/tyndall/math/vec.h", SPDX + "#pragma once\n#include <cmath>\n")
        self.write("src/tyndall/image/CMakeLists.txt", "tyndall_layer(HEADERS SOURCES a.cpp b.cpp)\n")
        self.write("src/tyndall/image/a.cpp", SPDX + '#include "tyndall/math/vec.h"\n// See [KF12].\n')
        self.write("apps/tyndall/main.cpp", SPDX)
        self.write("docs/references.bib", "@article{KF12,\n}\n")

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def run_tool(self, name):
        result = subprocess.run([sys.executable, TOOLS / name, self.root],
                                capture_output=True, text=True)
        return result.returncode, result.stdout

    def assert_complaint(self, tool, text):
        code, output = self.run_tool(tool)
        self.assertEqual(code, 1, output)
        self.assertIn(text, output)


class LayersTest(ToolTest):
    def check(self, path, text, complaint):
        self.write(path, SPDX + text)
        self.assert_complaint("check_layers.py", complaint)

    def test_honest_tree_passes(self):
        self.assertEqual(self.run_tool("check_layers.py"), (0, "layers: no complaints\n"))

    def test_upward_include(self):
        self.write("src/tyndall/loader/x.h", SPDX)
        self.check("src/tyndall/image/a.cpp", '#include "tyndall/loader/x.h"\n',
                   "src/tyndall/image/a.cpp:2: image (4) must not include loader (9)")

    def test_sideways_include(self):
        self.write("src/tyndall/media/x.h", SPDX)
        self.check("src/tyndall/image/a.cpp", '  #  include "tyndall/media/x.h"\n',
                   "image (4) must not include media (4)")

    def test_relative_include(self):
        self.check("src/tyndall/math/vec.h", '#include "scalar.h"\n',
                   '"scalar.h" is not a full path that begins with tyndall/')

    def test_missing_file(self):
        self.check("src/tyndall/math/vec.h", '#include "tyndall/math/nothing.h"\n',
                   '"tyndall/math/nothing.h" does not exist')

    def test_library_in_header(self):
        self.check("src/tyndall/math/vec.h", "#include <fmt/core.h>\n",
                   "<fmt/core.h>: a header must not include fmt")

    def test_library_in_wrong_folder(self):
        self.check("src/tyndall/image/a.cpp", "#include <embree3/rtcore.h>\n",
                   "<embree3/rtcore.h>: image must not include Embree")

    def test_library_in_too_many_files(self):
        self.write("src/tyndall/image/b.cpp", SPDX + "#include <png.h>\n")
        self.check("src/tyndall/image/a.cpp", "#include <png.h>\n",
                   "libpng is included by 2 files, at most 1: a.cpp, b.cpp")

    def test_unknown_library(self):
        self.check("src/tyndall/image/a.cpp", "#include <OpenImageIO/imageio.h>\n",
                   "<OpenImageIO/imageio.h> belongs to no library")

    def test_unknown_layer(self):
        self.check("src/tyndall/util/a.cpp", "", "src/tyndall/util/a.cpp: util is not a layer")

    def test_file_that_no_list_names(self):
        self.check("src/tyndall/image/forgotten.cpp", "",
                   "src/tyndall/image/forgotten.cpp: not listed")

    def test_mixtures_know_no_media(self):
        self.write("src/tyndall/guiding/CMakeLists.txt", "gaussian_mixture.cpp\n")
        self.check("src/tyndall/guiding/gaussian_mixture.cpp", '#include "tyndall/image/a.cpp"\n',
                   "mixtures and their training know only math and sampling")

    def test_cli11_in_a_second_file(self):
        self.check("apps/tyndall/main.cpp", "#include <CLI/CLI.hpp>\n",
                   "apps/tyndall/main.cpp:2: only arguments.cpp includes CLI11")


class CitationsTest(ToolTest):
    def check(self, text, complaint):
        self.write("src/tyndall/image/a.cpp", text)
        self.assert_complaint("check_citations.py", complaint)

    def test_honest_tree_passes(self):
        self.assertEqual(self.run_tool("check_citations.py"), (0, "citations: no complaints\n"))

    def test_unknown_key(self):
        self.check("// [KF12], [Nobody99, Sec. 2]\n",
                   "src/tyndall/image/a.cpp:1: [Nobody99] is not in docs/references.bib")

    def test_second_key_in_brackets(self):
        self.check("// [KF12; Nobody99]\n", "[Nobody99] is not in docs/references.bib")

    def test_key_that_nothing_cites(self):
        self.check("int a[KF12];\n", "docs/references.bib: nothing cites [KF12]")

    def test_key_that_stands_twice(self):
        self.write("docs/references.bib", "@article{KF12,\n}\n@book{KF12,\n}\n")
        self.assert_complaint("check_citations.py", "[KF12] stands there twice".replace("[KF12]", "KF12"))

    def test_units_and_links_are_no_citations(self):
        self.write("src/tyndall/image/a.cpp", "// [KF12] [W/(m^2 sr)] [0, 1) [A4](x.md) v[B2][i]\n")
        self.assertEqual(self.run_tool("check_citations.py")[0], 0)


class StyleTest(ToolTest):
    def check(self, path, text, complaint):
        self.write(path, text)
        self.assert_complaint("check_style.py", complaint)

    def test_honest_tree_passes(self):
        self.assertEqual(self.run_tool("check_style.py"), (0, "style: no complaints\n"))

    def test_no_license_line(self):
        self.check("src/a.cpp", "int a;\n", "src/a.cpp:1: no SPDX-License-Identifier")

    def test_no_include_guard(self):
        self.check("src/a.h", SPDX + "int a;\n", "src/a.h:1: no #pragma once")

    def test_open_end(self):
        self.check("src/a.cpp", SPDX + "// TO" + "DO: later\n", "src/a.cpp:2: an open end")

    def test_open_end_with_issue_number_passes(self):
        self.write("src/a.cpp", SPDX + "// TO" + "DO(#12): later\n")
        self.assertEqual(self.run_tool("check_style.py")[0], 0)

    def test_machine_path(self):
        self.check("src/a.cpp", SPDX + '// see "/ho' + 'me/me/a"\n',
                   "src/a.cpp:2: a path of somebody's machine")

    def test_disabled_code(self):
        self.check("src/a.cpp", SPDX + "#if 0\n#endif\n", "src/a.cpp:2: code that is switched off")

    def test_long_function(self):
        self.check("src/a.cpp", SPDX + "int f() {\n" + "  g();\n" * 99 + "}\n",
                   "src/a.cpp:2: a function of 101 lines, at most 100")

    def test_longest_function_passes(self):
        self.write("src/a.cpp", SPDX + "int f() {\n" + "  g();\n" * 98 + "}\nint h() { return 1; }\n")
        self.assertEqual(self.run_tool("check_style.py")[0], 0)

    def test_long_file(self):
        self.check("src/a.cpp", SPDX + "int a;\n" * 600, "src/a.cpp:1: 601 lines, at most 600")

    def test_white_space(self):
        self.check("src/a.cpp", SPDX + "int a; \n", "src/a.cpp:2: spaces at the end of the line")
        self.check("src/a.cpp", SPDX + "int\ta;\n", "src/a.cpp:2: a tab")
        self.check("src/a.cpp", SPDX + "int a;", "src/a.cpp:2: no newline at the end")


class FormatTest(ToolTest):
    def test_bad_format(self):
        self.write(".clang-format", "BasedOnStyle: Google\n")
        self.write("src/a.cpp", "int   a ;\n")
        code, output = self.run_tool("check_format.py")
        if code == 77:
            self.skipTest(output)
        self.assertEqual(code, 1)
        self.write("src/a.cpp", "int a;\n")
        self.assertEqual(self.run_tool("check_format.py")[0], 0)


if __name__ == "__main__":
    unittest.main()
