#!/usr/bin/env bash
# no_regular_file.sh RINGCRAFT FOLDER: a pipe that nobody writes to, a device and a folder are refused at
# once, each with what it is.
set -u
program=$1 folder=$2
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$folder"
mkdir -p "$folder/sub"
mkfifo "$folder/pipe.toml"
# refused PATTERN COMMAND...
refused() {
  local pattern=$1 said code
  shift
  said=$(timeout -s KILL 20 "$@" 2>&1 >/dev/null)
  code=$?
  [ "$code" -eq 3 ] || fault "exit code $code of $*: $said"
  printf '%s' "$said" | grep -q -- "$pattern" || fault "said: $said"
}
refused 'zero: a device or a pipe, no file; write what it gives to a file' "$program" fight /dev/zero -o "$folder/out"
refused 'pipe.toml: a device or a pipe, no file' "$program" fight "$folder/pipe.toml" -o "$folder/out"
refused 'pipe.toml: a device or a pipe, no file' "$program" replay "$folder/pipe.toml"
refused 'sub: a folder; name a file' "$program" replay "$folder/sub"
refused 'pipe.toml: exists and is no motion library' "$program" library build kickboxing -q -o "$folder/pipe.toml"
refused 'sub: exists and is no motion library' "$program" library build kickboxing -q -o "$folder/sub"
