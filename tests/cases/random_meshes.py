#!/usr/bin/python3
"""Foreign meshes, random motions: python3 random_meshes.py PATH/TO/winslow [--count N] [--seed S]
                                     [--max-rotation DEGREES] [--formulation NAME]

Gmsh meshes random polygons with holes (triangles, quadrilaterals, mixed); every motion must end
valid (status 0) or say that it did not (status 4 or 5). What the program says is checked
independently, and the share that ends valid is printed.
"""
import argparse
import collections
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from winslow_cases import PYTHON, ROOT, count_inverted, run


def run_motion(winslow, folder, mesh, motion, name, formulation):
    out, report = folder / f"{name}.su2", folder / f"{name}.json"
    done = run(winslow, ["move", folder / mesh["file"], "-o", out, "--marker", motion["marker"],
                         "--rotate", motion["rotate"], "--pivot", *motion["pivot"],
                         "--translate", *motion["translate"], "--formulation", formulation,
                         "--report", report, "--quiet"])
    said = json.loads(report.read_text()) if report.exists() else {}
    return done, said, out


def verdict(done, said, out, inverted_in):
    """Empty if the run kept its promises, else what is wrong with it. inverted_in: counts the inverted elements
    of a file without the program."""
    if done.returncode not in (0, 4, 5):
        return f"status {done.returncode}: {done.stderr.strip()}"
    complete = said.get("fraction_reached") == 1
    if done.returncode == 4 and (out.exists() or (said["inverted"] == 0 and complete)):
        return "status 4, but a mesh was written, or it is valid and the motion complete"
    if done.returncode == 0 and not complete:
        return "status 0, but the motion is not complete"
    if done.returncode == 0 and not said["converged"]:
        return "status 0, but not converged"
    if done.returncode in (0, 5) and out.exists() and inverted_in(out) > 0:
        return f"status {done.returncode}, but the mesh written has inverted elements"
    if done.returncode == 0 and not out.exists():
        return "status 0, but nothing was written"
    return ""


class Tally:
    """Tells of every motion, and counts."""

    def __init__(self):
        self.statuses, self.wrong = collections.Counter(), 0

    def add(self, mesh, motion, done, said, fault):
        self.statuses[done.returncode] += 1
        self.wrong += bool(fault)
        print(f"{mesh['file']} (seed {mesh['seed']}, {mesh['elements']}, {mesh['nodes']} nodes): "
              f"{motion['marker']} by {motion['rotate']:.0f} deg: status {done.returncode}, "
              f"{said.get('outer_iterations')} iterations, {said.get('inverted')} inverted"
              + (f"  WRONG: {fault}" if fault else "")
              + (f"  {done.stderr.strip()}" if done.returncode else ""), flush=True)

    def conclude(self, least_valid):
        """The exit status: 1 if a run broke its promises, or fewer than this share ended valid."""
        total = sum(self.statuses.values())
        valid = self.statuses[0] / max(total, 1)
        print(f"{self.statuses[0]} of {total} motions ended valid and converged ({100 * valid:.1f} %); "
              f"by status: {dict(sorted(self.statuses.items()))}")
        print(f"{total - self.wrong} passed, {self.wrong} failed")
        return 1 if self.wrong or total == 0 or valid < least_valid else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("winslow")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--max-rotation", type=float, default=120, help="degrees")
    parser.add_argument("--formulation", default="variational")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([PYTHON, ROOT / "tests/meshes/make_random.py", folder, "--count",
                        str(options.count), "--seed", str(options.seed),
                        "--max-rotation", str(options.max_rotation)], check=True)
        meshes = json.loads((folder / "meshes.json").read_text())["meshes"]
        tally = Tally()
        for mesh in meshes:
            for k, motion in enumerate(mesh["motions"]):
                done, said, out = run_motion(options.winslow, folder, mesh, motion,
                                             f"{Path(mesh['file']).stem}_{k}", options.formulation)
                tally.add(mesh, motion, done, said, verdict(done, said, out, count_inverted))
    return tally.conclude(0)


if __name__ == "__main__":
    sys.exit(main())
