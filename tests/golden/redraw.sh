#!/usr/bin/env bash
# Draws the stored pictures anew, with the software backend. Look at each before it is committed.
# usage: tests/golden/redraw.sh GNOMON
set -euo pipefail
cd "$(dirname "$0")/../.."
models=$(mktemp -d)
trap 'rm -rf "$models"' EXIT
tests/golden/models.sh "$1" "$models"
grep -v '^#' tests/golden/scenes.txt | while read -r name model camera options; do
    # shellcheck disable=SC2086
    "$1" render "$models/$model.gnm" --camera "data/cameras/$camera.json" --size 256x256 --error-pixels 0.001 $options \
        --samples 1 --backend software -o "tests/golden/$name.png"
done
