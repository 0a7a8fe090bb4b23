#!/bin/sh
# Runs one fuzz target for some minutes: run.sh NAME MINUTES. What it finds interesting is kept in
# build/fuzz/corpus, and an input that fails in build/fuzz/found; the exit code is then not 0.
set -eu
name=$1 minutes=$2
work=build/fuzz
corpus=tests/fuzz/corpus/$name
regressions=tests/fuzz/regressions/$name
mkdir -p "$work/corpus/$name" "$work/found" "$regressions"

words=""
case $name in xml | scene | dict) words=-dict=tests/fuzz/scene.dict ;; esac
length=4096 # longer inputs are slower, and need not be
[ "$name" = checkpoint ] && length=65536

# Packed scenes are unpacked into files.
[ -d /dev/shm ] && export TMPDIR=/dev/shm

program=$work/fuzz_$name
[ -f "tests/fuzz/fuzz_$name.py" ] && program=".venv/bin/python tests/fuzz/fuzz_$name.py"

log=$work/$name.log
# Memory that was freed is not to be kept long: it would count. Entropic scheduling takes longer than
# what it schedules: without it there are six times as many packed scenes a second.
status=0
ASAN_OPTIONS=quarantine_size_mb=16 $program \
  -entropic=0 -max_total_time=$((minutes * 60)) -timeout=10 -rss_limit_mb=1024 -max_len=$length \
  $words -print_final_stats=1 -artifact_prefix="$work/found/$name-" \
  "$work/corpus/$name" "$corpus" "$regressions" >"$log" 2>&1 || status=$?

runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
if [ "$status" = 0 ]; then
  echo "$name: $runs runs, nothing found"
else
  echo "$name: failed after $runs runs, see $log:"
  grep -E 'ERROR|SUMMARY|runtime error|Test unit written' "$log" || tail -n 5 "$log"
fi
exit "$status"
