# Helpers of the command line tests; read by the scripts beside it. Each takes the program as $1 and
# a scratch folder as $2, which is emptied.
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

# run ARGUMENTS...: leaves standard output in ../*.out, standard error in ../*.err, the exit code in
# $code. Outside the working folder, so that the latter holds what burnish wrote and nothing else.
out=$scratch.out
err=$scratch.err
run() {
    "$burnish" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}

# The instruction sets that this build has and this processor runs.
instruction_sets() {
    for isa in scalar sse2 avx2 avx512 neon; do
        "$burnish" render :sphere --size=16 --isa=$isa -o - >/dev/null 2>&1 && echo $isa
    done
}

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

# ended PID: the process has exited; nobody may have waited for it yet.
ended() {
    [ -z "$(cut -d' ' -f3 "/proc/$1/stat" 2>/dev/null | grep -v Z)" ]
}

# expect CODE LINE ARGUMENTS...: that exit code, exactly that one line on standard error ("" for none),
# nothing on standard output.
expect() {
    wanted_code=$1
    wanted_line=$2
    shift 2
    run "$@"
    checks=$((checks + 1))
    [ "$code" = "$wanted_code" ] || fail "burnish $*: exit code $code, not $wanted_code"
    if [ -n "$wanted_line" ]; then
        printf '%s\n' "$wanted_line" | cmp -s - "$err" ||
            fail "burnish $*: says '$(cat "$err")', not '$wanted_line'"
    else
        [ ! -s "$err" ] || fail "burnish $*: says '$(cat "$err")', should be silent"
    fi
    [ ! -s "$out" ] || fail "burnish $*: unasked output on standard output"
}

# nothing_left TEXT: the working folder is empty.
nothing_left() {
    checks=$((checks + 1))
    [ -z "$(ls -A)" ] || fail "$1: left behind: $(ls -A)"
}

# json KEY: the value of that key of the last output, but for the cells of a sheet; arrays as a,b,c.
json() {
    tr -d '\n\t ' <"$out" | sed 's/"cells":\[.*\],"equation"/"equation"/' |
        grep -oE "\"$1\":(\"[^\"]*\"|\[[^]]*\]|[^,}]*)" | sed "s/^\"$1\"://" | tr -d '"[]'
}

# valid_json: the last output is one JSON object (RFC 8259): tokens become S (string) and V (value),
# then objects and arrays of them are values, until one is left.
valid_json() {
    [ "$(tr -d '\n\t ' <"$out" | sed -E '
        s/"([^"\\]|\\["\\\/bfnrt]|\\u[0-9a-fA-F]{4})*"/S/g
        s/-?(0|[1-9][0-9]*)(\.[0-9]+)?([eE][-+]?[0-9]+)?/V/g
        s/true|false|null/V/g
        :again
        s/\[([SV](,[SV])*)?\]/V/g
        s/\{(S:[SV](,S:[SV])*)?\}/V/g
        t again')" = V ]
}

finish() {
    rm -f "$out" "$err"
    printf '%s: %d checks, %d failed\n' "$(basename "$0" .sh)" "$checks" "$failures"
    [ "$checks" -gt 0 ] && [ "$failures" -eq 0 ]
}
