#!/usr/bin/env bash
# Builds the models of scenes.txt: those in data/, and small made ones.
# usage: tests/golden/models.sh GNOMON FOLDER
set -euo pipefail
gnomon=$1 folder=$2 data=$(dirname "$0")/../../data/models
mkdir -p "$folder"
"$gnomon" make statue --triangles 40k -o "$folder/statue.ply"
"$gnomon" make plant --triangles 80k -o "$folder/plant.ply"
"$gnomon" make planes --triangles 40k -o "$folder/planes.ply"
for mesh in "$data"/sundial.ply "$data"/colonnade.obj "$folder"/{statue,plant,planes}.ply; do
    name=$(basename "$mesh")
    "$gnomon" build "$mesh" -o "$folder/${name%.*}.gnm" --progress none
done
