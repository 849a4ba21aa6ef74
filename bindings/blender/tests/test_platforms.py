# SPDX-License-Identifier: GPL-3.0-or-later
"""Which library the add-on takes on which system: plain Python, `python3 test_platforms.py`."""

import importlib.util
import sysconfig
import tempfile
import unittest
import unittest.mock
from pathlib import Path

ADDON = Path(__file__).resolve().parents[1] / "addon"
_spec = importlib.util.spec_from_file_location("platforms", ADDON / "platforms.py")
platforms = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(platforms)

#: What Python says of a system, and what has to be loaded there.
CASES = [
    ("linux", "x86_64", "linux-x64/libfairmesh.so"),
    ("win32", "amd64", "windows-x64/fairmesh.dll"),
    ("win32", "AMD64", "windows-x64/fairmesh.dll"),
    ("darwin", "x86_64", "macos-x64/libfairmesh.dylib"),
    ("darwin", "arm64", "macos-arm64/libfairmesh.dylib"),
    ("linux", "aarch64", "linux-arm64/libfairmesh.so"),
]


class Platforms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "THIRD-PARTY.txt").touch()

    def put(self, *places):
        for place in places:
            (self.folder / place).parent.mkdir(exist_ok=True)
            (self.folder / place).touch()

    def refused(self, *system):
        with self.assertRaises(LookupError) as caught:
            platforms.library(self.folder, *system)
        said = caught.exception.args[0]
        self.assertNotIn(". ", said, "more than one sentence")
        return said

    def test_each_system_gets_its_own(self):
        self.put(*(place for *_, place in CASES))
        for system, machine, place in CASES:
            self.assertEqual(platforms.library(self.folder, system, machine), self.folder / place)

    def test_the_zip_of_another_system(self):
        self.put("linux-x64/libfairmesh.so")
        said = self.refused("win32", "amd64")
        self.assertEqual(
            said,
            "this add-on is for linux-x64, and Blender runs on windows-x64 here: "
            "install the zip whose name ends with windows_x64",
        )

    def test_a_system_without_a_zip(self):
        self.put("linux-x64/libfairmesh.so")
        for system, machine, here in [
            ("linux", "aarch64", "linux-arm64"),
            ("win32", "arm64", "windows-arm64"),
            ("freebsd14", "amd64", "freebsd14-x64"),
            ("win32", "win32", "windows-win32"),
        ]:
            said = self.refused(system, machine)
            self.assertIn(f"runs on {here} here: there is no zip for that", said)
            self.assertIn("FAIRMESH_LIBRARY", said)

    def test_a_damaged_installation(self):
        self.assertIn("install it again", self.refused("linux", "x86_64"))
        self.put("linux-x64/other")
        self.assertIn("install it again", self.refused("linux", "x86_64"))

    def test_the_processor_is_that_of_the_program(self):
        for said, wanted in [
            ("linux-x86_64", "x86_64"),
            ("win-amd64", "amd64"),
            ("macosx-11.0-arm64", "arm64"),
            ("macosx-12.0-x86_64", "x86_64"),
            ("win32", "win32"),
        ]:
            with unittest.mock.patch.object(sysconfig, "get_platform", lambda said=said: said):
                self.assertEqual(platforms.processor(), wanted)
        with unittest.mock.patch.object(sysconfig, "get_platform", lambda: "macosx-11.0-universal2"):
            with unittest.mock.patch("platform.machine", lambda: "arm64"):
                self.assertEqual(platforms.processor(), "arm64")

    def test_the_manifest_names_all_for_which_there_is_a_zip(self):
        text = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
        line = next(line for line in text.splitlines() if line.startswith("platforms = "))
        self.assertEqual(line, f"platforms = {list(platforms.PUBLISHED)}".replace("'", '"'))


if __name__ == "__main__":
    unittest.main()
