#!/usr/bin/env bash
# keeps_its_inputs.sh scene|character|body|style|capture|capture_of_hit|COMMAND RINGCRAFT SCENE
# FOLDER: a fight, or another command, that would write one of its results over a file that it reads
# is refused, and what was there stays as it was.
set -u
what=$1 program=$2 scene=$3 folder=$4
assets=$(dirname "$scene")/..
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
mkdir -p "$folder"
# fight ARGUMENT...: into the folder.
fight() { "$program" fight "$@" -q --set duration_s=0.5 --export bvh -o "$folder" 2>&1; }
# of_other NAME FILE COMMAND...: the command into the folder, on a copy of FILE that is there as NAME.
of_other() {
  own=$folder/$1
  cp "$2" "$own"
  shift 2
  said=$("$program" "$@" "$own" -q -o "$folder" 2>&1)
}
# manifest NAME: the library.toml beside the folder that names a capture which is there as NAME.
manifest() {
  own=$folder/$1
  echo 'a capture' >"$own"
  mkdir -p "$folder.library"
  printf 'name = "mine"\n[[capture]]\npath = "%s"\nsegment = true\n' "$own" >"$folder.library/library.toml"
}
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
capture)
  manifest fight.glb
  said=$(fight "$scene" --set "library='$folder.library/library.toml'")
  ;;
capture_of_hit)
  manifest hit.glb
  said=$("$program" hit --library "$folder.library" -q -o "$folder" 2>&1)
  ;;
tree) of_other tree.json "$scene" tree --at 0 ;;
batch) of_other study.json "$scene" batch --count 1 ;;
bench) of_other timing.json "$scene" bench ;;
study) of_other study.csv "$scene" study cost ;;
hit) of_other hit.json "$assets/bodies/heavyweight.toml" hit --body ;;
sweep) of_other hit_sweep.csv "$assets/bodies/heavyweight.toml" hit --sweep tone=0:1:1 --body ;;
sparring) of_other table.json "$assets/bodies/heavyweight.toml" sparring --attacker ;;
interpolate) of_other blends.svg "$assets/kickboxing/library.toml" library interpolate ;;
esac
code=$?
[ "$code" -eq 3 ] || fault "exit code $code: $said"
case $said in *"$own: is read and would be written over"*) ;; *) fault "said: $said" ;; esac
[ "$(ls "$folder")" = "${own##*/}" ] || fault "left $(ls "$folder")"
