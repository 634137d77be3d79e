#!/usr/bin/env bash
# rounds.sh PARTS ERROR PICTURE COMMAND... renders a picture to a relMSE of ERROR, in PARTS parts and several rounds.
# Each round ends with a merge of the films, which estimates the error of the picture. If the error is too large, the
# merge writes a plan of how many samples each pixel gets in the next round.
set -euo pipefail
parts=$1 error=$2 picture=$3
shift 3
base=$(printf '%q' "${picture%.*}")
command=$(printf '%q ' "$@")
goal='--spp 8'
status=3  # the exit status of `limn merge` if another round is needed
while [[ $status -eq 3 ]]; do
    parallel --retries 3 "$command --quiet $goal --shard {}/$parts --film $base-{}.film --resume $base-{}.film" ::: $(seq "$parts")
    status=0
    eval "${LIMN:-limn} merge $(seq -f "$base-%g.film" -s ' ' "$parts") --error $error --plan $base.plan -o $(printf '%q' "$picture")" ||
        status=$?
    goal="--plan $base.plan"
done
exit "$status"
