#!/usr/bin/env bash
# keeps_its_inputs.sh scene|character RINGCRAFT SCENE FOLDER: `ringcraft fight` into the folder of what it
# reads, where that is called as one of its results, is refused, and what was there stays as it was.
set -u
what=$1 program=$2 scene=$3 folder=$4
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
mkdir -p "$folder/before"
"$program" fight "$scene" -q --set duration_s=0.5 -o "$folder/before" >/dev/null || fault "no fight"
if [ "$what" = scene ]; then
  own=$folder/report.json
  cp "$scene" "$own"
  said=$("$program" fight "$own" -q --set duration_s=0.5 -o "$folder" 2>&1)
else
  own=$folder/fight.glb
  cp "$folder/before/fight.glb" "$own"
  said=$("$program" fight "$scene" -q --set duration_s=0.5 --set "fighter.0.character='$own'" -o "$folder" 2>&1)
fi
code=$?
rm -rf "$folder/before"
[ "$code" -eq 3 ] || fault "exit code $code: $said"
case $said in *"$own: the scene needs it and the fight would overwrite it"*) ;; *) fault "said: $said" ;; esac
[ "$(ls "$folder")" = "${own##*/}" ] || fault "left $(ls "$folder")"
