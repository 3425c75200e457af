#!/bin/sh
# bench_kernels: every key is there, with a positive number, or with null and a reason. No time is
# judged.
# usage: cli_bench.sh BENCH_KERNELS SCRATCH
. "$(dirname "$0")/lib.sh"

positive() { printf '%s\n' "$1" | awk '{ exit !($1 ~ /^[0-9.]+(e[-+]?[0-9]+)?$/ && $1 > 0) }'; }

lobe_keys="over_copy schlick_over squarings_over table_over vector_pow_over sleef_over libmvec_over
    libm_over"
shade_keys="none_over libmvec_over sleef_over table_over vector_pow_over schlick_over"

# keys_of_last_output: of a run with one instruction set, in which each key occurs once (and once among the missing).
check_keys() {
    for key in $(for k in $lobe_keys; do echo "lobe.l1.$k"; done) lobe.memory.over_nt_copy \
        $(for k in $shade_keys; do echo "shade.directional.$k shade.point.$k"; done) \
        root.l1.ieee_over scalar.latency.schlick_over scalar.throughput.schlick_over \
        paper.latency.over_w paper.latency.over_w_half paper.throughput.over_w paper.throughput.over_w_half; do
        first=$(tr -d '\n\t ' <"$out" | grep -oF -m 1 "\"$key\":" | head -n 1)
        check "bench $1: no key $key" [ -n "$first" ]
        found=$(tr -d '\n\t ' <"$out" | sed 's/"missing":.*//' |
            grep -oE "\"$(printf '%s' "$key" | sed 's/\./\\./g')\":[^,}]*" | cut -d: -f2)
        if [ "$found" = null ]; then
            check "bench $1: $key is null without a reason" sh -c \
                "tr -d '\n\t' <'$out' | sed 's/.*\"missing\"://' | grep -qE '\"$key\": *\"[^\"]{10,}'"
        else
            check "bench $1: $key is '$found'" positive "$found"
        fi
    done
}

gives 0 --quick --json --isa scalar --csv rows.csv
check "bench: writes to standard error" [ ! -s "$err" ]
check "bench: no JSON" valid_json
check_keys scalar
check "bench --csv: no rows" [ "$(grep -c '^scalar,' rows.csv)" -ge 30 ]
check "bench --csv: rows of 7 fields" sh -c "sed 's/\"[^\"]*\"/S/g' rows.csv | awk -F, 'NF != 7 { bad = 1 } END { exit bad }'"

gives 0 --quick --json --isa auto  # bench --isa auto
check "bench --isa auto: no JSON" valid_json
check_keys auto

run --quick --isa auto
check "bench: no table" grep -q 'the lobe, m = 2' "$out"

gives 2 --isa mmx  # bench --isa mmx
check "bench --isa mmx: says $(cat "$err")" grep -qx 'burnish: --isa: "mmx" is not one of auto scalar.*' "$err"
expect 7 "burnish: no/such/folder.csv: can't be written: No such file or directory; create the folder first" \
    --quick --isa scalar --csv no/such/folder.csv
printf 'mine' >kept.csv
(
    ulimit -f 1 # one block: the rows do not fit
    "$burnish" --quick --isa scalar --csv kept.csv >"$out" 2>"$err"
    echo $? >code
)
check "bench --csv: an older file is lost on an error" [ "$(cat kept.csv)" = mine ]
rm -f rows.csv kept.csv code
nothing_left "bench"

finish
