#!/usr/bin/env bash
# end_by_signal.sh SECONDS OUT COMMAND...: after so many seconds SIGTERM, and in a second run SIGINT,
# must end the command with exit code 130, and leave no half-written file in OUT. It has 40 s for it:
# what is under way is finished first, and a decision takes seconds on a busy machine.
set -u
seconds=$1 out=$2
shift 2
faults=0
fault() { printf 'FAULT: %s\n' "$1"; faults=$((faults + 1)); }
for signal in TERM INT; do
  rm -rf "$out"
  "$@" >/dev/null 2>&1 &
  process=$!
  sleep "$seconds"
  if ! kill -0 "$process" 2>/dev/null; then
    fault "$signal: had ended before"
    wait "$process"
    continue
  fi
  kill -s "$signal" "$process"
  (sleep 40; kill -s KILL "$process" 2>/dev/null) >/dev/null 2>&1 &
  watch=$!
  wait "$process"
  code=$?
  kill "$watch" 2>/dev/null
  [ "$code" -eq 130 ] || fault "$signal: exit code $code, not 130"
  left=$(find "$out" -name '*.part*' 2>/dev/null)
  [ -z "$left" ] || fault "$signal: left $left"
done
[ "$faults" -eq 0 ]
