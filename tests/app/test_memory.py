"""Runs with too little memory end soon, with the mesh or with a sentence."""

import resource
import subprocess
import unittest

from support import DONE, INTERNAL, WINSLOW, ProgramTest


def limited(megabytes):
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))


class Memory(ProgramTest):
    def run_within(self, megabytes, *args):
        return subprocess.run([WINSLOW, *args], cwd=self.folder, text=True, capture_output=True,
                              check=False, timeout=120, preexec_fn=limited(megabytes))

    def setUp(self):
        super().setUp()
        # What the program and its libraries take before it begins is the loader's affair.
        starts = (megabytes for megabytes in range(60, 401, 10)
                  if self.run_within(megabytes, "--version").returncode == DONE)
        self.least = next(starts, None)
        # Sanitizers reserve more of the address space than any limit worth setting.
        if self.least is None:
            self.skipTest("does not start with 400 MB: built with a sanitizer")
        self.mesh = self.ring(around=128, rings=80, outer=40.0)

    def check_ends(self, *args):
        outcomes = []
        for megabytes in (*range(self.least, self.least + 120, 30), 1000):
            with self.subTest(megabytes=megabytes):
                run = self.run_within(megabytes, "move", self.mesh, "-o", "out.su2", "--marker",
                                      "body", "--rotate", "10", "--quiet", *args)
                self.assertIn(run.returncode, (DONE, INTERNAL), run.stderr)
                if run.returncode == INTERNAL:
                    self.assertIn("out of memory", run.stderr)
                    self.assertNotIn("out.su2", self.files())
                else:
                    (self.folder / "out.su2").unlink()
                outcomes.append(run.returncode)
        self.assertEqual(outcomes[-1], DONE)

    def test_a_factorisation_ends(self):
        self.check_ends("--linear", "direct", "--threads", "2")

    def test_a_factorisation_of_the_pointwise_form_ends(self):
        self.check_ends("--formulation", "pointwise", "--outer", "picard", "--linear", "direct",
                        "--threads", "2")

    def test_the_default_ends(self):
        self.check_ends("--threads", "8")


if __name__ == "__main__":
    unittest.main()
