#!/bin/sh
# The commands that pages, headers, shaders and hardware name in backquotes exist, with their flags;
# tables and claims of lobes without a placeholder in capitals run.
# usage: named_commands.sh BURNISH SOURCE SCRATCH
source=$(realpath "$2")
set -- "$1" "$3"
. "$(dirname "$0")/lib.sh"

grep -rhoI '`burnish [^`]*`' "$source/README.md" "$source/docs" "$source/include" "$source/shaders" "$source/rtl" \
    "$source/arduino" "$source/npm/README.md" | tr -d '`' | sort -u >commands.txt
while read -r line; do
    command=${line#burnish }
    case $command in
    help*) continue ;;
    lobe\ [a-z]*) words=$(printf '%s\n' "$command" | cut -d ' ' -f 1-2) ;;
    *) words=${command%% *} ;;
    esac
    # shellcheck disable=SC2086
    "$burnish" $words --help >help.txt 2>&1
    check "$line: no such command" [ $? = 0 ]
    for word in $command; do
        case $word in
        --help*) ;;
        --*)
            # shellcheck disable=SC2086
            "$burnish" $words --help=all >help.txt 2>&1
            check "$line: no such flag: $word" grep -q -e "${word%%=*}\([^a-z-]\|$\)" help.txt
            ;;
        esac
    done
    case $line in
    *[A-Z]*) ;;
    "burnish lobe table "* | "burnish lobe claims "*)
        # shellcheck disable=SC2086
        "$burnish" $command >output.txt 2>&1
        check "$line: fails: $(head -n 1 output.txt)" [ $? = 0 ]
        ;;
    esac
done <commands.txt
check "hardly any commands" [ "$(wc -l <commands.txt)" -ge 30 ]

finish
