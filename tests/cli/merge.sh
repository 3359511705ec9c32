#!/usr/bin/env bash
# merge.sh RINGCRAFT SCRATCH: what stands in the output folder of `merge` is kept and added to; where it
# cannot be, or another process writes there, nothing is touched.
set -eu
ringcraft=$1 scratch=$2
rm -rf "$scratch"

# batch FOLDER SETUP SEED...: a batch's bouts.
batch() {
  local folder=$scratch/$1 setup=$2
  shift 2
  mkdir -p "$folder"
  printf '{"type":"header","scene":"yard","setup":"%s"}\n' "$setup" >"$folder/bouts.jsonl"
  local seed
  for seed in "$@"; do
    printf '{"seed":%s,"scene":"yard","fighters":[{"name":"a","strikes":1}]}\n' "$seed" >>"$folder/bouts.jsonl"
  done
}
batch a one 1
batch b one 2
batch out one 3 4
batch other two 5

(cd "$scratch" && "$ringcraft" merge a b -q -o out >said.txt)
grep -q '4 bouts of yard, seeds 1 to 4' "$scratch/said.txt"
[ "$(wc -l <"$scratch/out/bouts.jsonl")" -eq 5 ]

# refused PATTERN FOLDER COMMAND...: with one line, and the bouts of the folder are as they were.
refused() {
  local pattern=$1 bouts=$scratch/$2/bouts.jsonl code=0
  shift 2
  cp "$bouts" "$scratch/before.jsonl"
  said=$(cd "$scratch" && "$@" 2>&1 >/dev/null) || code=$?
  [ "$code" -ne 0 ]
  printf '%s' "$said" | grep -q -- "$pattern"
  cmp "$bouts" "$scratch/before.jsonl"
}
refused 'other/bouts.jsonl: line 1: .*--out' other "$ringcraft" merge a b -q -o other
refused 'out: another ringcraft is writing here' out flock out "$ringcraft" merge a b -q -o out
