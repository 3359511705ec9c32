#!/bin/sh
# long_capture.sh BVH OUT: the motion ten times over.
awk '/^Frames:/ { print "Frames: " $2 * 10; next }
  { print }
  rows { all = all $0 "\n" }
  /^Frame Time/ { rows = 1 }
  END { for (i = 1; i < 10; ++i) printf "%s", all }' "$1" >"$2"
