#!/usr/bin/python3
"""Compares everything that two builds of the program write, byte for byte:

    python3 same_results.py BASE_PROGRAM NEW_PROGRAM [--quick] [--only PATTERN] [--ignore PATTERN]
    python3 same_results.py --record DIGESTS.json PROGRAM
    python3 same_results.py --against DIGESTS.json PROGRAM

The cases are those of result_cases.py: some 250 runs of every command, formulation, solver and format,
in about five minutes on two cores; --quick takes a sixth of them. The others need Gmsh and numpy. Exit statuses and all written files
are compared, of pictures their pixels, of reports all but times and memory. --extra OPTION (repeated)
hands the second program another option where it is known: to see that differences are found.
"""
import argparse
import collections
import concurrent.futures
import fnmatch
import hashlib
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path

from result_cases import all_cases

LIMIT = 900  # seconds for a step
VARYING = ("seconds", "peak_memory_bytes")


def without_varying(value):
    if isinstance(value, dict):
        return {k: without_varying(v) for k, v in value.items() if k not in VARYING}
    return [without_varying(v) for v in value] if isinstance(value, list) else value


def pixels(data):
    """What a PNG file holds: size, kind and the scanlines, unpacked."""
    at, parts, packed = 8, [], b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        if kind == b"IDAT":
            packed += body
        elif kind in (b"IHDR", b"PLTE"):
            parts.append(body)
        at += 12 + length
    return b"".join([*parts, zlib.decompress(packed)])


def essence(path):
    """The content of a file without what differs from run to run."""
    data = path.read_bytes()
    if path.suffix == ".json":
        return json.dumps(without_varying(json.loads(data)), indent=1, sort_keys=True).encode()
    if path.suffix == ".png":
        return pixels(data)
    if path.suffix == ".pdf":
        return re.sub(rb"/CreationDate \([^)]*\)", b"", data)
    return data


def run_case(program, case, folder, extra=()):
    """Runs the case in a new folder. Digest of each file written, a step's status counting as one, and
    what is wrong with the case itself; empty if nothing."""
    folder.mkdir(parents=True)
    for name, source in case.inputs.items():
        target = folder / name
        if isinstance(source, Path):
            target.symlink_to(source.resolve())
        else:
            target.write_text(source)
    environment = {**os.environ, "DISPLAY": "", "WAYLAND_DISPLAY": "",
                   "WINSLOW_PROFILE": str(folder) + ".profile"}
    found, worst = {}, ""
    for k, step in enumerate(case.steps):
        words = [*step, *extra] if step[0] in ("move", "deform", "smooth") else step
        try:
            done = subprocess.run([program, *words], cwd=folder, env=environment, capture_output=True,
                                  text=True, timeout=LIMIT, check=False)
        except subprocess.TimeoutExpired:
            return {}, f"no end after {LIMIT} s"
        (folder / f"step{k}.status").write_text(f"{done.returncode}\n")
        if done.returncode not in (0, 4, 5):
            worst = f"a step ended with status {done.returncode}: the case shows nothing"
            (folder / f"step{k}.stderr").write_text(done.stderr)
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_file() and name not in case.inputs and not name.endswith(".stderr"):
            found[name] = hashlib.sha256(essence(path)).hexdigest()
    return found, worst


def input_digest(case):
    digest = hashlib.sha256(json.dumps(case.steps).encode())
    for name, source in sorted(case.inputs.items()):
        digest.update(name.encode())
        digest.update(source.read_bytes() if isinstance(source, Path) else source.encode())
    return digest.hexdigest()


def first_difference(old, new):
    """One line about two contents: the first line that differs, of text."""
    if not (old.isascii() and new.isascii()):
        return f"{len(old)} and {len(new)} bytes"
    a, b = old.decode().splitlines(), new.decode().splitlines()
    apart = [k for k in range(min(len(a), len(b))) if a[k] != b[k]]
    if not apart:
        return f"{len(a)} and {len(b)} lines"
    k = apart[0]
    return f"{len(apart)} of {len(a)} lines, first line {k + 1}: {a[k].strip()[:70]!r}, {b[k].strip()[:70]!r}"


