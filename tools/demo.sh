#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# The demonstration: one good picture, then the same view by plain path tracing and by the learned
# integrator in the same time, measured against the good picture; a page that shows both.
# usage: tools/demo.sh [PROGRAM [FOLDER]]
# DEMO_SECONDS: time of each of the pair [15]; DEMO_PICTURE_SECONDS: of the good picture [30];
# DEMO_SEEDS: how many pairs are measured [1]; DEMO_SCENE: the scene.
set -euo pipefail

program=${1:-build/release/tyndall}
out=${2:-out}
scene=${DEMO_SCENE:-scenes/lantern.pbrt}
seconds=${DEMO_SECONDS:-15}
picture_seconds=${DEMO_PICTURE_SECONDS:-30}
name=$(basename "$scene" .pbrt)
pair=$out/pair
look=(--tone filmic)

# The seconds that a method took, from bench's table: whole passes.
taken() {
  awk -v method="$1" '$1 == method { print $5; exit }' "$out/bench.txt"
}

mkdir -p "$out"
rm -rf "$pair"

# Stopping at the time limit is what --time asks for: exit status 4.
echo "Rendering $scene for $picture_seconds s:"
status=0
"$program" render "$scene" --integrator learned --seed 1000 --time "$picture_seconds" \
  -o "$out/demo.exr" -o "$out/demo.png" "${look[@]}" || status=$?
[[ $status == 0 || $status == 4 ]] || exit "$status"

echo "The same view, $seconds s each, by volpath and by learned:"
"$program" bench "$scene" --integrators volpath,learned --time "$seconds" --seeds "${DEMO_SEEDS:-1}" \
  --reference "$out/demo.exr" -o "$pair" > "$out/bench.txt"
"$program" report "$pair" -o "$out/report.html" --plots "$out" > /dev/null
for method in volpath learned; do
  "$program" convert "$pair/$name-$method-0.exr" "$out/$method.png" "${look[@]}"
done
"$program" convert "$pair/$name-volpath-0.exr" "$out/pair.png" \
  --split "$pair/$name-learned-0.exr" "${look[@]}"

echo
head -n -1 "$out/bench.txt"
echo
printf '%-20s %s\n' "$out/demo.png" "the picture; all its layers are in $out/demo.exr" \
  "$out/pair.png" "left volpath, $(taken volpath) s; right learned, $(taken learned) s" \
  "$out/report.html" "the report: open it in a browser"
