#!/usr/bin/env bash
# Runs every fuzzer for a bounded time: tools/fuzz.sh [SECONDS_EACH]; fails on a crash, a hang, a leak.
#
# Inputs that break a reader are left in build/fuzz/found; a mended one stays as a test in tests/capture.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

seconds=${1:-20}
build=build/fuzz
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --parallel "$(nproc)" | tail -n 1

mkdir -p "$build/found"
"$build/tests/fuzz/ringcraft_fuzz_seeds" "$build/corpus"
failed=0
for fuzzer in "$build"/tests/fuzz/ringcraft_fuzz_*; do
  name=${fuzzer##*ringcraft_fuzz_}
  if [ "$name" = seeds ] || [ ! -x "$fuzzer" ]; then continue; fi
  log=$build/$name.log
  if "$fuzzer" "$build/corpus/$name" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
    -max_len=16384 -artifact_prefix="$build/found/$name-" -print_final_stats=1 >"$log" 2>&1; then
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    printf '%s: %s inputs in %s s, nothing broke\n' "$name" "$runs" "$seconds"
  else
    printf '%s: broke\n' "$name"
    tail -n 30 "$log"
    failed=1
  fi
done
exit "$failed"
