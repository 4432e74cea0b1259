"""Who runs a row: winslow, and the peers that it is measured beside."""
import hashlib
import json
import math
import os
import shutil
import subprocess
from dataclasses import dataclass, field, replace
from pathlib import Path

from measuring import MeasuringError, Run, first_heights, height_changes, motion_error, quality, run
from mesh_store import NoMesh

# Boundary nodes lie this near to where the motion takes them, over the size of the body.
PLACE_TOLERANCE = 1e-6


@dataclass(frozen=True)
class Outcome:
    """What one contender did in one row."""

    contender: str
    run: Run = None             # None: it did not run
    runs: int = 0
    quality: object = None      # of the mesh that it wrote; None: it wrote none
    heights: tuple = ()         # change of the first heights, per cent: 95th percentile, worst
    notes: tuple = ()
    failure: str = ""           # of a program of winslow: why the row counts as failed
    skipped: bool = False


@dataclass
class Bench:
    """What all contenders need: the judge is the program that converts and measures for all of them."""

    judge: Path
    store: object
    folder: Path
    timeout: float
    increments: tuple = ()                       # instead of those of the rows
    given: dict = field(default_factory=dict)    # file -> its quality, and heights

    def quality_of(self, mesh):
        if mesh not in self.given:
            self.given[mesh] = quality(self.judge, mesh)
        return self.given[mesh]

    def heights_of(self, mesh, wall):
        if (mesh, wall) not in self.given:
            self.given[mesh, wall] = first_heights(mesh, wall)
        return self.given[mesh, wall]

    def convert(self, source, target):
        done = subprocess.run([str(self.judge), "convert", "--quiet", str(source), "-o", str(target)],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise MeasuringError(f"{self.judge} convert {source}: {done.stderr.strip()}")

    def measured(self, outcome, row, written):
        """The outcome with all that is measured of the SU2 file that it wrote."""
        given = self.store.path(row.mesh)
        outcome = replace(outcome, quality=quality(self.judge, written))
        error = motion_error(row.motion, given, written) if row.motion else 0
        if error > PLACE_TOLERANCE and not outcome.failure:
            reason = f"the body is not where the motion takes it, by {error:.2g} of its size"
            outcome = replace(outcome, failure=reason)
        if row.wall:
            heights = height_changes(self.heights_of(given, row.wall), first_heights(written, row.wall))
            outcome = replace(outcome, heights=heights)
        return outcome


class Winslow:
    """A program of winslow, the new one or an old one. options: in every row, besides those of the row."""

    def __init__(self, label, program, options=()):
        self.name, self.program, self.options = label, program, options

    def command(self, row, mesh, out, report):
        words = [self.program, "move" if row.motion else "smooth", mesh, "-o", out, "--report", report]
        return [*words, *(row.motion.flags() if row.motion else ()), *row.options, *self.options]

    def run_once(self, row, bench):
        """One run, as an outcome whose mesh is not yet measured, and the file of that."""
        out, report = (bench.folder / f"winslow-{id(self)}{ending}" for ending in (".su2", ".json"))
        for path in (out, report):
            path.unlink(missing_ok=True)
        done = run(self.command(row, bench.store.path(row.mesh), out, report), bench.timeout)
        failure = ""
        if done.timed_out:
            failure = f"not done within {bench.timeout:g} s"
        elif done.code != 0:
            failure = f"exit status {done.code}: {done.reason()}"
        return Outcome(self.name, done, 1, notes=solves(report), failure=failure), out


def solves(report):
    try:
        count = json.loads(report.read_text())["linear_solves"]
        return (f"{count} solves",)
    except (OSError, ValueError, KeyError):
        return ()


def outcomes(programs, row, bench, repeat):
    """Runs programs of winslow by turns, each `repeat` times; of each the run with the least CPU."""
    best, bytes_of = {}, {}
    for _ in range(repeat):
        for program in programs:
            outcome, out = program.run_once(row, bench)
            written = digest(out) if out.exists() else b""
            if program.name in best:
                same = written == bytes_of[program.name]
                best[program.name] = better(best[program.name], outcome, same)
            else:
                best[program.name], bytes_of[program.name] = judged(outcome, row, bench, out), written
    return [replace(best[program.name], runs=repeat) for program in programs]


def digest(path):
    """Of a file, read in pieces: what is resident here counts as the memory of programs that are started."""
    out = hashlib.sha256()
    with open(path, "rb") as file:
        while piece := file.read(1 << 20):
            out.update(piece)
    return out.digest()


def better(before, again, same):
    """What to keep of an outcome and of another run of the same. same: whether it wrote the same bytes."""
    failure = before.failure or again.failure or ("" if same else "it wrote another mesh when it was run again")
    return replace(before, run=min(before.run, again.run, key=lambda run: run.user), failure=failure)


def judged(outcome, row, bench, out):
    if not out.exists():
        return outcome if outcome.failure else replace(outcome, failure="it wrote no mesh")
    try:
        outcome = bench.measured(outcome, row, out)
    except MeasuringError as error:
        return replace(outcome, failure=str(error))
    if outcome.quality.inverted and not outcome.failure:
        outcome = replace(outcome, failure=f"{outcome.quality.inverted} elements are inverted")
    return outcome


class Peer:
    """What peers have in common. A peer that fails is a result, not a fault."""

    def finish(self, name, done, row, bench, written, notes=()):
        if done.timed_out:
            return Outcome(name, done, 1, notes=(f"not done within {bench.timeout:g} s",))
        if done.code != 0:
            return Outcome(name, done, 1, notes=(done.reason(),))
        try:
            outcome = bench.measured(Outcome(name, done, 1, notes=notes), row, written())
        except MeasuringError as error:
            return Outcome(name, done, 1, notes=(*notes, str(error)))
        return replace(outcome, failure="", notes=(*outcome.notes, *((outcome.failure,) if outcome.failure else ())))


class Elasticity(Peer):
    """Linear elasticity in increments: bench/elastic_move."""

    family = "elasticity"

    def __init__(self, program):
        self.program = program

    def outcomes(self, row, bench):
        if row.motion is None or not row.mesh.tetrahedra:
            return
        counts = bench.increments or row.increments
        if self.program is None:
            yield Outcome("elasticity", skipped=True, notes=("bench/elastic_move is not built (WINSLOW_BUILD_BENCH)",))
            return
        for count in counts:
            out = bench.folder / "elasticity.su2"
            out.unlink(missing_ok=True)
            command = [self.program, bench.store.path(row.mesh), *row.motion.flags(), "--increments", count, "-o", out]
            done = run(command, bench.timeout)
            name = f"elasticity, {count} increment{'s' if count > 1 else ''}"
            yield self.finish(name, done, row, bench, lambda: out)


class Gmsh(Peer):
    """Gmsh's optimizers of tetrahedra, on its own mesh with its geometry: without that they leave meshes as they
    are. They change edges and faces as well. Elements better than the threshold are left."""

    family = "gmsh"
    OPTIMIZERS = [("Gmsh -optimize", "Gmsh", 0.3), ("Gmsh -optimize, threshold .8", "Gmsh", 0.8),
                  ("Gmsh Relocate3D", "Relocate3D", 0.3), ("Gmsh -optimize_netgen", "Netgen", 0.3)]

    def outcomes(self, row, bench):
        if row.motion is not None or row.mesh.scrambled or not row.mesh.volume:
            return
        if shutil.which("gmsh") is None:
            yield Outcome("Gmsh", skipped=True, notes=("gmsh is not installed",))
            return
        try:
            geo, msh = bench.store.gmsh_files(row.mesh)
        except NoMesh as error:
            yield Outcome("Gmsh", skipped=True, notes=(str(error),))
            return
        for name, optimizer, threshold in self.OPTIMIZERS:
            yield self.optimized(name, optimizer, threshold, row, bench, geo, msh)

    def optimized(self, name, optimizer, threshold, row, bench, geo, msh):
        script, out = bench.folder / "optimize.geo", bench.folder / "optimized.msh"
        out.unlink(missing_ok=True)
        script.write_text(f'Merge "{geo}";\nMerge "{msh}";\nMesh.OptimizeThreshold = {threshold};\n'
                          f'OptimizeMesh "{optimizer}";\nSave "{out}";\n')
        done = run(["gmsh", script, "-parse_and_exit", "-v", 2], bench.timeout)
        if "not compiled" in done.output:
            return Outcome(name, skipped=True, notes=(done.reason().removeprefix("Error   : "),))
        outcome = self.finish(name, done, row, bench, lambda: out)
        if outcome.quality and outcome.quality == bench.quality_of(bench.store.path(row.mesh)):
            outcome = replace(outcome, notes=(*outcome.notes, "left the mesh as it was"))
        return outcome


class OpenFoam(Peer):
    """displacementLaplacian of OpenFOAM in one step: the displacement is linear in the motion, so more steps would
    only renew the diffusivity."""

    family = "openfoam"
    NAME = "OpenFOAM displacementLaplacian"
    # What Debian's package installs and does not find by itself.
    ETC = Path("/usr/share/openfoam")

    def outcomes(self, row, bench):
        if row.motion is None or not row.mesh.volume:
            return
        program = shutil.which("moveDynamicMesh")
        if program is None:
            yield Outcome(self.NAME, skipped=True, notes=("moveDynamicMesh is not installed (Debian: openfoam)",))
            return
        case = bench.folder / "openfoam"
        shutil.rmtree(case, ignore_errors=True)
        try:
            case.mkdir()
            bench.convert(bench.store.path(row.mesh), case / "constant/polyMesh")
        except MeasuringError as error:
            yield Outcome(self.NAME, skipped=True, notes=(str(error),))
            return
        write_case(case, row.motion)
        environment = dict(os.environ)
        if self.ETC.is_dir():
            environment.setdefault("WM_PROJECT_DIR", str(self.ETC))
        done = run([program, "-overwrite", "-case", case], bench.timeout, environment=environment)
        yield self.finish(self.NAME, done, row, bench, lambda: self.as_su2(case, bench))

    @staticmethod
    def as_su2(case, bench):
        out = bench.folder / "openfoam.su2"
        bench.convert(case / "constant/polyMesh", out)
        return out


def write_case(case, motion):
    """The files of a case beside its mesh. Distances are those from points of the body: by inverseDistance the
    diffusivity is infinite at the body, and the linear solvers stop at once."""
    patches = [line.strip() for line in patch_names((case / "constant/polyMesh/boundary").read_text())]
    body = " ".join(motion.markers)
    write_dictionary(case / "system/controlDict", "dictionary",
                     "application moveDynamicMesh; startFrom startTime; startTime 0; stopAt endTime; endTime 1; "
                     "deltaT 1; writeControl timeStep; writeInterval 1; writeFormat ascii; writePrecision 17; "
                     "writeCompression off; timeFormat general; runTimeModifiable false;")
    write_dictionary(case / "system/fvSchemes", "dictionary",
                     "ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default none; } "
                     "laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; } "
                     "snGradSchemes { default corrected; }")
    write_dictionary(case / "system/fvSolution", "dictionary", 'solvers { "cellDisplacement.*" { solver GAMG; '
                     "smoother GaussSeidel; tolerance 1e-8; relTol 0; } }")
    write_dictionary(case / "constant/dynamicMeshDict", "dictionary",
                     "dynamicFvMesh dynamicMotionSolverFvMesh; motionSolverLibs (fvMotionSolvers); motionSolver "
                     "displacementLaplacian; displacementLaplacianCoeffs { diffusivity quadratic inversePointDistance "
                     f"({body}); }}")
    fixed = "{ type fixedValue; value uniform (0 0 0); }"
    conditions = "\n".join(f"{p} {moving_patch(motion) if p in motion.markers else fixed}" for p in patches)
    write_dictionary(case / "0/pointDisplacement", "pointVectorField",
                     "dimensions [0 1 0 0 0 0 0]; internalField uniform (0 0 0);\n"
                     f"boundaryField {{\n{conditions}\n}}")


def moving_patch(motion):
    """Turned about the axis, then shifted: multiMotion takes the last motion first. Time goes from 0 to 1."""
    def vector(v):
        return f"({' '.join(map(repr, map(float, v)))})"

    return ("{ type solidBodyMotionDisplacement; value uniform (0 0 0); solidBodyMotionFunction multiMotion; "
            "multiMotionCoeffs { shift { solidBodyMotionFunction linearMotion; linearMotionCoeffs { velocity "
            f"{vector(motion.translate)}; }} }} turn {{ solidBodyMotionFunction rotatingMotion; rotatingMotionCoeffs "
            f"{{ origin {vector(motion.pivot)}; axis {vector(motion.axis)}; "
            f"omega {math.radians(motion.rotate)!r}; }} }} }} }}")


def patch_names(boundary):
    """Names in the file `boundary` as winslow writes it: alone on a line before a line with {."""
    lines = [line.strip() for line in boundary.splitlines()]
    return [name for name, after in zip(lines, lines[1:]) if after == "{" and name and name != "FoamFile"]


def write_dictionary(path, kind, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"FoamFile {{ version 2.0; format ascii; class {kind}; object {path.name}; }}\n{text}\n")
