#!/usr/bin/python3
"""Puts sources into groups that compile together: unity_groups.py OUT_FOLDER BYTES INCLUDE_FOLDER,... < SOURCES

Writes OUT_FOLDER/unity_N.cpp, which include the sources, and prints the names of these files. A group
holds about BYTES of sources, neighbours by path where that can be. Sources of one group see the
helpers of each other, so two are kept apart

- when both have a helper (in an unnamed namespace, static, constant, or an alias) of one name,
- when one has a helper that is called as something in a header that only the other one includes,
- when a helper of the earlier one is called as something in a header that the later one uses.

This is decided by names alone, without a compiler: names of one word that would get along as overloads are
kept apart, too. Headers are included first, so that helpers of sources do not reach into them.
"""

import functools
import itertools
import pathlib
import re
import sys

TOKEN = re.compile(r"[A-Za-z_]\w*|::|[{}()<>\[\];,=:*&~]|\S")
NOISE = re.compile(
    r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9A-Fa-f])\'(?:\\.|[^\'\\\n])+\''
    r"|^[ \t]*#(?:\\\n|[^\n])*", re.S | re.M)
DIRECTIVE = re.compile(r"^using namespace [\w:]+", re.M)
INCLUDE = re.compile(r'^#include "([^"]+)"', re.M)
TYPES = {"class", "struct", "union", "enum"}
INTERNAL = {"static", "const", "constexpr"}
SIMILAR = {  # a call could mean either of them
    "text": {"string", "string_view", "char", "path"},
    "number": {"int", "double", "float", "size_t", "bool", "Index", "auto"},
    "list": {"span", "vector", "array", "initializer_list"},
}
IDENTIFIER = re.compile(r"[A-Za-z_]\w*$")
# Explicit instantiations, of a template and of a member.
WHOLE = re.compile(r"^template (?:class|struct) (\w+)<", re.M)
MEMBER = re.compile(r"^template (?!<)[^;]*?\b(\w+)<[^;<>]*>::\w+\(", re.M)


def without_templates(tokens):
    """The tokens without arguments and parameters of templates."""
    kept, depth = [], 0
    for i, token in enumerate(tokens):
        if token == "<" and i and (IDENTIFIER.match(tokens[i - 1]) or depth):
            depth += 1
        elif token == ">" and depth:
            depth -= 1
        elif not depth:
            kept.append(token)
    return kept


def alike(parameter):
    """The type of a parameter, where types that convert into each other are one."""
    words = parameter[:parameter.index("=")] if "=" in parameter else parameter
    words = [w for w in words if w not in ("const", "std", "::", "&", "fs", "filesystem", "unsigned", "long")]
    if len(words) > 1 and IDENTIFIER.match(words[-1]):
        words = words[:-1]  # its name
    for kind, types in SIMILAR.items():
        if types & set(words):
            return kind
    return " ".join(words)


def signature(statement):
    """The types of a function's parameters; nothing for what is no function."""
    plain = without_templates(statement)
    first = plain.index("(") if "(" in plain else len(plain)
    if first == len(plain) or {"=", "using"} & set(plain[:first]) or TYPES & set(plain[:1]):
        return None
    if statement[0] == "template":
        return None
    parameters, depth, angles = [[]], 0, 0
    for i, token in enumerate(statement[statement.index("("):]):
        depth += (token in "([{") - (token in ")]}")
        angles += (token == "<") - (token == ">")
        if not depth:
            break
        if token == "," and depth == 1 and not angles:
            parameters.append([])
        elif i:
            parameters[-1].append(token)
    return tuple(alike(p) for p in parameters)


def declared(statement):
    """The names that a statement of a namespace declares: of types, functions, variables or aliases."""
    tokens = without_templates(statement)
    while tokens and tokens[0] in ("template", "inline", "extern"):
        tokens = tokens[1:]
    if not tokens or tokens[0] in ("friend", "static_assert") or "operator" in tokens:
        return []
    if tokens[0] == "using":
        if "=" in tokens:
            return [tokens[1]]
        return [] if tokens[1] == "namespace" else [tokens[-1]]
    if tokens[0] == "namespace":
        return [tokens[1]] if "=" in tokens else []
    if tokens[0] in TYPES and "(" not in tokens and "=" not in tokens:
        head = tokens[:tokens.index(":")] if ":" in tokens else tokens
        words = [t for t in head if IDENTIFIER.match(t) and t not in TYPES | {"final", "alignas"}]
        return words[:1] if len(words) == 1 or "::" not in head else []
    # Each declarator's name stands before its initialiser or parameters.
    names, depth, last, done = [], 0, None, False
    for i, token in enumerate([*tokens, ","]):
        if token in ("(", "[", "=", "{") and not depth and not done and last:
            before = tokens[last - 1] if last else ""
            if before != "::" and before != "~":
                names.append(tokens[last])
            done = True
        if token in "([{":
            depth += 1
        elif token in ")]}":
            depth -= 1
        elif token == "," and not depth:
            if not done and last:
                names.append(tokens[last])
            last, done = None, False
        elif not depth and not done and IDENTIFIER.match(token):
            last = i
    return [n for n in names if not n.isupper()]


