#!/usr/bin/env python3
"""The folders of a library are in an order: no two of them include one another, by whatever way.

usage: check_folders.py [LIBRARY ...], as src/core
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2] / "src"


def includes(library):
    """{folder: {folder that it includes: a file that does}}; files of the library itself are '.'."""
    found = {}
    for file in sorted(library.rglob("*")):
        if file.suffix not in (".h", ".cpp", ".inc"):
            continue
        folder = file.parent.relative_to(ROOT).as_posix()
        uses = found.setdefault(folder, {})
        for target in re.findall(r'#\s*include\s*"([^"]+)"', file.read_text()):
            if (ROOT / target).is_file() and (ROOT / target).is_relative_to(library):
                other = pathlib.PurePosixPath(target).parent.as_posix()
                if other != folder:
                    uses.setdefault(other, file.relative_to(ROOT).as_posix())
    return found


def cycle(graph):
    """A list of folders, each of which includes the next, the last the first; or None."""
    done, path = set(), []

    def visit(folder):
        if folder in path:
            return path[path.index(folder):]
        if folder in done:
            return None
        path.append(folder)
        for other in graph.get(folder, {}):
            if round_trip := visit(other):
                return round_trip
        path.pop()
        done.add(folder)
        return None

    for folder in graph:
        if found := visit(folder):
            return found
    return None


def main():
    status = 0
    for name in sys.argv[1:] or ["src/core"]:
        library = ROOT.parent / name
        graph = includes(library)
        if len(graph) < 3:
            sys.exit(f"{name} has no folders to check")
        if found := cycle(graph):
            status = 1
            print(f"{name}: these folders include one another:")
            for folder, other in zip(found, found[1:] + found[:1]):
                print(f"  {graph[folder][other]} includes {other}")
    if status == 0:
        print("No folder includes itself through others.")
    sys.exit(status)


if __name__ == "__main__":
    main()
