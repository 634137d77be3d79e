#!/usr/bin/env bash
# slurm.sh PARTS PICTURE COMMAND... renders a picture by a Slurm array job of PARTS tasks. A second job waits for the
# first and merges its films to PICTURE. The script prints the number of the second job. If a node is lost, Slurm starts
# its task again, and the task continues from its checkpoint. All nodes must share this folder and have the programs.
# LIMN is the path of `limn`.
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
