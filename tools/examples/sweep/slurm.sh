#!/usr/bin/env bash
# Runs a sweep as a Slurm job array (Debian: slurm-wlm): one task per run, and one at the end that collects. DIR is on a
# file system that all nodes share.
#
#     tools/examples/sweep/slurm.sh SPEC DIR [drape sweep's options]
set -euo pipefail
spec=$(realpath "$1") folder=$(realpath "$2")
shift 2
drape=$(realpath "${DRAPE:-build/drape}")
last=$(($("$drape" sweep "$spec" --count) - 1))
mkdir -p "$folder-logs"
array=$(sbatch --parsable --array="0-$last" --cpus-per-task=1 --output="$folder-logs/%a.log" \
    --wrap="$(printf '%q ' "$drape" sweep "$spec" -o "$folder" --resume "$@") --index \$SLURM_ARRAY_TASK_ID")
sbatch --parsable --dependency="afterany:$array" --output="$folder-logs/collect.log" \
    --wrap="$(printf '%q ' "$drape" sweep "$spec" -o "$folder" "$@" --collect)"
