#!/bin/sh
#SBATCH --job-name=viscosity
#SBATCH --array=0-3
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --output=study_%a.csv
# A parameter study as a Slurm job array: one case per task, each with a private server on its node.
# usage: sbatch slurm.sh [OPTIONS of case.py]; then cat study_*.csv
# STUDY names this folder (a job's script is copied elsewhere); by default the one that sbatch was called in.
set -eu
set -- "$(echo 0.5 2 5 10 | cut -d ' ' -f $((SLURM_ARRAY_TASK_ID + 1)))" "$@"
exec python3 "${STUDY:-$SLURM_SUBMIT_DIR}/case.py" "$@" --threads "${SLURM_CPUS_PER_TASK:-1}"
