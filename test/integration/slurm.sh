#!/bin/sh
# Runs the commands of docs/batch.md on a private one-machine Slurm: pictures and report are the same as in one run.
# Usage: slurm.sh PROGRAM FOLDER SOURCES
for tool in munged slurmctld slurmd sbatch srun; do
    PATH=$PATH:/usr/sbin command -v $tool >/dev/null || { echo "slurm: $tool is missing (Debian: slurm-wlm, munge)"; exit 77; }
done
PATH=$PATH:/usr/sbin
here=$(cd "$(dirname "$0")" && pwd)
sources=$(realpath "$3")
. "$here/../cli/lib.sh"

# Sockets have short names, and munge wants folders that nobody else writes to.
home=$(mktemp -d /tmp/slurm.XXXXXX)
chmod 755 "$home"
mkdir "$home/state" "$home/spool"
end() {
    for name in slurmd slurmctld munged; do
        daemon=$(cat "$home/$name.pid" 2>/dev/null) || continue
        kill "$daemon" 2>/dev/null && await ended "$daemon"
    done
    rm -rf "$home"
}
trap end EXIT
trap 'exit 1' HUP INT TERM
dd if=/dev/urandom of="$home/key" bs=128 count=1 2>/dev/null
chmod 600 "$home/key"

# Declares 64 processors, so tasks run in parallel on every machine.
node=$(uname -n | cut -d. -f1)
configure() {
    cat >"$home/slurm.conf" <<END
ClusterName=burnish
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$1
SlurmdPort=$(($1 + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthInfo=socket=$home/munge
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
SlurmctldLogFile=$home/slurmctld.log
SlurmdLogFile=$home/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=sched_min_interval=1,batch_sched_delay=0
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=64 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
END
}
export SLURM_CONF="$home/slurm.conf"
is_idle() { [ "$(sinfo -h -o %T 2>/dev/null)" = idle ]; }
begin() {
    munged --key-file="$home/key" --socket="$home/munge" --pid-file="$home/munged.pid" \
        --log-file="$home/munged.log" --seed-file="$home/seed" || return
    for port in $((20000 + $$ % 20000)) $((20000 + ($$ + 7000) % 20000)); do
        configure $port
        slurmctld -c && slurmd -N "$node" || continue
        ! await is_idle || return 0
    done
    return 1
}
if ! begin >"$home/begin.log" 2>&1; then
    echo "slurm: it does not start here: $(tail -n 2 "$home"/*.log)"
    exit 77
fi

mkdir parts parts/deep programs
for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
    printf 'v 0 0 0\nv %d 0 1\nv 0 2 %d\nv 1 1 5\nf 1 2 3\nf 1 3 4\n' $i $i >parts/deep/$i.obj
done
printf 'v 0 0\n' >parts/bad.obj
ln -s "$burnish" programs/burnish
export PATH="$scratch/programs:$PATH"
burnish batch parts -r -d thumbs --size=32 --index --quiet --no-seconds 2>/dev/null
mv thumbs reference

# The commands of the page, with pictures that are smaller and fewer tasks.
page="$sources/docs/batch.md"
cp "$sources/docs/examples/batch-array.sh" .
sed -n '/^job=\$(sbatch/,/^```/p' "$page" | grep -v '```' |
    sed -e 's/--size=256/--size=32 --no-seconds/' -e 's/ 100 parts/ 9 parts/' -e 's/sbatch --dep/sbatch --wait --dep/' >commands
check "the page has an array" [ "$(grep -c 'sbatch' commands)" = 2 ]
sed -i 's/^#SBATCH --array=1-100/#SBATCH --array=1-9/' batch-array.sh
timeout 60 sh -e commands >"$out" 2>&1
check "an array: exit code $?, $(cat "$out")" [ $? = 11 ]
check "an array: $(diff -r thumbs reference 2>&1 | head -n 3; cat slurm-*.out | head -n 5)" diff -r thumbs reference
check "an array: nine tasks and the last" [ "$(ls slurm-*.out | wc -l)" = 10 ]
check "an array: tasks keep to their processors" grep -q -- '-j "$SLURM_CPUS_PER_TASK"' batch-array.sh
rm -rf thumbs slurm-*.out

# Ranks of srun and of mpirun, and the last command.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
for starter in srun mpirun; do
    has "ranks" "$starter" || continue
    sed -n '/^mpirun/,/^```/p' "$page" | grep "^\(burnish\|$starter\) " |
        sed -e 's/-N 16 .*--exclusive/-n 4/; s/--map-by ppr:1:node --bind-to none/-n 4 --oversubscribe/; s/-d thumbs/-d thumbs --size=32 --no-seconds/' >commands
    check "$starter: the page has two commands" [ "$(wc -l <commands)" = 2 ]
    timeout 60 sh -e commands >"$out" 2>&1
    check "$starter: exit code $?, $(cat "$out")" [ $? = 11 ]
    check "$starter: $(diff -r thumbs reference 2>&1 | head -n 3; cat "$out")" diff -r thumbs reference
    rm -rf thumbs
done
finish
