#!/usr/bin/env bash
# slurm.sh PARTS PICTURE COMMAND...: renders by a Slurm array job of PARTS tasks, whose films a job that depends on it
# merges to PICTURE; prints that job's number. A task whose node is lost is started again by Slurm and goes on from its
# checkpoint. All nodes see this folder and have the programs; LIMN says where `limn` is.
set -euo pipefail
parts=$1 picture=$2
shift 2
base=${picture%.*}
command=$(printf '%q ' "$@")
film=$(printf '%q' "$base")-\$SLURM_ARRAY_TASK_ID.film
tasks=$(sbatch --parsable --job-name=limn --array="1-$parts" --requeue --open-mode=append --output="$base-%a.log" --wrap \
    "exec $command --quiet --shard \$SLURM_ARRAY_TASK_ID/$parts --checkpoint $film --resume $film --every ${EVERY:-60}")
films=$(seq -f "$base-%g.film" "$parts" | xargs printf '%q ')
sbatch --parsable --job-name=limn-merge --dependency="afterok:$tasks" --output="$base.log" --wrap \
    "exec ${LIMN:-limn} merge $films-o $(printf '%q' "$picture")"
