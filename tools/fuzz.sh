#!/bin/sh
# Fuzzes every reader of input from outside for SECONDS each, as many at once as there are cores,
# and prints how many inputs were tried and how many branches were reached. What a fuzzer learns
# stays in build-sanitize/fuzz for the next run. An input that crashes a reader, takes more than 5 s
# or more than 500 MB is a file there whose name begins with the kind, such as crash-, and the exit
# status is 1.
set -eu
seconds=${1:-}
case "$seconds" in
'' | *[!0-9]*)
  echo "usage: tools/fuzz.sh SECONDS" >&2
  exit 2
  ;;
esac
cd "$(dirname "$0")/.."
sources=$PWD/tests/fuzz

sh tools/install_packages.sh clang libclang-rt-dev
cmake --preset sanitize >/dev/null
cmake --build --preset sanitize --target fuzzers
found=build-sanitize/fuzz
mkdir -p "$found"
cd "$found"

# fuzz_one TARGET SECONDS fuzzes one reader.
cat >fuzz_one.sh <<'END'
set -u
name=$1; seconds=$2; sources=$3
mkdir -p "$name"
options="-max_total_time=$seconds -timeout=5 -rss_limit_mb=500 -max_len=65536 -print_final_stats=1"
if ../tests/fuzz/"fuzz_$name" $options -artifact_prefix="./$name-" "$name" "$sources/corpus/$name" \
    >"$name.log" 2>&1; then result=ok; else result=FAILED; fi
runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$name.log")
covered=$(sed -n 's/.*cov: \([0-9]*\).*/\1/p' "$name.log" | tail -1)
printf '%-16s %-6s %10s inputs, %6s branches\n' "$name" "$result" "${runs:-?}" "${covered:-?}"
[ "$result" = ok ] || { tail -30 "$name.log"; exit 1; }
END
ls "$sources"/corpus | xargs -P "$(nproc)" -I NAME sh fuzz_one.sh NAME "$seconds" "$sources"
