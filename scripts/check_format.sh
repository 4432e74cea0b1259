#!/usr/bin/env bash
# Fails, showing the differences, if a source file is not formatted as .clang-format says.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
clang_format=$(command -v clang-format-14 || command -v clang-format)
find src tests bench examples -name '*.cpp' -o -name '*.h' | sort |
  xargs "$clang_format" --dry-run -Werror --ferror-limit=5
echo "All sources are formatted."
