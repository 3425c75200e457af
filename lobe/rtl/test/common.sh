# Shared by the tests of lobe/rtl, which source it with the folder to work in as their first argument.
# Sets here (the script's folder), rtl and work.
here=$(cd "$(dirname "$0")" && pwd)
rtl=$here
while [ ! -e "$rtl/burnish_lobe.v" ]; do rtl=$(dirname "$rtl"); done
mkdir -p "$1"
work=$(cd "$1" && pwd)
test=$(basename "$0")

# fail TEXT
fail() {
    echo "$test: $*" >&2
    exit 1
}

# need TOOL...: exits with 77, which CTest counts as skipped, if a tool is missing.
need() {
    for tool in "$@"; do
        command -v "$tool" >/dev/null 2>&1 || { echo "$test: $tool is missing; run scripts/install-deps rtl" >&2; exit 77; }
    done
}

# mutate FILE CHANGE OUTPUT: FILE after the sed command CHANGE, which must have an effect.
mutate() {
    sed "$2" "$1" >"$3"
    ! cmp -s "$1" "$3" || fail "$(basename "$1") was not changed by $2"
}
