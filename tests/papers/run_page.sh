#!/usr/bin/env bash
# run_page.sh ROOT BIN FOLDER BLOCK...: runs the shell blocks of a page one after the other, in a FOLDER that looks like
# ROOT after a build; fails where a command does.
set -euo pipefail
root=$1 bin=$2 folder=$3
shift 3
rm -rf "$folder"
mkdir -p "$folder/build/release"
ln -s "$bin" "$folder/build/release/bin"
ln -s "$root/examples" "$folder/examples"
cd "$folder"
for block in "$@"; do
    echo "== $block"
    bash -euxo pipefail "$block"
done
[[ -e build/films/merged.exr ]] || exit 0
# What the page of long renders says of its pictures: parts make the picture of one render, more samples that of so many.
build/release/bin/fig15_cornell_box --quiet --size 160x160 --spp 64 -o build/films/64.exr
build/release/bin/fig15_cornell_box --quiet --size 160x160 --spp 256 -o build/films/256.exr
build/release/bin/limn compare build/films/merged.exr build/films/64.exr | grep -E '^MSE +0$'
build/release/bin/limn compare build/films/box.exr build/films/256.exr | grep -E '^MSE +0$'
