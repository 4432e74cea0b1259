# Shared by ./run and ./test; sourced, not run.

# Debian's interpreter has the modules that Debian's packages install, whatever python3 comes first.
python=/usr/bin/python3
[[ -x $python ]] || python=python3

# packages_of SECTION...: the packages of those sections of packages.txt.
packages_of() {
  local section
  for section in "$@"; do
    sed -n "/^\[$section\]/,/^\[/p" "$root/scripts/packages.txt" | grep -v -e '^\[' -e '^#' -e '^$'
  done
}

# apt_get ARGUMENTS...: as root; apt_error: what went wrong. Another apt, such as the one that a machine
# starts when it has booted, is waited for: DPkg::Lock::Timeout does so for the lock of dpkg only, the
# loop for those of the lists and of downloads, too.
apt_get() {
  local limit=${WINSLOW_APT_TIMEOUT:-600} told=false command deadline
  command=(env LC_ALL=C DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=10 "$@")
  if [[ $(id -u) -ne 0 ]]; then
    command=(sudo "${command[@]}")
  fi
  deadline=$((SECONDS + limit))
  until apt_error=$("${command[@]}" 2>&1 </dev/null); do
    if ! grep -qE 'Could not get lock|Unable to (acquire|lock)' <<<"$apt_error" || ((SECONDS >= deadline)); then
      return 1
    fi
    $told || echo "Another apt is at work: waiting for it, $limit s at most." >&2
    told=true
    sleep 2
  done
}

# install_packages SECTION...: installs what is missing; does nothing, quickly, if nothing is.
install_packages() {
  command -v apt-get >/dev/null || return 0 # not Debian: CMake says what it lacks
  local missing
  missing=$(comm -23 <(packages_of "$@" | sort -u) \
    <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u))
  [[ -z $missing ]] && return 0
  echo "Installing:" $missing >&2
  if [[ $(id -u) -ne 0 ]] && ! command -v sudo >/dev/null; then
    echo "These packages are missing. As root, run: apt-get install" $missing >&2
    return 1
  fi
  # The package lists of a fresh machine are empty or stale: fetch them if the install fails.
  local install=(install -y --no-install-recommends $missing)
  apt_get "${install[@]}" || { apt_get update && apt_get "${install[@]}"; } || {
    echo "$apt_error" >&2
    return 1
  }
}
