#!/usr/bin/python3
"""The robustness figure of docs/performance.md: python3 robustness.py PATH/TO/winslow [--meshes N]
                                     [--seed S] [--failures OUT.json] [--again IN.json]

Five cases on each of N random meshes with one to four holes (make_random.py): two motions with
rotations up to 180 degrees, two translations of a hole straight towards the nearest other boundary,
over 50 to 95 % of the way to contact, and one scramble. A case ends valid if the program writes a mesh
that has no inverted element by an independent count, with status 0, or 5 where it had not converged
within the limit of iterations. All that did not end with status 0 are listed, and written as JSON
(robustness_open.json: those of the last run); --again runs only what such a file lists.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

from winslow_cases import PYTHON, ROOT, count_inverted, read_nodes, run


def read_markers(path):
    """Nodes of every marker of an SU2 file."""
    markers, name = {}, None
    lines = iter(Path(path).read_text().splitlines())
    for line in lines:
        if line.startswith("MARKER_TAG"):
            name = line.split("=")[1].strip()
        elif line.startswith("MARKER_ELEMS"):
            rows = (next(lines).split() for _ in range(int(line.split("=")[1])))
            markers[name] = sorted({int(n) for row in rows for n in row[1:3]})
    return markers


def towards_contact(nodes, markers, rng):
    """A hole and the translation along which its node nearest to another boundary gets there."""
    hole = rng.choice(sorted(m for m in markers if m != "outer"))
    others = [n for m, ns in markers.items() if m != hole for n in ns]
    _, a, b = min(((nodes[a][0] - nodes[b][0]) ** 2 + (nodes[a][1] - nodes[b][1]) ** 2, a, b)
                  for a in markers[hole] for b in others)
    share = rng.uniform(0.5, 0.95)
    return hole, [share * (nodes[b][k] - nodes[a][k]) for k in range(2)]


def cases_of(mesh, nodes, markers):
    rng = random.Random(mesh["seed"])
    for motion in mesh["motions"]:
        yield "rotation", [["move", "--marker", motion["marker"], "--rotate", motion["rotate"],
                            "--pivot", *motion["pivot"], "--translate", *motion["translate"]]]
    for _ in range(2):
        hole, move = towards_contact(nodes, markers, rng)
        yield "contact", [["move", "--marker", hole, "--translate", *move]]
    yield "scramble", [["scramble", "--seed", mesh["seed"], "--allow-inverted"], ["smooth"]]


NOT_CONVERGED = 5


def run_case(winslow, folder, mesh, steps):
    """Whether the case ends valid, and what there is to say of it: empty if it converged."""
    for k, (command, *options) in enumerate(steps):
        out = folder / f"out{k}.su2"
        out.unlink(missing_ok=True)
        try:
            done = run(winslow, [command, mesh, "-o", out, "--quiet", *options], timeout=300)
        except subprocess.TimeoutExpired:
            return False, "no end after 300 s"
        mesh = out
    if done.returncode not in (0, NOT_CONVERGED):
        return False, f"status {done.returncode}: {done.stderr.strip()}"
    if inverted := count_inverted(out):
        return False, f"{inverted} inverted"
    return True, "valid, not converged" if done.returncode else ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("winslow")
    parser.add_argument("--meshes", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1000)
    parser.add_argument("--failures", type=Path)
    parser.add_argument("--again", type=Path)
    options = parser.parse_args()
    tally, failures = {}, []
    listed = json.loads(options.again.read_text()) if options.again else None
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([PYTHON, ROOT / "tests/meshes/make_random.py", folder, "--count",
                        str(options.meshes), "--seed", str(options.seed), "--max-rotation", "180",
                        "--max-holes", "4"],
                       check=True)
        for mesh in json.loads((folder / "meshes.json").read_text())["meshes"]:
            wanted = [f for f in listed or [] if f["seed"] == mesh["seed"]]
            if listed is not None and not wanted:
                continue
            plain = folder / "plain.su2"
            run(options.winslow, ["convert", folder / mesh["file"], plain]).check_returncode()
            nodes, markers = read_nodes(plain), read_markers(plain)
            for kind, steps in cases_of(mesh, nodes, markers):
                if listed is not None and not any(f["steps"] == steps for f in wanted):
                    continue
                valid, fault = run_case(options.winslow, folder, plain, steps)
                so_far = tally.get(kind, (0, 0, 0))
                tally[kind] = tuple(n + more for n, more in zip(so_far, (not fault, valid, 1)))
                if fault:
                    failures.append({"seed": mesh["seed"], "file": mesh["file"],
                                     "elements": mesh["elements"], "kind": kind, "steps": steps,
                                     "fault": fault})
                    print(f"{mesh['file']} (seed {mesh['seed']}, {mesh['elements']}): {kind}: "
                          f"{fault.splitlines()[0]}", flush=True)
    if options.failures:
        options.failures.write_text(json.dumps(failures, indent=1) + "\n")
    for kind, (converged, valid, total) in sorted(tally.items()):
        print(f"{kind}: {valid} of {total} valid, {converged} converged")
    converged, valid, total = (sum(t[k] for t in tally.values()) for k in range(3))
    print(f"{valid} of {total} cases ended valid ({100 * valid / total:.1f} %), {converged} converged")
    return 0 if valid == total else 1


if __name__ == "__main__":
    sys.exit(main())
