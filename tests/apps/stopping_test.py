#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How `tyndall render` stops and how it shows progress: signals, time limits, bars."""

import json
import os
import signal
import struct
import subprocess
import time
import unittest

import numpy as np

from program import PROGRAM, ProgramTest, environment


class StoppingTest(ProgramTest):
    def start_and_wait(self, *arguments):
        """Starts a render without end, returns it as soon as it has shown progress twice."""
        process = self.start_program("render", "fog.pbrt", "-o", "a.exr", "--spp", "100000000",
                                     "--size", "64x64", "--time", "100s", "--progress", "farm",
                                     *arguments)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        for _ in range(2):
            self.assertIn("ALF_PROGRESS", process.stderr.readline())
        return process

    def check_valid_picture(self):
        """Returns the numbers of samples."""
        channels = self.exr("a.exr").channels()
        for values in channels.values():
            self.assertTrue(np.isfinite(values).all())
        self.assertGreater(channels["R"].mean(), 0)
        count = channels["spp.Y"]
        self.assertEqual(self.exr("a.exr")["samplesPerPixel"], count.min())
        return count

    def check_first_signal(self, number):
        process = self.start_and_wait()
        process.send_signal(number)
        rest = process.stderr.read()
        self.assertEqual(process.wait(60), 4, rest)
        self.assertIn("\nstopping; a second signal ends at once and writes nothing\n", rest)
        self.assertIn("stopped early: ", rest)
        self.assertTrue(rest.endswith("wrote a.exr\n"))
        self.assertGreater(self.check_valid_picture().min(), 0)

    def test_interrupt_writes_a_valid_picture(self):
        self.check_first_signal(signal.SIGINT)

    def test_termination_writes_a_valid_picture(self):
        self.check_first_signal(signal.SIGTERM)

    @staticmethod
    def catches(process, number):
        with open(f"/proc/{process.pid}/status") as status:
            caught = next(line.split()[1] for line in status if line.startswith("SigCgt:"))
        return int(caught, 16) >> (number - 1) & 1

    def test_quiet_says_nothing(self):
        process = self.start_program("render", "fog.pbrt", "-o", "a.exr", "--spp", "100000000",
                                     "--size", "64x64", "--time", "100s", "-q")
        self.addCleanup(process.kill)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        while process.poll() is None and not self.catches(process, signal.SIGINT):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=60)
        self.assertEqual((process.returncode, out, err), (4, "", ""))
        self.assertGreater(self.check_valid_picture().min(), 0)

    def test_second_signal_kills(self):
        process = self.start_and_wait("--size", "3000x3000")
        process.send_signal(signal.SIGINT)
        while "stopping" not in process.stderr.readline():
            pass
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), -signal.SIGINT)
        self.assertEqual(self.files(), ["fog.pbrt"])

    def test_time_limit(self):
        result = self.run_program("render", "fog.pbrt", "-o", "a.exr", "--spp", "100000000",
                                  "--time", "0.5s", "--stats", "json")
        self.assertEqual(result.returncode, 4, result.stderr)
        count = self.check_valid_picture()
        self.assertGreater(count.min(), 0)
        statistics = json.loads(result.stdout)
        self.assertIs(statistics["stopped_early"], True)
        self.assertLess(statistics["seconds"], 1.5)
        self.assertEqual(statistics["paths"], count.sum())
        self.assertEqual(statistics["samples_per_pixel_wanted"], 100000000)
        self.assertEqual(statistics["unsampled_pixels"], 0)

    def test_time_limit_too_short_for_a_pass(self):
        result = self.run_program("render", "fog.pbrt", "-o", "a.exr", "--size", "2000x1500", "--time",
                                  "0.5s", "--progress", "farm", "--stats", "json", "-t", "1")
        self.assertEqual(result.returncode, 4, result.stderr)
        count = self.check_valid_picture()
        statistics = json.loads(result.stdout)
        # A pass takes 16 s, or more beside other programs.
        self.assertLess(statistics["seconds"], 4)
        unsampled = statistics["unsampled_pixels"]
        self.assertGreater(unsampled, 0)
        self.assertEqual(unsampled, (count == 0).sum())
        self.assertEqual(statistics["paths"], count.sum())
        self.assertIn("\nnote: stopped before each pixel had a sample: "
                      f"{unsampled} of 3000000 ({unsampled / 3e4:.1f} %) show what a pixel nearby "
                      "found\n", result.stderr)
        self.assertIn("\nstopped early: 0 of 4 samples per pixel\n", result.stderr)
        told = [line for line in result.stderr.splitlines() if line.startswith("ALF_PROGRESS")]
        self.assertGreater(len(told), 1)
        self.assertEqual(told[-1], "ALF_PROGRESS 100%")

    def test_time_limit_that_is_not_reached(self):
        self.render("--time", "1h")


class ProgressTest(ProgramTest):
    def test_lines_where_there_is_no_terminal(self):
        result = self.render("--spp", "400")
        lines = [line for line in result.stderr.splitlines() if line.startswith("rendering: ")]
        self.assertLessEqual(len(lines), 21)
        self.assertRegex(lines[-1], r"^rendering: 100 %, 400 spp, .* s")
        self.assertNotIn("\r", result.stderr)

    def bar(self, **variables):
        """What appears on a terminal of 80 columns."""
        master, slave = os.openpty()
        import fcntl
        import termios
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        process = subprocess.Popen([PROGRAM, "render", "fog.pbrt", "--spp", "2000"],
                                   cwd=self.folder, stderr=slave, env=environment(**variables))
        os.close(slave)
        text = b""
        try:
            while chunk := os.read(master, 65536):
                text += chunk
        except OSError:  # Linux reports the other side's end so
            pass
        os.close(master)
        self.assertEqual(process.wait(60), 0)
        return text.decode()

    def test_bar_on_a_terminal(self):
        text = self.bar()
        self.assertIn("\rrendering [", text)
        self.assertIn("ETA ", text)
        self.assertIn("\033[36m#", text)

    def test_no_color(self):
        text = self.bar(NO_COLOR="1")
        self.assertIn("\rrendering [#", text)
        self.assertNotIn("\033[36m", text)


if __name__ == "__main__":
    unittest.main()
