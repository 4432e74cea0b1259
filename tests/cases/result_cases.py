"""The command lines whose results same_results.py compares between two builds of the program.

A case is a list of command lines that run one after the other in an empty folder in which only its
inputs lie. Everything that they write there is compared.
"""
import dataclasses
import json
import subprocess
import sys
from pathlib import Path

from robustness import cases_of, read_markers
from winslow_cases import CASES, PYTHON, ROOT, read_nodes, run

sys.path.insert(0, str(ROOT / "tests" / "meshes"))
from make_bodies import bodies, mesh_bodies  # noqa: E402

ASSETS, DATA = ROOT / "assets", ROOT / "tests" / "data"
PICARD = ["--formulation", "pointwise", "--outer", "picard"]
RANDOM_MESHES, ROBUSTNESS_MESHES = 6, 6
BODIES = ("naca2412_sharp", "naca6409_blunt", "ellipse_0.1", "polygon_5", "star_5", "gear_6", "cross",
          "smooth_1", "jagged_2", "pair_gap")


@dataclasses.dataclass
class Case:
    name: str
    steps: list  # command lines, without the program
    inputs: dict  # name in the folder: path of the file, or its text
    quick: bool = False

    def __post_init__(self):
        self.steps = [[str(word) for word in step] for step in self.steps]


def records(stem):
    """Options that have all there is to say of a solve written into files."""
    return ["--report", f"{stem}.json", "--history", f"{stem}.csv", "--save-recipe", f"{stem}.recipe.json"]


def chain(name, mesh, steps, quick=False, **more_inputs):
    """A case whose steps (command and options) work each on the mesh that the one before wrote."""
    lines, source = [], "in.su2"
    for k, (command, *options) in enumerate(steps):
        lines.append([command, source, "-o", f"out{k}.su2", "--quiet", *records(f"out{k}"), *options])
        source = f"out{k}.su2"
    return Case(name, lines, {"in.su2": Path(mesh), **more_inputs}, quick)


def with_options(steps, options):
    return [step if step[0] == "scramble" else [*step, *options] for step in steps]


def paper():
    """Cases A to G, with the program's method and the paper's."""
    for case in CASES:
        mesh, steps, name = ASSETS / case["mesh"], case["steps"], f"paper/{case['name']}"
        yield chain(name, mesh, steps, quick=case["name"] in "ACE")
        yield chain(f"{name}/picard", mesh, with_options(steps, PICARD), quick=case["name"] == "D")
        if case["name"] in "AD":
            yield chain(f"{name}/pointwise", mesh, with_options(steps, ["--formulation", "pointwise"]))
        if case["name"] == "A":
            yield chain(f"{name}/plain", mesh, with_options(steps, [
                *PICARD, "--acceleration", 0, "--fixed-damping", "--increments", 1,
                "--max-iterations", 150]))
        if case["name"] in "ABDG":
            yield chain(f"{name}/direct", mesh, with_options(steps, ["--direct"]))
            yield chain(f"{name}/before", mesh, [[*steps[0], "--no-smooth", "--allow-inverted"]])
    yield chain("paper/F", ASSETS / "circle.su2", [["layers", "--marker", "circle"]], quick=True)
    yield chain("paper/F/pointwise", ASSETS / "circle.su2",
                [["layers", "--marker", "circle", "--formulation", "pointwise"]])


FLAP = ["move", "--marker", "flap", "--rotate", -40, "--pivot", 0.848, -0.036]
TURN = ["move", "--marker", "airfoil", "--rotate", 60, "--pivot", 0.5, 0, "--translate", 0.4, 0.2]


