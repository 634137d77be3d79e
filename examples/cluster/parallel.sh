#!/usr/bin/env bash
# parallel.sh PARTS PICTURE COMMAND...: the same by GNU parallel, on this machine or, with PARALLEL='--sshlogin ...', on
# others that see this folder. What failed is tried again, and goes on from its checkpoint.
set -euo pipefail
parts=$1 picture=$2
shift 2
base=$(printf '%q' "${picture%.*}")
command=$(printf '%q ' "$@")
parallel --retries 3 "$command --quiet --shard {}/$parts --checkpoint $base-{}.film --resume $base-{}.film" ::: $(seq "$parts")
eval "${LIMN:-limn} merge $(seq -f "$base-%g.film" -s ' ' "$parts") -o $(printf '%q' "$picture")"
