"""The numbers of quality of volume meshes are those that OpenFOAM's checkMesh prints, to all of its digits."""
import argparse
import json
import math
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile

from support import check, finish

FOAM = pathlib.Path("/usr/share/openfoam")
DATA = pathlib.Path(__file__).resolve().parents[1] / "data" / "openfoam"
EXAMPLES = pathlib.Path("/usr/share/doc/openfoam-examples/examples")
NUMBER = r"(-?(?:\d+\.?\d*(?:e[-+]?\d+)?|nan|inf))"
# What checkMesh prints, and where our number is: name and "min", "avg", "max" or "beyond".
PRINTED = [
    (rf"Boundary openness \({NUMBER} {NUMBER} {NUMBER}\)",
     [("boundary_openness", 0), ("boundary_openness", 1), ("boundary_openness", 2)]),
    (rf"Max cell openness = {NUMBER}", [("cell_openness", "max")]),
    (rf"max cell openness: {NUMBER}, number of open cells {NUMBER}",
     [("cell_openness", "max"), ("cell_openness", "beyond")]),
    (rf"Max aspect ratio = {NUMBER}", [("aspect_ratio", "max")]),
    (rf"Max aspect ratio: {NUMBER}, number of cells {NUMBER}",
     [("aspect_ratio", "max"), ("aspect_ratio", "beyond")]),
    (rf"Minimum face area = {NUMBER}\. Maximum face area = {NUMBER}\.",
     [("face_area", "min"), ("face_area", "max")]),
    (rf"Min volume = {NUMBER}\. Max volume = {NUMBER}\.  Total volume = {NUMBER}\.",
     [("volume", "min"), ("volume", "max"), ("total_volume", None)]),
    (rf"Minimum negative volume: {NUMBER}, Number of negative volume cells: {NUMBER}",
     [("volume", "min"), ("volume", "beyond")]),
    (rf"Mesh non-orthogonality Max: {NUMBER} average: {NUMBER}",
     [("non_orthogonality", "max"), ("non_orthogonality", "avg")]),
    (rf"non-orthogonality errors: {NUMBER}\.", [("orthogonality_errors", None)]),
    (rf"Error in face pyramids: {NUMBER} faces", [("pyramid_errors", None)]),
    (rf"Max skewness = {NUMBER}", [("skewness", "max")]),
    (rf"{NUMBER} highly skew faces", [("skewness", "beyond")]),
    (rf"Error in face tets: {NUMBER} faces", [("poor_divisions", None)]),
    (rf"[Mm]in/max edge length = {NUMBER} {NUMBER}", [("edge_length", "min"), ("edge_length", "max")]),
    (rf"There are {NUMBER} faces with concave angles.*angle = {NUMBER} degrees",
     [("concave_angle", "beyond"), ("concave_angle", "max")]),
    (rf"Face flatness .* min = {NUMBER}  average = {NUMBER}", [("flatness", "min"), ("flatness", "avg")]),
    (rf"There are {NUMBER} faces with ratio between projected", [("flatness", "beyond")]),
    (rf"Cell determinant \(wellposedness\) : minimum: {NUMBER} average: {NUMBER}",
     [("determinant", "min"), ("determinant", "avg")]),
    (rf"small determinant .* number of cells: {NUMBER}", [("determinant", "beyond")]),
    (rf"Concave cells .* number of cells: {NUMBER}", [("concave_cells", None)]),
    (rf"Face interpolation weight : minimum: {NUMBER} average: {NUMBER}",
     [("face_weight", "min"), ("face_weight", "avg")]),
    (rf"small interpolation weight .* number of faces: {NUMBER}", [("face_weight", "beyond")]),
    (rf"Face volume ratio : minimum: {NUMBER} average: {NUMBER}",
     [("volume_ratio", "min"), ("volume_ratio", "avg")]),
    (rf"small volume ratio .* number of faces: {NUMBER}", [("volume_ratio", "beyond")]),
]
# checkMesh does not print these where they are 0.
COUNTED = {"orthogonality_errors": "non-orthogonality errors", "pyramid_errors": "face pyramids:",
           "poor_divisions": "face tets:", "concave_cells": "Concave cells"}