def smoothing():
    """Options of smoothing, one by one, on the coarse meshes."""
    flap, naca = ASSETS / "coarse/three_element.su2", ASSETS / "coarse/naca0012.su2"
    variational = {
        "vcv": ["--targets", "vcv"], "rest": ["--targets", "rest"],
        "blend": ["--targets", "element=0.5", "vcv=0.2", "rest=0.3"],
        "exponent": ["--exponent", 2], "steep": ["--exponent", 24, "--knee", 2.5],
        "power-alone": ["--knee", 0], "loose": ["--tolerance", 1e-5], "short": ["--max-iterations", 3],
        "thread": ["--threads", 1], "threads": ["--threads", 3]}
    for name, options in variational.items():
        quick = name in ("blend", "threads")
        yield chain(f"smoothing/{name}", flap, [[*FLAP, *options]], quick)
    pointwise = {"newton": ["--outer", "newton"], "auto": [], "picard": ["--outer", "picard"],
                 "damped": ["--outer", "picard", "--damping", 0.6, "--acceleration", 5],
                 "clipped": ["--outer", "picard", "--clip", "on"],
                 "unclipped": ["--outer", "picard", "--clip", "off"],
                 "at-once": ["--outer", "picard", "--direct"]}
    for name, options in pointwise.items():
        yield chain(f"pointwise/{name}", naca, [[*TURN, "--formulation", "pointwise", *options]],
                    quick=name in ("newton", "damped"))
    for solver in ("automatic", "direct", "cg", "multigrid", "gmres", "point-implicit"):
        yield chain(f"linear/{solver}", flap, [[*FLAP, "--linear", solver]], quick=solver == "multigrid")
        if solver not in ("cg", "multigrid"):
            yield chain(f"linear/{solver}/picard", flap, [[*FLAP, *PICARD, "--linear", solver]],
                        quick=solver == "gmres")


def untangling():
    """Every way to untangle, of scrambles and of boundaries that were moved at once."""
    for how in ("auto", "picard", "energy"):
        options = ["--untangle", how]
        for mesh, seed in (("circle", 1), ("quads", 2), ("naca0012", 3), ("three_element", 4)):
            yield chain(f"untangling/{how}/{mesh}", ASSETS / f"coarse/{mesh}.su2",
                        [["scramble", "--seed", seed, "--allow-inverted"], ["smooth", *options]],
                        quick=mesh == "circle")
        yield chain(f"untangling/{how}/flap", ASSETS / "coarse/three_element.su2",
                    [[*FLAP, "--direct", *options]])
        yield chain(f"untangling/{how}/turn", ASSETS / "coarse/naca0012.su2",
                    [[*TURN[:4], 178, *TURN[5:8], "--direct", *options]], quick=how == "auto")
    yield chain("untangling/pointwise", ASSETS / "coarse/naca0012.su2",
                [["scramble", "--seed", 5, "--allow-inverted"], ["smooth", "--formulation", "pointwise"]])


def markers_csv():
    """Displacements of single boundary nodes of the coarse three-element section, in both forms."""
    mesh = ASSETS / "coarse/three_element.su2"
    nodes, flap = read_nodes(mesh), read_markers(mesh)["flap"]
    by_node, by_place = ["node,dx,dy"], ["x,y,dx,dy"]
    for k, node in enumerate(flap):
        by_node.append(f"{node},{0.0004 * (k % 3)},{-0.0003 * (k % 5)}")
        by_place.append(f"{nodes[node][0]!r},{nodes[node][1]!r},0,{0.0002 * (k % 7)}")
    return "\n".join(by_node) + "\n", "\n".join(by_place) + "\n"


def motions():
    """Motions by path, in increments, at once and beyond what is possible; changes of shape."""
    flap, naca = ASSETS / "coarse/three_element.su2", ASSETS / "coarse/naca0012.su2"
    for count in (1, 3, 8):
        for name, options in (("", []), ("/picard", PICARD)):
            yield chain(f"motion/increments{count}{name}", naca, [[*TURN, "--increments", count, *options]],
                        quick=count == 3)
    yield chain("motion/turn-360", naca, [["move", "--marker", "airfoil", "--rotate", 360, "--pivot", 0.5, 0]])
    yield chain("motion/two-bodies", flap, [["move", "--marker", "flap", "--marker", "main", "--rotate", 12,
                                             "--pivot", 0.5, 0, "--translate", 0.05, 0.1]], quick=True)
    yield chain("motion/partial", flap, [["move", "--marker", "flap", "--translate", -0.4, 0.1,
                                          "--accept-partial", "--max-iterations", 120]])
    yield chain("motion/one-after-the-other", flap,
                [FLAP, ["move", "--marker", "slat", "--rotate", 10, "--pivot", 0, 0], ["smooth"]])
    sine = ["deform", "--marker", "main", "--sine", -0.03, 3]
    for fade in ("none", "start", "end", "both"):
        yield chain(f"deform/{fade}", flap, [[*sine, "--fade", fade, "--fade-length", 0.3]],
                    quick=fade == "both")
    yield chain("deform/direction", flap, [[*sine, "--direction", 1, 2, "--increments", 2]])
    yield chain("deform/picard", flap, [[*sine, *PICARD]])
    by_node, by_place = markers_csv()
    yield chain("deform/by-node", flap, [["deform", "--marker", "flap", "--displacements", "d.csv"]],
                quick=True, **{"d.csv": by_node})
    yield chain("deform/by-place", flap, [["deform", "--marker", "flap", "--displacements", "d.csv"]],
                **{"d.csv": by_place})


