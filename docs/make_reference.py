#!/usr/bin/python3
"""Writes the tables of the reference pages, which the program's own tables say: make_reference.py WINSLOW

Each stands between "<!-- reference NAME -->" and "<!-- end of reference -->". With --check nothing is
written: the exit status is 1 if a page is not what it should be.
"""
import re
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
BLOCK = re.compile(r"(<!-- reference (\w+) -->\n).*?(<!-- end of reference -->)", re.S)


def table(winslow, name):
    return subprocess.run([winslow, "reference", name], check=True, capture_output=True, text=True).stdout


def rewritten(winslow, text):
    return BLOCK.sub(lambda block: block[1] + table(winslow, block[2]) + block[3], text)


def main(winslow, check):
    stale = []
    tables = 0
    for page in sorted(HERE.glob("*.md")):
        old = page.read_text()
        tables += len(BLOCK.findall(old))
        new = rewritten(winslow, old)
        if new == old:
            continue
        stale.append(page.name)
        if not check:
            page.write_text(new)
    if tables == 0:
        sys.exit("no page has a reference table")
    if check and stale:
        sys.exit(f"not as the program's tables say: {', '.join(stale)}; run docs/make_reference.py WINSLOW")


if __name__ == "__main__":
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    if len(arguments) != 1:
        sys.exit(__doc__)
    main(arguments[0], "--check" in sys.argv)
