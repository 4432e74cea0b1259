#!/usr/bin/python3
"""Runs clang-tidy over src. Usage: tidy.py [--all] BUILD_FOLDER [SOURCE...]

Checks the sources that differ from the main branch (origin/main, else main), or that include a header that
does; all of them where no such branch is known, where it is what is checked out, where the checks
themselves changed, and with --all.

What passed is remembered, in the user's cache, by the hash of everything it depends on but for where the
repository lies, so a second run, or one of a second clone, is quick. Where the build compiles several
sources together, so does this: headers are then read once for all of them. Of such a group only the
sources to check are taken.
"""

import argparse
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
# What the result depends on beside the sources and what they include.
RULES = {".clang-tidy", "scripts/tidy.py", "scripts/packages.txt"}


def git(*arguments):
    """What git prints; nothing where it fails, there is no repository or no git."""
    if shutil.which("git") is None:
        return None
    run = subprocess.run(["git", "-C", str(ROOT), *arguments], capture_output=True, text=True, check=False)
    return run.stdout if run.returncode == 0 else None


def changed_files():
    """The files that differ from the main branch; nothing where there is none to compare with."""
    for branch in ("origin/main", "main"):
        base = git("merge-base", "HEAD", branch)
        if base is None:
            continue
        names = git("diff", "--name-only", base.strip(), "--")
        new = git("ls-files", "--others", "--exclude-standard")
        if names is None or new is None:
            continue
        names = {*names.split("\n"), *new.split("\n")} - {""}
        if names:
            return None if names & RULES else {ROOT / n for n in names}
    return None


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
    # A group includes .cpp files.
    options = ["--checks=-bugprone-suspicious-include"] if is_group(source) else []
    # The compile commands are g++'s: clang does not know all of its warnings.
    run = subprocess.run([TIDY, "-p", str(build), "--quiet",
                          "--extra-arg=-Wno-unknown-warning-option", *options, str(source)],
                         capture_output=True, text=True, check=False)
    if run.returncode == 0:
        stamp.touch()
    return source, run.returncode == 0, run.stdout


def is_group(path):
    return path.parent.name.endswith("_unity")


def part_of(group, sources, folder):
    """A file that includes those sources only, beside the headers of the group."""
    lines = [line for line in group.read_text().splitlines()
             if not line.endswith('.cpp"') or ROOT / "src" / line.split('"')[1] in sources]
    part = folder / group.parent.name / group.name
    part.parent.mkdir(parents=True, exist_ok=True)
    part.write_text("\n".join(lines) + "\n")
    return part


def units_of(build, wanted, folder):
    """The entries of a compilation database for what is to be checked: all, or the wanted sources."""
    entries = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = pathlib.Path(entry["file"]).resolve()
        group = is_group(path) and path.is_relative_to(build / "src")
        if not path.exists() or not (group or path.is_relative_to(ROOT / "src")):
            continue
        if wanted is not None and group:
            sources = {p for p in project_includes(path)[1] if p.suffix == ".cpp"}
            if not sources & wanted:
                continue
            if not sources <= wanted:
                part = part_of(path, wanted, folder)
                entry = {**entry, "file": str(part), "command": entry["command"].replace(str(path), str(part))}
        elif wanted is not None and path not in wanted:
            continue
        entries.append(entry)
    return entries


def sources_to_check(files):
    """The sources among the files, and those that include a header among them themselves."""
    sources = (ROOT / "src").rglob("*.cpp")
    return {s for s in sources if s in files or any(h in files for h in project_includes(s)[1])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true")
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("sources", nargs="*", type=pathlib.Path)
    arguments = parser.parse_args()
    build = arguments.build.resolve()
    wanted = None
    if arguments.sources:
        wanted = {p.resolve() for p in arguments.sources}
    elif not arguments.all and (changed := changed_files()) is not None:
        wanted = sources_to_check(changed)
        print(f"clang-tidy: {len(wanted)} sources differ from the main branch", flush=True)
    PASSED.mkdir(parents=True, exist_ok=True)
    folder = build / "tidy"
    folder.mkdir(exist_ok=True)
    entries = units_of(build, wanted, folder)
    (folder / "compile_commands.json").write_text(json.dumps(entries, indent=1))
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [pool.submit(check, pathlib.Path(e["file"]), e["command"], folder) for e in entries]
        for job in concurrent.futures.as_completed(jobs):
            path, good, output = job.result()
            if not good:
                bad += 1
                print(f"{path.relative_to(ROOT)}\n{output}", flush=True)
    print(f"clang-tidy: {len(entries)} files, {bad} with findings")
    sys.exit(1 if bad or (wanted is None or arguments.sources) and not entries else 0)


main()
