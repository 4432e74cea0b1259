"""Running programs, and measuring the meshes that they write."""
import itertools
import json
import math
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass


@dataclass(frozen=True)
class Run:
    """A program that ran to its end. memory: the most that was resident at a time, bytes."""

    code: int
    user: float
    system: float
    wall: float
    memory: int
    timed_out: bool
    output: str  # the end of what it said

    def reason(self):
        """Its last words."""
        lines = [line.strip() for line in self.output.splitlines() if line.strip()]
        return lines[-1][:200] if lines else "it said nothing"


def run(command, timeout, environment=None):
    """Runs a command and measures it and all that it started. Throws OSError where it cannot be started."""
    with tempfile.TemporaryFile() as said:
        begin = time.monotonic()
        # A session of its own, so that all of it can be ended.
        process = subprocess.Popen([str(word) for word in command], env=environment, stdin=subprocess.DEVNULL,
                                   stdout=said, stderr=subprocess.STDOUT, start_new_session=True)
        expired = threading.Event()

        def end():
            expired.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(timeout, end)
        timer.start()
        try:
            _, status, usage = os.wait4(process.pid, 0)
        except BaseException:
            os.killpg(process.pid, signal.SIGKILL)
            raise
        finally:
            timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        wall = time.monotonic() - begin
        said.seek(0, os.SEEK_END)
        said.seek(max(0, said.tell() - 100_000))
        unit = 1 if sys.platform == "darwin" else 1024
        return Run(process.returncode, usage.ru_utime, usage.ru_stime, wall, usage.ru_maxrss * unit, expired.is_set(),
                   said.read().decode(errors="replace"))


@dataclass(frozen=True)
class Quality:
    """scaled Jacobian: of a plane mesh, sines scaled so that 1 is best. aspect: R/3r, in the plane R/2r."""

    nodes: int
    elements: int
    inverted: int
    jacobian_min: float
    jacobian_mean: float
    aspect_max: float


class MeasuringError(Exception):
    """A mesh that cannot be measured: a sentence."""


def quality(program, mesh):
    """Measures a mesh file by `winslow quality`."""
    done = subprocess.run([str(program), "quality", "--quiet", "--report", "-", str(mesh)], capture_output=True,
                          text=True, check=False)
    try:
        report = json.loads(done.stdout)
        metrics = report["quality"]
        return Quality(report["nodes"], report["elements"], report["inverted"],
                       metrics["normalized_jacobian"]["min"], metrics["normalized_jacobian"]["avg"],
                       metrics["aspect_ratio"]["max"])
    except (ValueError, KeyError, TypeError) as error:
        words = done.stderr.strip().splitlines() or [repr(error)]
        raise MeasuringError(f"{program} quality {mesh}: {words[-1]}") from error


class Su2File:
    """Parts of an SU2 file. It is read line by line, so that large meshes take no memory here."""

    PRISM = "13"

    def __init__(self, path):
        self.path = path

    def sections(self):
        """(key, value, lines) of every KEY= value; lines must be left or taken as far as they belong to it."""
        with open(self.path, encoding="ascii") as lines:
            for line in lines:
                key, separator, value = line.partition("=")
                if separator:
                    yield key.strip(), value.split("%")[0].strip(), lines

    def marker_faces(self, markers):
        out, wanted = [], False
        for key, value, lines in self.sections():
            if key in ("NELEM", "NPOIN"):
                skip(lines, int(value.split()[0]))
            elif key == "MARKER_TAG":
                wanted = value in markers
            elif key == "MARKER_ELEMS":
                faces = itertools.islice(lines, int(value))
                out += [tuple(map(int, face.split()[1:])) for face in faces if wanted]
        return out

    def points(self, nodes):
        """node -> coordinates"""
        for key, value, lines in self.sections():
            if key == "NELEM":
                skip(lines, int(value.split()[0]))
            elif key == "NPOIN":
                listed = enumerate(itertools.islice(lines, int(value.split()[0])))
                return {k: tuple(map(float, line.split()[:3])) for k, line in listed if k in nodes}
        raise MeasuringError(f"{self.path}: no NPOIN=")

    def prisms(self):
        for key, value, lines in self.sections():
            if key == "NELEM":
                for line in itertools.islice(lines, int(value.split()[0])):
                    kind, *nodes = line.split()
                    if kind == self.PRISM:
                        yield tuple(map(int, nodes[:6]))


def skip(lines, count):
    for _ in itertools.islice(lines, count):
        pass


def first_heights(path, marker):
    """wall face, as a set of nodes -> height of the prism on it: the middle of its other triangle over the wall."""
    mesh = Su2File(path)
    wall = {frozenset(face[:3]) for face in mesh.marker_faces({marker})}
    pairs = {}
    for prism in mesh.prisms():
        for face, other in ((prism[:3], prism[3:]), (prism[3:], prism[:3])):
            if frozenset(face) in wall:
                pairs[frozenset(face)] = (face, other)
    at = mesh.points({node for face, other in pairs.values() for node in (*face, *other)})
    heights = {}
    for key, (face, other) in pairs.items():
        a, b, c = (at[node] for node in face)
        normal = cross(minus(b, a), minus(c, a))
        above = [sum(at[node][k] for node in other) / 3 - (a[k] + b[k] + c[k]) / 3 for k in range(3)]
        heights[key] = abs(sum(n * h for n, h in zip(normal, above))) / math.hypot(*normal)
    return heights


def height_changes(before, after):
    """95th percentile and largest change of the heights, in per cent."""
    if not before or before.keys() != after.keys():
        raise MeasuringError("the faces at the wall are not those of the mesh as given")
    changes = sorted(100 * abs(after[face] / before[face] - 1) for face in before)
    return changes[int(0.95 * (len(changes) - 1))], changes[-1]


def motion_error(motion, before, after):
    """How far nodes of the body are from where the motion takes them, at most, over the size of the body."""
    nodes = {node for face in Su2File(before).marker_faces(set(motion.markers)) for node in face}
    given, moved = Su2File(before).points(nodes), Su2File(after).points(nodes)
    if not nodes or given.keys() != moved.keys():
        raise MeasuringError(f"{after}: the nodes are not those of {before}")
    error = max(math.dist(image(motion, given[k]), in_space(moved[k], len(motion.pivot))) for k in nodes)
    size = max(max(p[k] for p in given.values()) - min(p[k] for p in given.values()) for k in range(len(motion.pivot)))
    return error / size


def image(motion, point):
    """Where a motion takes a point, in space; Rodrigues' formula."""
    pivot, shift = (in_space(v, len(motion.pivot)) for v in (motion.pivot, motion.translate))
    axis = motion.axis or (0, 0, 1)
    unit = [a / math.hypot(*axis) for a in axis]
    arm = minus(in_space(point, len(motion.pivot)), pivot)
    angle = math.radians(motion.rotate)
    along = sum(u * a for u, a in zip(unit, arm)) * (1 - math.cos(angle))
    side = cross(unit, arm)
    return [pivot[k] + math.cos(angle) * arm[k] + math.sin(angle) * side[k] + along * unit[k] + shift[k]
            for k in range(3)]


def in_space(point, dimension):
    return (*point[:dimension], 0.0)[:3]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
