# Cycles by a model, from a program's listing and a trace of its executed instructions.
# Usage: awk -v model=m0|rv32 -f cycles.awk LISTING FS=/ TRACE, with LISTING from objdump -d and TRACE from
# qemu -singlestep -d exec,nochain. Prints "mark CYCLE" for every call of target_mark, and at the end
# "end CYCLE".
#
# m0    Cortex-M0, technical reference manual table 3-1, single-cycle multiplier, no wait states:
#       1; loads and stores 2; ldm, stm, push 1 + N; pop 1 + N, with pc 4 + N; branch taken 3, not
#       taken 1; bl 4; bx, blx 3; writes to pc 3.
# rv32  a small in-order core (Ibex without branch target ALU, single-cycle multiplier), from its manual:
#       1; loads and stores 2; mul 1, mulh* 2; div, rem 37; branch taken 3, not taken 1; jumps 2.

function registers(list,   n, i, parts, range, count) { # {r0, r1, r4-r7} counts 6
    sub(/^[^{]*\{/, "", list)
    sub(/\}.*/, "", list)
    n = split(list, parts, /, */)
    for (i = 1; i <= n; ++i) {
        count += split(parts[i], range, "-") == 2 ? substr(range[2], 2) - substr(range[1], 2) + 1 : 1
    }
    return count
}

function learn_m0(at, op, rest) {
    sub(/\.[nw]$/, "", op)
    cost[at] = 1
    jump[at] = 0
    if (op ~ /^(ldm|stm|push)/) { cost[at] = 1 + registers(rest) }
    else if (op == "pop") { cost[at] = (rest ~ /pc/ ? 4 : 1) + registers(rest) }
    else if (op ~ /^(ldr|str)/) { cost[at] = 2 }
    else if (op == "bl") { cost[at] = 4 }
    else if (op == "bx" || op == "blx") { cost[at] = 3 }
    else if (op ~ /^(mrs|msr|dmb|dsb|isb)$/) { cost[at] = 4 }
    else if (op == "b" || rest ~ /^pc,/) { cost[at] = 3 }
    else if (op ~ /^b(eq|ne|cs|cc|hs|lo|mi|pl|vs|vc|hi|ls|ge|lt|gt|le)$/) { jump[at] = 2 }
}

function learn_rv32(at, op) {
    cost[at] = 1
    jump[at] = 0
    if (op ~ /^(lb|lh|lw|lbu|lhu|sb|sh|sw)$/) { cost[at] = 2 }
    else if (op ~ /^mulh/) { cost[at] = 2 }
    else if (op ~ /^(div|rem)/) { cost[at] = 37 }
    else if (op ~ /^(j|jal|jr|jalr|ret|tail|call)$/) { cost[at] = 2 }
    else if (op ~ /^b/) { jump[at] = 2 }
}

function plain(address) { sub(/^0+/, "", address); return address == "" ? "0" : address }

FNR == NR {
    if (/^[0-9a-f]+ <target_mark>:/) { mark = plain($1) }
    if (!/^ *[0-9a-f]+:\t/) { next }
    split($0, field, "\t")
    at = field[1]
    gsub(/[ :]/, "", at)
    at = plain(at)
    if (last != "") { next_of[last] = at }
    last = at
    op = field[3]
    rest = field[4]
    if (model == "m0") { learn_m0(at, op, rest) }
    else { learn_rv32(at, op) }
    next
}

# An instruction's cost depends on the next one: whether a branch was taken.
/^Trace/ {
    if (!($2 in address)) { address[$2] = plain($2) } # gawk takes its time over regular expressions
    at = address[$2]
    if (again) { again = 0; if (at == before) { next } }
    if (before == "" && !(at in cost)) { next } # the board's own start
    if (!(at in cost)) { print "cycles.awk: no instruction at " at >"/dev/stderr"; failed = 1; exit 1 }
    if (before != "") { cycles += cost[before] + (jump[before] && next_of[before] != at ? jump[before] : 0) }
    if (at == mark) { print "mark " cycles }
    before = at
    ++steps
}
/^Stopped/ { again = 1 } # the last instruction did not run and comes again
END {
    if (!failed) { print "end " cycles; if (steps < 1000) { print "cycles.awk: no trace" >"/dev/stderr"; exit 1 } }
}
