#!/usr/bin/python3
"""Checks how src is built: python3 check_structure.py

- Folders: what a file may include says structure.txt; folders that are missing there are a fault.
- Includes: no standard header that an included header of src brings already.
- Sizes: no function over 60 lines. How long a class may be depends on what it is for: no test knows that.
The sources are read as clang-format leaves them: what begins in a column ends in it.
"""
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SRC = HERE.parents[1] / "src"
MOST_LINES = 60
STANDARD = re.compile(r"#include <([a-z_0-9]+|Eigen/\w+)>")
NO_FUNCTION = re.compile(r"\s*(if|for|while|switch|else|do|catch|return|struct|class|enum|union|namespace|extern|"
                         r"public|private|protected|case|default|try|#|//|\}|\[)|.*(=|\[[^\]]*\]\([^)]*\)( mutable)?) \{$")


class Structure:
    def __init__(self, path):
        self.order, self.forbidden = {}, {}
        for rank, line in enumerate(path.read_text().splitlines(), 1):
            folders, _, names = line.partition("#")[0].partition("!")
            for folder in folders.split():
                self.order[folder] = rank
            if names:
                self.forbidden[folders.split("/")[0].split()[0]] = tuple(names.split())

    def fault(self, file, include):
        """What is wrong with an include of a file of src; empty if nothing."""
        folder, library = str(file.parent.relative_to(SRC)), file.relative_to(SRC).parts[0]
        if (SRC / include).exists():
            other = str(Path(include).parent)
            if self.order.get(other, 0) > self.order.get(folder, 0):
                return f"{folder} lies below {other}"
        elif self.forbidden.get(library) and include.startswith(self.forbidden[library]):
            return f"{library} knows nothing of it"
        return ""


def sources():
    return sorted(p for p in SRC.rglob("*") if p.suffix in (".h", ".cpp"))


def folder_faults(structure):
    folders = {str(path.parent.relative_to(SRC)) for path in sources()}
    for folder in sorted(folders ^ set(structure.order)):
        yield f"structure.txt: {folder}: " + ("not listed" if folder in folders else "has no sources")
    for path in sources():
        for number, line in enumerate(path.read_text().splitlines(), 1):
            include = re.match(r'\s*#\s*include\s*[<"]([^>"]+)', line)
            fault = include and structure.fault(path, include[1])
            if fault:
                yield f"{path.relative_to(SRC)}:{number}: {line.strip()}: {fault}"


class Includes:
    """What the files of src include; what stands between #if and #endif is not looked at."""

    def __init__(self):
        self.own, self.standard, self.brought = {}, {}, {}
        for path in sources():
            depth, own, standard = 0, [], []
            for number, line in enumerate(path.read_text().splitlines(), 1):
                depth += line.startswith("#if") - line.startswith("#endif")
                include = depth == 0 and re.match(r'#include "([^"]+)"', line)
                if include and (SRC / include[1]).exists():
                    own.append(include[1])
                elif depth == 0 and STANDARD.match(line):
                    standard.append((number, STANDARD.match(line)[1]))
            name = str(path.relative_to(SRC))
            self.own[name], self.standard[name] = own, standard

    def brings(self, name):
        """The standard headers that somebody has who includes a header."""
        if name not in self.brought:
            self.brought[name] = {header for _, header in self.standard[name]}.union(*map(self.brings, self.own[name]))
        return self.brought[name]

    def repeated(self):
        """(file, line, standard header, the header of src that brings it)"""
        for name in self.own:
            for number, header in self.standard[name]:
                source = next((other for other in self.own[name] if header in self.brings(other)), None)
                if source:
                    yield name, number, header, source


def include_faults():
    for name, number, header, source in Includes().repeated():
        yield f"{name}:{number}: #include <{header}>: {source} has it already"


def end_of(lines, first, indent):
    """Index of the line that closes what the line `first` opens."""
    closing = re.compile(" " * indent + r"\}")
    return next((k for k in range(first + 1, len(lines)) if closing.match(lines[k])), first)


def signature_start(lines, last):
    """Index of the first line of the statement that ends in line `last`."""
    first = last
    while first > 0 and lines[first - 1].strip() and not re.search(r"[;{}:]$|^\s*(//|#)|\*/$", lines[first - 1]):
        first -= 1
    return first


def functions(lines):
    """(first line, last line, text before the body) of every function that has a body in the file."""
    skip_until = -1
    for k, line in enumerate(lines):
        if k <= skip_until or not line.endswith("{") or ")" not in line and ":" not in line:
            continue
        first = signature_start(lines, k)
        head = " ".join(part.strip() for part in lines[first:k + 1])
        indent = len(lines[first]) - len(lines[first].lstrip())
        if "(" not in head or NO_FUNCTION.match(lines[first]) or NO_FUNCTION.match(head):
            continue
        skip_until = end_of(lines, k, indent)
        yield first, skip_until, head


def size_faults():
    for path in sources():
        lines = path.read_text().splitlines()
        for first, last, head in functions(lines):
            if last - first + 1 > MOST_LINES:
                yield f"{path.relative_to(SRC)}:{first + 1}: function of {last - first + 1} lines: {head[:70]}"


def main():
    structure = Structure(HERE / "structure.txt")
    wrong = [*folder_faults(structure), *include_faults(), *size_faults()]
    print("\n".join(wrong))
    print(f"{len(sources())} files in {len(structure.order)} folders: {len(wrong)} faults")
    return 1 if wrong or len(sources()) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
