#!/bin/sh
# The completions know the commands, flags and values of the tables. bash is asked; zsh and fish check
# the syntax where they are installed.
# usage: cli_complete.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

for shell in bash zsh fish; do
    gives 0 help --completion=$shell
    cp "$out" burnish.$shell
done

# words LINE...: bash's completions of the last word, after bash has split the line at =.
cat >ask.bash <<'END'
source ./burnish.bash
compopt() { :; }
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
_burnish
printf '%s\n' "${COMPREPLY[@]}"
END
offers() {
    wanted=$1
    shift
    offered=$(bash ask.bash "$@" | tr '\n' ' ' | sed 's/ $//')
    check "bash offers '$offered' for $*, not '$wanted'" [ "$offered" = "$wanted" ]
}
if has "completion of bash" bash; then
    check "bash: syntax" bash -n burnish.bash
    touch part.stl
    offers "render" burnish ren
    offers "render view batch serve-stdio compare info lobe help --help --version" burnish ""
    offers "table" burnish lobe ta
    offers "--camera-position=" burnish render x --camera-pos
    offers "--json" burnish render x --js
    offers "part.stl" burnish info --json = pa
    offers "1 4 8 16" burnish render x --samples ""
    offers "1 16" burnish render x --samples = 1
    offers "matte satin plastic polished metal" burnish render x --material =
    offers "camera" burnish render --help = cam
    offers "--help" burnish render --hel
    offers "" burnish lobe table --help = x
    offers "part.stl" burnish render part
    offers "part.stl" burnish render x -o part
    offers "--exponents=" burnish lobe table --exp
    offers "markdown" burnish lobe table --format ma
fi
if has "syntax of zsh" zsh; then
    check "zsh: $(zsh -n burnish.zsh 2>&1)" zsh -n burnish.zsh
    check "zsh: no topics" grep -q -- "--help=-.*picture files camera light report all" burnish.zsh
fi
if has "completion of fish" fish; then
    check "fish: $(fish --no-execute burnish.fish 2>&1)" fish --no-execute burnish.fish
    check "fish offers no render" sh -c "fish --no-config -c 'source burnish.fish; complete -C \"burnish ren\"' 2>&1 | grep -q render"
    check "fish offers no --camera-position" sh -c "fish --no-config -c 'source burnish.fish; complete -C \"burnish render x --camera-pos\"' 2>&1 | grep -q camera-position"
    check "fish offers no --help=camera" sh -c "fish --no-config -c 'source burnish.fish; complete -C \"burnish render x --help=cam\"' 2>&1 | grep -q camera"
fi
# Every flag of the help screen is in each.
"$burnish" render --help=all | grep -o -- '--[a-z-]*[= ]' | tr -d '= ' | sort -u | while read -r flag; do
    for shell in bash zsh; do
        grep -q -- "$flag" burnish.$shell || echo "$shell: $flag"
    done
    grep -q -- "-l ${flag#--} " burnish.fish || echo "fish: $flag"
done >lacking.txt
check "flags lacking: $(tr '\n' ' ' <lacking.txt)" [ ! -s lacking.txt ]

finish
