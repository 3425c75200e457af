#!/bin/sh
#SBATCH --array=1-100
#SBATCH --cpus-per-task=4
#SBATCH --time=2:00:00
# A part of a batch for each task of a Slurm array. PARTS is the array's last number, whatever tasks run:
#   sbatch batch-array.sh 100 FOLDER OUT [FLAGS of burnish batch...]
#   sbatch --dependency=afterany:JOB --wrap='burnish batch FOLDER -r -d OUT --index [the same FLAGS]'
parts=$1 input=$2 output=$3
shift 3
exec burnish batch "$input" --recursive -d "$output" -j "$SLURM_CPUS_PER_TASK" --shard="$SLURM_ARRAY_TASK_ID/$parts" --quiet "$@"
