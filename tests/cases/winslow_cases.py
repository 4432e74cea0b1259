"""What the case tests and the gallery of the README share: running cases and reading results."""
import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "meshes"))
from debian_python import PYTHON  # noqa: E402, F401
CASES = json.loads((Path(__file__).parent / "cases.json").read_text())["cases"]


def run(winslow, arguments, timeout=1200):
    """Runs the program; returns the finished process, its output as text."""
    return subprocess.run([winslow, *map(str, arguments)], capture_output=True, text=True, timeout=timeout)


def run_steps(winslow, steps, mesh, folder, stem):
    """Runs the steps of a case one after the other. Returns the last process, report and mesh."""
    for k, (command, *options) in enumerate(steps):
        out = Path(folder) / f"{stem}_{k}.su2"
        report = out.with_suffix(".json")
        done = run(winslow, [command, mesh, "-o", out, "--report", report, "--quiet", *options])
        mesh = out
    return done, json.loads(report.read_text()) if report.exists() else None, mesh


def lookup(quality, key):
    metric, statistic = key.split(".")
    return quality[metric][statistic]


def read_nodes(path):
    """Coordinates of an SU2 file, as (x, y) pairs."""
    lines = iter(Path(path).read_text().splitlines())
    for line in lines:
        if line.startswith("NPOIN"):
            count = int(line.split("=")[1].split()[0])
            return [tuple(map(float, next(lines).split()[:2])) for _ in range(count)]
    raise ValueError(f"{path}: no NPOIN")


def read_elements(path):
    """Corner lists of an SU2 file."""
    lines = iter(Path(path).read_text().splitlines())
    for line in lines:
        if line.startswith("NELEM"):
            corners = {"5": 3, "9": 4}
            rows = (next(lines).split() for _ in range(int(line.split("=")[1])))
            return [tuple(map(int, row[1:1 + corners[row[0]]])) for row in rows]
    raise ValueError(f"{path}: no NELEM")


def count_inverted(path):
    """Elements with a corner that is not counter-clockwise, counted without the program."""
    nodes = read_nodes(path)

    def inverted(element):
        n = len(element)
        for k in range(n):
            (x, y), (nx, ny), (px, py) = (nodes[element[(k + d) % n]] for d in (0, 1, -1))
            if (nx - x) * (py - y) - (ny - y) * (px - x) <= 0:
                return True
        return False

    return sum(map(inverted, read_elements(path)))
