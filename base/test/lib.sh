# Helpers for the command line tests, which source this file. Each test takes the program as $1 and a scratch folder as
# $2, which is emptied.
set -u
burnish=$(realpath "$1")
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
scratch=$(realpath "$scratch")
cd "$scratch" || exit 1
checks=0
failures=0

fail() {
    failures=$((failures + 1))
    printf '%s: %s\n' "$0" "$*"
}

# check TEXT COMMAND...: the command must succeed.
check() {
    checks=$((checks + 1))
    text=$1
    shift
    "$@" >/dev/null 2>&1 || fail "$text"
}

# same TEXT ACTUAL WANTED, differs TEXT ONE OTHER
same() { check "$1: $2 is not $3" [ "$2" = "$3" ]; }
differs() { check "$1: both are $2" [ "$2" != "$3" ]; }

# run ARGUMENTS...: standard output goes to $out, standard error to $err, the exit code to $code. The files are outside the
# working folder, which holds only what burnish wrote.
out=$scratch.out
err=$scratch.err
run() {
    "$burnish" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}

# gives CODE ARGUMENTS...: run, which must end with that exit code, and an error with one line.
gives() {
    wanted_code=$1
    shift
    run "$@"
    checks=$((checks + 1))
    [ "$code" = "$wanted_code" ] || fail "burnish $*: exit code $code, not $wanted_code: $(cat "$err")"
    case $wanted_code in
    [2-7]) [ "$(wc -l <"$err")" = 1 ] || fail "burnish $*: expected one line on standard error, found: $(cat "$err")" ;;
    esac
}

# skip PART, REASON: says that a part of the test is not run; scripts/ctest lists these lines at the end.
skip() { printf '%s: SKIPPED: %s\n' "$(basename "$0" .sh)" "$*"; }

# has PART TOOL...: whether the tools of a part are installed; says so if not.
has() {
    part=$1
    shift
    for tool in "$@"; do
        command -v "$tool" >/dev/null || { skip "$part, no $tool" && return 1; }
    done
}

# png_size FILE: width and height in the header of a PNG file.
png_size() { python3 -c 'import struct, sys; s, *size = struct.unpack(">12s4xII", open(sys.argv[1], "rb").read(24)); print(*size if s[:8] == b"\x89PNG\r\n\x1a\n" else "")' "$1"; }

# await COMMAND...: returns when the command succeeds. After a minute it fails: the bound only ends a test that would
# otherwise hang, and no result depends on how long the wait takes.
await() {
    awaited=0
    until "$@" >/dev/null 2>&1; do
        [ $((awaited += 1)) -le 1200 ] || return 1
        sleep 0.05
    done
}

# computes PID: the process has used a tenth of a second of processor time, so it is past its start.
computes() {
    [ "$(awk '{ print $14 + $15 }' "/proc/$1/stat")" -ge 10 ]
}

# children PID: the processes that it has started.
children() { grep -ls "^PPid:[[:space:]]*$1\$" /proc/[0-9]*/status | cut -d/ -f3; }

# ended PID: the process has exited, even if no process has waited for it yet.
ended() {
    [ -z "$(cut -d' ' -f3 "/proc/$1/stat" 2>/dev/null | grep -v Z)" ]
}

# expect CODE LINE ARGUMENTS...: run, which must end with that exit code, print exactly that line to standard error ("" for
# nothing), and nothing to standard output.
expect() {
    wanted_code=$1
    wanted_line=$2
    shift 2
    run "$@"
    checks=$((checks + 1))
    [ "$code" = "$wanted_code" ] || fail "burnish $*: exit code $code, not $wanted_code"
    if [ -n "$wanted_line" ]; then
        printf '%s\n' "$wanted_line" | cmp -s - "$err" ||
            fail "burnish $*: prints '$(cat "$err")', not '$wanted_line'"
    else
        [ ! -s "$err" ] || fail "burnish $*: prints '$(cat "$err")' to standard error, not nothing"
    fi
    [ ! -s "$out" ] || fail "burnish $*: prints to standard output"
}

# nothing_left TEXT: the working folder is empty.
nothing_left() {
    checks=$((checks + 1))
    [ -z "$(ls -A)" ] || fail "$1: left behind: $(ls -A)"
}

# json KEY: the values of that key in the last output, without the cells of a sheet and parts; arrays as a,b,c.
json() {
    tr -d '\n\t ' <"$out" | sed 's/"cells":\[.*\],"equation"/"equation"/;s/"parts":\[.*\],"plates"/"plates"/' |
        grep -oE "\"$1\":(\"[^\"]*\"|\[[^]]*\]|[^,}]*)" | sed "s/^\"$1\"://" | tr -d '"[]'
}

# valid_json: the last output is JSON in UTF-8 (RFC 8259, so without NaN and Infinity).
valid_json() { python3 -c 'import json, sys; json.loads(open(sys.argv[1], "rb").read().decode(), parse_constant=sys.exit)' "$out"; }

finish() {
    rm -f "$out" "$err"
    printf '%s: %d checks, %d failed\n' "$(basename "$0" .sh)" "$checks" "$failures"
    [ "$checks" -gt 0 ] && [ "$failures" -eq 0 ]
}
