# SPDX-License-Identifier: GPL-2.0-only
"""scripts/setup.sh asks on a terminal before it installs packages. Stand-ins for apt-get, dpkg-query and cmake
note how they were called, so that nothing is installed or built."""
import os
import pty
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Setup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.notes = self.folder / "notes"
        self.notes.touch()
        self.stand_in("dpkg-query", '[ "$4" = ninja-build ] || printf installed')
        for name in ("apt-get", "cmake"):
            self.stand_in(name, f'echo {name} "$@" >> "{self.notes}"')
        self.stand_in("sudo", 'exec "$@"')

    def stand_in(self, name, text):
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def call(self, *words, typed=None, **environment):
        """Exit status, output, and what was called. `typed`: on a terminal, else there is none."""
        kept = {name: value for name, value in os.environ.items() if name not in ("CI", "TARGETS")}
        master = terminal = None
        if typed is not None:
            try:
                master, terminal = pty.openpty()
            except OSError as error:
                self.skipTest(f"no terminal can be had here: {error}")    # a system without /dev/pts
            os.write(master, typed.encode())
        try:
            done = subprocess.run([str(ROOT / "scripts" / "setup.sh"), *words], text=True, timeout=60,
                                  stdin=subprocess.DEVNULL if terminal is None else terminal,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  env={**kept, "PATH": f"{self.folder}:{os.environ['PATH']}",
                                       "BUILD_DIR": str(self.folder / "build"), **environment})
        finally:
            for end in (master, terminal):
                if end is not None:
                    os.close(end)
        return done.returncode, done.stdout, self.notes.read_text()

    def assert_installed_and_built(self, result):
        status, out, called = result
        self.assertEqual(status, 0, out)
        self.assertIn("Installing ninja-build", out)
        self.assertRegex(called, r"apt-get install .* ninja-build\n")
        self.assertIn("cmake --build", called)

    def test_asks_on_a_terminal(self):
        for answer in ("\n", "y\n", "Yes\n"):
            with self.subTest(answer=answer):
                self.notes.write_text("")
                result = self.call(typed=answer)
                self.assertIn("will be installed with apt-get: ninja-build", result[1])
                self.assert_installed_and_built(result)

    def test_no_is_no(self):
        for answer in ("n\n", "what?\n", "\x04"):  # the last: end of file
            with self.subTest(answer=answer):
                status, out, called = self.call(typed=answer)
                self.assertEqual(status, 1, out)
                self.assertIn("apt-get install --no-install-recommends ninja-build", out)
                self.assertEqual(called, "")

    def test_does_not_ask_when_told(self):
        for words, environment in ((["--yes"], {}), ([], {"CI": "true"})):
            with self.subTest(words=words):
                self.notes.write_text("")
                result = self.call(*words, typed="n\n", **environment)
                self.assert_installed_and_built(result)
                self.assertNotIn("Go on?", result[1])

    def test_without_a_terminal_it_installs(self):
        self.assert_installed_and_built(self.call())

    def test_what_follows_yes_goes_to_cmake(self):
        _, _, called = self.call("--yes", "-D", "EEPA_ARCH=native")
        self.assertRegex(called, r"cmake -S \S+ -B \S+ -G Ninja -D EEPA_ARCH=native\n")

    def test_asks_nothing_where_nothing_is_missing(self):
        self.stand_in("dpkg-query", "printf installed")
        status, out, called = self.call(typed="n\n")
        self.assertEqual(status, 0, out)
        self.assertNotIn("apt-get", called)


if __name__ == "__main__":
    unittest.main()
