"""What the interoperability checks share: running programs, and an independent reader of MSH 2.2."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
failures = []
checks = 0


def arguments():
    parser = argparse.ArgumentParser()
    parser.add_argument("--convert", required=True)
    parser.add_argument("--gmsh", required=True)
    return parser.parse_args()


def run(*command):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if result.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
    if "Error" in result.stdout or "Error" in result.stderr:
        raise RuntimeError(f"{' '.join(map(str, command))} complains:\n{result.stdout}{result.stderr}")
    return result.stdout + result.stderr


def check(name, ok, detail=""):
    global checks
    checks += 1
    if not ok:
        failures.append(name)
        print(f"FAILED {name} {detail}", file=sys.stderr)


def same(name, found, expected):
    if found == expected:
        check(name, True)
        return
    if isinstance(found, dict) and isinstance(expected, dict):
        for key in expected.keys() | found.keys():
            if found.get(key) != expected.get(key):
                detail = f"{key}: found {str(found.get(key))[:300]}, expected {str(expected.get(key))[:300]}"
                check(name, False, detail)
        return
    check(name, False, f"found {str(found)[:300]}, expected {str(expected)[:300]}")


def finish():
    print(f"{checks} checks, {len(failures)} failed")
    sys.exit(1 if failures else 0)


def workspace():
    return tempfile.TemporaryDirectory(prefix="winslow_interop_")


def make_mesh(gmsh, geo, out, version, binary, *options):
    command = [gmsh, "-2", geo, "-o", out, "-format", "msh22" if version == "2.2" else "msh41", "-v", "2"]
    if binary:
        command.append("-bin")
    run(*command, *options)


def resave(gmsh, source, out, everything=False):
    """Lets Gmsh read a file and write it as MSH 2.2 ASCII: what is in physical groups, or
    everything, but then without the groups (such is Gmsh)."""
    run(gmsh, source, "-save", "-o", out, "-format", "msh22", "-v", "2",
        *(["-save_all"] if everything else []))
    return read_msh22(out)


def read_msh22(path):
    """Nodes, elements (type, physical, nodes) and physical names of an ASCII MSH 2.2 file."""
    lines = pathlib.Path(path).read_text().split("\n")
    names, nodes, elements = {}, {}, []
    i = 0
    while i < len(lines):
        if lines[i] == "$PhysicalNames":
            for line in lines[i + 2:i + 2 + int(lines[i + 1])]:
                dimension, tag, name = line.split(" ", 2)
                names[(int(dimension), int(tag))] = name.strip().strip('"')
        if lines[i] == "$Nodes":
            for line in lines[i + 2:i + 2 + int(lines[i + 1])]:
                tag, x, y, z = line.split()
                nodes[int(tag)] = (float(x), float(y), float(z))
        if lines[i] == "$Elements":
            for line in lines[i + 2:i + 2 + int(lines[i + 1])]:
                words = [int(w) for w in line.split()]
                tags = words[3:3 + words[2]]
                elements.append((words[1], tags[0], tuple(words[3 + words[2]:])))
        i += 1
    return {"names": names, "nodes": nodes, "elements": elements}


def by_place(mesh):
    """The same with node tags replaced by coordinates, so that renumbering does not matter."""
    nodes = mesh["nodes"]
    groups = {}
    for kind, physical, corners in mesh["elements"]:
        dimension = {15: 0, 1: 1, 2: 2, 3: 2}[kind]
        name = mesh["names"].get((dimension, physical), f"{dimension}:{physical}")
        groups.setdefault(name, []).append((kind, tuple(nodes[c] for c in corners)))
    return groups