def layers():
    """Viscous layers: rules for corners, walls and columns; layers that are held and respaced."""
    circle, naca = ASSETS / "coarse/circle.su2", ASSETS / "naca0012.su2"
    insert = ["layers", "--count", 8, "--first", 0.002, "--ratio", 1.2, "--growth", 1]
    wall = [*insert, "--marker", "circle"]
    for name, options in {
            "plain": [], "pure": ["--no-control"], "pointwise": ["--formulation", "pointwise"],
            "total": ["--total", 0.1], "outside": ["--match-outside"], "scaled": ["--scale-all"],
            "thin": ["--clearance", 0.1, "--steepest", 0.2]}.items():
        yield chain(f"layers/circle/{name}", circle, [[*wall, *options]], quick=name == "plain")
    yield chain("layers/circle/y-plus", circle, [[
        "layers", "--marker", "circle", "--count", 8, "--ratio", 1.2, "--growth", 1, "--y-plus", 30,
        "--reynolds", 1e5]])
    yield chain("layers/circle/part", circle, [[*insert, "--wall", "circle:count=4,xmin=0"]], quick=True)
    yield chain("layers/respace", circle, [wall, [
        "layers", "--marker", "circle", "--respace", "--count", 8, "--first", 0.001, "--ratio", 1.3]])
    yield chain("layers/held", circle, [wall, [
        "move", "--marker", "circle", "--rotate", 40, "--translate", 0.3, 0.1, "--hold-layers", "circle"]],
        quick=True)
    aerofoil = ["layers", "--marker", "airfoil", "--count", 30, "--first", 1e-5, "--ratio", 1.2,
                "--growth", 1]
    yield chain("layers/naca0012", naca, [aerofoil])
    yield chain("layers/naca0012/no-fans", naca, [[*aerofoil, "--no-fans"]])
    walls = [word for name in ("slat", "main", "flap") for word in ("--marker", name)]
    yield chain("layers/three_element", ASSETS / "three_element.su2", [
        ["layers", *walls, "--count", 25, "--first", 1e-5, "--ratio", 1.2, "--growth", 1],
        [*FLAP[:4], -20, *FLAP[5:], *(w if w != "--marker" else "--hold-layers" for w in walls)]])


RECIPE_PARTS = {
    "flap": ("three_element", [
        {"command": "move", "markers": ["flap"], "rotate": -40, "pivot": [0.86, -0.02]},
        {"command": "deform", "markers": ["main"],
         "sine": {"amplitude": 0.02, "waves": 2, "fade": "end", "fade_length": 0.3},
         "smooth": {"targets": {"element": 0.7, "rest": 0.3}, "exponent": 4, "max_iterations": 800}}]),
    "paper": ("naca0012", [
        {"command": "move", "markers": ["airfoil"], "rotate": -90, "pivot": [0.5, 0], "increments": 1,
         "smooth": {"formulation": "pointwise", "outer": "picard",
                    "linear": {"solver": "gmres", "tolerance": 1e-4, "restart": 20}}}]),
    "scramble": ("three_element", [
        {"command": "scramble", "seed": 3},
        {"command": "smooth", "smooth": {"targets": {"element": 0, "vcv": 1}, "knee": 2,
                                         "untangle": "picard"}}]),
    "layers": ("circle", [
        {"command": "layers", "walls": [{"markers": ["circle"], "count": 6, "first": 0.003,
                                         "ratio": 1.2, "growth": 1}]},
        {"command": "move", "markers": ["circle"], "rotate": 30, "translate": [0.4, 0.1]},
        {"command": "layers", "task": "respace",
         "walls": [{"markers": ["circle"], "count": 6, "first": 0.002, "ratio": 1.3, "growth": 1}]}]),
}