class Names:
    """What a file declares in its namespaces: helpers of its own and the rest, by name, each as a set of
    (namespace, types of parameters, text of an alias)."""

    def __init__(self, text):
        code = NOISE.sub(" ", text)
        self.words = set(re.findall(r"[A-Za-z_]\w*", code))
        # What stands first in a qualified name, such as test in test::square().
        self.qualifiers = set(re.findall(r"(?<![\w:])(?!namespace\b)([A-Za-z_]\w*)\s*::", re.sub(DIRECTIVE, "", code)))
        self.directives = set(re.findall(DIRECTIVE, code))
        self.own, self.others, self.namespaces = {}, {}, set()
        self.read(TOKEN.findall(code))

    def note(self, statement, scopes):
        alias = statement[0] in ("using", "namespace")
        space = "::".join(s for s in scopes if s)
        meaning = (space, signature(statement), " ".join(statement) if alias else None)
        internal = "" in scopes or alias or INTERNAL & set(without_templates(statement)[:3])
        for name in declared(statement):
            (self.own if internal else self.others).setdefault(name, set()).add(meaning)

    def note_namespace(self, path):
        self.namespaces.add(path)
        space, _, name = path.rpartition("::")
        self.others.setdefault(name, set()).add((space, None, "namespace"))

    def read(self, tokens):
        scopes, statement, inner = [], [], 0  # inner: braces that are open below the namespaces
        for token in tokens:
            if inner:
                inner += (token == "{") - (token == "}")
                if not inner and self.ends_with_brace(statement):
                    statement = []
            elif token == "{":
                words = [t for t in statement if t != "inline"]
                if words[:1] == ["namespace"] and "=" not in words:
                    scopes.append("".join(words[1:]))
                    self.note_namespace("::".join(s for s in scopes if s))
                    statement = []
                elif words == ["extern"]:
                    scopes.append("C")
                    statement = []
                else:
                    if self.ends_with_brace(statement):
                        self.note(statement, scopes)
                    statement.append("{")
                    inner = 1
                    statement.append("}")
            elif token == "}":
                if scopes:
                    scopes.pop()
                statement = []
            elif token == ";":
                if statement:
                    self.note(statement, scopes)
                statement = []
            else:
                statement.append(token)

    @staticmethod
    def ends_with_brace(statement):
        """Whether this is the definition of a function: nothing follows its closing brace."""
        tokens = without_templates(statement)
        first = tokens.index("(") if "(" in tokens else -1
        return first >= 0 and "=" not in tokens[:first]


class Files:
    def __init__(self, folders):
        self.folders = folders

    @functools.lru_cache(maxsize=None)
    def text(self, path):
        return path.read_text()

    @functools.lru_cache(maxsize=None)
    def names(self, path):
        return Names(self.text(path))

    @functools.lru_cache(maxsize=None)
    def included(self, path):
        """The project's headers that a file includes itself, as they are written there."""
        found = {}
        for name in INCLUDE.findall(self.text(path)):
            for folder in (*self.folders, path.parent):
                if (folder / name).exists():
                    found[name] = folder / name
                    break
        return found

    @functools.lru_cache(maxsize=None)
    def headers(self, path):
        seen, todo = set(), list(self.included(path).values())
        while todo:
            header = todo.pop()
            if header not in seen:
                seen.add(header)
                todo.extend(self.included(header).values())
        return frozenset(seen)

    @functools.lru_cache(maxsize=None)
    def known(self, path):
        """What the headers of a file declare."""
        found = {}
        for header in self.headers(path):
            names = self.names(header)
            for name, meanings in (*names.others.items(), *names.own.items()):
                found.setdefault(name, set()).update(meanings)
        return found

    @functools.lru_cache(maxsize=None)
    def namespaces(self, path):
        return frozenset().union(*(self.names(h).namespaces for h in self.headers(path)))


