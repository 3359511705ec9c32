#!/usr/bin/env bash
# expect_failure.sh CODE PATTERN OUT COMMAND...: the command must fail with CODE, say exactly one line on
# stderr that matches PATTERN, and leave nothing in OUT.
set -u
code=$1 pattern=$2 out=$3
shift 3
said=$("$@" 2>&1 >/dev/null)
got=$?
fault() { printf 'FAULT: %s\n' "$1"; printf 'said: %s\n' "$said"; exit 1; }
[ "$got" -eq "$code" ] || fault "exit code $got, not $code"
[ "$(printf '%s\n' "$said" | wc -l)" -eq 1 ] || fault "not one line"
printf '%s' "$said" | grep -Eq -- "$pattern" || fault "does not match: $pattern"
if [ -e "$out" ] && [ -n "$(ls -A "$out" 2>/dev/null)" ]; then fault "left files in $out"; fi
exit 0