def free_node(mesh):
    """A node that is on no marker, and not of the first ones, which lie at corners."""
    held = {node for nodes in read_markers(mesh).values() for node in nodes}
    return max(n for n in range(len(read_nodes(mesh))) if n not in held)


def recipes():
    """Recipes of every command, replayed as the reference page shows them."""
    node = free_node(ASSETS / "coarse/naca0012.su2")
    parts = {**RECIPE_PARTS, "edit_vcv": ("naca0012", [
        {"command": "edit_vcv", "nodes": [{"node": node}]},
        {"command": "move", "markers": ["airfoil"], "rotate": 20, "pivot": [0.5, 0]}])}
    for name, (mesh, commands) in parts.items():
        text = json.dumps({"winslow_recipe": 1, "input": "in.su2", "output": "out.su2",
                           "commands": commands})
        yield Case(f"recipe/{name}", [["replay", "r.json", "--quiet", "--report", "out.json", "--history",
                                       "out.csv"]],
                   {"in.su2": ASSETS / f"coarse/{mesh}.su2", "r.json": text}, name in ("layers", "edit_vcv"))
    again = chain("recipe/saved", ASSETS / "coarse/three_element.su2", [FLAP], quick=True)
    again.steps.append(["replay", "out0.recipe.json", "-o", "again.su2", "--quiet"])
    yield again


WRITERS = {"su2": ["a.su2"], "msh22": ["a.msh", "--gmsh-version", "2.2"],
           "msh22b": ["a.msh", "--gmsh-version", "2.2", "--binary"],
           "msh41": ["a.msh", "--gmsh-version", "4.1"],
           "msh41b": ["a.msh", "--gmsh-version", "4.1", "--binary"], "vtk": ["a.vtk", "--ascii"],
           "vtkb": ["a.vtk", "--binary"], "vtu": ["a.vtu", "--ascii"], "vtub": ["a.vtu", "--binary"],
           "obj": ["a.obj"], "off": ["a.off"], "ply": ["a.ply", "--ascii"], "plyb": ["a.ply", "--binary"],
           "stl": ["a.stl", "--ascii"], "stlb": ["a.stl", "--binary"]}


def formats():
    """Every writer on meshes of every reader, and back again; quality of what was read.

    What bounds a volume mesh is several solids of an STL file: it is not read again.
    """
    files = [*sorted(DATA.glob("square*")), *sorted((ASSETS / "coarse").glob("*.su2"))]
    for path in files:
        steps = []
        volume = path.suffix == ".su2" and "NDIME= 3" in path.read_text()
        for name, (out, *options) in WRITERS.items():
            there = f"{name}.{out.split('.')[1]}"
            steps.append(["convert", path.name, there, "--quiet", *options])
            if not (volume and there.endswith(".stl")):
                steps.append(["convert", there, f"{name}_back.su2", "--quiet"])
        steps.append(["quality", path.name, "--report", "quality.json", "--quiet"])
        yield Case(f"format/{path.name}", steps, {path.name: path},
                   quick=path.name in ("square_41b.msh", "square_b.vtu", "quads.su2"))


def reports():
    for path in sorted(ASSETS.glob("*.su2")):
        yield Case(f"quality/{path.stem}", [["quality", "in.su2", "--histogram", "--worst", 7, "--report",
                                             "quality.json"]], {"in.su2": path}, quick=True)


SIZE = ["--size", 480, 360, "--quiet"]


