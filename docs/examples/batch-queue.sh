#!/bin/sh
# Takes parts of a batch until none is left. Run it as often as you like, on any machine that sees the folders, early or late; afterwards
# the command of the last line but without --shard draws what a worker that died has left. mkdir is atomic, on NFS too.
#   batch-queue.sh PARTS FOLDER OUT [FLAGS of burnish batch...]
parts=$1 input=$2 output=$3
shift 3
mkdir -p "$output/.taken"
part=0
while [ $((part += 1)) -le "$parts" ]; do
    mkdir "$output/.taken/$part" 2>/dev/null || continue
    burnish batch "$input" --recursive -d "$output" --shard="$part/$parts" --quiet "$@" || [ $? = 11 ] || exit
done
