#!/usr/bin/env bash
# The hard cases, and what else compares hits, on every instruction set that the kernels are built for and this processor
# has. usage: targets.sh [BUILD_FOLDER]
set -euo pipefail
bin=${1:-build/release}/bin
failed=0
for target in SCALAR EMU128 SSE4 AVX2 AVX3; do
    for program in test_digest test_hard test_compile test_render; do
        status=0
        LIMN_TEST_TARGET=$target "$bin/$program" >"/tmp/limn-$target-$program.log" 2>&1 || status=$?
        case $status in
            0) echo "$target $program: $(tail -n 3 "/tmp/limn-$target-$program.log" | grep -m1 passed)" ;;
            4) echo "$target: not on this machine"; break ;;
            *) echo "$target $program FAILED, see /tmp/limn-$target-$program.log"; failed=1 ;;
        esac
    done
done
exit $failed
