# Shared by ./run and ./test; sourced, not run.

# packages_of SECTION...: the packages of those sections of packages.txt.
packages_of() {
  local section
  for section in "$@"; do
    sed -n "/^\[$section\]/,/^\[/p" "$root/scripts/packages.txt" | grep -v -e '^\[' -e '^#' -e '^$'
  done
}

# install_packages SECTION...: installs what is missing; does nothing, quickly, if nothing is.
install_packages() {
  command -v apt-get >/dev/null || return 0 # not Debian: CMake says what it lacks
  local missing as_root=()
  missing=$(comm -23 <(packages_of "$@" | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u))
  [[ -z $missing ]] && return 0
  echo "Installing:" $missing >&2
  if [[ $(id -u) -ne 0 ]]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing. As root, run: apt-get install" $missing >&2
      return 1
    fi
    as_root=(sudo)
  fi
  local install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get install -y -qq --no-install-recommends)
  # The package lists of a fresh machine are empty or stale: fetch them if the install fails.
  "${install[@]}" $missing >/dev/null 2>&1 && return 0
  "${as_root[@]}" apt-get update -qq && "${install[@]}" $missing >/dev/null
}
