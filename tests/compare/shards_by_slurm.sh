#!/usr/bin/env bash
# A job array of four shards on a Slurm of one node, merged, is the whole sweep. The daemons are Debian's. They run in
# the foreground, with their files in FOLDER_TO_WORK_IN, and end with the test.
#   shards_by_slurm.sh COMMAND FOLDER_TO_WORK_IN
set -euo pipefail
export PATH=$PATH:/usr/sbin
command=$1
skip() { echo "skipped: $1"; exit 77; }
for tool in munged slurmctld slurmd sbatch; do
  command -v "$tool" >/dev/null || skip "there is no $tool here"
done
rm -rf "$2" && mkdir -p "$2/state" "$2/spool" && cd "$2"
(( $(pwd | wc -c) < 80 )) || skip "the path of a socket has at most 107 bytes, and $(pwd) is too long"
trap 'kill $(jobs -p) 2>/dev/null || true; wait' EXIT

head -c 1024 /dev/urandom >munge.key && chmod 400 munge.key
munged --force --foreground --key-file="$PWD/munge.key" --socket="$PWD/munge.socket" --pid-file="$PWD/munged.pid" \
  --seed-file="$PWD/munged.seed" >munged.log 2>&1 &
port=$((20000 + RANDOM % 20000))
cat >slurm.conf <<END
ClusterName=one
SlurmctldHost=localhost
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$PWD/munge.socket
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$PWD/state
SlurmdSpoolDir=$PWD/spool
SlurmctldPidFile=$PWD/slurmctld.pid
SlurmdPidFile=$PWD/slurmd.pid
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=localhost NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$PWD/slurm.conf
for ((tenths = 0; tenths < 50; ++tenths)); do
  [[ -S munge.socket ]] && break
  sleep 0.1
done
slurmctld -D -c >slurmctld.log 2>&1 &
slurmd -D -N localhost -c >slurmd.log 2>&1 &
is_idle() { timeout 2 sinfo --noheader --format=%T 2>/dev/null | grep -q idle; }
for ((tries = 0; tries < 15; ++tries)); do
  is_idle && break
  sleep 1
done
is_idle || skip "no node of Slurm became idle in time: $(tail -q -n 1 munged.log slurmctld.log slurmd.log | tr '\n' ' ')"

sweep=(sweep paper --vary speed=1:1e4:log40 --vary phase=0:0.9:lin5 --contender mask,discrete,octagon_sweep --quiet)
"$command" "${sweep[@]}" --rows whole.jsonl
cat >shard.sh <<END
#!/bin/sh
exec "$command" ${sweep[*]} --shard \$SLURM_ARRAY_TASK_ID/4 --jobs 1 --rows part\$SLURM_ARRAY_TASK_ID.jsonl
END
timeout 300 sbatch --wait --array=1-4 --output=job-%a.log shard.sh
"$command" merge part*.jsonl --rows all.jsonl
cmp <(tail -n +2 whole.jsonl) <(tail -n +2 all.jsonl)
[[ $(wc -l <all.jsonl) == 601 ]]
