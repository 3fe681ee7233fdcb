#!/bin/sh
# The manual pages in FOLDER, which make_manual.sh made of PROGRAM: there is one for each command, each
# has the sections that people look for, refers to pages that exist, and is set without a warning. Made
# again, they have the same bytes, whenever that is.
set -eu
make_manual=$1
program=$2
folder=$3
fail() {
  echo "$*" >&2
  exit 1
}

again=$(mktemp -d)
trap 'rm -r "$again"' EXIT
SOURCE_DATE_EPOCH=0 sh "$make_manual" "$program" "$again/man1"
diff -r "$folder" "$again/man1" || fail "the pages are not the same when they are made again"

for command in $("$program" --help | sed -n '/^Subcommands:/,$s/^  \([a-z]\+\) .*/\1/p'); do
  [ -f "$folder/vndf-$command.1.gz" ] || fail "there is no page of vndf $command"
done
for page in "$folder"/*; do
  text=$(gzip -dc "$page")
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS '"EXIT STATUS"' '"SEE ALSO"'; do
    echo "$text" | grep -qx "\.SH $section" || fail "$page has no section $section"
  done
  echo "$text" | grep -q '^vndf[a-z\-]* \\- [a-z]' || fail "$page has no sentence beside its name"
  for other in $(echo "$text" | sed -n 's/^\.BR \([^ ]*\) (1).*/\1/p' | tr -d '\\'); do
    [ -f "$folder/$other.1.gz" ] || fail "$page refers to $other, of which there is no page"
  done
  if command -v man >/dev/null; then
    warnings=$(LC_ALL=C man --warnings -l "$page" 2>&1 >/dev/null)
    [ -z "$warnings" ] || fail "$page: $warnings"
  fi
done
