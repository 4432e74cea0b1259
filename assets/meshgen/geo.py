"""Gmsh input: wall points, size field, .geo text, and the run of gmsh."""
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

# Options every .geo carries: sizes from the field alone, one thread, no random perturbation that
# could differ between runs.
OPTIONS = """\
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = {algorithm};
Mesh.RandomFactor = 1e-9;
Mesh.Smoothing = 10;
General.NumThreads = 1;
"""


@dataclass
class SizeField:
    """h(x) = min(wall + growth * distance to the walls, h_k + growth * |x - x_k|): grows linearly
    from the walls and from point sources (x_k, y_k, h_k)."""

    wall: float
    growth: float
    sources: list = field(default_factory=list)

    def on_wall(self, points):
        h = np.full(len(points), self.wall)
        for x, y, h_k in self.sources:
            h = np.minimum(h, h_k + self.growth * np.hypot(points[:, 0] - x, points[:, 1] - y))
        return h

    def geo(self, wall_points):
        lines = ["Field[1] = Distance;", f"Field[1].NodesList = {{1:{wall_points}}};",
                 "Field[2] = MathEval;", f'Field[2].F = "{self.wall!r} + {self.growth!r} * F1";']
        used = [2]
        for k, (x, y, h_k) in enumerate(self.sources, 3):
            r = f"Sqrt((x - ({x!r}))^2 + (y - ({y!r}))^2)"
            lines += [f"Field[{k}] = MathEval;",
                      f'Field[{k}].F = "{h_k!r} + {self.growth!r} * {r}";']
            used.append(k)
        n = used[-1] + 1
        ids = ", ".join(map(str, used))
        lines += [f"Field[{n}] = Min;", f"Field[{n}].FieldsList = {{{ids}}};",
                  f"Background Field = {n};"]
        return lines


def spread(curve, size):
    """Points on a dense polyline, so many and so placed that each step is the local size."""
    step = np.hypot(*np.diff(curve, axis=0).T)
    mid = (curve[1:] + curve[:-1]) / 2
    t = np.concatenate([[0], np.cumsum(step / size.on_wall(mid))])
    at = np.linspace(0, t[-1], int(round(t[-1])) + 1)
    points = np.stack([np.interp(at, t, curve[:, c]) for c in (0, 1)], 1)
    points[0], points[-1] = curve[0], curve[-1]
    return points


def wall_loop(sides, size):
    """Wall points of a closed section given as its sides in order; each side keeps its ends."""
    return np.concatenate([spread(side, size)[:-1] for side in sides])


def body_in_circle(header, walls, size, radius, centre=(0.5, 0.0), far_points=None, algorithm=6):
    """.geo text: bodies (name -> closed wall points) in a circular far field."""
    lines = [f"// {line}" for line in header]
    far = far_points or max(8, int(round(2 * np.pi * radius / (size.wall + size.growth * radius))))
    far += -far % 4
    point, curve, loops, groups = 0, 0, [], []
    for name, points in walls.items():
        n = len(points)
        lines += [f"Point({point + i + 1}) = {{{x:.17g}, {y:.17g}, 0}};"
                  for i, (x, y) in enumerate(points)]
        lines += [f"Line({curve + i + 1}) = {{{point + i + 1}, {point + (i + 1) % n + 1}}};"
                  for i in range(n)]
        loops.append((curve + 1, curve + n))
        groups.append((name, curve + 1, curve + n))
        point, curve = point + n, curve + n
    lines.append(f"Transfinite Curve {{1:{curve}}} = 2;")
    cx, cy = centre
    lines.append(f"Point({point + 1}) = {{{cx!r}, {cy!r}, 0}};")
    for k, (dx, dy) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        lines.append(f"Point({point + 2 + k}) = {{{cx + radius * dx!r}, {cy + radius * dy!r}, 0}};")
    for k in range(4):
        lines.append(f"Circle({curve + 1 + k}) = {{{point + 2 + k}, {point + 1}, "
                     f"{point + 2 + (k + 1) % 4}}};")
    groups.append(("farfield", curve + 1, curve + 4))
    loops.insert(0, (curve + 1, curve + 4))
    lines.append(f"Transfinite Curve {{{curve + 1}:{curve + 4}}} = {far // 4 + 1};")
    for k, (a, b) in enumerate(loops, 1):
        lines.append(f"Curve Loop({k}) = {{{a}:{b}}};")
    lines.append(f"Plane Surface(1) = {{1:{len(loops)}}};")
    lines += [f'Physical Curve("{name}") = {{{a}:{b}}};' for name, a, b in groups]
    lines.append('Physical Surface("fluid") = {1};')
    lines += size.geo(point)
    return "\n".join(lines) + "\n" + OPTIONS.format(algorithm=algorithm)


def run_gmsh(geo):
    """Runs gmsh on a .geo file: (coordinates, elements, marker -> edges) without unused nodes."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "mesh.msh"
        command = ["gmsh", "-2", str(geo), "-format", "msh22", "-o", str(out), "-v", "2"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0 or not out.exists():
            raise RuntimeError(f"gmsh failed on {geo}:\n{done.stdout}{done.stderr}")
        return read_msh22(out.read_text())


def read_msh22(text):
    lines = iter(text.splitlines())
    names, xyz, ids, elements, marks = {}, [], {}, [], {}
    for line in lines:
        if line == "$PhysicalNames":
            for _ in range(int(next(lines))):
                dim, tag, name = next(lines).split(maxsplit=2)
                names[int(dim), int(tag)] = name.strip('"')
        elif line == "$Nodes":
            for k in range(int(next(lines))):
                tag, x, y, _ = next(lines).split()
                ids[int(tag)] = k
                xyz.append((float(x), float(y)))
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                kind, tags, physical, *rest = map(int, next(lines).split()[1:])
                nodes = [ids[i] for i in rest[tags - 1:]]
                if kind == 1:
                    marks.setdefault(names[1, physical], []).append(nodes)
                elif kind in (2, 3):
                    elements.append(nodes)
    return drop_unused(np.array(xyz), elements, marks)


def drop_unused(xyz, elements, marks):
    used = np.zeros(len(xyz), bool)
    for element in elements:
        used[element] = True
    new = np.cumsum(used) - 1
    return (xyz[used], [[int(new[i]) for i in e] for e in elements],
            {name: [[int(new[i]) for i in e] for e in edges] for name, edges in marks.items()})
