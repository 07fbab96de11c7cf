#!/bin/bash
# The flight simulator takes off, lands, and sward replays what its pilot saw.
#   flightsim.sh FLIGHTSIM SWARD
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$1"; cat "$folder/report"; exit 1; }

"$1" "$folder" --fps 30 >"$folder/report" 2>"$folder/errors" || { cat "$folder/errors"; fail "the flight failed"; }
grep -q '^stands after' "$folder/report" || fail "nothing stands"
awk '/^touched down/ { gsub("m/s", ""); exit !($NF > 0 && $NF < 1.6) }' "$folder/report" || fail "a hard landing"
awk '/^touched down/ { exit !($6 > 0 && $6 < 300) }' "$folder/report" || fail "beside the touch-down zone"
awk '/^circuit/ { exit !($4 > 40) }' "$folder/report" || fail "too near the hills"

# Every thirtieth second of it, small.
awk 'NR == 1 || NR % 900 == 2' "$folder/flight.csv" | sed 's/,960,540$/,96,54/' >"$folder/some.csv"
rows=$(($(wc -l <"$folder/some.csv") - 1))
"$2" fly "$folder/strip.toml" --flight "$folder/some.csv" --size 96x54 --samples 1 --csv "$folder/frames.csv" \
  >"$folder/log" 2>&1 || { cat "$folder/log"; fail "the replay failed"; }
[ "$(($(wc -l <"$folder/frames.csv") - 1))" = "$rows" ] || fail "the replay has not $rows frames"
echo passed
