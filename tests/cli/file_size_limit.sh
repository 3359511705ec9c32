#!/usr/bin/env bash
# file_size_limit.sh RINGCRAFT OUT: where files may not grow (ulimit -f), a library is not written, with
# one line and exit code 3, and no part of it is left.
set -u
program=$1 out=$2
fault() { printf 'FAULT: %s\n' "$1"; exit 1; }
rm -rf "$out"
mkdir -p "$out"
said=$(ulimit -f 8; "$program" library build kickboxing -q -o "$out/limited.ringlib" 2>&1)
code=$?
[ "$code" -eq 3 ] || fault "exit code $code: $said"
case $said in *"limited.ringlib: cannot be written: File too large;"*) ;; *) fault "said: $said" ;; esac
[ -z "$(ls -A "$out")" ] || fault "left $(ls -A "$out")"
