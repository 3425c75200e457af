#!/bin/sh
# The library's binary interface (x86-64, and every other with 64-bit pointers): each function's declaration, the layout of each
# struct, the value of each enumerator, against test/golden/abi.txt. A change is deliberate: rewrite the list with `make abi` and
# say it in CHANGELOG.md; after 1.0 it also takes another SOVERSION unless it only adds.
# Usage: abi.sh SOURCE_DIR SCRATCH [--update [FILE]]
set -eu
source=$1
scratch=$2
list=${4:-$source/test/golden/abi.txt}
command -v clang >/dev/null || {
    echo "abi: no clang, which prints the layouts; scripts/install-deps check"
    exit 77
}
mkdir -p "$scratch"
# without those whose vectors depend on the compiler's flags: the library holds nothing of them
headers=$(cd "$source/include" && ls burnish/*.h | grep -vE '(arrays|vector)_q15')
for header in $headers; do
    echo "#include \"$header\""
done >"$scratch/all.c"
clang -E -P -I"$source/include" "$scratch/all.c" | tr '\n' ' ' | tr -s ' \t' ' ' >"$scratch/all.i"

{
    # functions, with the names of their parameters: a change of either is worth a look
    sed 's/;/;\n/g' "$scratch/all.i" | sed -n 's/.*__attribute__((visibility("default"))) *\(.*);\)$/\1/p' | sort
    # structs: offset, type and name of every member, size and alignment
    clang -fsyntax-only -Xclang -fdump-record-layouts-complete -I"$source/include" "$scratch/all.c" |
        awk '/^\*\*\* Dumping/ {wanted = 0; next}
             / \| (struct|union) / && !/^ +[0-9]+ \|   / {wanted = / burnish_/}
             wanted' | sed 's/  *$//' | awk 'NF' | awk '{key = ($3 ~ /^(struct|union)$/ && $0 !~ /\|   /) ? $4 : key; printf "%s\t%d\t%s\n", key, NR, $0}' |
        sort -s -k1,1 -k2,2n | cut -f3-
    # enumerators
    echo '#include <stdio.h>' >"$scratch/enums.c"
    cat "$scratch/all.c" >>"$scratch/enums.c"
    echo 'int main(void) {' >>"$scratch/enums.c"
    grep -oE 'enum( burnish_[a-z0-9_]+)? \{[^}]*\}' "$scratch/all.i" | sed 's/^[^{]*{//; s/}$//' | tr ',' '\n' |
        sed -n 's/^ *\(BURNISH_[A-Z0-9_]*\).*/    printf("%s %lld\\n", "\1", (long long)\1);/p' | sort -u >>"$scratch/enums.c"
    echo '    return 0; }' >>"$scratch/enums.c"
    clang -I"$source/include" "$scratch/enums.c" -o "$scratch/enums"
    "$scratch/enums"
} >"$scratch/abi.txt"

[ "$(wc -l <"$scratch/abi.txt")" -gt 300 ] || {
    echo "abi: hardly anything found: $scratch/abi.txt"
    exit 1
}
if [ "${3:-}" = --update ]; then
    cp "$scratch/abi.txt" "$list"
    echo "abi: $list is written; say in CHANGELOG.md what changed"
    exit
fi
if ! diff -u "$list" "$scratch/abi.txt"; then
    echo "abi: the binary interface has changed; if that is meant: make abi, and a line in CHANGELOG.md"
    exit 1
fi
echo "abi: $(wc -l <"$list") lines as they were"
