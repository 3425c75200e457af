#!/bin/sh
# make, for systems that have none yet: ./make TARGET... installs it first.
set -eu
cd "$(dirname "$0")"
command -v make >/dev/null 2>&1 || ./scripts/install-deps make
exec make "$@"
