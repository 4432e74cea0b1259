#!/usr/bin/env python3
"""Puts the examples into the page on the library: make_library.py [--check]

In library.md every block between "<!-- example NAME -->" and "<!-- end of example -->" shows
examples/NAME. With --check nothing is written: the exit status is 1 if the page is not what it should be,
if it leaves out an example, or if an example does not begin as they all do.
"""
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAGE = HERE / "library.md"
EXAMPLES = HERE.parent / "examples"
BLOCK = re.compile(r"(<!-- example (\S+) -->\n).*?(<!-- end of example -->)", re.S)
FEWEST_LINES, MOST_LINES = 20, 60


def shown(name):
    return "```cpp\n" + (EXAMPLES / name).read_text() + "```\n"


def faults(page):
    """What is wrong with the examples and with which of them the page shows."""
    names = {path.name for path in EXAMPLES.glob("*.cpp")}
    on_page = [block[1] for block in BLOCK.findall(page)]
    for name in sorted(names - set(on_page)):
        yield f"library.md does not show examples/{name}"
    for name in sorted(names):
        lines = (EXAMPLES / name).read_text().splitlines()
        head = "\n".join(lines[:lines.index(next(line for line in lines if not line.startswith("//")))])
        if not re.search(r"^//     \./" + name.removesuffix(".cpp"), head, re.M):
            yield f"examples/{name} does not begin with how it is run"
        if not FEWEST_LINES <= len(lines) <= MOST_LINES:
            yield f"examples/{name} has {len(lines)} lines, not {FEWEST_LINES} to {MOST_LINES}"
        if "catch (const" not in "\n".join(lines):
            yield f"examples/{name} does not say what went wrong"


def main(check):
    old = PAGE.read_text()
    new = BLOCK.sub(lambda block: block[1] + shown(block[2]) + block[3], old)
    wrong = list(faults(new))
    if check and new != old:
        wrong.append("library.md does not show the examples as they are: run docs/make_library.py")
    if not check and new != old:
        PAGE.write_text(new)
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    main(bool(sys.argv[1:]))
