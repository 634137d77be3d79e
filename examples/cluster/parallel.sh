#!/usr/bin/env bash
# parallel.sh PARTS PICTURE COMMAND... renders a picture in PARTS parts by GNU parallel and merges them to PICTURE. With
# PARALLEL='--sshlogin ...' the parts are rendered on other machines, which must share this folder. A part that failed
# is tried again from its checkpoint, three times in all.
set -euo pipefail
parts=$1 picture=$2
shift 2
base=$(printf '%q' "${picture%.*}")
command=$(printf '%q ' "$@")
parallel --retries 3 "$command --quiet --shard {}/$parts --checkpoint $base-{}.film --resume $base-{}.film" ::: $(seq "$parts")
eval "${LIMN:-limn} merge $(seq -f "$base-%g.film" -s ' ' "$parts") -o $(printf '%q' "$picture")"
