# Sourced by demo.sh and test.sh: steps into the repository and prepares a Debian 12 machine to build it.
# shellcheck shell=bash

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# Installs what packages.txt names, but leaves apt alone where all of it is there: a second run must be quick, and must
# work without root and without a network.
install_packages() {
  local packages missing=() package sudo=()
  mapfile -t packages <packages.txt
  for package in "${packages[@]}"; do
    if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
      missing+=("$package")
    fi
  done
  if ((${#missing[@]} == 0)); then return; fi

  say "Installing ${#missing[@]} packages: ${missing[*]}"
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "$0: packages are missing: run this as root, install sudo, or install them yourself" >&2
      exit 1
    fi
    sudo=(sudo)
  fi
  "${sudo[@]}" apt-get update -q
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# build PRESET [TARGET…]
build() {
  local preset=$1
  shift
  say "Configuring and building build/$preset"
  cmake --preset "$preset"
  cmake --build --preset "$preset" ${1:+--target "$@"}
}
