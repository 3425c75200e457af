"""Counts from simulators: the operations of docs/theory.md and the tables of docs/firmware.md."""
import collections
import glob
import os
import re
import shlex
import subprocess
import tempfile

from page import ROOT, Refused, fill, need, read, run, write

CC = "-std=c99 -O2 -Wall -Wextra -Werror -Iinclude -Ihardware/firmware hardware/firmware/operations.c"
ALONE = "-ffreestanding -nostdlib -nostartfiles"
QEMU = "-display none -monitor none -serial none -singlestep -d exec,nochain"
# Machine, tool prefix, flags and target files, and kinds of instructions in the order of the columns. Constants, moves and
# extensions are of no kind.
MACHINES = {
    "rv32": ("riscv64-unknown-elf", f"-march=rv32im -mabi=ilp32 {ALONE} -Wl,--no-warn-rwx-segments", "rv32/target.c -T hardware/firmware/rv32/target.ld -lgcc", (
        "mul.*", "add|addi|sub|neg|not|xori", "sll|slli|srl|srli|sra|srai", "b.*|slt.*|sltu.*|seqz|snez|j", "(div|rem).*")),
    "m0": ("arm-none-eabi", f"-mcpu=cortex-m0 -mthumb {ALONE}", "arm/target.c -T hardware/firmware/arm/target.ld -lgcc", (
        "mul.*", "adds?|adcs?|subs?|sbcs?|negs|rsbs|mvns", "lsls|lsrs|asrs|rors", "cmp|cmn|tst|b|b(eq|ne|cs|cc|hs|lo|mi|pl|hi|ls|ge|lt|gt|le)", "none")),
    "avr": ("avr", "-mmcu=atmega1284p", "avr/target.c", (
        "mul.*", "add|adc|adiw|sub|subi|sbc|sbci|sbiw|com|neg|inc|dec", "lsl|lsr|asr|rol|ror|swap", "cp|cpc|cpi|cpse|sb[ri][sc]|br..|rjmp|tst", "none")),
}
CELLS = (r"\$mul", r"\$(add|sub|neg|alu)", r"\$(shl|shr|sshl|sshr|shift)", r"\$(reduce_|logic_|lt|le|gt|ge|eq|ne|mux|pmux|and|or).*", r"\$(div|mod)")


def operations(scratch, counts):
    """SCRATCH CSV: what one value of W, W_0.5 and Schlick's lobe takes: cells of circuits, instructions of three processors"""
    need("mcu rtl", "avr-gcc", "arm-none-eabi-gcc", "riscv64-unknown-elf-gcc", "qemu-system-arm", "qemu-system-riscv32", "yosys")
    os.makedirs(scratch, exist_ok=True)
    scratch = os.path.abspath(scratch)
    for machine, (prefix, flags, target, _) in MACHINES.items():
        shell(f"{prefix}-gcc {flags} {CC} hardware/firmware/{target} -o {scratch}/{machine}")
    simavr = [run("pkg-config", flag, "simavr").strip() for flag in ("--cflags", "--libs")]
    shell(f"gcc -O2 hardware/firmware/avr/simulate.c {simavr[0]} -o {scratch}/simulate {simavr[1]} -lelf")
    with open(f"{scratch}/avr.trace", "w", encoding="utf-8") as trace:
        subprocess.run([f"{scratch}/simulate", f"{scratch}/avr", "trace"], stdout=subprocess.DEVNULL, stderr=trace, timeout=60, check=True)
    shell(f"qemu-system-arm -M microbit {QEMU} -D {scratch}/m0.trace -semihosting -kernel {scratch}/m0")
    shell(f"qemu-system-riscv32 -M virt -bios none {QEMU} -D {scratch}/rv32.trace -kernel {scratch}/rv32")
    versions = [run(f"{prefix}-gcc", "-dumpversion").strip() for prefix in ("avr", "arm-none-eabi", "riscv64-unknown-elf")]
    lines = [f"# {' '.join(versions)} {run('yosys', '-V').split()[1]}: GCC for AVR, Arm, RISC-V; yosys"]
    lines.append("lobe,machine,multiplications,additions,shifts,tests,divisions,all")
    lines += [cells(scratch, lobe, module) for lobe, module in (("w", "burnish_taylor"), ("w_half", "burnish_shift7"), ("schlick", "schlick_divider"))]
    for machine, (prefix, _, _, kinds) in MACHINES.items():
        listing = run(f"{prefix}-objdump", "-d", "--no-show-raw-insn", f"{scratch}/{machine}")
        found = instructions(listing, read(f"{scratch}/{machine}.trace"), kinds)
        if len(found) != 3:
            raise Refused(f"{machine}: expected the instructions of 3 lobes, found {len(found)}")
        lines += [",".join([lobe, machine, *map(str, values)]) for lobe, values in found.items()]
    write(counts, "\n".join(lines) + "\n")


