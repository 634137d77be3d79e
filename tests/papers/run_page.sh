#!/usr/bin/env bash
# run_page.sh ROOT BIN FOLDER BLOCK...: runs the shell blocks of a page one after the other, in a FOLDER that looks like
# ROOT after a build; fails where a command does. Exit status 77 where all went well but what a program is missing for.
set -euo pipefail
root=$1 bin=$2 folder=$3
shift 3
rm -rf "$folder"
mkdir -p "$folder/build/release"
ln -s "$bin" "$folder/build/release/bin"
ln -s "$root/examples" "$folder/examples"
cd "$folder"
left_out=0
for block in "$@"; do
    # Not every system has the engines that run parts of a render.
    case $(<"$block") in
        make\ *) engine=make ;;
        *examples/cluster/*) engine=parallel ;;
        *) engine=bash ;;
    esac
    if ! command -v "$engine" >/dev/null; then
        echo "== $block is left out: $engine is missing"
        left_out=77  # by which CTest knows a test that was skipped
        continue
    fi
    echo "== $block"
    bash -euxo pipefail "$block"
done
[[ -e build/films/merged.exr ]] || exit "$left_out"

# What the page of long renders says of its pictures: parts make the picture of one render, more samples that of so many.
same() { build/release/bin/limn compare "build/films/$1.exr" "build/films/$2.exr" | grep -E '^MSE +0$'; }
once=(build/release/bin/fig15_cornell_box --quiet --size 100x100)
"${once[@]}" --spp 64 -o build/films/64.exr
"${once[@]}" --spp 256 -o build/films/256.exr
same merged 64
same box 256
for engine in make parallel; do
    ! command -v "$engine" >/dev/null || same "$engine" 64
done
if command -v parallel >/dev/null; then
    # After the rounds each pixel has as many samples as the last of their plans says.
    "${once[@]}" --plan build/films/rounds.plan -o build/films/planned.exr
    same rounds planned
fi
exit "$left_out"
