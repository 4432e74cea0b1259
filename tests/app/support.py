"""What the tests of the program share: running it, small meshes, and reading what it writes."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ASSETS = pathlib.Path(__file__).resolve().parents[2] / "assets"
WINSLOW = os.environ["WINSLOW"]
HAS_GUI = os.environ.get("WINSLOW_HAS_GUI") == "1"

DONE, INTERNAL, USAGE, INPUT, INVERTED, NOT_CONVERGED, INTERRUPTED = 0, 1, 2, 3, 4, 5, 130


class ProgramTest(unittest.TestCase):
    """Runs the program in an empty folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="winslow-test-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def winslow(self, *args, code=DONE, cwd=None, env=None, text=None):
        """Runs `winslow ARGS`, with `text` piped in; fails unless it exits with `code`."""
        for _ in range(3):
            run = subprocess.run([WINSLOW, *map(str, args)], cwd=cwd or self.folder, text=True,
                                 capture_output=True, check=False, timeout=300, input=text,
                                 env={**os.environ, **(env or {})})
            # The leak sanitizer itself can fail when a graphics driver's thread ends while its
            # memory is searched; that says nothing of the program. A leak is reported otherwise.
            if "LeakSanitizer has encountered a fatal error" not in run.stderr:
                break
        self.assertEqual(run.returncode, code,
                         f"winslow {' '.join(map(str, args))}\n{run.stdout}\n{run.stderr}")
        return run

    def path(self, name):
        return self.folder / name

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())

    def json(self, name):
        return json.loads(self.path(name).read_text())

    def ring(self, name="ring.su2", **options):
        """Writes a ring mesh; returns its name."""
        write_su2(self.path(name), *ring_mesh(**options))
        return name


def ring_mesh(around=24, rings=8, inner=0.5, outer=4.0, quads=False):
    """Nodes, elements and markers `body` and `farfield` of a ring of cells around the origin."""
    def node(i, j):
        return j * around + i % around

    nodes = []
    for j in range(rings + 1):
        radius = inner * (outer / inner) ** (j / rings)
        nodes += [(radius * math.cos(2 * math.pi * i / around),
                   radius * math.sin(2 * math.pi * i / around)) for i in range(around)]
    elements = []
    for j in range(rings):
        for i in range(around):
            cell = (node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j))
            elements += [cell] if quads else [cell[:3], (cell[0], cell[2], cell[3])]
    markers = {name: [(node(i, j), node(i + 1, j)) for i in range(around)]
               for name, j in (("body", 0), ("farfield", rings))}
    return nodes, elements, markers


def write_su2(path, nodes, elements, markers):
    lines = ["NDIME= 2", f"NELEM= {len(elements)}"]
    for k, e in enumerate(elements):
        lines.append(" ".join(map(str, (5 if len(e) == 3 else 9, *e, k))))
    lines.append(f"NPOIN= {len(nodes)}")
    lines += [f"{x!r} {y!r} {k}" for k, (x, y) in enumerate(nodes)]
    lines.append(f"NMARK= {len(markers)}")
    for name, edges in markers.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(edges)}"]
        lines += [f"3 {a} {b}" for a, b in edges]
    path.write_text("\n".join(lines) + "\n")


def read_su2(path):
    """Nodes, elements (corner tuples) and markers of an SU2 file."""
    lines = iter(pathlib.Path(path).read_text().splitlines())
    nodes, elements, markers = [], [], {}
    for line in lines:
        key, _, value = (part.strip() for part in line.partition("="))
        if key == "NELEM":
            for _ in range(int(value)):
                kind, *ids = map(int, next(lines).split())
                elements.append(tuple(ids[:3 if kind == 5 else 4]))
        elif key == "NPOIN":
            nodes = [tuple(map(float, next(lines).split()[:2])) for _ in range(int(value.split()[0]))]
        elif key == "MARKER_TAG":
            count = int(next(lines).partition("=")[2])
            markers[value] = [tuple(map(int, next(lines).split()[1:3])) for _ in range(count)]
    return nodes, elements, markers


def rotated(point, degrees, pivot=(0.0, 0.0), shift=(0.0, 0.0)):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    x, y = point[0] - pivot[0], point[1] - pivot[1]
    return pivot[0] + c * x - s * y + shift[0], pivot[1] + s * x + c * y + shift[1]


def smallest_corner_area(nodes, elements):
    """Twice the smallest corner area of any element: positive for a valid mesh."""
    def cross(a, b, c):
        return ((nodes[b][0] - nodes[a][0]) * (nodes[c][1] - nodes[a][1])
                - (nodes[b][1] - nodes[a][1]) * (nodes[c][0] - nodes[a][0]))

    return min(cross(e[k], e[(k + 1) % len(e)], e[k - 1]) for e in elements for k in range(len(e)))


def main():
    unittest.main(verbosity=2)