# Round-off alone: the numbers agree if the faces and their nodes have the same order in both programs.
ROUND_OFF = ("boundary_openness", "cell_openness")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--measures", required=True, help="the program interop_foam_measures")
    parser.add_argument("--winslow", help="the program winslow")
    parser.add_argument("--table", action="store_true", help="print both numbers of every line")
    parser.add_argument("cases", nargs="*", help="other cases; none: those of the test")
    return parser.parse_args()


def run(*command, cwd=None):
    env = {**os.environ}
    env.setdefault("WM_PROJECT_DIR", str(FOAM))
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=env, cwd=cwd,
                            check=False)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{result.stdout[-2000:]}{result.stderr[-2000:]}")
    return result.stdout


def header(kind, name):
    return ("FoamFile\n{\n    version     2.0;\n    format      ascii;\n"
            f"    class       {kind};\n    object      {name};\n}}\n")


def write_system(case):
    (case / "system").mkdir(parents=True, exist_ok=True)
    control = "application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; "
    (case / "system/controlDict").write_text(header("dictionary", "controlDict") + control +
                                             "writeControl timeStep; writeInterval 1;\n")
    for name in ("fvSchemes", "fvSolution"):
        shutil.copy(DATA / "cyclic/system" / name, case / "system")


def write_blocks(case, blocks, vertices, edges=""):
    """A case whose mesh blockMesh makes."""
    write_system(case)
    points = "\n".join(f"({x} {y} {z})" for x, y, z in vertices)
    (case / "system/blockMeshDict").write_text(
        header("dictionary", "blockMeshDict") +
        f"vertices\n(\n{points}\n);\nblocks\n(\n{blocks}\n);\nedges ({edges});\nboundary ();\n")
    run("blockMesh", "-case", case)


def cube(case, cells="4 5 6", grading="1 1 1", edges=""):
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    write_blocks(case, f"hex (0 1 2 3 4 5 6 7) ({cells}) simpleGrading ({grading})", corners, edges)


POINT = re.compile(r"\(([^ ()]+) ([^ ()]+) ([^ ()]+)\)")


def move_points(case, move):
    file = case / "constant/polyMesh/points"
    text = file.read_text()

    def moved(match):
        return "(%.17g %.17g %.17g)" % tuple(move([float(x) for x in match.groups()]))

    file.write_text(POINT.sub(moved, text))


def scrambled(case, reach, seed):
    shake = random.Random(seed)

    def move(p):
        inside = all(1e-6 < x < 1 - 1e-6 for x in p)
        return [x + (shake.uniform(-reach, reach) if inside else 0) for x in p]

    move_points(case, move)


def sphere(case):
    """A ball of seven blocks: hexahedra with curved sides."""
    inner, outer = 0.3, 1 / math.sqrt(3)
    signs = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1), (-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)]
    vertices = [tuple(size * s for s in sign) for size in (inner, outer) for sign in signs]
    sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    blocks = ["hex (0 1 2 3 4 5 6 7) (4 4 4) simpleGrading (1 1 1)"]
    for side in sides:
        nodes = list(side) + [8 + node for node in side]
        blocks.append(f"hex ({' '.join(map(str, nodes))}) (4 4 5) simpleGrading (1 1 0.2)")
    edges = []
    for a in range(8):
        for b in range(a + 1, 8):
            if sum(x != y for x, y in zip(signs[a], signs[b])) != 1:
                continue
            middle = [(x + y) / math.sqrt(8) for x, y in zip(signs[a], signs[b])]
            edges.append(f"arc {8 + a} {8 + b} ({' '.join(map(str, middle))})")
    write_blocks(case, "\n".join(blocks), vertices, "\n".join(edges))


