#!/usr/bin/env bash
# run.sh READER [SECONDS]: fuzzes the reader of film, gltf, image, obj, ply, stl or rays, by default for half an hour.
# Inputs that lead to new code are kept in build/fuzz/corpus, inputs that fail in build/fuzz/found. The next run tries
# both first. The exit status is 0 if no input failed.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$here/../../build/fuzz
data=$here/../io/data
target=${1:?READER: film, gltf, image, obj, ply, stl or rays}
seconds=${2:-1800}

launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
cmake -S "$here" -B "$build" -G Ninja -DCMAKE_CXX_COMPILER=clang++-14 "${launcher[@]}" >/dev/null
nice -n 10 cmake --build "$build" --target "fuzz_$target"

seeds=$build/seeds/$target corpus=$build/corpus/$target found=$build/found/$target
rm -rf "$seeds"
mkdir -p "$seeds" "$corpus" "$found" "$build/scratch"
export TMPDIR=$build/scratch  # for scratch_file.h
case $target in
    image)
        cp "$data"/images/* "$data/orange.jpg" "$here"/seeds/images/* "$seeds"
        largest=4096
        ;;
    obj)  # an OBJ, a zero byte, an MTL
        for obj in "$data"/obj/*.obj "$here"/seeds/*.obj; do
            mtl=${obj%.obj}.mtl
            { cat "$obj" && printf '\0' && if [[ -e $mtl ]]; then cat "$mtl"; fi; } >"$seeds/$(basename "$obj")"
        done
        largest=2048
        ;;
    ply | stl)
        cp "$here"/seeds/*."$target" "$seeds"
        largest=2048
        ;;
    gltf)
        cp "$here"/seeds/*.gltf "$here"/seeds/*.glb "$seeds"
        largest=4096
        ;;
    film)
        # What the bytes of a small film are changed by: none of them, and all.
        head -c 4096 /dev/zero >"$seeds/nothing"
        head -c 4096 /dev/zero | tr '\0' '\377' >"$seeds/everything"
        largest=65536  # two tiles have 41008
        ;;
    rays)
        printf '0 0 5 0 0 -1\n# a comment\n\n1e-3 +2. .5 0 1 0 0 inf\n' >"$seeds/rays.txt"
        head -c 640 /dev/zero >"$seeds/zeros"
        largest=1024
        ;;
esac
# 4 KB of PNG may hold 34 million pixels of one bit, so 400 MB of floats; what takes more is a claim that was believed.
cd "$found"
exec nice -n 10 "$build/fuzz_$target" -max_total_time="$seconds" -max_len=$largest -timeout=20 -malloc_limit_mb=500 \
    -rss_limit_mb=2000 -artifact_prefix="$found/" -print_final_stats=1 -use_value_profile=1 "$corpus" "$seeds" "$found"
