#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Measures again every figure that README.md and docs/ quote, and draws their pictures: one command,
# a few hours on a quiet machine with two cores. Finished runs of efficiency.py are kept.
# usage: bench/reproduce.sh [FOLDER for what is not part of the documentation, build/reproduced]
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-build/reproduced}
mkdir -p "$out"

docs/figures/techniques.py                                       # docs/figures/*.svg
bench/readme_pictures.py                                         # docs/figures/hero.jpg, pair.*
bench/efficiency.py --seconds 10 --seeds 5 --docs docs/efficiency.md
bench/agreement.py > "$out/agreement.md"                          # docs/efficiency.md
bench/compare_mitsuba.py --clock cpu --spp 256 --json "$out/mitsuba.json" || [[ $? == 77 ]]
for layer in sampling geometry media techniques guiding; do      # costs in nanoseconds
  build/release/bench/tyndall_bench_$layer --benchmark_out="$out/$layer.json" \
    --benchmark_out_format=json
done
