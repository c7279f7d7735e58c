#!/bin/bash
# What became of a job of Slurm, for Snakemake: running, success or failed. status.sh JOB
state=$(scontrol --oneliner show job "$1" 2>/dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
# The controller forgets a job some minutes after it has ended; the accounts, where a cluster has them, do not.
if [ -z "$state" ]; then state=$(sacct --noheader --parsable2 --allocations --format=State --jobs "$1" 2>/dev/null); fi
case $state in
  COMPLETED*) echo success ;;
  PENDING* | CONFIGURING* | RUNNING* | COMPLETING* | SUSPENDED* | REQUEUED*) echo running ;;
  *) echo failed ;;
esac
