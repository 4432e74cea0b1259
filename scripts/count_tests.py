#!/usr/bin/python3
"""Prints "PASSED FAILED" for a ctest log, counting the test cases inside doctest and unittest runs.

A test of ctest that reports no cases of its own counts as one.
"""

import re
import sys


def count(block):
    ok = re.search(r"^Test Passed\.|^Test Pass Reason", block, re.M) is not None
    skipped = re.search(r"^Test Skipped|^Test Not Run", block, re.M) is not None
    cases = re.findall(r"test cases:\s*\d+ \|\s*(\d+) passed \|\s*(\d+) failed", block)
    if cases:
        passed, failed = (sum(int(c[i]) for c in cases) for i in (0, 1))
    elif match := re.search(r"^Ran (\d+) tests?", block, re.M):
        bad = sum(int(n) for n in re.findall(r"(?:failures|errors)=(\d+)", block))
        idle = sum(int(n) for n in re.findall(r"skipped=(\d+)", block))
        passed, failed = int(match[1]) - bad - idle, bad
    else:
        passed, failed = int(ok and not skipped), 0
    # A crash after the last case still is a failure.
    return passed, failed if ok or skipped else max(failed, 1)


def main():
    try:
        with open(sys.argv[1], encoding="utf-8", errors="replace") as log:
            blocks = re.split(r"^\d+/\d+ Test(?:ing)?: ", log.read(), flags=re.M)[1:]
    except OSError:
        print("0 1")
        return
    counts = [count(block) for block in blocks if '" time elapsed' in block or "Test time" in block]
    print(sum(c[0] for c in counts), sum(c[1] for c in counts))


main()
