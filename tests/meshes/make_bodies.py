#!/usr/bin/python3
"""Meshes around many bodies for layers: make_bodies.py FOLDER [--seed S]

Aerofoils with sharp and blunt trailing edges, ellipses, polygons, stars, gears, smooth random
bodies, jagged ones, pairs with a narrow gap, channels whose walls end at other boundaries. Writes
NAME.su2 for each and bodies.json: names and wall markers. Needs Gmsh.
"""
import argparse
import json
import math
import random
import subprocess
from pathlib import Path




def naca(code, blunt, points=60):
    """NACA four-digit section, chord 1, counter-clockwise from the trailing edge."""
    m, p, t = int(code[0]) / 100, int(code[1]) / 10, int(code[2:]) / 100
    last = 0.1015 if blunt else 0.1036
    upper, lower = [], []
    for i in range(points + 1):
        x = 0.5 * (1 - math.cos(math.pi * i / points))
        y = 5 * t * (0.2969 * math.sqrt(x) - 0.1260 * x - 0.3516 * x**2 + 0.2843 * x**3 - last * x**4)
        if p == 0 or m == 0:
            camber, slope = 0.0, 0.0
        elif x < p:
            camber, slope = m / p**2 * (2 * p * x - x * x), 2 * m / p**2 * (p - x)
        else:
            camber = m / (1 - p)**2 * (1 - 2 * p + 2 * p * x - x * x)
            slope = 2 * m / (1 - p)**2 * (p - x)
        a = math.atan(slope)
        upper.append((x - y * math.sin(a), camber + y * math.cos(a)))
        lower.append((x + y * math.sin(a), camber - y * math.cos(a)))
    outline = upper[::-1] + lower[1:]
    return outline if blunt else outline[:-1]


def around(radius, points):
    return [(radius(a) * math.cos(a), radius(a) * math.sin(a))
            for a in (2 * math.pi * i / points for i in range(points))]


def ellipse(a, b, points=100):
    return [(a * math.cos(t), b * math.sin(t))
            for t in (2 * math.pi * i / points for i in range(points))]


def refined(corners, size):
    """A closed polygon with its edges divided to about a length."""
    outline = []
    for (x0, y0), (x1, y1) in zip(corners, corners[1:] + corners[:1]):
        n = max(1, round(math.hypot(x1 - x0, y1 - y0) / size))
        outline += [(x0 + (x1 - x0) * i / n, y0 + (y1 - y0) * i / n) for i in range(n)]
    return outline


def polygon(n, size=0.03):
    return refined(around(lambda a: 0.5, n), size)


def star(n, inner, size=0.03):
    return refined([(r * math.cos(math.pi * k / n), r * math.sin(math.pi * k / n))
                    for k in range(2 * n) for r in [0.5 if k % 2 == 0 else inner]], size)


def gear(n, size=0.025):
    corners = []
    for k in range(n):
        for share, r in ((0, 0.4), (0.3, 0.4), (0.3, 0.5), (0.8, 0.5), (0.8, 0.4)):
            a = 2 * math.pi * (k + share) / n
            corners.append((r * math.cos(a), r * math.sin(a)))
    return refined(corners, size)


def smooth_random(rng, points=140):
    waves = [(rng.uniform(-0.08, 0.08), rng.uniform(0, 2 * math.pi)) for _ in range(6)]
    return around(lambda a: 0.5 + sum(c * math.cos((k + 2) * a + s)
                                      for k, (c, s) in enumerate(waves)), points)


def jagged(rng, size=0.03):
    n = rng.randint(7, 11)
    return refined([(r * math.cos(a), r * math.sin(a)) for a, r in
                    ((2 * math.pi * (k + rng.uniform(-0.25, 0.25)) / n, rng.uniform(0.3, 0.55))
                     for k in range(n))], size)


def moved(outline, dx, dy, degrees=0, scale=1):
    c, s = math.cos(math.radians(degrees)) * scale, math.sin(math.radians(degrees)) * scale
    return [(c * x - s * y + dx, s * x + c * y + dy) for x, y in outline]


def bodies(seed):
    """Name: list of outlines around which there is a far field."""
    rng = random.Random(seed)
    all_ = {}
    for code in ("0006", "0012", "2412", "4412", "6409", "0024"):
        all_[f"naca{code}_sharp"] = [naca(code, False)]
        all_[f"naca{code}_blunt"] = [naca(code, True)]
    for b in (0.5, 0.25, 0.1, 0.05):
        all_[f"ellipse_{b:g}"] = [ellipse(0.5, b, 100 if b > 0.1 else 160)]
    for n in (3, 4, 5, 6, 8):
        all_[f"polygon_{n}"] = [polygon(n)]
    for n, inner in ((4, 0.2), (5, 0.25), (6, 0.3), (8, 0.35)):
        all_[f"star_{n}"] = [star(n, inner)]
    for n in (6, 9):
        all_[f"gear_{n}"] = [gear(n)]
    all_["ell"] = [refined([(0, 0), (1, 0), (1, 0.3), (0.3, 0.3), (0.3, 1), (0, 1)], 0.03)]
    all_["u_shape"] = [refined([(0, 0), (1, 0), (1, 1), (0.7, 1), (0.7, 0.3), (0.3, 0.3), (0.3, 1),
                                (0, 1)], 0.03)]
    all_["cross"] = [refined([(0.3, 0), (0.6, 0), (0.6, 0.3), (0.9, 0.3), (0.9, 0.6), (0.6, 0.6),
                              (0.6, 0.9), (0.3, 0.9), (0.3, 0.6), (0, 0.6), (0, 0.3), (0.3, 0.3)],
                             0.03)]
    for k in range(4):
        all_[f"smooth_{k}"] = [smooth_random(rng)]
    for k in range(4):
        all_[f"jagged_{k}"] = [jagged(rng)]
    all_["pair_gap"] = [naca("4412", False), moved(naca("0012", False), 0.96, -0.07, -25, 0.4)]
    all_["pair_circles"] = [ellipse(0.5, 0.5), moved(ellipse(0.5, 0.5), 1.04, 0)]
    return all_


