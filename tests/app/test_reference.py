"""The reference pages list every option, field and format that the program has."""
import re
import subprocess
import sys
from pathlib import Path

import support
from support import ProgramTest

DOCS = Path(__file__).resolve().parents[2] / "docs"


class ReferenceTest(ProgramTest):
    def test_the_pages_are_what_the_tables_say(self):
        done = subprocess.run([sys.executable, "-B", DOCS / "make_reference.py", support.WINSLOW, "--check"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_page_that_lacks_an_option_is_noticed(self):
        folder = self.path("docs")
        folder.mkdir()
        (folder / "make_reference.py").write_text((DOCS / "make_reference.py").read_text())
        page = (DOCS / "command-line.md").read_text()
        without = re.sub(r"\| `--damping` .*\n", "", page)
        self.assertNotEqual(without, page)
        for text, code in ((page, 0), (without, 1)):
            (folder / "command-line.md").write_text(text)
            done = subprocess.run([sys.executable, "-B", folder / "make_reference.py", support.WINSLOW, "--check"],
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, code, done.stderr)

    def test_every_flag_of_the_tables_is_in_the_help_and_the_other_way_round(self):
        """Of smoothing: its group of the help holds nothing else."""
        table = self.winslow("reference", "smoothing").stdout
        help_text = self.winslow("smooth", "--help").stdout
        group = re.search(r"^Smoothing:\n(.*?)(^\S|\Z)", help_text, re.S | re.M)[1]
        first_cells = re.findall(r"^\| (`--[^|]*)\|", table, re.M)
        listed = set(re.findall(r"`(--[a-z-]+)`", " ".join(first_cells)))
        offered = set(re.findall(r"^  (--[a-z-]+)", group, re.M))
        self.assertEqual(listed, offered)
        for flag in ("--linear-tolerance", "--linear-max-iterations", "--linear-restart"):
            self.assertIn(flag, offered)


if __name__ == "__main__":
    support.main()
