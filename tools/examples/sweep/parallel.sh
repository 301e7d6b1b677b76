#!/usr/bin/env bash
# Runs a sweep by GNU parallel (Debian: apt-get install parallel), on this machine or, with --sshlogin, on several that
# share the folder: every run is a job of its own.
#
#     tools/examples/sweep/parallel.sh SPEC DIR [drape sweep's options]
set -euo pipefail
spec=$1 folder=$2
shift 2
drape=${DRAPE:-build/drape}
last=$(($("$drape" sweep "$spec" --count) - 1))
# A failed run is in its record, and --collect counts it.
seq 0 "$last" | parallel --will-cite "$drape" sweep "$spec" -o "$folder" --resume "$@" --index {} || true
"$drape" sweep "$spec" -o "$folder" "$@" --collect
