#!/bin/sh
# Prints a table of accuracy or speed as Markdown, as tables/README.md and tests/README.md show it.
#
#     sh tables/make_accuracy.sh pairs      [NAME...]   the certificates of the pairs; a minute
#     sh tables/make_accuracy.sh baked      [NAME...]   those of baked tables, and verdicts; two minutes
#     sh tables/make_accuracy.sh samplers   [NAME...]   verdicts of the reference samplers; half a minute
#     sh tables/make_accuracy.sh thorough   [NAME...]   1e9 normals of each pair; four hours
#     sh tables/make_accuracy.sh speed      [FILE]      what vndf bench measures, or measured into FILE
#
# With names, only those rows. It needs vndf on the PATH, and writes nothing but a scratch folder.
set -euf

families="ggx beckmann student-t:gamma=1.55 student-t:gamma=1.6 student-t:gamma=2 student-t:gamma=4
  student-t:gamma=20 exponential-power:p=0.5 exponential-power:p=1 exponential-power:p=2
  exponential-power:p=4 exponential-power:p=8 exponential-power:p=16 disk pearson-ii:m=1
  annulus:inner=0.5 k:nu=1 k:nu=3 hyper-cauchy:q=1.75 blinn-phong:n=50 volcano
  mixture:0.7*ggx+0.3*beckmann@0.333 mixture:0.5*ggx+0.5*beckmann@0.01"
# Three families keep no tolerance in bytes that a cache would hold; the page says what they reach.
bakeable="ggx beckmann student-t:gamma=1.6 student-t:gamma=2.5 student-t:gamma=4 student-t:gamma=20
  exponential-power:p=0.5 exponential-power:p=1 exponential-power:p=4 exponential-power:p=8
  exponential-power:p=16 disk pearson-ii:m=1 k:nu=1 k:nu=3 hyper-cauchy:q=1.75 blinn-phong:n=50
  volcano mixture:0.7*ggx+0.3*beckmann@0.333 mixture:0.5*ggx+0.5*beckmann@0.1"
samplers="beckmann-analytic beckmann-exact ggx-analytic ggx-exact ggx-hemisphere ggx-caps
  beckmann-ndf ggx-ndf beckmann-walter ggx-walter gtr-2-ndf blinn-phong-ndf gtr-1.5-ndf
  beckmann-v-cavity ggx-v-cavity"

usage() {
  sed -n '/^#     sh/s/^#     //p' "$0" >&2
  exit 2
}

# Functions of awk that all tables share.
functions='
  function value(line) { sub(/^[^:]*: /, "", line); sub(/,$/, "", line); gsub(/"/, "", line)
                         return line ~ /^[-+.0-9e]+$/ ? line + 0 : line }
  function distance(ratio) { return ratio >= 1 ? ratio - 1 : 1 / ratio - 1 }
  function short(x, text) { text = sprintf("%.1e", x); sub(/e-0/, "e-", text); return text }
  function bold(text, wrong) { return wrong ? "**" text "**" : text }'

# The report of vndf build --json becomes one row.
pair_row() {
  awk -v name="$1" "$functions"'
    /"marginal_max_u_error"/ { marginal = value($0) }
    /"conditional_max_u_error"/ { conditional = value($0) }
    /tail_ratio_1e-6/ { if (distance(value($0)) >= distance(sixth)) sixth = value($0) }
    /tail_ratio_1e-5/ { if (distance(value($0)) >= distance(fifth)) fifth = value($0) }
    /"seconds"/ { seconds = value($0) }
    BEGIN { sixth = fifth = 1 }
    END {
      printf "| `%s` | %s | %s | %s | %.3f | %.1f |\n", name, bold(short(marginal), marginal > 5e-6),
        bold(short(conditional), conditional > 5e-6),
        bold(sprintf("%.3f", sixth), (sixth < 0.95 || sixth > 1.05)), fifth, seconds
    }' "$2"
}

# The first two lines of a table: the names of its columns, and the line below them.
print_head() {
  echo "$1"
  echo "$1" | sed 's/[^|]\{1,\}/---/g'
}

make_pairs() {
  print_head "| distribution | u-error, marginal | u-error, conditional | tail ratio at 1e-6 | at 1e-5 | seconds |"
  for name in $1; do
    vndf build "$name" -o "$scratch/t.h5" --json >"$scratch/t.json" 2>/dev/null
    pair_row "$name" "$scratch/t.json"
  done
}

baked_row() {
  awk -v name="$1" -v verdict="$3" "$functions"'
    /"tolerance"/ { tolerance = value($0) }
    /"sampling_bytes"/ { bytes = value($0) }
    /"marginal_max_u_error"/ { x = value($0) }
    /"conditional_max_u_error"/ { y = value($0) }
    /tail_ratio_1e-6/ { if (distance(value($0)) >= distance(tail)) tail = value($0) }
    BEGIN { tail = 1 }
    END {
      printf "| `%s` | %s | %.0f KiB | %s | %s | %.3f | %s |\n", name, short(tolerance), bytes / 1024,
        short(x), short(y), tail, verdict
    }' "$2"
}

make_baked() {
  print_head "| distribution | tolerance | reads | u-error, slope x | u-error, slope y | tail ratio at 1e-6 | verdict |"
  for name in $1; do
    bytes=262144
    case $name in *@0.1) bytes=1048576 ;; esac
    vndf build "$name" --tolerance 1e-5 --max-bytes $bytes -o "$scratch/t.vndf" --json >"$scratch/t.json"
    verdict=pass
    vndf validate "$scratch/t.vndf" --quick --seed 20261122 >"$scratch/verdict" || verdict="**fail**"
    baked_row "$name" "$scratch/t.json" "$verdict"
  done
}

