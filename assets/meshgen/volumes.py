"""Gmsh input of volume meshes: bodies in a box, and a wing of three elements on a symmetry plane."""
import numpy as np

OPTIONS = """\
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.RandomFactor = 1e-9;
Mesh.Smoothing = 10;
General.NumThreads = 1;
"""

# Sides of a box by the numbers of its corners: bit 0 is x, bit 1 is y, bit 2 is z.
BOX_EDGES = [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)]
BOX_SIDES = {"-z": (0, 1, 3, 2), "+z": (4, 5, 7, 6), "-y": (0, 1, 5, 4), "+y": (2, 3, 7, 6),
             "-x": (0, 2, 6, 4), "+x": (1, 3, 7, 5)}


class Geometry:
    """Collects the entities of a .geo file; every add_... returns the number of the new one."""

    def __init__(self, header):
        self.lines = [f"// {line}" for line in header]
        self.points = self.curves = self.surfaces = 0

    def add_point(self, xyz):
        self.points += 1
        self.lines.append(f"Point({self.points}) = {{{', '.join(f'{c:.17g}' for c in xyz)}}};")
        return self.points

    def add_curve(self, kind, points):
        self.curves += 1
        self.lines.append(f"{kind}({self.curves}) = {{{', '.join(map(str, points))}}};")
        return self.curves

    def add_surface(self, kind, loops):
        """loops: of numbers of curves, negative where a curve is run through backwards."""
        self.surfaces += 1
        numbers = []
        for k, loop in enumerate(loops):
            numbers.append(100 * self.surfaces + k)
            self.lines.append(f"Curve Loop({numbers[-1]}) = {{{', '.join(map(str, loop))}}};")
        self.lines.append(f"{kind}({self.surfaces}) = {{{', '.join(map(str, numbers))}}};")
        return self.surfaces

    def add_box(self, low, high, holes=()):
        """Sides of a box as surfaces by their names; holes: (name of the side, loop of curves)."""
        corners = [self.add_point([(low, high)[k >> axis & 1][axis] for axis in range(3)])
                   for k in range(8)]
        edges = {}
        for a, b in BOX_EDGES:
            edges[a, b] = self.add_curve("Line", (corners[a], corners[b]))
            edges[b, a] = -edges[a, b]
        sides = {}
        for name, ring in BOX_SIDES.items():
            outer = [edges[ring[k], ring[(k + 1) % 4]] for k in range(4)]
            sides[name] = self.add_surface("Plane Surface", [outer] + [h for s, h in holes if s == name])
        return sides

    def text(self, shells, markers, fields):
        """shells: lists of surfaces, the outer one first; markers: name -> surfaces."""
        for k, shell in enumerate(shells, 1):
            self.lines.append(f"Surface Loop({k}) = {{{', '.join(map(str, shell))}}};")
        self.lines.append(f"Volume(1) = {{{', '.join(map(str, range(1, len(shells) + 1)))}}};")
        self.lines += [f'Physical Surface("{name}") = {{{", ".join(map(str, s))}}};'
                       for name, s in markers.items()]
        self.lines += ['Physical Volume("fluid") = {1};'] + fields
        return "\n".join(self.lines) + "\n" + OPTIONS


def one_field(formula):
    return ["Field[1] = MathEval;", f'Field[1].F = "{formula}";', "Background Field = 1;"]


def add_octants(g, tips, add_arc):
    """The eight surfaces between six points, opposite ones beside each other; add_arc(a, b): of two tips."""
    arcs = {}
    for a in range(6):
        for b in range(a + 1, 6):
            if a // 2 != b // 2:
                arcs[a, b] = add_arc(tips[a], tips[b])
                arcs[b, a] = -arcs[a, b]
    return [g.add_surface("Surface", [[arcs[x, y], arcs[y, z], arcs[z, x]]])
            for x in (0, 1) for y in (2, 3) for z in (4, 5)]


def sphere_in_box(header, radius, half, wall, growth):
    """Size: wall + growth * distance from the sphere."""
    g = Geometry(header)
    centre = g.add_point((0, 0, 0))
    tips = [g.add_point(radius * sign * np.eye(3)[axis]) for axis in range(3) for sign in (1, -1)]
    octants = add_octants(g, tips, lambda a, b: g.add_curve("Circle", (a, centre, b)))
    box = list(g.add_box((-half,) * 3, (half,) * 3).values())
    formula = f"{wall!r} + {growth!r} * (Sqrt(x^2 + y^2 + z^2) - {radius!r})"
    return g.text([box, octants], {"farfield": box, "sphere": octants}, one_field(formula))


def ellipsoid_in_box(header, semi_axes, half, size):
    """semi_axes: along x, y, z, the first the longest. half: edges of the box, halved. size: everywhere."""
    g = Geometry(header)
    centre = g.add_point((0, 0, 0))
    tips = [g.add_point(semi_axes[axis] * sign * np.eye(3)[axis]) for axis in range(3) for sign in (1, -1)]
    # An arc between y and z is longest along y.
    octants = add_octants(g, tips, lambda a, b: g.add_curve("Ellipse", (a, centre, a, b)))
    box = list(g.add_box([-h for h in half], half).values())
    return g.text([box, octants], {"farfield": box, "body": octants}, one_field(repr(size)))


