#!/usr/bin/python3
"""The paper's cases on the bundled meshes: python3 paper_cases.py PATH/TO/winslow"""
import sys
import tempfile
import unittest
from pathlib import Path

from winslow_cases import CASES, ROOT, count_inverted, lookup, read_elements, read_nodes, run_steps

WINSLOW = ""


class PaperCases(unittest.TestCase):
    def check(self, name):
        case = next(c for c in CASES if c["name"] == name)
        mesh = ROOT / "assets" / case["mesh"]
        with tempfile.TemporaryDirectory() as folder:
            done, report, out = run_steps(WINSLOW, case["steps"], mesh, folder, "case")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(report["converged"])
            self.assertEqual(report["inverted"], 0)
            self.assertEqual(count_inverted(out), 0)
            self.assertEqual(read_elements(out), read_elements(mesh))
            print(f"case {name}:", report["quality"], report["linear_solves"], "linear solves")
            for key, bound in case["at_least"].items():
                self.assertGreaterEqual(lookup(report["quality"], key), bound, key)
            for key, bound in case["at_most"].items():
                self.assertLessEqual(lookup(report["quality"], key), bound, key)
            if "linear_solves" in case:
                self.assertLessEqual(report["linear_solves"], case["linear_solves"])
            if "same_as" in case:
                _, _, other = run_steps(WINSLOW, case["same_as"], mesh, folder, "other")
                apart = max(max(abs(a - c), abs(b - d))
                            for (a, b), (c, d) in zip(read_nodes(out), read_nodes(other)))
                print(f"case {name}: largest distance from the mesh that it should equal {apart:.1e}")
                self.assertLess(apart, case["same_within"])


for _case in CASES:
    def _test(self, name=_case["name"]):
        self.check(name)
    setattr(PaperCases, f"test_case_{_case['name']}", _test)

if __name__ == "__main__":
    WINSLOW = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
