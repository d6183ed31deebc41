#!/bin/bash
# A run of crossbar in parts as an array of Slurm:
#
#   PARTS=8 sbatch --array=1-8 docs/examples/cluster/array.sh     # all parts
#   PARTS=8 sbatch --array=3 docs/examples/cluster/array.sh       # one that was killed, again
#   crossbar merge out/parts/*-of-8 --out out/court.npz           # when all are there
#SBATCH --job-name=crossbar
#SBATCH --cpus-per-task=1
#SBATCH --output=out/parts/%a.log
set -euo pipefail
exec "${CROSSBAR:-crossbar}" ${COMMAND:-all-frequency precompute docs/examples/court.obj --ground 24} \
  --part "$SLURM_ARRAY_TASK_ID/$PARTS" --threads "${SLURM_CPUS_PER_TASK:-1}" \
  --out "out/parts/$SLURM_ARRAY_TASK_ID-of-$PARTS"
