#!/usr/bin/env bash
# Installs what is missing, builds, and simulates a scene: ./run.sh [SCENE] [OPTION...]
#
# SCENE is a file, or the name of one in assets/scenes; without it the default duel is fought. The
# options are those of `ringcraft fight`. The result is in out/<scene's name>/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
preset=${RINGCRAFT_PRESET:-release}

scene=duel
if [ $# -gt 0 ] && [ "${1#-}" = "$1" ]; then
  scene=$1
  shift
fi

"$root/tools/setup.sh" build
(
  cd "$root"
  cmake --preset "$preset" >&2
  cmake --build --preset "$preset" --target ringcraft --parallel "$(nproc)" >&2
)
exec "$root/build/$preset/ringcraft" fight "$scene" "$@"