def snappy(case):
    """A sphere in a box, refined around it: cells with hanging nodes, and polyhedra at the sphere."""
    cube(case, "8 8 8")
    (case / "system/snappyHexMeshDict").write_text(header("dictionary", "snappyHexMeshDict") + """
castellatedMesh true; snap true; addLayers false;
geometry { ball { type searchableSphere; centre (0.5 0.5 0.5); radius 0.23; } }
castellatedMeshControls
{
    maxLocalCells 100000; maxGlobalCells 200000; minRefinementCells 0; nCellsBetweenLevels 2;
    features (); refinementSurfaces { ball { level (1 2); } } resolveFeatureAngle 30;
    refinementRegions {} locationInMesh (0.11 0.12 0.13); allowFreeStandingZoneFaces true;
}
snapControls { nSmoothPatch 3; tolerance 2; nSolveIter 30; nRelaxIter 5; }
addLayersControls
{
    relativeSizes true; layers {} expansionRatio 1; finalLayerThickness 0.3; minThickness 0.1; nGrow 0;
    featureAngle 60; nRelaxIter 3; nSmoothSurfaceNormals 1; nSmoothNormals 3; nSmoothThickness 10;
    maxFaceThicknessRatio 0.5; maxThicknessToMedialRatio 0.3; minMedianAxisAngle 90;
    nBufferCellsNoExtrude 0; nLayerIter 50;
}
meshQualityControls
{
    maxNonOrtho 65; maxBoundarySkewness 20; maxInternalSkewness 4; maxConcave 80; minVol 1e-13;
    minTetQuality 1e-30; minArea -1; minTwist 0.02; minDeterminant 0.001; minFaceWeight 0.05;
    minVolRatio 0.01; minTriangleTwist -1; nSmoothScale 4; errorReduction 0.75;
}
mergeTolerance 1e-6;
""")
    run("snappyHexMesh", "-overwrite", "-case", case)


def made_cases(folder):
    """Names and folders of cases that are made here."""
    def make(name, build):
        case = folder / re.sub("[^a-z]", "_", name)
        build(case)
        return name, case

    yield make("cubes", cube)
    yield make("graded to 1 : 2000", lambda case: cube(case, "4 4 8", "1 1 2000"))

    def shear(case):
        cube(case)
        move_points(case, lambda p: [p[0] + 0.7 * p[2], p[1] - 0.4 * p[2], p[2]])

    yield make("sheared", shear)

    def shaken(case, reach, seed):
        cube(case)
        scrambled(case, reach, seed)

    yield make("shaken", lambda case: shaken(case, 0.05, 1))
    yield make("scrambled", lambda case: shaken(case, 0.4, 2))

    def bent(case):
        cube(case, "6 6 6")
        move_points(case, lambda p: [p[0] + 0.3 * math.sin(5 * p[1]), p[1] + 0.4 * p[0] * p[2], p[2] ** 2 + 0.1 * p[2]])

    yield make("bent", bent)
    yield make("ball", sphere)
    yield make("polyhedra of a refined box", snappy)

    def dual(case):
        shaken(case, 0.03, 3)
        run("polyDualMesh", "60", "-overwrite", "-case", case, cwd=case)  # writes files there

    yield make("dual polyhedra", dual)


def installed_cases(folder):
    """Cases of OpenFOAM's examples, and those of our own tests that lie in a plane."""
    shutil.copytree(DATA / "ellipse", folder / "ellipse")
    write_system(folder / "ellipse")
    yield "one cell thick", folder / "ellipse"
    airfoil = EXAMPLES / "incompressible/simpleFoam/airFoil2D/constant"
    if airfoil.exists():
        shutil.copytree(airfoil, folder / "airfoil/constant")
        write_system(folder / "airfoil")
        yield "airFoil2D of the examples", folder / "airfoil"