class Geo:
    """A Gmsh script of points, one-element or free lines, loops and groups."""

    def __init__(self):
        self.text, self.points, self.lines, self.loops = [], 0, 0, []
        self.groups = {}

    def loop(self, points, names, divided):
        """A closed polygon of (x, y, size); names: marker of the edge that follows each point.
        divided: Gmsh divides the edges; else each is one element."""
        first = self.points + 1
        for x, y, size in points:
            self.points += 1
            self.text.append(f"Point({self.points}) = {{{x!r}, {y!r}, 0, {size!r}}};")
        begin = self.lines + 1
        for k, name in enumerate(names):
            self.lines += 1
            self.text.append(f"Line({self.lines}) = {{{first + k}, {first + (k + 1) % len(points)}}};")
            self.groups.setdefault(name, []).append(self.lines)
        if not divided:
            self.text.append(f"Transfinite Curve {{{begin}:{self.lines}}} = 2;")
        self.loops.append(len(self.loops) + 1)
        self.text.append(f"Curve Loop({self.loops[-1]}) = {{{begin}:{self.lines}}};")

    def mesh(self, path):
        loops = ", ".join(map(str, self.loops))
        self.text.append(f"Plane Surface(1) = {{{loops}}};")
        for name, lines in self.groups.items():
            self.text.append(f'Physical Curve("{name}") = {{{", ".join(map(str, lines))}}};')
        self.text.append('Physical Surface("domain") = {1};')
        script = path.with_suffix(".geo")
        script.write_text("\n".join(["Mesh.Algorithm = 6;", *self.text]) + "\n")
        subprocess.run(["gmsh", "-2", "-v", "1", "-format", "su2", "-o", path, script], check=True,
                       stdout=subprocess.DEVNULL)
        script.unlink()


def mesh_bodies(outlines, path, far=12):
    geo = Geo()
    size = 2 * math.pi * far / 40
    geo.loop([(far * math.cos(2 * math.pi * i / 40), far * math.sin(2 * math.pi * i / 40), size)
              for i in range(40)], ["farfield"] * 40, False)
    names = []
    for k, outline in enumerate(outlines):
        names.append(f"body{k}" if len(outlines) > 1 else "body")
        points = []
        for i, (x, y) in enumerate(outline):
            near = [math.hypot(x - q[0], y - q[1])
                    for q in (outline[i - 1], outline[(i + 1) % len(outline)])]
            points.append((x, y, sum(near) / 2))
        geo.loop(points, [names[-1]] * len(points), False)
    geo.mesh(path)
    return names


def mesh_channel(corners, size, path):
    """corners: (x, y, marker of the side that follows), counter-clockwise."""
    geo = Geo()
    geo.loop([(x, y, size) for x, y, _ in corners], [name for _, _, name in corners], True)
    geo.mesh(path)
    return ["wall"]


def bump(x):
    return 0.1 * math.exp(-((x - 1.5) / 0.25) ** 2)


CHANNELS = {
    "channel": [(0, 0, "wall"), (3, 0, "outlet"), (3, 1, "wall"), (0, 1, "inlet")],
    "channel_bump": [(0.1 * i, bump(0.1 * i), "wall" if i < 30 else "outlet") for i in range(31)]
                    + [(3, 1, "top"), (0, 1, "inlet")],
    "plate": [(-1, 0, "symmetry"), (0, 0, "wall"), (2, 0, "outlet"), (2, 1, "top"),
              (-1, 1, "inlet")],
    "step": [(0, 0.3, "wall"), (1, 0.3, "wall"), (1, 0, "wall"), (3, 0, "outlet"), (3, 1, "wall"),
             (0, 1, "inlet")],
}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    made = []
    for name, outlines in bodies(options.seed).items():
        walls = mesh_bodies(outlines, options.folder / f"{name}.su2")
        made.append({"name": name, "file": f"{name}.su2", "walls": walls})
    for name, corners in CHANNELS.items():
        walls = mesh_channel(corners, 0.06, options.folder / f"{name}.su2")
        made.append({"name": name, "file": f"{name}.su2", "walls": walls})
    (options.folder / "bodies.json").write_text(json.dumps({"seed": options.seed, "bodies": made},
                                                           indent=1))
    print(f"{len(made)} meshes in {options.folder}")


if __name__ == "__main__":
    main()