def describe(name, folders):
    paths = [folder / name for folder in folders]
    if len(paths) < 2:
        return name
    for path, which in zip(paths, ("base", "new")):
        if not path.exists():
            return f"{name}: not written by the {which} program"
    return f"{name}: {first_difference(*map(essence, paths))}"


def folder_of(work, which, case):
    return work / which / case.name.replace("/", "+")  # beside one another: names begin alike


class Comparison:
    def __init__(self, options, work, recorded):
        self.options, self.work, self.recorded = options, work, recorded
        self.digests = {}

    def ignored(self, name):
        return any(fnmatch.fnmatch(name, pattern) for pattern in self.options.ignore)

    def expected(self, case):
        """Digests of the base, and the folders to look into for differences."""
        if self.recorded is None:
            folder = folder_of(self.work, "base", case)
            found, worst = run_case(self.options.programs[0], case, folder)
            return found, worst, [folder]
        known = self.recorded.get(case.name)
        if known is None:
            return None, "", []
        return (known["files"] if known["inputs"] == input_digest(case) else {}), "", []

    def compare(self, case):
        """Case, list of differences, seconds."""
        start = time.monotonic()
        faults = []
        old, worst, folders = ({}, "", []) if self.options.record else self.expected(case)
        folder = folder_of(self.work, "new", case)
        new, worst_new = run_case(self.options.programs[-1], case, folder, self.options.extra)
        self.digests[case.name] = {"inputs": input_digest(case), "files": new}
        if worst or worst_new:
            faults.append(worst_new or worst)
        elif old is None:
            faults.append("not recorded")
        elif self.options.record:
            pass
        elif not old:
            faults.append("recorded with other inputs")
        else:
            faults += [describe(name, [*folders, folder]) for name in sorted({*old, *new})
                       if old.get(name) != new.get(name) and not self.ignored(name)]
        return case, faults, time.monotonic() - start


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", metavar="PROGRAM", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="*", help="cases by name, e.g. 'layers/*'")
    parser.add_argument("--ignore", action="append", default=[], help="files by name, e.g. '*.recipe.json'")
    parser.add_argument("--record", type=Path, help="write the digests of one program")
    parser.add_argument("--against", type=Path, help="compare with recorded digests")
    parser.add_argument("--extra", action="append", default=[], help="option for the second program alone")
    parser.add_argument("--keep", type=Path, help="leave what was written here")
    parser.add_argument("--list", action="store_true", help="list the cases and do nothing")
    parser.add_argument("-j", "--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    wanted = 1 if options.record or options.against or options.list else 2
    if len(options.programs) != wanted:
        parser.error(f"{wanted} program(s) wanted, {len(options.programs)} given")
    return options


def run_all(options, work):
    recorded = json.loads(options.against.read_text()) if options.against else None
    (work / "inputs").mkdir(parents=True)
    cases = [case for case in all_cases(work / "inputs", options.programs[0], options.quick)
             if fnmatch.fnmatch(case.name, options.only)]
    if options.list:
        print("\n".join(case.name for case in cases))
        return 0
    comparison = Comparison(options, work, recorded)
    tally = collections.defaultdict(lambda: [0, 0, 0, 0.0])
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for case, faults, seconds in pool.map(comparison.compare, cases):
            row = tally[case.name.split("/")[0]]
            row[0] += not faults
            row[1] += bool(faults)
            row[2] += len(comparison.digests[case.name]["files"])
            row[3] += seconds
            for fault in faults:
                print(f"{case.name}: {fault}", flush=True)
    if options.record:
        options.record.write_text(json.dumps(comparison.digests, indent=1, sort_keys=True) + "\n")
    print(f"{'group':<12} {'same':>6} {'other':>6} {'files':>6} {'seconds':>8}")
    for group, (same, other, files, seconds) in tally.items():
        print(f"{group:<12} {same:>6} {other:>6} {files:>6} {seconds:>8.1f}")
    passed, failed = (sum(row[k] for row in tally.values()) for k in (0, 1))
    print(f"{passed} passed, {failed} failed")
    return 1 if failed or not passed else 0


def main():
    options = parse()
    if options.keep:
        return run_all(options, options.keep)
    with tempfile.TemporaryDirectory() as work:
        return run_all(options, Path(work))


if __name__ == "__main__":
    sys.exit(main())