def precision_of(case):
    """Digits that checkMesh writes."""
    given = re.search(r"writePrecision\s+(\d+)", (case / "system/controlDict").read_text())
    return int(given.group(1)) if given else 6


def digits(value, precision):
    """A number as checkMesh writes it."""
    return f"{value:.{precision}g}"


def our_number(measures, place):
    name, part = place
    return measures[name] if part is None else measures[name][part]


def printed_numbers(said):
    """The numbers that checkMesh printed, as texts, by our places."""
    seen = {}
    for pattern, places in PRINTED:
        match = re.search(pattern, said)
        if match:
            seen.update(zip(places, match.groups()))
    for place, text in COUNTED.items():
        if text not in said:
            seen[(place, None)] = "0"
    return seen


def same_number(place, text, ours, precision):
    if place[0] in ROUND_OFF and abs(float(text)) < 1e-12:
        return abs(ours) < 1e-12
    if precision > 12:  # the last digits are round-off
        return math.isclose(ours, float(text), rel_tol=1e-12, abs_tol=1e-14)
    return digits(ours, precision) == text


def compare_report(name, case, seen, args):
    """The same of winslow's own report, if it reads the mesh. It knows no directions without solution."""
    report = case / "quality.json"
    result = subprocess.run([args.winslow, "quality", case, "--quiet", "--report", report], check=False,
                            capture_output=True, text=True)
    if not report.exists():
        return "not read: " + (result.stderr.strip().split("\n") or [""])[0][-60:]
    measures = json.loads(report.read_text()).get("openfoam")
    if measures is None:
        return "plane"
    equal, precision = 0, precision_of(case)
    for place, text in seen.items():
        ours = our_number(measures, place)
        if text == "-1":  # checkMesh measures no aspect ratio where empty patches leave no direction
            continue
        # Round-off depends on where the nodes of a face begin, which a reader may change.
        same = same_number(place, text, ours, precision) or max(abs(float(text)), abs(ours)) < 1e-12
        equal += same
        check(f"{name}, winslow quality: {place}", same, f"checkMesh {text}, we {ours:.17g}")
    return f"{equal} of {len(seen)}"


def compare(name, case, args):
    said = run("checkMesh", "-allGeometry", "-allTopology", "-constant", "-case", case)
    measures = json.loads(run(args.measures, case))
    seen = printed_numbers(said)
    severe = re.search(r"severely non-orthogonal .* faces: (\d+)\.", said)
    beyond = measures["non_orthogonality"]["beyond"] - measures["orthogonality_errors"]
    check(f"{name}: severely non-orthogonal faces", beyond == int(severe.group(1) if severe else 0), beyond)
    check(f"{name}: enough was compared", len(seen) >= 24, f"{len(seen)} numbers\n{said}")
    equal, precision = 0, precision_of(case)
    for place, text in seen.items():
        ours = our_number(measures, place)
        same = digits(ours, precision) == text
        equal += same
        if args.table and not same:
            print(f"  {name}: {place}: checkMesh {text}, we {digits(ours, precision)}")
        check(f"{name}: {place}", same_number(place, text, ours, precision), f"checkMesh {text}, we {ours:.17g}")
    own = compare_report(name, case, seen, args) if args.winslow else "-"
    if args.table:
        cells = re.search(r"cells: +(\d+)", said).group(1)
        print(f"| {name} | {cells} | {equal} of {len(seen)} | {own} |")


def main():
    args = arguments()
    if not shutil.which("checkMesh"):
        print("skipped: checkMesh is not installed")
        sys.exit(77)
    if args.cases:
        for case in args.cases:
            compare(case, pathlib.Path(case), args)
    else:
        with tempfile.TemporaryDirectory() as name:
            for cases in (made_cases, installed_cases):
                for title, case in cases(pathlib.Path(name)):
                    compare(title, case, args)
    finish()


main()
