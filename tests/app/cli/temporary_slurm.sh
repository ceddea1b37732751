#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# temporary_slurm.sh FOLDER COMMAND...: runs COMMAND beside a Slurm of one node of its own, in namespaces of its own: ports
# never collide, nothing listens outside, and every process of it ends with COMMAND. Needs root, or unprivileged user
# namespaces. Exit status 77: Slurm is not installed, or no namespaces may be made here. COMMAND that fails: what Slurm
# holds and the ends of its logs are printed. COMMAND finds in $SLURM_TOOLS functions of a shell:
#   kill_controller   -9, and starts it again
#   administer        what an administrator does after that: tasks that were requeued need not wait for two minutes, and
#                     a node that Slurm drained (it started a task a second time: "Duplicate jobid") works again
set -u
PATH=$PATH:/usr/sbin
if [ "${1:-}" != --inside ]; then
  for program in slurmctld slurmd munged sbatch unshare ip; do command -v $program >/dev/null || { echo "no $program"; exit 77; }; done
  as=()
  [ "$(id -u)" = 0 ] || as=(--map-root-user)
  unshare "${as[@]}" --net --pid --ipc --uts --mount --fork --mount-proc true 2>/dev/null || { echo "no namespaces"; exit 77; }
  exec unshare "${as[@]}" --net --pid --ipc --uts --mount --fork --kill-child --mount-proc "$0" --inside "$@"
fi
shift
D=$1; shift
# Without a second address on lo, name resolution finds no IPv4 and the daemons do not come up.
ip link set lo up && ip addr add 10.255.255.1/32 dev lo && hostname plantnode || exit 77
mkdir -p "$D/state" "$D/spool" "$D/munge" && chmod 700 "$D/state" && chmod 711 "$D" && chmod 755 "$D/munge" "$D/spool"
echo "127.0.0.1 localhost plantnode" >"$D/hosts" && mount --bind "$D/hosts" /etc/hosts || exit 77
cat >"$D/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=plantnode(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=17817
SlurmdPort=17818
StateSaveLocation=$D/state
SlurmdSpoolDir=$D/spool
SlurmctldPidFile=$D/slurmctld.pid
SlurmdPidFile=$D/slurmd.pid
SlurmctldLogFile=$D/slurmctld.log
SlurmdLogFile=$D/slurmd.log
AuthType=auth/munge
AuthInfo=socket=$D/munge/s
CredType=cred/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_min_interval=20000
MinJobAge=300
KillWait=2
ReturnToService=2
RequeueExit=75
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
MailProg=/bin/true
SlurmdParameters=config_overrides
NodeName=plantnode NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=batch Nodes=ALL Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
export SLURM_CONF=$D/slurm.conf
(umask 077 && head -c 128 /dev/urandom >"$D/munge/key")
munged --force --socket="$D/munge/s" --key-file="$D/munge/key" --pid-file="$D/munge/munged.pid" --log-file="$D/munge/log" \
  --seed-file="$D/munge/seed" 2>/dev/null && slurmctld && slurmd || exit 1
for _ in $(seq 300); do [ "$(timeout 5 sinfo -h -o %T 2>/dev/null)" = idle ] && break; sleep 0.05; done
[ "$(timeout 5 sinfo -h -o %T 2>/dev/null)" = idle ] || { tail -n 5 "$D"/slurm*.log; exit 1; }
cat >"$D/tools" <<'TOOLS'
kill_controller() {
  kill -9 "$(cat "$(dirname "$SLURM_CONF")/slurmctld.pid")"; sleep 0.3; slurmctld
}
administer() {
  local job
  for job in $(timeout 10 squeue -h -t PD -o '%i %r' | awk '$2=="BeginTime"{print $1}'); do
    timeout 10 scontrol update jobid="$job" starttime=now
  done
  case $(timeout 10 sinfo -h -o %T) in drain*|down*) timeout 10 scontrol update nodename=plantnode state=resume ;; esac
  return 0
}
TOOLS
export SLURM_TOOLS=$D/tools
"$@"
status=$?
[ $status = 0 ] || { timeout 10 squeue -r; timeout 10 sinfo -R; tail -n 60 "$D/slurmctld.log"; tail -n 30 "$D/slurmd.log"; }
timeout 10 scancel --me 2>/dev/null
exit $status