def cube_in_box(header, edge, half, wall, growth):
    """Size: wall + growth * distance from the cube."""
    g = Geometry(header)
    cube = list(g.add_box((-edge / 2,) * 3, (edge / 2,) * 3).values())
    box = list(g.add_box((-half,) * 3, (half,) * 3).values())
    # max(|x| - edge / 2, 0), without max
    beyond = [f"((Fabs({c}) - {edge / 2!r} + Fabs(Fabs({c}) - {edge / 2!r})) / 2)^2" for c in "xyz"]
    formula = f"{wall!r} + {growth!r} * Sqrt({' + '.join(beyond)})"
    return g.text([box, cube], {"farfield": box, "cube": cube}, one_field(formula))


class WingShape:
    """Planform: sections of chord c(z) = 1 - (1 - taper) z / span whose leading edges lie on the
    line x = z tan(sweep)."""

    def __init__(self, span, taper, sweep):
        self.span, self.taper, self.slope = span, taper, float(np.tan(np.radians(sweep)))

    def chord(self, z):
        return 1 - (1 - self.taper) * z / self.span

    def place(self, section, z):
        """Points of a section of chord 1 at the station z."""
        c = self.chord(z)
        return np.stack([c * section[:, 0] + self.slope * z, c * section[:, 1],
                         np.full(len(section), float(z))], 1)

    def chord_formula(self):
        """c(z), held beyond the tip, for Gmsh."""
        t = f"z / {self.span!r}"
        return f"(1 - {1 - self.taper!r} * (Fabs({t}) - Fabs({t} - 1) + 1) / 2)"


def add_element(g, shape, sides, stations):
    """An element of the wing from one station to another, straight between them. Returns its two
    sides, the loops of curves around its ends, and its leading and trailing edges."""
    ends = []
    for z in stations:
        upper, lower = (shape.place(side, z) for side in sides)
        trailing, leading = g.add_point(upper[0]), g.add_point(upper[-1])
        curves = [g.add_curve("Spline", [a, *(g.add_point(p) for p in side[1:-1]), b])
                  for side, a, b in ((upper, trailing, leading), (lower, leading, trailing))]
        ends.append((trailing, leading, *curves))
    (t0, l0, u0, d0), (t1, l1, u1, d1) = ends
    trail, lead = g.add_curve("Line", (t0, t1)), g.add_curve("Line", (l0, l1))
    skin = [g.add_surface("Surface", [[u0, lead, -u1, -trail]]),
            g.add_surface("Surface", [[d0, trail, -d1, -lead]])]
    return skin, [[u0, d0], [u1, d1]], [trail, lead]


def wing_fields(shape, skins, edges, wall, edge, growth):
    """Sizes, each times the local chord: wall + growth * distance from the surfaces, and edge +
    growth * distance from the leading and trailing edges."""
    chord = shape.chord_formula()
    return ["Field[1] = Distance;", f"Field[1].FacesList = {{{', '.join(map(str, skins))}}};",
            "Field[1].NNodesByEdge = 160;",
            "Field[2] = MathEval;", f'Field[2].F = "{wall!r} * {chord} + {growth!r} * F1";',
            "Field[3] = Distance;", f"Field[3].EdgesList = {{{', '.join(map(str, edges))}}};",
            "Field[3].NNodesByEdge = 400;",
            "Field[4] = MathEval;", f'Field[4].F = "{edge!r} * {chord} + {growth!r} * F3";',
            "Field[5] = Min;", "Field[5].FieldsList = {2, 4};", "Background Field = 5;"]


def wing_in_box(header, shape, elements, low, high, sizes):
    """Elements (name -> (sides, stations)) in a box whose side z = 0 is the symmetry plane: an
    element that begins there is cut open by it, others are closed by a flat end."""
    g = Geometry(header)
    shells, markers, holes, skins, edges, at_symmetry = [], {}, [], [], [], []
    for name, (sides, stations) in elements.items():
        skin, loops, lines = add_element(g, shape, sides, stations)
        skins, edges = skins + skin, edges + lines
        ends = loops[1:] if stations[0] == 0 else loops
        if stations[0] == 0:
            holes.append(("-z", loops[0]))
        skin = skin + [g.add_surface("Plane Surface", [loop]) for loop in ends]
        markers[name] = skin
        if stations[0] == 0:
            at_symmetry += skin
        else:
            shells.append(skin)
    box = g.add_box(low, high, holes)
    symmetry = box.pop("-z")
    far = list(box.values())
    markers |= {"symmetry": [symmetry], "farfield": far}
    return g.text([far + [symmetry] + at_symmetry] + shells, markers,
                  wing_fields(shape, skins, edges, *sizes))
