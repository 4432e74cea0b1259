#!/usr/bin/python3
"""Runs clang-tidy over src. Usage: tidy.py BUILD_FOLDER [SOURCE...]

What passed is remembered, in the user's cache, by the hash of everything it depends on but for where the
repository lies, so a second run, or one of a second clone, is quick. Where the build compiles several
sources together, so does this: headers are then read once for all of them.
"""

import concurrent.futures
import functools
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIDY = shutil.which("clang-tidy-14") or shutil.which("clang-tidy")
PASSED = pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "winslow" / "tidy"


@functools.lru_cache(maxsize=None)
def project_includes(path):
    text = path.read_text()
    found = (ROOT / "src" / name for name in re.findall(r'#include "([^"]+)"', text))
    return text, tuple(p for p in found if p.exists())


def closure(path):
    seen, todo = set(), [path]
    while todo:
        current = todo.pop()
        if current not in seen:
            seen.add(current)
            todo.extend(project_includes(current)[1])
    return sorted(seen)


def key(source, command):
    def anywhere(content):
        return content.replace(str(ROOT).encode(), b"")

    digest = hashlib.sha256(TIDY.encode() + anywhere(command.encode()))
    # By what they are called in the repository: two clones have them in one order.
    paths = sorted(closure(source), key=lambda path: anywhere(str(path).encode()))
    for path in [ROOT / ".clang-tidy", *paths]:
        digest.update(anywhere(path.read_bytes()))
    return digest.hexdigest()


def check(source, command, build):
    stamp = PASSED / key(source, command)
    if stamp.exists():
        return source, True, ""
    # What CMake puts together includes .cpp files.
    options = ["--checks=-bugprone-suspicious-include"] if "Unity" in source.parts else []
    # The compile commands are g++'s: clang does not know all of its warnings.
    run = subprocess.run([TIDY, "-p", str(build), "--quiet",
                          "--extra-arg=-Wno-unknown-warning-option", *options, str(source)],
                         capture_output=True, text=True, check=False)
    if run.returncode == 0:
        stamp.touch()
    return source, run.returncode == 0, run.stdout


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    wanted = {pathlib.Path(p).resolve() for p in sys.argv[2:]}
    PASSED.mkdir(parents=True, exist_ok=True)
    units = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["file"]).resolve()
        unity = path.is_relative_to(build / "src") and "Unity" in path.parts
        if not path.exists() or not (unity or path.is_relative_to(ROOT / "src")):
            continue
        if not wanted or wanted & {path, *(project_includes(path)[1] if unity else ())}:
            units[path] = entry["command"]
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(check, path, command, build) for path, command in units.items()]
        for job in concurrent.futures.as_completed(jobs):
            path, good, output = job.result()
            if not good:
                bad += 1
                print(f"{path.relative_to(ROOT)}\n{output}", flush=True)
    print(f"clang-tidy: {len(units)} files, {bad} with findings")
    sys.exit(1 if bad or not units else 0)


main()
