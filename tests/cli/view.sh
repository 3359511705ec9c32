#!/usr/bin/env bash
# view.sh RINGCRAFT FOLDER: `ringcraft view` prints the address, opens it with $BROWSER where there
# is one, and does not fail without a display.
set -u
program=$1 folder=$2
faults=0
fault() { printf 'FAULT: %s\n' "$1"; faults=$((faults + 1)); }
unset BROWSER DISPLAY WAYLAND_DISPLAY
rm -rf "$folder"
mkdir -p "$folder/a fight #1"
cd "$folder" || exit 1
folder=$(pwd -P)
echo '<p>fight' >'a fight #1/fight.html'
# A browser that writes down what it is asked to open.
printf '#!/bin/sh\nprintf "%%s\\n" "$@" >"%s/opened"\n' "$folder" >browser
printf '#!/bin/sh\nexit 1\n' >broken
chmod +x browser broken
address="file://$folder/a%20fight%20%231/fight.html"

# says CODE WANTED ARGUMENT...: exit code and stdout.
says() {
  local code=$1 wanted=$2 got
  shift 2
  got=$("$program" view "$@" 2>said)
  local is=$?
  [ "$is" -eq "$code" ] || fault "view $*: exit code $is, not $code: $(cat said)"
  [ "$got" = "$wanted" ] || fault "view $*: said '$got', not '$wanted'"
}
says 0 "$address" 'a fight #1'
grep -q 'no display' said || fault "does not say that there is no display"
says 0 "$address" 'a fight #1/fight.html'
# Of several pages the newest is meant: a sweep into the folder of a hit.
mkdir hits
touch -d '2 seconds ago' hits/hit.html
touch hits/hit_sweep.svg
says 0 "file://$folder/hits/hit_sweep.svg" hits
touch -d '4 seconds ago' hits/hit_sweep.svg
says 0 "file://$folder/hits/hit.html" hits
BROWSER=$folder/browser says 0 "$address" 'a fight #1'
[ "$(cat opened 2>/dev/null)" = "$address" ] || fault "the browser was given '$(cat opened)'"
rm -f opened
BROWSER="$folder/browser --new %s x" says 0 "$address" 'a fight #1'
[ "$(tr '\n' ' ' <opened)" = "--new $address x " ] || fault "the browser was given '$(cat opened)'"
rm -f opened
BROWSER=$folder/browser says 0 "$address" --print 'a fight #1'
[ ! -e opened ] || fault "--print opened a browser"
for wrong in "$folder/broken" no_such_browser_here; do
  BROWSER=$wrong says 0 "$address" 'a fight #1'
  grep -q 'by hand' said || fault "a browser that fails is not spoken of"
done
says 3 '' .
says 3 '' nothing.html
says 3 '' no_such_scene
# A scene is fought first.
says 0 "file://$folder/made/fight.html" duel --set duration_s=1 -q -o made
[ -s made/fight.html ] || fault "the scene was not fought"
# So it is where a folder without a page is called as the scene is.
mkdir duel
says 0 "file://$folder/made2/fight.html" duel --set duration_s=1 -q -o made2
says 3 '' ./duel
echo '<p>fight' >duel/fight.html
says 0 "file://$folder/duel/fight.html" duel
[ "$faults" -eq 0 ]