# The verdict of vndf validate --json becomes one row. The last column before the verdict is the furnace,
# or for the thorough table the least p-value.
verdict_row() {
  awk -v name="$1" -v thorough="$3" "$functions"'
    /"statistic"/ { statistic = value($0) }
    /"kind"/ { kind = value($0) }
    /"measured"/ { measured = value($0) }
    /"passed"/ {
      failed = value($0) == "false"
      if (statistic == "" && failed) verdict = "**fail**"
      if (statistic ~ /^u-error/) keep("u")
      if (statistic ~ /distance of cdfs/) keep("distance")
      if (statistic ~ /tail mass.*slope x/) keep("x")
      if (statistic ~ /tail mass.*slope y/) keep("y")
      if (statistic ~ /integral of pdf/) keep("integral")
      if (statistic ~ /weak white furnace/) keep("furnace")
      if (kind == "p-value" && (least == "" || measured < least)) least = measured
    }
    function keep(column) {
      if (!(column in most) || measured + 0 > most[column]) most[column] = measured + 0
      if (failed) wrong[column] = 1
    }
    function cell(column, text) {
      if (!(column in most)) return ""
      text = most[column] >= 1 ? sprintf("%.0f", most[column]) : most[column] == 0 ? "0" : short(most[column])
      return bold(text, column in wrong)
    }
    BEGIN { verdict = "pass" }
    END {
      printf "| `%s` | %s | %s | %s | %s | %s | %s | %s |\n", name, cell("u"), cell("distance"),
        cell("x"), cell("y"), cell("integral"), thorough ? short(least) : cell("furnace"), verdict
    }' "$2"
}

make_samplers() {
  print_head "| sampler | u-error | distance | tail x | tail y | integral | furnace | verdict |"
  for name in $1; do
    vndf validate "$name" --quick --seed 20261122 --json "$scratch/v.json" >/dev/null || true
    verdict_row "$name" "$scratch/v.json" ""
  done
}

make_thorough() {
  print_head "| table | u-error | distance | tail x | tail y | integral | least p | verdict |"
  for name in $1; do
    vndf build "$name" -o "$scratch/t.h5" --quiet 2>/dev/null
    vndf validate "$scratch/t.h5" --thorough --seed 20261122 --json "$scratch/v.json" >/dev/null || true
    verdict_row "$name" "$scratch/v.json" 1
  done
}

# The first of two ratios, of medians; the columns and rows that the page has room for.
make_speed() {
  file=${1:-$scratch/speed}
  [ -n "${1:-}" ] || vndf bench --plot "$scratch/speed.svg" >"$file"
  print_head "| sampler | bytes | setup, ms | coherent | random | chain | polluted | u-error | tail ratio |"
  awk -F ' *[|] *' "$functions"'
    function ratio(text) { sub(/ .*/, "", text); return text }
    function error(text) { sub(/e-0/, "e-", text); return text }
    !/^[|]/ || $2 == "sampler" || $2 ~ /^-/ { next }
    $2 ~ /(literal|linear) (16|64|256)|all normals|V-cavities|double$|0[.]0001, / { next }
    {
      printf "| %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", $2, $3, $5, ratio($7), ratio($9),
        ratio($11), ratio($13), error($14), $16
    }' "$file"
}

table=${1:-}
[ $# -eq 0 ] || shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
case $table in
  pairs) make_pairs "${*:-$families}" ;;
  baked) make_baked "${*:-$bakeable}" ;;
  samplers) make_samplers "${*:-$samplers}" ;;
  thorough) make_thorough "${*:-$families}" ;;
  speed) make_speed "${1:-}" ;;
  *) usage ;;
esac
