#!/bin/bash
# What Snakemake 7.21.0 asks a cluster for when it groups six runs of a study, three to a job.
#
# A run asks for 2 threads, 1,000 MB and 10 minutes. Runs do not depend on each other. A command that only writes down what it was asked for
# stands in for sbatch.
#
# Guessed: grouped runs follow each other, so that a job asks for 2 threads, 1,000 MB and 30 minutes.
# Seen: a job asks for 6 threads, 3,000 MB and 10 minutes: a group of runs that could go at once is taken to go at once, however many it has.
# With --cores 2 it is 2 threads, 1,000 MB and 30 minutes, as guessed, for the group's runs then have to follow each other.
# Why it matters: studies of many short runs are grouped to spare the queue. Groups of 100 would ask for 200 threads and for the time of one run,
# and where a site or a profile caps the threads, the time is too short. Give --cores with --group-components.
#
# usage: findings/snakemake_groups_grow_wide.sh
# It needs Debian's snakemake 7.21.0-1, installs nothing, and ends with 1 where Snakemake does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
cat > Snakefile <<'RULES'
rule all:
    input: expand("out/{run}", run=range(6))
rule run:
    output: "out/{run}"
    group: "runs"
    threads: 2
    resources: runtime=10, mem_mb=1000
    shell: "touch {output}"
RULES
cat > submit <<'SUBMIT'
#!/bin/bash
echo "$1" >> asked
sh "${@: -1}" > job.log 2>&1 &
echo $!
SUBMIT
chmod +x submit
asked() {
  rm -rf out asked .snakemake
  snakemake --quiet --jobs 2 --cluster "./submit '{threads} threads, {resources.mem_mb} MB, {resources.runtime} min'" "$@" > log 2>&1
  sort asked | uniq -c | sed 's/^ *//; s/^\([0-9]*\) /\1 jobs of /'
}
wrong=0
see() {
  local expected=$1 seen
  shift
  seen=$(asked "$@")
  echo "$*: $seen"
  [ "$seen" = "$expected" ] || { echo "   expected $expected"; wrong=1; }
}
echo "Snakemake $(snakemake --version)"
[ "$(snakemake --version)" = 7.21.0 ] || wrong=1
see "2 jobs of 6 threads, 3000 MB, 10 min" --group-components runs=3
see "2 jobs of 2 threads, 1000 MB, 30 min" --group-components runs=3 --cores 2
exit $wrong
