#!/usr/bin/env bash
# The hard cases in six builds: g++ and clang, each at -O0, -O2 and -O3 -march=native, under build/hard/.
#   tests/hard/builds.sh          the digests: are the answers to the fixed corpus the same bits in all of them?
#   tests/hard/builds.sh --full   the whole hard-case suite in each, and with link-time optimisation
# Prints a table; exits with 0 only where everything passed and all digests are the same.
set -euo pipefail
cd "$(dirname "$0")/../.."

usage() {
    sed -n '2,4s/^# \{0,1\}//p' "$0" >&2
    exit 2
}

full=0
[[ $# -le 1 ]] || usage
if [[ $# -eq 1 ]]; then
    [[ $1 == --full ]] || usage
    full=1
fi

clang=$(command -v clang++-19 || command -v clang++) || { echo "builds.sh: no clang++ here" >&2; exit 1; }
gcc=$(command -v g++) || { echo "builds.sh: no g++ here" >&2; exit 1; }
launcher=()
! command -v ccache >/dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)

# Into build/hard/$1.
build() {
    cmake -S . -B "build/hard/$1" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$2" -DCMAKE_CXX_FLAGS="$3" \
        -DLIMN_WARNINGS_AS_ERRORS=OFF "${launcher[@]}" >"build/hard/$1.log" 2>&1 &&
        cmake --build "build/hard/$1" -j "$(nproc)" --target "${targets[@]}" >>"build/hard/$1.log" 2>&1
}

# The digests that a run found, one line; Catch2 prints them as "found" == "expected".
digests() { sed -n 's/^ *"\([0-9a-f]\{16\}\)" == .*/\1/p' "$1" | paste -sd ' '; }

targets=(test_digest)
[[ $full -eq 0 ]] || targets+=(test_hard)
mkdir -p build/hard
failed=0
all_digests=
printf '%-26s %-8s %8s  %s\n' build result seconds "digests (compiled, described, surfaces)"
for compiler in "$gcc" "$clang"; do
    variants=("-O0" "-O2" "-O3 -march=native")
    [[ $full -eq 0 || $compiler != "$gcc" ]] || variants+=("-O3 -march=native -flto=auto")
    for flags in "${variants[@]}"; do
        label="$(basename "$compiler") $flags"
        folder=${label//[ =]/_}
        result=passed found= seconds=
        if build "$folder" "$compiler" "$flags"; then
            bin=build/hard/$folder/bin
            started=$EPOCHREALTIME
            "$bin/test_digest" -s >"build/hard/$folder.txt" 2>&1 || result=FAILED
            found=$(digests "build/hard/$folder.txt")
            if [[ $full -eq 1 ]]; then
                "$bin/test_hard" >>"build/hard/$folder.txt" 2>&1 || result=FAILED
            fi
            seconds=$(awk -v a="$started" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')
        else
            result="no build"
        fi
        [[ $result == passed ]] || failed=1
        [[ -n $found && (-z $all_digests || $found == "$all_digests") ]] || failed=1
        all_digests=${all_digests:-$found}
        printf '%-26s %-8s %8s  %s\n' "$label" "$result" "$seconds" "$found"
    done
done
[[ $failed -eq 0 ]] || echo "builds.sh: not all alike; the output is in build/hard/*.txt, that of the builds in *.log" >&2
exit $failed
