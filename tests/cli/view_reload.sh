#!/bin/bash
# A window that reloads its scene: what is wrong is told and nothing changes, what is right is taken over.
#   view_reload.sh SWARD     under a display
set -u
folder=$(mktemp -d)
trap 'kill "$viewer" 2>/dev/null; rm -rf "$folder"' EXIT
viewer=
scene() {
  cat <<TOML
name = "small"
[terrain]
generator = "meadow"
samples = 65
size_m = 200.0
[[layer]]
name = "ground_cover"
density = 20.0
$1 = 10.0
[[layer.species]]
name = "grass"
color = "#6a8f3c"
height_m = [0.2, 0.4]
TOML
}
# Waits until the log says it.
expect() {
  for _ in $(seq 400); do
    grep -q "$1" "$folder/log" && return
    kill -0 "$viewer" 2>/dev/null || break
    sleep 0.2
  done
  echo "the window never said \"$1\":"
  cat "$folder/log"
  exit 1
}

scene horizon_m >"$folder/scene.toml"
"$1" view "$folder/scene.toml" --watch --size 64x48 --samples 1 >"$folder/log" 2>&1 &
viewer=$!
sleep 3
for _ in $(seq 40); do
  # Again and again: the window may not have begun to watch.
  scene horizont_m >"$folder/scene.toml"
  sleep 1
  grep -q "not reloaded" "$folder/log" && break
done
expect 'not reloaded: .*scene.toml:9: unknown key "horizont_m"'
scene horizon_m >"$folder/scene.toml"
expect 'reloaded: [0-9]* ms beside the drawing'
kill -0 "$viewer" || { echo "the window has gone"; exit 1; }
echo passed
