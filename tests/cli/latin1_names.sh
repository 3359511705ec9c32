#!/usr/bin/env bash
# latin1_names.sh RINGCRAFT SCENE FOLDER: files whose names are not UTF-8 lose no result.
set -u
program=$1 scene=$2 folder=$3
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
mkdir -p "$folder"
grep -v '^name = "duel"' "$scene" >"$folder/"$'n\xff.toml'
"$program" fight "$folder/"$'n\xff.toml' -q --set duration_s=0.5 --export bvh -o "$folder/fight" || fault "no fight"
[ -s "$folder/fight/report.json" ] || fault "no report"
cp "$folder/fight/fighter0.bvh" "$folder/"$'Box\xe9.bvh'
"$program" study clips "$folder/"$'Box\xe9.bvh' jab --distance 3 -o "$folder/clips" || fault "no study"
[ -s "$folder/clips/study.json" ] || fault "no table"
