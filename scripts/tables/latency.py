"""The latencies of docs/hardware.md, which a simulation of the Verilog measures."""
import concurrent.futures
import os
import re
import tempfile

from page import ROOT, Refused, fill, filled, need, read, run, table, write

# Label, module, parameters.
ROWS = """`burnish_taylor`|taylor|
`burnish_taylor` order 4|taylor|SQUARINGS=2
`burnish_taylor` order 16|taylor|SQUARINGS=4
`burnish_shift7`|shift7|
`burnish_shift7` RESULT=8|shift7|RESULT=8
`burnish_shift7` LAMBDA=1|shift7|LAMBDA=1
`burnish_shift3`|shift3|
`burnish_zeta`|zeta|
`burnish_energy`|energy|
`burnish_boundary`, shift7|boundary|
`burnish_stream`, shift7|stream|OUTPUT=0
`burnish_stream`, shift7, OUTPUT=1|stream|OUTPUT=1
`burnish_dot`|dot|
`burnish_chord`|chord|
`burnish_normalize`|normalize|
`burnish_highlight`|highlight|
`burnish_highlight` NARROW=0|highlight|NARROW=0
`burnish_channel`|channel|
`burnish_light`|light|
`burnish_pixel`, one light|pixel|HELD=0
`burnish_pixel`, two lights|pixel|LIGHTS=2 HELD=0"""
LARGE = ("light", "pixel")  # simulated with multipliers only: rows take too long
COLUMNS = ("DSP=1", "ROWS=1", "ROWS=2", "ROWS=1 SEGMENT=6")
# The two values between which an input steps; others stay.
STEPS = {"angle": ("32'h7E80", "32'h7F40"), "lambda": ("32'h00C000", "32'h018000"), "slope": ("32'h5000", "32'h6000"), "exponent": ("32'd20", "32'd24"),
         "normal": ("48'h7F5A_0800_0A00", "48'h7FE0_0400_0300"), "half": ("48'h7FFF_0000_0000", "48'h7FE8_0300_FC00"),
         "light": ("48'h6000_3000_4000", "48'h5000_4000_4800"), "color": ("48'h4000_5000_6000", "48'h6000_4000_5000"), "user": ("32'd0", "32'd1")}
KINDS = {"s_angle": "angle", "s_exponent": "exponent", "v": "normal", "a": "normal", "b": "half", "diffuse": "color", "specular": "color",
         "ambient": "color", "sum_in": "color", "user_in": "user", "s_user": "user"}


def rtl_latency(*arguments):
    """[--check] PAGE: fills the table of latencies in docs/hardware.md by simulation; --check fails if PAGE has another"""
    need("rtl", "iverilog")
    rows = [line.split("|") for line in ROWS.splitlines()]
    units = []
    for at, (_, module, parameters) in enumerate(rows):
        units += [(at, column, module, f"{parameters} {setting}") for column, setting in enumerate(COLUMNS) if module not in LARGE or setting == "DSP=1"]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = list(pool.map(lambda unit: measured(*unit[2:]), units))
    found = {unit[:2]: clocks for unit, clocks in zip(units, results)}
    heads = ["clocks", *(f"`{column}`" for column in COLUMNS)]
    tables = {"latency": table(heads, [[row[0], *(found.get((at, column), "-") for column in range(len(COLUMNS)))] for at, row in enumerate(rows)])}
    if arguments[0] == "--check":
        if filled(arguments[1], tables, keep=True) != read(arguments[1]):
            raise Refused(f"{arguments[1]}: its latencies are not those of the simulation; run scripts/tables rtl-latency {arguments[1]}")
    else:
        fill(arguments[0], tables, ("MAC", "RAM"), keep=True)


def measured(module, parameters):
    """The clocks from a step of all inputs of a unit to that of all its outputs, which must come at once."""
    with tempfile.TemporaryDirectory() as work:
        write(f"{work}/latency.v", bench(module, dict(word.split("=") for word in parameters.split())))
        run("iverilog", "-g2001", "-Ihardware/rtl", "-yhardware/rtl", "-s", "latency", "-o", f"{work}/latency", f"{work}/latency.v", cwd=ROOT)
        first, last = run("vvp", "-n", f"{work}/latency").split()
    if first != last or first == "0":
        raise Refused(f"burnish_{module} {parameters}: expected one step of its outputs, found steps from clock {first} to {last}")
    return int(first)


def bench(module, parameters):
    given = {**{name: default for kind, name, default, _ in declarations(f"burnish_{module}") if kind == "parameter"}, **parameters}
    lights = int(given.get("LIGHTS", 1))
    constant = {"enable": "1'b1", "s_valid": "1'b1", "m_ready": "1'b1", "lit": "1'b1", "shift": "4'd8"}
    ports, high = [], 0
    for kind, name, width, _ in declarations(f"burnish_{module}"):
        if kind == "input":
            driver = constant.get(name, "lambda" if name.endswith("angle") and given.get("LAMBDA") == "1" else KINDS.get(name, name))
            is_wide = name in ("light", "half", "diffuse", "specular") and lights > 1
            ports.append(f".{name}({{{lights}{{{driver}}}}})" if is_wide else f".{name}({driver})")
        elif kind == "output" and name not in ("s_ready", "busy"):
            bits = int(given.get(width, width))
            ports.append(f".{name}(out[{high}+:{bits}])")
            high += bits
    steps = "\n".join(f"    wire [47:0] {name} = step ? {after} : {before};" for name, (before, after) in STEPS.items())
    return f"""`timescale 1ns / 1ns
module latency;
    reg clk = 0, step = 0, reset = 1;
    integer clocks = 0, first = 0, last = 0;
{steps}
    wire [{high - 1}:0] out;
    reg [{high - 1}:0] was;
    burnish_{module} #({", ".join(f".{name}({value})" for name, value in parameters.items())}) unit ({", ".join(ports)});
    always #5 clk = !clk;
    initial begin
        repeat (3) @(negedge clk);
        reset = 0;
        repeat (120) @(negedge clk);
        was = out;
        step = 1;
        for (clocks = 1; clocks < 120; clocks = clocks + 1) begin
            @(negedge clk);
            if (out !== was && first == 0) first = clocks;
            if (out !== was) last = clocks;
            was = out;
        end
        $display("%0d %0d", first, last);
        $finish;
    end
endmodule
"""


def declarations(module):
    """(kind, name, width or default, meaning): one per line of the module's head, the meaning as the line's comment."""
    items, inside = [], False
    path = f"hardware/rtl/{module}.v"
    for at, line in enumerate(read(f"{ROOT}/{path}").splitlines(), 1):
        if line.startswith("module "):
            inside = True
        elif line == ");":
            return items
        elif inside and line != ") (":
            declaration, _, meaning = line.partition(" // ")
            if not meaning:
                raise Refused(f"{path}: line {at}: expected a comment that says what it means")
            words = declaration.strip().rstrip(",").split()
            if words[0] == "parameter" and words[2] == "=":
                items.append((words[0], words[1], words[3], meaning))
            elif words[0] in ("input", "output"):
                width = re.search(r"\[(.*):0\]", declaration)
                width = width[1] if width else "0"
                items.append((words[0], words[-1], str(int(width) + 1) if width.isdigit() else width[:-2], meaning))
            else:
                raise Refused(f"{path}: line {at}: expected a parameter or a port")
    raise Refused(f"{path}: expected the end of the ports")
