#!/bin/sh
# Whether the jobs between its two calls left the sources as they were. Usage: sources.sh before|after SOURCE_DIR FILE
set -eu
git -C "$2" rev-parse HEAD >/dev/null 2>&1 || { echo "no git, or no repository"; exit 77; }
git -C "$2" status --porcelain >"$3.$1"
git -C "$2" diff >>"$3.$1"
[ "$1" = before ] || diff "$3.before" "$3.after"