def pictures():
    """What is drawn without a window: pictures, vector graphics, frames, and the studio."""
    mesh, view = ASSETS / "coarse/three_element.su2", ["--bounds", 0.65, -0.35, 1.15, 0.1]
    draw = ["render", "in.su2", *view, *SIZE]
    for field in ("normalized_jacobian", "aspect_ratio", "condition_number", "area", "kappa",
                  "smallest_weight", "residual"):
        yield Case(f"picture/{field}", [[*draw, "-o", "p.png", "--color", field]], {"in.su2": mesh},
                   quick=field in ("normalized_jacobian", "kappa"))
    vcv = free_node(mesh)
    options = {"plain": [], "dark": ["--dark", "--title", "Dark"], "bare": ["--no-wireframe", "--no-legend"],
               "vcv": ["--vcv", vcv]}
    for name, words in options.items():
        yield Case(f"picture/{name}", [[*draw, "-o", f"p.{end}", "--color", "aspect_ratio", *words]
                                       for end in ("png", "svg", "pdf")], {"in.su2": mesh}, name == "vcv")
    moved = ["move", "in.su2", "-o", "out.su2", "--quiet", *FLAP[1:]]
    yield Case("picture/before", [moved, ["render", "out.su2", "--before", "in.su2", "-o", "p.png", *view,
                                          *SIZE]], {"in.su2": mesh})
    recipe = json.dumps({"winslow_recipe": 1, "input": "in.su2", "commands": [
        {"command": "move", "markers": ["flap"], "rotate": -40, "pivot": [0.848, -0.036]}]})
    inputs = {"in.su2": mesh, "r.json": recipe}
    yield Case("picture/frames", [["render", "in.su2", "--recipe", "r.json", "--frames", "film",
                                   "--per-command", 3, *view, *SIZE]], inputs)
    yield Case("studio/window", [["studio", "--screenshot", "p.png", "--size", 1000, 700, "in.su2"]],
               {"in.su2": mesh}, quick=True)
    yield Case("studio/replay", [["studio", "--headless", "--replay", "r.json", "--screenshot", "p.png",
                                  "--size", 1000, 700]], inputs)


def body_layers(folder):
    """Layers around bodies that Gmsh meshes."""
    outlines = bodies(1)
    for name in BODIES:
        mesh = folder / f"{name}.su2"
        walls = mesh_bodies(outlines[name], mesh)
        yield chain(f"bodies/{name}", mesh, [["layers", *(w for wall in walls for w in ("--marker", wall)),
                                              "--count", 20, "--first", 5e-5, "--ratio", 1.25, "--growth", 1]])


def random_meshes(folder, count, seed, *more):
    subprocess.run([PYTHON, ROOT / "tests/meshes/make_random.py", folder, "--count", str(count),
                    "--seed", str(seed), *more], check=True, stdout=subprocess.DEVNULL)
    return json.loads((folder / "meshes.json").read_text())["meshes"]


def random_motions(folder):
    for mesh in random_meshes(folder, RANDOM_MESHES, 1, "--max-rotation", "120"):
        for k, motion in enumerate(mesh["motions"]):
            words = ["--marker", motion["marker"], "--rotate", motion["rotate"], "--pivot", *motion["pivot"],
                     "--translate", *motion["translate"], "--quiet"]
            for name in ("variational", "pointwise"):
                yield Case(f"random/{Path(mesh['file']).stem}/{k}/{name}",
                           [["move", mesh["file"], "-o", "out.su2", *words, *records("out"), "--formulation",
                             name]], {mesh["file"]: folder / mesh["file"]})


def robustness(folder, program):
    """The sample of robustness.py; the program only turns Gmsh's files into SU2, to read them here."""
    more = ("--max-rotation", "180", "--max-holes", "4")
    for mesh in random_meshes(folder, ROBUSTNESS_MESHES, 1000, *more):
        plain = folder / f"{Path(mesh['file']).stem}.su2"
        run(program, ["convert", folder / mesh["file"], plain, "--quiet"]).check_returncode()
        for k, (kind, steps) in enumerate(cases_of(mesh, read_nodes(plain), read_markers(plain))):
            yield chain(f"robustness/{plain.stem}/{k}-{kind}", plain, steps)


def all_cases(folder, program, quick):
    """All cases. Meshes that Gmsh makes are put into folder; quick: the few cases that need none."""
    made = [make() for make in (paper, smoothing, untangling, motions, layers, recipes, formats, reports,
                                pictures)]
    if not quick:
        places = [folder / name for name in ("bodies", "random", "robustness")]
        for place in places:
            place.mkdir()
        made += [body_layers(places[0]), random_motions(places[1]), robustness(places[2], program)]
    return [case for cases in made for case in cases if case.quick or not quick]
