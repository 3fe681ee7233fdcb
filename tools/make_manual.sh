#!/bin/sh
# Makes the manual pages of PROGRAM and all its commands in FOLDER, which it replaces, from what
# --help prints, with help2man. What --help does not say is in manual.h2m.
set -eu
program=$1
folder=$2
common=$(dirname "$0")/manual.h2m
version=$("$program" --version)
# Letters that troff would take for its own.
escape='s/\\/\\e/g; s/-/\\-/g'

# page COMMAND... makes vndf-COMMAND.1 and the pages of its commands.
page() {
  name=$(echo "vndf $*" | tr -s ' ' '-' | sed 's/-$//')
  help=$("$program" "$@" --help)
  summary=$(echo "$help" | sed -n "1{s/\.\$//; s/./\\l&/; $escape; p}")
  usage=$(echo "$help" | sed -n "/^Usage: /{s/^Usage: vndf *$* *//; $escape; s/[A-Za-z]\\+/\\\\fI&\\\\fR/g; p}")
  commands=$(echo "$help" | sed -n '/^Subcommands:/,$s/^  \([a-z]\+\) .*/\1/p')
  above=$(echo "$name" | sed -n 's/-[a-z]*$//p')
  others=$(for other in $above $(for command in $commands; do echo "$name-$command"; done); do
    echo ".BR $other (1),"
  done | sed "$escape; \$s/,\$//")
  {
    printf '[NAME]\n%s \\- %s\n' "$(echo "$name" | sed "$escape")" "$summary"
    printf '[SYNOPSIS]\n\\fB%s\\fR %s\n' "vndf${*:+ $*}" "$usage"
    cat "$common"
    echo "$others"
  } >"$folder/$name.h2m"
  help2man --no-info --version-string="$version" --include "$folder/$name.h2m" \
    --output "$folder/$name.1" "'$program' $*"
  # The month in which a page was made says nothing, and would make another page of the same source.
  sed -i 's/^\(\.TH [^ ]* "1" \)"[^"]*"/\1""/' "$folder/$name.1"
  rm "$folder/$name.h2m"
  for command in $commands; do
    (page "$@" "$command")
  done
}

rm -rf "$folder"
mkdir -p "$folder"
page
gzip -9 --no-name "$folder"/*.1