def shell(command):
    run(*shlex.split(command), cwd=ROOT, timeout=60)


def instructions(listing, trace, kinds):
    """{lobe: counts by kind, then of all} of the instructions that the trace ran between count_LOBE and main; listing is objdump's."""
    symbol, code, counting, before, repeated, counts = None, {}, None, None, False, {}
    for line in listing.splitlines():
        head = re.match(r"([0-9a-f]+) <(.*)>:", line)
        if head:
            symbol = symbol if head[2].startswith(".") else head[2]
        elif re.match(r" *[0-9a-f]+:\t", line):
            address, operation = line.split("\t")[:2]
            code[int(address.strip(" :"), 16)] = symbol, re.sub(r"\.[nw]$", "", operation.split()[0])
    for line in trace.splitlines():
        repeated = repeated or line.startswith("Stopped")
        if not line.startswith("Trace"):
            continue
        at = int(line.split("/")[1], 16)
        if at == before and repeated:
            continue
        before = at
        owner, operation = code.get(at, ("", ""))
        if owner == "main":
            counting = None
        if owner.startswith("count_") and counting is None:
            counting = counts[owner[6:]] = [0] * 6
        if counting is None or operation in ("ret", "bx"):
            continue
        counting[5] += 1
        kind = next((kind for kind, pattern in enumerate(kinds) if re.fullmatch(pattern, operation)), None)
        if kind is not None:
            counting[kind] += 1
    return counts


def cells(scratch, lobe, module):
    """A row of the cells that compute; registers, and shifts by constants, which are wires, are not counted."""
    sources = " ".join(sorted(glob.glob(f"{ROOT}/hardware/rtl/burnish_*.v") + glob.glob(f"{ROOT}/hardware/rtl/opponents/*.v")))
    run("yosys", "-q", "-p", f"read_verilog -I{ROOT}/hardware/rtl {sources}; chparam -set DSP 1 {module}; hierarchy -top {module}; "
        f"setattr -mod -unset keep_hierarchy *; proc; flatten; opt; clean; tee -o {scratch}/{module}.stat stat", cwd=scratch)
    counts = collections.Counter()
    for line in read(f"{scratch}/{module}.stat").splitlines():
        words = line.split()
        if len(words) == 2 and words[0].startswith("$") and "dff" not in words[0]:
            counts["all"] += int(words[1])
            for kind in CELLS:
                counts[kind] += int(words[1]) if re.fullmatch(kind, words[0]) else 0
    if not counts[CELLS[0]]:
        raise Refused(f"{module}: expected multipliers in {scratch}/{module}.stat, found none")
    return ",".join([lobe, "circuit", *(str(counts[kind]) for kind in CELLS), str(counts["all"])])


def firmware(build, page, images, mode="table"):
    """BUILD_DIR PAGE IMAGES [short]: runs the firmware on its simulators, fills docs/firmware.md and writes its images

    short: without the variants in floating point, and errors over every 64th exponent.
    """
    with tempfile.TemporaryDirectory() as work:
        run(f"{ROOT}/hardware/firmware/run", mode, work)
        tables = {os.path.basename(path): read(path).splitlines() for path in glob.glob(f"{work}/tables/*")}
        for name, flag in (("errors", "--short" if mode == "short" else "--markdown"), ("inputs", "--inputs"), ("rivals", "--tables")):
            tables[name] = run(f"{build}/test/prove_q15", flag).splitlines()
            print("\n".join(tables[name]))
        with open(f"{work}/picture.avr", "rb") as file:
            subprocess.run([f"{ROOT}/hardware/firmware/sheet", f"{images}/firmware.png", "4", "1"], stdin=file, check=True)
        fill(page, tables, ("exact 1 - cosine in UQ0.24",))  # its first error is below half a thousandth of a step
    print(f"firmware: {page} and its images are up to date")
