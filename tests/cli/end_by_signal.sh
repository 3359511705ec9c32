#!/usr/bin/env bash
# end_by_signal.sh SECONDS OUT COMMAND...: after so many seconds SIGTERM, and in a second run SIGINT,
# must end the command with exit code 130, and leave no half-written file in OUT. It has 120 s for it:
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
  for ((tenths = 0; tenths < 1200; ++tenths)); do
    kill -0 "$process" 2>/dev/null || break
    sleep 0.1
  done
  kill -s KILL "$process" 2>/dev/null
  wait "$process"
  code=$?
  [ "$code" -eq 130 ] || fault "$signal: exit code $code, not 130"
  left=$(find "$out" -name '*.part*' 2>/dev/null)
  [ -z "$left" ] || fault "$signal: left $left"
done
[ "$faults" -eq 0 ]
