#!/usr/bin/env bash
# Makes the Debian packages of a build and looks into them. Usage: packages.sh BUILD_FOLDER
set -euo pipefail
build=$(cd "$1" && pwd)
work=$build/tests/install/packages
rm -rf "$work"
mkdir -p "$work"
(cd "$work" && cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work" >cpack.log 2>&1) || {
  cat "$work/cpack.log"
  exit 1
}

# holds PACKAGE PATH...: the package brings these files.
holds() {
  local list
  list=$(dpkg-deb --contents "$work"/"$1"_*.deb | awk '{ print $6 }')
  shift
  for path in "$@"; do
    grep -qx "\./usr/$path" <<<"$list" || { echo "missing: /usr/$path"; exit 1; }
  done
}
# asks PACKAGE FIELD PATTERN: what the package says of itself.
asks() {
  dpkg-deb --field "$work"/"$1"_*.deb "$2" | grep -E "$3" >/dev/null || {
    dpkg-deb --info "$work"/"$1"_*.deb
    echo "$1: $2 has no $3"
    exit 1
  }
}

asks libwinslow-dev Depends 'libeigen3-dev'
holds libwinslow-dev include/winslow/winslow.h include/winslow/core/version.h \
  share/winslow/examples/CMakeLists.txt share/winslow/examples/time_loop.cpp \
  share/doc/libwinslow-dev/copyright
dpkg-deb --contents "$work"/libwinslow-dev_*.deb | grep 'winslowConfig.cmake' >/dev/null
if compgen -G "$work/winslow_*.deb" >/dev/null; then
  # What dpkg-shlibdeps found.
  asks winslow Depends 'libc6 \(>= [0-9.]+\)'
  asks winslow Depends 'libstdc\+\+6'
  holds winslow bin/winslow share/man/man1/winslow.1 share/winslow/naca0012.su2 \
    share/doc/winslow/copyright share/doc/winslow/docs/library.md
  # It can be unpacked and started where it is.
  dpkg-deb --extract "$work"/winslow_*.deb "$work/root"
  "$work/root/usr/bin/winslow" --version
fi
if compgen -G "$work/python3-winslow_*.deb" >/dev/null; then
  asks python3-winslow Depends 'python3-numpy'
  asks python3-winslow Depends 'libstdc\+\+6'
  holds python3-winslow lib/python3/dist-packages/winslow/__init__.py share/doc/python3-winslow/copyright
  dpkg-deb --extract "$work"/python3-winslow_*.deb "$work/root"
  (cd "$work" && PYTHONPATH=$work/root/usr/lib/python3/dist-packages /usr/bin/python3 -B -c \
    "import winslow; assert winslow.__file__.startswith('$work'), winslow.__file__")
fi
ls "$work"/*.deb
