#!/usr/bin/python3
"""Checks how src is built: python3 check_structure.py

- Folders: what a file may include says structure.txt; folders that are missing there are a fault.
- Sizes: no function over 60 lines; no class over 400 lines, its members' definitions included, or with
  more than 25 public member functions.
The sources are read as clang-format leaves them: what begins in a column ends in it.
"""
import collections
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SRC = HERE.parents[1] / "src"
MOST_LINES, MOST_CLASS_LINES, MOST_PUBLIC = 60, 400, 25
NO_FUNCTION = re.compile(r"\s*(if|for|while|switch|else|do|catch|return|struct|class|enum|union|namespace|extern|"
                         r"public|private|protected|case|default|try|#|//|\}|\[)|.*(=|\[[^\]]*\]\([^)]*\)( mutable)?) \{$")
QUALIFIED = re.compile(r"(\w+)::~?(?:\w+|operator\S+)\(")
CLASS = re.compile(r"(\s*)(?:template <.*> )?(class|struct) (?:\w+::)*(\w+)(?: final)?(?: :.*)? ?\{$")


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


def classes(lines):
    """(first line, last line, kind, name) of every class that is defined in the file."""
    for k, line in enumerate(lines):
        found = CLASS.match(line)
        if found:
            yield k, end_of(lines, k, len(found[1])), found[2], found[3]


def public_functions(body, kind):
    """Number of public member functions that a class declares."""
    indent = min(len(line) - len(line.lstrip()) for line in body if line.strip() and not line.lstrip().startswith(
        ("public:", "private:", "protected:"))) if any(line.strip() for line in body) else 0
    public, names, statement = kind == "struct", 0, ""
    for line in body:
        access = re.match(r"\s*(public|private|protected):", line)
        if access:
            public = access[1] == "public"
            continue
        depth = len(line) - len(line.lstrip())
        text = line.split("//")[0].strip()
        if not text or depth < indent or (depth > indent and not statement):
            continue
        statement += " " + text
        if text.endswith((";", "{", "}")):
            member = re.search(r"\)\s*(const|noexcept|override|final|= 0|= default|= delete|->.*|&|\s)*\s*(;|\{|:)",
                               statement)
            special = re.search(r"= (default|delete)|operator=|^ (friend|using|struct|class|enum)|~\w+\(", statement)
            names += bool(public and member and not special and "(" in statement)
            statement = ""
    return names


def size_faults():
    lengths, where, public = collections.Counter(), {}, {}
    for path in sources():
        lines, name = path.read_text().splitlines(), path.relative_to(SRC)
        local = {found for *_, found in classes(lines)} if path.suffix == ".cpp" else ()
        for first, last, head in functions(lines):
            if last - first + 1 > MOST_LINES:
                yield f"{name}:{first + 1}: function of {last - first + 1} lines: {head[:70]}"
            member = QUALIFIED.search(head)
            if member and lines[first][:1].strip():
                lengths[name if member[1] in local else name.parent, member[1]] += last - first + 1
        for first, last, kind, found in classes(lines):
            key = (name if local else name.parent, found)
            lengths[key] += last - first + 1
            where.setdefault(key, f"{name}:{first + 1}")
            public[key] = max(public.get(key, 0), public_functions(lines[first + 1:last], kind))
    for key in sorted(where, key=where.get):
        length = lengths[key]
        if length > MOST_CLASS_LINES:
            yield f"{where[key]}: class {key[1]} has {length} lines with its members"
        if public.get(key, 0) > MOST_PUBLIC:
            yield f"{where[key]}: class {key[1]} has {public[key]} public member functions"


def main():
    structure = Structure(HERE / "structure.txt")
    sizes = list(size_faults())
    functions = [fault for fault in sizes if ": function of " in fault]
    wrong = [*folder_faults(structure), *functions]
    sizes = [fault for fault in sizes if fault not in functions]
    print("\n".join([*wrong, *sizes]))
    print(f"{len(sources())} files in {len(structure.order)} folders: {len(wrong)} faults of folders and functions, "
          f"{len(sizes)} of classes")
    return 1 if wrong or sizes or len(sources()) < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
