"""Quadrilateral meshes with layers inserted in the connectivity at their boundaries."""
import numpy as np

OPTIONS = """\
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthMin = {size!r};
Mesh.CharacteristicLengthMax = {size!r};
Mesh.Algorithm = 9;
Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 1;
Mesh.RandomFactor = 1e-9;
Mesh.Smoothing = 10;
General.NumThreads = 1;
"""


def ring(centre, axes, points, turn):
    """Points on an ellipse, equally spaced in arc length."""
    t = np.linspace(0, 2 * np.pi, 4001)
    curve = np.stack([axes[0] * np.cos(t), axes[1] * np.sin(t)], 1)
    s = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))])
    at = np.arange(points) * s[-1] / points
    x, y = (np.interp(at, s, curve[:, c]) for c in (0, 1))
    c, q = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    return np.stack([centre[0] + c * x - q * y, centre[1] + q * x + c * y], 1)


def box_with_holes(header, half_width, half_height, holes, size):
    """.geo text: uniform quadrilaterals of the given size in a box with holes
    (name -> (centre, semi-axes, turn in degrees))."""
    lines = [f"// {line}" for line in header]
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    lines += [f"Point({k + 1}) = {{{half_width * x!r}, {half_height * y!r}, 0}};"
              for k, (x, y) in enumerate(corners)]
    for k in range(4):
        lines.append(f"Line({k + 1}) = {{{k + 1}, {(k + 1) % 4 + 1}}};")
        steps = int(round(2 * (half_width, half_height)[k % 2] / size))
        lines.append(f"Transfinite Curve {{{k + 1}}} = {steps + steps % 2 + 1};")
    groups, last = [("outer", 1, 4)], 4
    for name, (centre, axes, turn) in holes.items():
        n = int(np.pi * (axes[0] + axes[1]) / size)
        points = ring(centre, axes, n + n % 2, turn)
        n = len(points)
        lines += [f"Point({last + k + 1}) = {{{x:.17g}, {y:.17g}, 0}};"
                  for k, (x, y) in enumerate(points)]
        lines += [f"Line({last + k + 1}) = {{{last + k + 1}, {last + (k + 1) % n + 1}}};"
                  for k in range(n)]
        lines.append(f"Transfinite Curve {{{last + 1}:{last + n}}} = 2;")
        groups.append((name, last + 1, last + n))
        last += n
    for k, (_, a, b) in enumerate(groups, 1):
        lines.append(f"Curve Loop({k}) = {{{a}:{b}}};")
    lines.append(f"Plane Surface(1) = {{1:{len(groups)}}};")
    lines += [f'Physical Curve("{name}") = {{{a}:{b}}};' for name, a, b in groups]
    lines.append('Physical Surface("fluid") = {1};')
    return "\n".join(lines) + "\n" + OPTIONS.format(size=size)


def inward(xyz, edges):
    """Unit-offset directions at the nodes of directed boundary edges (interior on the left), longer
    at corners so that both edges are offset by the same distance."""
    normal = {}
    for a, b in edges:
        d = xyz[b] - xyz[a]
        n = np.array([-d[1], d[0]]) / np.hypot(*d)
        for i in (a, b):
            normal.setdefault(i, []).append(n)
    out = {}
    for i, (n, m) in normal.items():
        out[i] = (n + m) / (1 + n @ m)
    return out


def insert_layers(xyz, elements, marks, layers, share):
    """Inserts rings of quadrilaterals along every boundary.

    The new boundary nodes take the place of the old ones, which move inside: each ring is `share`
    of the local boundary spacing thick, so thin that the mesh stays valid, and smoothing spreads
    the rings."""
    directed = {(e[k], e[(k + 1) % len(e)]) for e in elements for k in range(len(e))}
    marks = {name: [(a, b) if (a, b) in directed else (b, a) for a, b in edges]
             for name, edges in marks.items()}
    edges = [edge for group in marks.values() for edge in group]
    offset = inward(xyz, edges)
    length = {}
    for a, b in edges:
        for i in (a, b):
            length[i] = min(length.get(i, np.inf), float(np.hypot(*(xyz[b] - xyz[a]))))
    nodes = sorted(offset)
    points = [tuple(p) for p in xyz]
    rows = []
    for ring_no in range(layers + 1):
        row = {}
        for i in nodes:
            p = xyz[i] + ring_no * share * length[i] * offset[i]
            if ring_no == layers:
                points[i], row[i] = tuple(p), i
            else:
                row[i] = len(points)
                points.append(tuple(p))
        rows.append(row)
    new = [[low[a], low[b], high[b], high[a]]
           for low, high in zip(rows, rows[1:]) for a, b in edges]
    outer = {name: [[rows[0][a], rows[0][b]] for a, b in group] for name, group in marks.items()}
    return np.array(points), [list(e) for e in elements] + new, outer
