#!/usr/bin/env bash
# keeps_its_inputs.sh scene|character|body|style RINGCRAFT SCENE FOLDER: a fight that would write
# one of its results over a file that it reads is refused, and what was there stays as it was.
set -u
what=$1 program=$2 scene=$3 folder=$4
assets=$(dirname "$scene")/..
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
mkdir -p "$folder"
# fight ARGUMENT...: into the folder.
fight() { "$program" fight "$@" -q --set duration_s=0.5 --export bvh -o "$folder" 2>&1; }
case $what in
scene)
  own=$folder/report.json
  cp "$scene" "$own"
  said=$(fight "$own")
  ;;
character)
  own=$folder/fight.glb
  fight "$scene" >/dev/null || fault "no fight"
  find "$folder" -type f ! -name fight.glb -delete
  said=$(fight "$scene" --set "fighter.0.character='$own'")
  ;;
body)
  own=$folder/report.json
  cp "$assets/bodies/heavyweight.toml" "$own"
  said=$(fight "$scene" --set "fighter.0.body='$own'")
  ;;
style)
  own=$folder/events.jsonl
  cp "$assets/styles/balanced.toml" "$own"
  said=$(fight "$scene" --set "fighter.1.style='$own'")
  ;;
esac
code=$?
[ "$code" -eq 3 ] || fault "exit code $code: $said"
case $said in *"$own: is read and would be written over"*) ;; *) fault "said: $said" ;; esac
[ "$(ls "$folder")" = "${own##*/}" ] || fault "left $(ls "$folder")"
