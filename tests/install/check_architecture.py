#!/usr/bin/env python3
"""Checks that the pages name what exists: python3 check_architecture.py

In docs/architecture.md every name in backquotes is a file or a folder of the repository, or stands in
the code of src or in what builds and tests it: `Name::member` in a file that has both words. Comments of
C++ do not count. In the README and the other pages of docs every path in backquotes exists.
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SRC = ROOT / "src"
PAGE = ROOT / "docs" / "architecture.md"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
# A path of a page, from the root or from a library on.
PATH = re.compile(r"(?:src|core|io|gui|app|tests|bench|docs|examples|assets|scripts|shaders|cmake)/[\w.{},/-]+")
# Where a path of the page may begin.
BASES = [ROOT, SRC, *(SRC / library for library in ("core", "io", "gui", "app")), ROOT / "docs"]
WORD = re.compile(r"[A-Za-z_]\w*")


# What builds and tests the program.
BUILD = ["CMakeLists.txt", "CMakePresets.json", "test", "run", "cmake/*", "scripts/*", "src/*/CMakeLists.txt"]


def code_of(path):
    text = path.read_text()
    if path.suffix not in (".h", ".cpp"):
        return text
    return "\n".join(line if line.lstrip().startswith("#") else line.split("//")[0] for line in text.splitlines())


class Code:
    """The words of every file of src, and its files and folders."""

    def __init__(self):
        sources = [path for path in SRC.rglob("*") if path.suffix in (".h", ".cpp")]
        build = [path for pattern in BUILD for path in ROOT.glob(pattern) if path.is_file()]
        self.texts = {path: code_of(path) for path in [*sources, *build]}
        self.words = [set(WORD.findall(text)) for text in self.texts.values()]
        self.names = {part for path in sources for part in (path.name, path.stem, *path.relative_to(SRC).parts)}

    def has_words(self, words):
        """Whether one file has all of these words."""
        return any(words <= found for found in self.words)

    def has_path(self, name):
        return any(any(base.glob(name)) for base in BASES) or name in self.names

    def has_text(self, name):
        return any(name in text for text in self.texts.values())


def alternatives(name):
    """`a.{h,cpp}` as a.h and a.cpp."""
    found = re.fullmatch(r"(.*)\{([^}]*)\}(.*)", name)
    return [found[1] + one + found[3] for one in found[2].split(",")] if found else [name]


def exists(code, name):
    if code.has_path(name) or any(code.has_path(f"{name}{suffix}") for suffix in (".h", ".cpp")):
        return True
    if "/" in name or re.fullmatch(r"\w*\.\w+", name):
        return code.has_text(name)  # a header of a library, an extension of files
    return code.has_words(set(WORD.findall(name)))


def faults(code, text):
    for number, line in enumerate(text.splitlines(), 1):
        for quoted in re.findall(r"`([^`]+)`", line):
            words = quoted.split()
            command = words[0] == "python3" or len(words) > 1 and "/" in words[0]
            names = [word for word in words if "/" in word] if command else [quoted]
            for name in (one for whole in names for one in alternatives(whole)):
                if not exists(code, name):
                    yield f"{PAGE.name}:{number}: {name}: found neither in src nor among its files"


def broken_paths(code, page):
    for number, line in enumerate(page.read_text().splitlines(), 1):
        words = (word for quoted in re.findall(r"`([^`]+)`", line) for word in quoted.split())
        for name in (one for word in words if PATH.fullmatch(word) for one in alternatives(word)):
            if not code.has_path(name):
                yield f"{page.name}:{number}: {name}: there is no such file"


def main():
    code, text = Code(), PAGE.read_text()
    found = [*faults(code, text), *(fault for page in PAGES for fault in broken_paths(code, page))]
    # The check itself must be able to fail.
    for wrong in ("NoSuchClass", "Topology::no_such_member()", "core/mesh/no_such_file.h", "no_such_file.cpp"):
        if exists(code, wrong):
            found.append(f"{wrong} is taken for something that exists")
    names = len(re.findall(r"`[^`]+`", text))
    print("\n".join([*found, f"{names} names in {PAGE.name}: {len(found)} faults"]))
    return 1 if found or names < 50 else 0


if __name__ == "__main__":
    sys.exit(main())
