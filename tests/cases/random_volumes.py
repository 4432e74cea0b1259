#!/usr/bin/python3
"""Foreign volume meshes, random motions: python3 random_volumes.py PATH/TO/winslow [--count N]
                                          [--seed S] [--max-rotation DEGREES] [--keep FOLDER]

make_random_volumes.py makes boxes with one to three bodies in them, of tetrahedra, prisms, hexahedra and
mixtures; each has two motions. Every motion must end valid (status 0) or say that it did not (status 4 or 5),
and 98 % must end valid. What the program wrote is checked without it: the sign of the Jacobian all over the
elements, the places of the nodes that moved, the bits of those that are held, elements and markers.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "meshes"))
import debian_python  # noqa: E402

debian_python.take_over()
import numpy as np  # noqa: E402
from random_meshes import Tally, verdict
from volume_checks import count_inverted, marker_nodes, read_volume, rotated, same_elements
from winslow_cases import ROOT, run

LEAST_VALID = 0.98


def run_motion(winslow, folder, mesh, motion, stem):
    out, report = (folder / f"{stem}{end}" for end in (Path(mesh["file"]).suffix, ".json"))
    for old in (out, report):
        old.unlink(missing_ok=True)
    done = run(winslow, ["move", folder / mesh["file"], "-o", out, "--marker", motion["marker"],
                         "--rotate", motion["rotate"], "--axis", *motion["axis"], "--pivot", *motion["pivot"],
                         "--translate", *motion["translate"], "--report", report, "--quiet"])
    return done, json.loads(report.read_text()) if report.exists() else {}, out


def change_of(given, out, motion):
    """What a mesh that was written has that it should not have; empty if nothing."""
    after = read_volume(out)
    if after.markers != given.markers or list(after.markers) != list(given.markers):
        return "the markers have changed"
    if not same_elements(given, after):
        return "the elements have changed"
    moved = marker_nodes(given, [motion["marker"]])
    held = sorted(set(marker_nodes(given, given.markers)) - set(moved))
    if not np.array_equal(after.points[held], given.points[held]):
        return "nodes that are held have other bits"
    there = rotated(given.points[moved], motion["rotate"], motion["axis"], motion["pivot"]) + motion["translate"]
    error = np.abs(after.points[moved] - there).max()
    if error > 1e-12:
        return f"the body is off its place by {error:.2g}"
    return ""


def judged(given, done, said, out, motion):
    fault = verdict(done, said, out, lambda path: count_inverted(given, read_volume(path).points))
    if not fault and done.returncode == 0:
        fault = change_of(given, out, motion)
    return fault


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("winslow")
    parser.add_argument("--count", type=int, default=6)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--max-rotation", type=float, default=90, help="degrees")
    parser.add_argument("--keep", help="folder for the meshes")
    options = parser.parse_args()
    tally = Tally()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(options.keep or name)
        subprocess.run([debian_python.PYTHON, "-B", ROOT / "tests/meshes/make_random_volumes.py", folder, "--count",
                        str(options.count), "--seed", str(options.seed),
                        "--max-rotation", str(options.max_rotation)], check=True)
        for mesh in json.loads((folder / "meshes.json").read_text())["meshes"]:
            given = read_volume(folder / mesh["file"])
            if count_inverted(given, given.points):
                sys.exit(f"{mesh['file']} (seed {mesh['seed']}) is not valid as Gmsh made it")
            for k, motion in enumerate(mesh["motions"]):
                done, said, out = run_motion(options.winslow, folder, mesh, motion,
                                             f"{Path(mesh['file']).stem}_{k}")
                tally.add(mesh, motion, done, said, judged(given, done, said, out, motion))
    return tally.conclude(LEAST_VALID)


if __name__ == "__main__":
    sys.exit(main())