def confused(some, others):
    """Whether a name could mean several things: all but the same alias and overloads in one namespace."""
    for a in some:
        for b in others:
            overloads = a[0] == b[0] and a[1] is not None and b[1] is not None and a[1] != b[1]
            same_alias = a[2] is not None and a[2] == b[2]
            if not overloads and not same_alias:
                return True
    return False


def ambiguous(source, directives, namespaces):
    """The words of a source by which it could mean namespaces of several of these directives."""
    spaces = [d.split()[-1] for d in directives]
    if len(spaces) < 2:
        return set()
    words = {n.rsplit("::", 1)[-1] for n in namespaces} & source.qualifiers
    return {w for w in words if sum(f"{s}::{w}" in namespaces for s in spaces) > 1}


def clash(files, first, second):
    """Why two sources, compiled in this order, cannot be in one group; nothing when they can."""
    a, b = files.names(first), files.names(second)
    for mine, theirs in ((a.own, b.own), (a.own, b.others), (b.own, a.others)):
        for name in mine:
            if name in theirs and confused(mine[name], theirs[name]):
                return f"both have {name}"
    for one, other in ((first, second), (second, first)):
        mine, theirs, here = files.names(one).own, files.known(other), files.known(one)
        for name in mine:
            if name in theirs and confused(mine[name], theirs[name] - here.get(name, set())):
                return f"{name} of {one.name} is in a header of {other.name}"
    known = files.known(second)
    for name in a.own:
        if name in known and name in b.words and name not in b.own and confused(a.own[name], known[name]):
            return f"{second.name} uses {name}"
    namespaces = files.namespaces(first) | files.namespaces(second)
    both = a.directives | b.directives  # what comes first stays in force
    if (ambiguous(a, a.directives, namespaces) - ambiguous(a, a.directives, files.namespaces(first)) or
            ambiguous(b, both, namespaces) - ambiguous(b, b.directives, files.namespaces(second))):
        return "a namespace of the same name"
    return None


def in_order(files, sources):
    """The sources, the one that instantiates a template before those that instantiate members of it: it takes
    what is defined by then, and Clang refuses a member that it instantiated before."""
    whole = {name: source for source in sources for name in WHOLE.findall(files.text(source))}
    ordered = {}
    for source in sources:
        for name in MEMBER.findall(files.text(source)):
            if name in whole:
                ordered[whole[name]] = None
        ordered[source] = None
    return list(ordered)


def grouped(files, sources, limit):
    sizes = [len(files.text(s)) for s in sources]
    count = max(1, round(sum(sizes) / limit))
    most = 1.25 * sum(sizes) / count
    clashing = [set() for _ in sources]
    for i, k in itertools.combinations(range(len(sources)), 2):
        if clash(files, sources[i], sources[k]):
            clashing[i].add(k)
            clashing[k].add(i)
    wanted, done = [], 0  # the group in which a source has its neighbours by path
    for size in sizes:
        wanted.append(int(count * done / max(sum(sizes), 1)))
        done += size
    groups, filled = [set() for _ in range(count)], [0] * count
    # First those that are hard to place.
    for i in sorted(range(len(sources)), key=lambda i: (-len(clashing[i]), i)):
        fitting = [g for g, members in enumerate(groups) if not members & clashing[i]]
        if not fitting:
            groups.append(set())
            filled.append(0)
            fitting = [len(groups) - 1]
        best = min(fitting, key=lambda g: (filled[g] + sizes[i] > most, abs(g - wanted[i]), g))
        groups[best].add(i)
        filled[best] += sizes[i]
    return [[sources[i] for i in sorted(g)] for g in groups if g]


def write(files, path, group):
    headers = dict.fromkeys(name for source in group for name in files.included(source) if "/" in name)
    lines = [f'#include "{h}"' for h in headers]
    for source in group:
        folder = next(f for f in files.folders if source.is_relative_to(f))
        lines.append(f'#include "{source.relative_to(folder)}"')
    text = "\n".join(lines) + "\n"
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def main():
    out, limit = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    files = Files([pathlib.Path(f) for f in sys.argv[3].split(",")])
    out.mkdir(parents=True, exist_ok=True)
    sources = [pathlib.Path(line) for line in sys.stdin.read().splitlines()]
    names = []
    for k, group in enumerate(grouped(files, in_order(files, sources), limit)):
        path = out / f"unity_{k}.cpp"
        write(files, path, group)
        names.append(str(path))
    for old in set(out.glob("unity_*.cpp")) - {pathlib.Path(n) for n in names}:
        old.unlink()
    print(";".join(names), end="")


if __name__ == "__main__":
    main()
