#!/bin/sh
# The completions know the commands, flags and values of the tables. bash is asked; zsh and fish check
# the syntax where they are installed.
# Lines are typed into real shells, on a pseudo-terminal, where there is one.
# usage: cli_complete.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

for shell in bash zsh fish; do
    gives 0 help --completion=$shell
    cp "$out" burnish.$shell
    gives 0 lobe help --completion=$shell
    cp "$out" burnish-lobe.$shell
done
PATH=$(dirname "$burnish"):$PATH # burnish-lobe, which completes `burnish lobe`

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
    touch renders.stl
    offers "render renders.stl" burnish ren
    offers "--version" burnish --ver
    offers "--look=" burnish part.stl --loo
    offers "studio" burnish part.stl --look = st
    offers "front,top front,third-angle" burnish part.stl --views = front,t
    offers "table" burnish lobe ta
    offers "--camera-position=" burnish render x --camera-pos
    offers "--json" burnish render x --js
    offers "1 4 8 16" burnish render x --samples ""
    offers "1 16" burnish render x --samples = 1
    offers "matte satin plastic polished metal glass" burnish render x --material =
    offers "camera" burnish render --help = cam
    offers "--help" burnish render --hel
    offers "" burnish lobe table --help = x
    offers "" burnish render part # readline completes names of files
    offers "--exponents=" burnish lobe table --exp
    offers "markdown" burnish lobe table --format ma
    offers "markdown" burnish lobe table --format = ma
fi

# typed SHELL: types lines into a shell. Prints the words that each line passes to burnish, or the reason why it can't.
cat >typed.py <<'END'
import os, pty, select, sys
SETUP = {
    "bash": (["bash", "--norc", "--noprofile", "-i"], "bind 'set bell-style none'; bind 'set enable-bracketed-paste off'; source ./burnish.bash"),
    "zsh": (["zsh", "-f", "-i"], "unset zle_bracketed_paste; setopt no_beep; fpath=($PWD $fpath); autoload -Uz compinit; compinit -u -D"),
}
command, setup = SETUP[sys.argv[1]]
try:
    process, terminal = pty.fork()
except OSError as error:
    sys.exit(f"no pseudo-terminal: {error}")
if process == 0:
    os.environ.update(LC_ALL="C.UTF-8", TERM="dumb", PS1="", HISTFILE="")
    os.execvp(command[0], command)

received = b""

def until(mark):
    global received
    while mark not in received:
        if not select.select([terminal], [], [], 60)[0]:
            sys.exit(f"no answer: {received!r}")
        received += os.read(terminal, 65536)
    text, _, received = received.partition(mark)
    return text.decode()

# The mark is split in what is typed, so only output contains it.
os.write(terminal, (f"PS1='re''ady>'; stty -echo; {setup}; burnish() {{ printf 're''ply'; printf '<%s>' \"$@\"; printf 'en''d\\n'; }}\n").encode())
for line in sys.stdin.read().splitlines():
    until(b"ready>")
    os.write(terminal, line.replace("^", "\t").encode() + b"\n")
    print(until(b"end\r\n").rpartition("reply")[2])
os.close(terminal)
END
mkdir -p typed && cp burnish.bash typed && cp burnish.zsh typed/_burnish && cp burnish-lobe.zsh typed/_burnish-lobe
touch typed/part.stl "typed/my part (v2).stl" 'typed/Größe – 部品.stl' "typed/it's.stl"
cat >typed.table <<'END'
burnish pa^                           <part.stl>
burnish my^                           <my part (v2).stl>
burnish render my\ p^                 <render><my part (v2).stl>
burnish info Gr^                      <info><Größe – 部品.stl>
burnish it^                           <it's.stl>
burnish -o my^                        <-o><my part (v2).stl>
burnish part.stl --output=my^         <part.stl><--output=my part (v2).stl>
burnish ba^                           <batch>
burnish part.stl --loo^st^            <part.stl><--look=studio>
burnish part.stl --views=fro^,to^     <part.stl><--views=front,top>
burnish --wid^20                      <--width=20>
burnish help rend^                    <help><render>
burnish help pa^                      <help><pa>
burnish lobe tab^                     <lobe><table>
burnish lobe table --exp^10           <lobe><table><--exponents=10>
END
for shell in bash zsh; do
    command -v $shell >/dev/null || continue
    sed 's/  *<.*//' typed.table >typed.lines
    sed 's/^[^<]*</</' typed.table >typed.wanted
    if (cd typed && python3 ../typed.py $shell) <typed.lines >typed.found 2>typed.error; then
        check "$shell: $(diff typed.wanted typed.found)" cmp typed.wanted typed.found
    elif grep -q '^no pseudo-terminal' typed.error; then
        skip "typing into $shell, $(cat typed.error)"
    else
        fail "$shell: $(cat typed.error)"
    fi
done
if has "syntax of zsh" zsh; then
    check "zsh: $(zsh -n burnish.zsh 2>&1)" zsh -n burnish.zsh
    check "zsh: no topics" grep -q -- "--help=-.*picture files camera light input report all" burnish.zsh
fi
if has "completion of fish" fish; then
    check "fish: $(fish --no-execute burnish.fish 2>&1)" fish --no-execute burnish.fish
    check "fish offers no render" sh -c "fish --no-config -c 'source burnish.fish; complete -C \"burnish ren\"' 2>&1 | grep -q render"
    check "fish offers no --camera-position" sh -c "fish --no-config -c 'source burnish.fish; complete -C \"burnish render x --camera-pos\"' 2>&1 | grep -q camera-position"
    fish_offers() { # LINE WANTED
        found=$(cd typed && fish --no-config -c "source ../burnish.fish; source ../burnish-lobe.fish; complete -C '$1'" 2>&1 | cut -f1 | tr '\n' ' ')
        check "fish offers '$found' for $1" [ "$found" = "$2 " ]
    }
    fish_offers "burnish pa" part.stl
    fish_offers "burnish my" "my part (v2).stl"
    fish_offers "burnish part.stl --loo" --look
    fish_offers "burnish part.stl --look=st" --look=studio
    fish_offers "burnish part.stl --views=front,to" --views=front,top
    fish_offers "burnish help rend" render
    fish_offers "burnish ba" batch
    fish_offers "burnish lobe tab" table
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
