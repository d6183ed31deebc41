#!/bin/bash
# Tries array.sh on a Slurm of one node: sets it up, submits the array, kills a task, submits that again, merges, and
# compares with one run. For root on a Debian machine of its own (a container): it installs slurm-wlm and munge, and
# ends the daemons that it started.
#
#   docs/examples/cluster/slurm.sh target/release/crossbar [COMMAND...]
set -euo pipefail
cd "$(dirname "$0")/../../.."
CROSSBAR=$(realpath "${1:-target/release/crossbar}")
shift || true
COMMAND=${*:-all-frequency precompute docs/examples/court.obj --ground 96}
PARTS=6
export CROSSBAR COMMAND PARTS

if ! command -v slurmctld >/dev/null; then
  apt-get update -qq
  apt-get install -y -qq --no-install-recommends slurm-wlm munge
fi
state=$(mktemp -d)
export SLURM_CONF=$state/slurm.conf
node=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=crossbar
SlurmctldHost=$node
SlurmUser=root
StateSaveLocation=$state/ctld
SlurmdSpoolDir=$state/d
SlurmctldPidFile=$state/slurmctld.pid
SlurmdPidFile=$state/slurmd.pid
SlurmctldLogFile=$state/slurmctld.log
SlurmdLogFile=$state/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
NodeName=$node CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
CONF
mkdir -p "$state/ctld" "$state/d"
finish() {
  for daemon in slurmd slurmctld munged; do
    if test -s "$state/$daemon.pid"; then kill "$(cat "$state/$daemon.pid")" || true; fi
  done
}
trap finish EXIT
test -s /etc/munge/munge.key || mungekey --create
mkdir -p /run/munge
chown munge: /run/munge /etc/munge/munge.key
if ! munge -n >/dev/null 2>&1; then
  setpriv --reuid=munge --regid=munge --clear-groups munged --force --pid-file=/run/munge/munged.pid
  cp /run/munge/munged.pid "$state/munged.pid"
fi
slurmctld
slurmd
until sinfo --noheader --format=%T | grep -q idle; do sleep 0.5; done

rm -rf out/parts out/cluster.npz out/whole.npz
mkdir -p out/parts
# One run, for the comparison; the options of a file's place come last.
time "$CROSSBAR" $COMMAND --threads 1 --out out/whole.npz >/dev/null
start=$(date +%s.%N)
job=$(sbatch --parsable --array=1-$PARTS docs/examples/cluster/array.sh)
# The last task is killed as soon as it runs.
until squeue --noheader --states=running --format=%K --job="$job" | grep -qx "$PARTS"; do sleep 0.1; done
scancel --signal=KILL --batch "${job}_$PARTS" || scancel "${job}_$PARTS"
while squeue --noheader --job="$job" 2>/dev/null | grep -q .; do sleep 0.2; done
ls out/parts
if "$CROSSBAR" merge out/parts/*-of-$PARTS --out out/cluster.npz; then
  echo 'a merge without the killed part was accepted' >&2
  exit 1
fi
sbatch --wait --array=$PARTS docs/examples/cluster/array.sh
"$CROSSBAR" merge out/parts/*-of-$PARTS --out out/cluster.npz
echo "array, kill, array again, merge: $(echo "$(date +%s.%N) - $start" | bc) s"
cmp out/whole.npz out/cluster.npz
for also in ground.npz ground.obj; do
  if test -e "out/whole.$also"; then cmp "out/whole.$also" "out/cluster.$also"; fi
done
echo 'the merged files are those of one run'
