#!/usr/bin/env bash
# rounds.sh PARTS ERROR PICTURE COMMAND...: renders to an error by parts. After each round the films are merged and their
# error is known; where it is too large, the plan says how many samples each pixel needs next.
set -euo pipefail
parts=$1 error=$2 picture=$3
shift 3
base=$(printf '%q' "${picture%.*}")
command=$(printf '%q ' "$@")
goal='--spp 8'
status=3  # of `limn merge`: another round
while [[ $status -eq 3 ]]; do
    parallel --retries 3 "$command --quiet $goal --shard {}/$parts --film $base-{}.film --resume $base-{}.film" ::: $(seq "$parts")
    status=0
    eval "${LIMN:-limn} merge $(seq -f "$base-%g.film" -s ' ' "$parts") --error $error --plan $base.plan -o $(printf '%q' "$picture")" ||
        status=$?
    goal="--plan $base.plan"
done
exit "$status"
