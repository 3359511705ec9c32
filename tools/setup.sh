#!/usr/bin/env bash
# Makes a Debian 12 machine ready: tools/setup.sh build|test|ci
#
# Installs the packages that are missing (with sudo where it does not run as root), then the modules
# of the page and the page itself where they are missing or out of date. Says what it does; does
# nothing that is done already, and then needs no network.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# README.md gives each its reason.
build_packages=(
  cmake ninja-build g++ ccache pkg-config
  libbullet-dev libeigen3-dev libglm-dev libtinygltf-dev libgtest-dev libgmock-dev libbenchmark-dev
  libcli11-dev libtomlplusplus-dev libvalijson-dev nlohmann-json3-dev libfmt-dev libspdlog-dev
  libexpected-dev libboost-graph-dev libxxhash-dev assimp-testmodels
)
node_packages=(nodejs npm ca-certificates)
test_packages=(assimp-utils)
browser_packages=(chromium)
ci_packages=(clang clang-format clang-tidy libclang-rt-14-dev shellcheck git)

say() { printf '%s\n' "$*" >&2; }

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# The packages among the arguments that are not installed, one a line.
missing_packages() {
  local name status
  for name in "$@"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null) || status=none
    [ "$status" = installed ] || printf '%s\n' "$name"
  done
}

install_packages() {
  if ! command -v dpkg-query >/dev/null; then
    say "setup: this is not Debian; install by your own means what is missing of: $*"
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0
  say "setup: installs ${missing[*]}"
  as_root apt-get update -q >&2
  as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}" >&2
}

# Node 18 or newer and npm, from wherever.
has_node() {
  command -v node >/dev/null && command -v npm >/dev/null &&
    [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 18 ]
}

has_browser() {
  [ -x "${CHROMIUM:-/usr/bin/chromium}" ]
}

# viewer/dist/page.html, the page into which a fight is embedded.
build_page() {
  local installed=viewer/node_modules/.package-lock.json page=viewer/dist/page.html
  if [ ! -e "$installed" ] || [ viewer/package-lock.json -nt "$installed" ]; then
    say "setup: installs the page's modules (viewer/package-lock.json)"
    npm --prefix viewer ci --no-progress >&2
    touch "$installed"
  fi
  if [ ! -e "$page" ] ||
    [ -n "$(find viewer/src viewer/build.mjs viewer/package-lock.json -newer "$page" -print -quit)" ]; then
    say "setup: builds the page"
    npm --prefix viewer run --silent build >&2
    touch "$page"
  fi
}

packages=("${build_packages[@]}")
has_node || packages+=("${node_packages[@]}")
case "${1:-}" in
  build) ;;
  test | ci)
    packages+=("${test_packages[@]}")
    has_browser || packages+=("${browser_packages[@]}")
    if [ "$1" = ci ]; then packages+=("${ci_packages[@]}"); fi
    ;;
  *)
    say "usage: tools/setup.sh build|test|ci"
    exit 2
    ;;
esac
install_packages "${packages[@]}"
build_page
