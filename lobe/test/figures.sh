#!/bin/sh
# The figures of lobe/docs are what lobe/docs/figures/draw draws. usage: figures.sh BURNISH-LOBE SCRATCH
figures=$(realpath "$(dirname "$0")/../docs/figures")
. "$(dirname "$0")/../../base/test/lib.sh"
has "figures" gnuplot || exit 77
check "draw" "$figures/draw" "$burnish" .
for file in "$figures"/*.svg; do
    check "$file is not what draw draws; run make figures" cmp "${file##*/}" "$file"
    check "$file is on no page" grep -q "(figures/${file##*/})" "$figures/../theory.md" "$figures/../lobes.md"
    check "${file##*/} is not well-formed" python3 -c 'import sys, xml.dom.minidom as dom; dom.parse(sys.argv[1])' "${file##*/}"
done
finish
