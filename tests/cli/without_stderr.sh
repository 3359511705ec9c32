#!/usr/bin/env bash
# without_stderr.sh RINGCRAFT FOLDER: where stderr is closed or full, nothing is said and the rest is as ever.
set -u
program=$1 folder=$2
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
"$program" fight duel --set duration_s=0.3 -o "$folder/closed" >/dev/null 2>&- || fault "closed: exit code $?"
"$program" fight duel --set duration_s=0.3 -o "$folder/full" >/dev/null 2>/dev/full || fault "full: exit code $?"
for result in closed full; do
  [ -s "$folder/$result/fight.glb" ] || fault "$result: no fight"
done
"$program" schema nothing_like_this 2>/dev/full
[ $? -eq 2 ] || fault "an error with another exit code"
"$program" schema scene >&- 2>&-
[ $? -eq 3 ] || fault "stdout closed as well: another exit code"
