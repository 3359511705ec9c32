#!/usr/bin/env bash
# completion.sh RINGCRAFT: bash completes with the script as it is printed; zsh and fish, where they
# are installed, find no fault in theirs, and fish completes.
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
faults=0
fault() { printf 'FAULT: %s\n' "$1"; faults=$((faults + 1)); }

# What bash offers for the words, the last of which is being typed; one a line.
in_bash() {
  bash -c 'source <("$1" completion bash); COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
    complete -p ringcraft >&2; _ringcraft; printf "%s\n" "${COMPREPLY[@]}"' "$program" "$program" "$@" 2>"$folder/said"
}
offers() {
  local wanted=$1 got
  shift
  got=$(in_bash "$@" | tr '\n' ' ')
  [ "$got" = "$wanted " ] || fault "bash, '$*': wanted '$wanted', got '$got'"
}
cd "$folder" || exit 1
mkdir results
offers "fight" "fi"
offers "duel" fight du
offers "southpaw" tree --at 2 sou
offers "bvh" fight --export = b
offers "results" serve res
offers "kickboxing" library check kick
offers "infighter" study styles --pairings outboxer : infi
offers "bash" completion b
grep -q '_ringcraft ringcraft' "$folder/said" || fault "bash: not set up for ringcraft"

"$program" completion zsh >"$folder/zsh"
"$program" completion fish >"$folder/fish"
if command -v zsh >/dev/null; then
  zsh -n "$folder/zsh" || fault "zsh: syntax"
fi
if command -v fish >/dev/null; then
  fish -n "$folder/fish" || fault "fish: syntax"
  got=$(HOME=$folder PATH=$(dirname "$program"):$PATH fish -c "source $folder/fish; complete -C 'ringcraft fight --export-profile mi'")
  case $got in mixamo*) ;; *) fault "fish: got '$got'" ;; esac
fi
[ "$faults" -eq 0 ]
