#!/bin/bash
# What became of a job of Slurm, for Snakemake: running, success or failed. status.sh JOB
shown=$(scontrol --oneliner show job "$1" 2>&1)
case $shown in
  *" JobState="*) state=${shown#* JobState=} ;;
  # The controller forgets a job some minutes after it has ended; the accounts, where a cluster has them, do not.
  *"Invalid job id"*) state=$(sacct --noheader --parsable2 --allocations --format=State --jobs "$1" 2>/dev/null) ;;
  *) state=UNKNOWN ;; # the controller does not answer: Snakemake asks again
esac
log=.snakemake/slurm-$1.log
case ${state%% *} in
  COMPLETED) echo success ;;
  *FAIL* | CANCELLED | DEADLINE | OUT_OF_MEMORY | PREEMPTED | REVOKED) echo failed ;;
  # A job that ended with 0 just past its time limit is TIMEOUT, too. Unless the log of such a job, or of a forgotten one, lacks its end,
  # Snakemake looks for what it made.
  TIMEOUT | '') if [ -e "$log" ] && ! grep -q ' steps (100%) done' "$log"; then echo failed; else echo success; fi ;;
  *) echo running ;;
esac
