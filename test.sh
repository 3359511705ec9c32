#!/usr/bin/env bash
# Installs what is missing, builds everything, and runs every test: ./test.sh
#
# RINGCRAFT_PRESET chooses the build (release, the default, or sanitize).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

preset=${RINGCRAFT_PRESET:-release}
tools/setup.sh test
cmake --preset "$preset" >&2
cmake --build --preset "$preset" --parallel "$(nproc)" >&2

failed=0
ctest --preset "$preset" --parallel 2 || failed=1

# The page, in a browser, on a fight made now.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if "build/$preset/ringcraft" fight duel --set duration_s=6 --quiet --out "$folder" >&2; then
  FIGHT_HTML=$folder/fight.html npm --prefix viewer --silent test || failed=1
else
  failed=1
fi

if [ "$failed" -ne 0 ]; then
  echo "test.sh: failed"
  exit 1
fi
echo "test.sh: all tests passed"
