"""docs/hardware.md: what the units of hardware/rtl and the units that they are compared with cost."""
import concurrent.futures
import os
import re
import subprocess

from page import ROOT, Refused, fill, need, run, table, write

HX8K = """taylor|`burnish_taylor`
taylor_rows2|`burnish_taylor` ROWS=2
shift7|`burnish_shift7`
shift7_rows2|`burnish_shift7` ROWS=2
shift7_segments|`burnish_shift7` SEGMENT=6, highest clock
shift7_near|`burnish_shift7` ROUND=1 ROWS=2
shift7_8bit|`burnish_shift7` RESULT=8 ROWS=2
shift3|`burnish_shift3` ROWS=2
taylor_10bit|`burnish_taylor` RESULT=10 ROWS=2
taylor4|`burnish_taylor` order 4 ROWS=2
taylor8|`burnish_taylor` order 8 ROWS=2
taylor16|`burnish_taylor` order 16 ROWS=2
zeta_rows2|`burnish_zeta` ROWS=2
energy|`burnish_energy` ROUND=1 ROWS=2
lambda_shift7|`burnish_shift7` LAMBDA=1
schlick_16|Schlick, divider, 16 bits
schlick_8|Schlick, divider, 8 bits"""
UP5K = """taylor_dsp|`burnish_taylor` DSP=1
shift7_dsp|`burnish_shift7` DSP=1
shift3_dsp|`burnish_shift3` DSP=1
taylor4_dsp|`burnish_taylor` order 4 DSP=1
energy_dsp|`burnish_energy` DSP=1 ROUND=1
lambda_taylor_dsp|`burnish_taylor` DSP=1 LAMBDA=1
schlick_16_dsp|Schlick, divider, 16 bits
schlick_rom_8|Schlick, reciprocals in memory, 8 bits"""
OTHERS = "taylor shift7 shift7_rows2 shift7_dsp zeta_rows2 schlick_16 schlick_8 schlick_16_dsp schlick_rom_8".split()
# Module, label, inputs, outputs, parameters; ports as for wrap().
PARTS = """dot|`burnish_dot`|enable a:48 b:48|cosine:16
chord|`burnish_chord`|enable a:48 b:48|lambda:24
normalize|`burnish_normalize`|enable v:48|unit:48
channel|`burnish_channel`, cosine or chord|enable normal:48 half:48 exponent:10 lit:1 color:48 sum_in:48 user_in|sum_out:48
pixel|`burnish_pixel`, one light|enable normal:48 exponent:10 ambient:48 light:48 half:48 diffuse:48 specular:48 user_in|color:48
stream|`burnish_stream`, shift7|reset:1 s_valid:1 s_exponent:10 s_angle:16 s_user:1 m_ready:1|s_ready:1 m_valid:1 m_value:16 m_user:1
stream|`burnish_stream`, shift7, OUTPUT=1|reset:1 s_valid:1 s_exponent:10 s_angle:16 s_user:1 m_ready:1|s_ready:1 m_valid:1 m_value:16 m_user:1|OUTPUT=1"""
GATES = r"\$_(AND|OR|XOR|NAND|NOR|XNOR|NOT|ANDNOT|ORNOT|MUX)_"
ICE40 = {"hx8k": ("ct256", "-device hx"), "up5k": ("sg48", "-device u -dsp")}
BENCH = """module bench;
    reg clk = 0;
    reg [511:0] in = 0;
    wire [511:0] value;
    reg [511:0] before;
    integer trial, clock, word, last;
    top unit(.clk(clk), .in(in), .value(value));
    initial begin
        last = 0;
        for (trial = 0; trial < 60; trial = trial + 1) begin
            for (clock = 1; clock <= 250; clock = clock + 1) begin
                #1 clk = 1;
                #1 clk = 0;
                if (clock > 1 && trial > 0 && value !== before && clock > last) last = clock;
                before = value;
            end
            for (word = 0; word < 16; word = word + 1) in[32*word+:32] = $random & $random;
        end
        $display("%0d", last);
    end
endmodule
"""


def lines_of(text, only=None):
    split = [line.split("|") for line in text.splitlines()]
    return [line for line in split if only is None or line[0] in only]


def rtl(work, page, errors, short=""):
    """FOLDER PAGE ERRORS [short]: synthesises every unit, fills docs/hardware.md, writes images/rtl-area.csv next to it

    ERRORS: lines of "name error-in-steps bits latency", as `hardware/rtl/test/run FOLDER errors` writes them.
    short: one or two units per table, placed once.
    """
    need("rtl", "yosys", "nextpnr-ice40", "iverilog")
    os.makedirs(work, exist_ok=True)
    with open(errors, encoding="utf-8") as file:
        facts = {line.split()[0]: line.split()[1:] for line in file}
    synthesis = Synthesis(os.path.abspath(work), facts, (1,) if short else (1, 2, 3))
    hx8k = lines_of(HX8K, ("shift7", "schlick_8") if short else None)
    up5k = lines_of(UP5K, ("shift7_dsp",) if short else None)
    others = lines_of(HX8K + "\n" + UP5K, ("shift7", "shift7_dsp") if short else OTHERS)
    parts = lines_of(PARTS, ("stream",) if short else None)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = [[pool.submit(make, *line) for line in lines] for make, lines in
                ((synthesis.hx8k, hx8k), (synthesis.up5k, up5k), (synthesis.others, others), (synthesis.part, parts))]
        rows = [[job.result() for job in each] for each in jobs]
    tables = {
        "hx8k": table("unit|LUT4|flip-flops|cells|MHz, median of three seeds|latency|largest error, steps", rows[0]),
        "up5k": table("unit|LUT4|flip-flops|MAC|RAM|MHz, median of three seeds|latency|largest error, steps", rows[1]),
        "others": table("unit|ECP5: LUT4 / flip-flops / MULT18|xc7: LUT / flip-flops / DSP48|two-input gates, without flip-flops", rows[2]),
        "parts": table("unit|HX8K, ROWS=2: LUT4 / flip-flops|MHz|latency|UP5K, DSP=1: LUT4 / flip-flops / MAC|MHz|latency|"
                       "ECP5, DSP=1: LUT4 / flip-flops / MULT18", rows[3]),
    }
    if not short:
        tables["summary"] = summary(*({row[0]: row for row in each} for each in (rows[0], rows[1], rows[3])))
    fill(page, tables, ("MAC", "RAM"), keep=True)
    area = "chip,unit,lut,flipflops,cells,mhz,error,bits\n" + "".join(line + "\n" for line in sorted(synthesis.area))
    write(os.path.join(os.path.dirname(page), "images", "rtl-area.csv"), area)


def summary(hx8k, up5k, parts):
    """The first table of the page, from rows of the others."""
    lobe, rows, fast, pixel = up5k["`burnish_shift7` DSP=1"], hx8k["`burnish_shift7` ROWS=2"], hx8k["`burnish_shift7` SEGMENT=6, highest clock"], parts["`burnish_pixel`, one light"]
    lut, flipflops, multipliers = pixel[4].split(" / ")
    ecp5 = pixel[7].split(" / ")
    return table("circuit|chip|LUT4|flip-flops|multipliers|MHz|results per clock|latency, clocks", [
        ["lobe `burnish_shift7`, DSP=1", "iCE40 UP5K", lobe[1], lobe[2], lobe[3], lobe[5].split()[0], 1, lobe[6]],
        ["the same, ROWS=2", "iCE40 HX8K", rows[1], rows[2], "-", rows[4].split()[0], 1, rows[5]],
        ["the same, SEGMENT=6", "iCE40 HX8K", fast[1], fast[2], "-", fast[4].split()[0], 1, fast[5]],
        ["pixel `burnish_pixel`, one light, DSP=1", "iCE40 UP5K, synthesis only", lut, flipflops, multipliers, pixel[5], 1, pixel[6]],
        ["the same", "ECP5, synthesis only", *ecp5, "-", 1, pixel[6]]], left=2)


def wrap(module, parameters, inputs, outputs, pins=""):
    """The Verilog of a module top around one unit.

    inputs, outputs: port:width each; inputs without a width are constant, reset and user_in 0, others 1.
    pins: "serial" takes the inputs from a shift register, for packages with fewer pins than the unit has ports; "narrow" also
    sends the outputs through one.
    """
    ports, bits, out = ["clk(clk)"], 0, 0
    for name, _, width in (port.partition(":") for port in inputs.split()):
        if width:
            ports.append(f"{name}(in[{bits + int(width) - 1}:{bits}])")
            bits += int(width)
        else:
            ports.append(f"{name}({int(name not in ('reset', 'user_in'))})")
    for name, _, width in (port.partition(":") for port in outputs.split()):
        ports.append(f"{name}(value[{out + int(width) - 1}:{out}])")
        out += int(width)
    values = ", ".join(".{}({})".format(*parameter.split("=")) for parameter in parameters.split())
    source = "input wire serial" if pins else f"input wire [{bits - 1}:0] in"
    sink = "output wire last, input wire load" if pins == "narrow" else f"output wire [{out - 1}:0] value"
    text = [f"module top(input wire clk, {source}, {sink});"]
    if pins:
        text.append(f"    reg [{bits - 1}:0] in; always @(posedge clk) in <= {{in[{bits - 2}:0], serial}};")
    if pins == "narrow":
        text.append(f"    wire [{out - 1}:0] value; reg [{out - 1}:0] kept; assign last = kept[{out - 1}];")
        text.append(f"    always @(posedge clk) kept <= load ? value : {{kept[{out - 2}:0], serial}};")
    return "\n".join([*text, f"    {module} #({values}) unit({', '.join('.' + port for port in ports)});", "endmodule", ""])


def count_cells(path, cells):
    """The number of cells in yosys' statistics whose type matches."""
    with open(path, encoding="utf-8") as file:
        words = [line.split() for line in file]
    return sum(int(line[1]) for line in words if len(line) > 1 and re.fullmatch(cells, line[0]) and line[1].isdigit())


class Synthesis:
    def __init__(self, work, facts, seeds):
        self.work, self.facts, self.seeds, self.area = work, facts, seeds, []
        self.units = {}
        for name in ("units.txt", "opponents.txt"):
            with open(os.path.join(ROOT, "hardware", "rtl", "test", name), encoding="utf-8") as file:
                self.units.update((line.split()[0], line.split()) for line in file if line.strip())

    def path(self, name):
        return os.path.join(self.work, name)

    def blocks(self, name, cells):
        return count_cells(self.path(name + ".stat"), cells)

    def cells(self, name, cells):
        """The number of cells of a kind that every unit has."""
        number = self.blocks(name, cells)
        if not number:
            raise Refused(f"{self.path(name)}.stat: expected cells named {cells}, found none")
        return number

    def wrapped(self, name, file, pins=""):
        """Writes the wrapper of a unit of the bench's lists."""
        _, module, _, _, *parameters = self.units[name]
        width = next((each[7:] for each in parameters if each.startswith("RESULT=")), "8" if name.endswith("_8") else "16")
        angle = 24 if "LAMBDA=1" in parameters else 16
        control = "slope:16 shift:4" if module == "burnish_zeta" else "exponent:10"
        write(self.path(file), wrap(module, " ".join(parameters), f"enable angle:{angle} {control} user_in", f"value:{width}", pins))

    def synthesise(self, wrapper, name, command):
        """Leaves the number of each cell in NAME.stat. For iCE40 multipliers are separate modules (burnish_multiplier) until the end."""
        chip = "" if command.startswith("synth_ice40") else "-DBURNISH_NOT_ICE40 "
        rtl = f"{ROOT}/hardware/rtl"
        script = f"read_verilog {chip}-I{rtl} {rtl}/burnish_*.v {rtl}/opponents/*.v {self.path(wrapper)}\n{command}\n"
        script += f"setattr -mod -unset keep_hierarchy *; flatten; tee -o {self.path(name)}.stat stat\n"
        write(self.path(name + ".ys"), script)
        try:
            run("yosys", "-q", "-l", self.path(name + ".log"), "-s", self.path(name + ".ys"), cwd=self.work)
        except Refused as refused:
            raise Refused(f"{name}: {refused}") from None

    def place(self, name, device):
        """Logic cells, MHz: median, least, most; dashes if it does not fit."""
        found = []
        for seed in self.seeds:
            command = ["nextpnr-ice40", f"--{device}", "--package", ICE40[device][0], "--json", self.path(name + ".json")]
            command += ["--seed", str(seed), "--freq", "250", "--timing-allow-fail"]
            done = subprocess.run(command, capture_output=True, text=True)
            if done.returncode:
                if not re.search("ERROR: (Unable to place cell|Failed to expand region)", done.stderr):
                    raise Refused(f"{name}: {re.findall('ERROR.*', done.stderr)[:1]}")
                return "-", "-", "-", "-"
            cells = re.findall(r"ICESTORM_LC: *(\d+)/", done.stderr)
            speed = re.findall(r"Max frequency for clock.*?([\d.]+) MHz", done.stderr)
            if not cells or not speed or float(speed[-1]) == 0:
                raise Refused(f"{name}: expected logic cells and a frequency from nextpnr-ice40, found none")
            found.append((float(speed[-1]), int(cells[-1])))
        found.sort()
        speed, cells = found[(len(found) - 1) // 2]
        return cells, *("%.0f" % each for each in (speed, found[0][0], found[-1][0]))

    def ice40(self, name, label, device, pins, middle):
        flags = ICE40[device][1]
        self.wrapped(name, name + ".v")
        self.synthesise(name + ".v", name, f"synth_ice40 -abc9 {flags} -top top")
        self.wrapped(name, name + ".placed.v", pins)
        self.synthesise(name + ".placed.v", name + ".placed", f"synth_ice40 -abc9 {flags} -top top -json {self.path(name)}.json")
        cells, speed, least, most = self.place(name, device)
        lut, flipflops = self.cells(name, "SB_LUT4"), self.cells(name, "SB_DFF.*")
        error, bits, latency = self.facts[name]
        # With pins, the cells would count the shift register of the inputs.
        self.area.append(f"{device},{name},{lut},{flipflops},{'' if pins else cells},{speed},{error},{bits}")
        return [label, lut, flipflops, *(middle or [cells]), f"{speed} ({least} to {most})", latency, f"{bits} bits: {error}"]

    def hx8k(self, name, label):
        return self.ice40(name, label, "hx8k", "", None)

    def up5k(self, name, label):
        line = self.ice40(name, label, "up5k", "serial", ["MAC", "RAM"])
        line[3:5] = self.blocks(name, "SB_MAC16"), self.blocks(name, "SB_RAM40_4K.*")
        return line

    def latency(self, wrapper):
        """Clocks after which the last output has followed a change of all inputs, by simulation of the unit in its wrapper."""
        path = self.path(wrapper)
        write(path + ".tb.v", BENCH)
        run("iverilog", "-g2001", "-Ihardware/rtl", "-y", "hardware/rtl", "-s", "bench", "-o", path + ".vvp", path, path + ".tb.v", cwd=ROOT)
        return run("vvp", "-n", path + ".vvp").strip()

    def ecp5(self, wrapper, name, flags=""):
        """Its carry cell CCU2C takes the two LUT4 of a slice."""
        self.synthesise(wrapper, name + ".ecp5", f"synth_ecp5 {flags} -top top")
        lut = self.cells(name + ".ecp5", "LUT4") + 2 * self.blocks(name + ".ecp5", "CCU2C")
        return f"{lut} / {self.cells(name + '.ecp5', 'TRELLIS_FF')} / {self.blocks(name + '.ecp5', 'MULT18X18D')}"

    def part(self, name, label, inputs, outputs, more=""):
        """A unit that is more than a lobe."""
        columns = []
        for device, parameters in (("hx8k", f"ROWS=2 {more}"), ("up5k", f"DSP=1 {more}")):
            kind = f"{name}{more}.{device[:2]}"
            module = "burnish_" + name
            free = re.sub(r"\b(reset|m_ready):1", r"\1", inputs)
            for suffix, ports, pins in ((".v", inputs, ""), (".narrow.v", inputs, "narrow"), (".free.v", free, "")):
                write(self.path(kind + suffix), wrap(module, parameters, ports, outputs, pins))
            command = f"synth_ice40 -abc9 {ICE40[device][1]} -top top"
            self.synthesise(kind + ".v", kind, command)
            self.synthesise(kind + ".narrow.v", kind + ".narrow", f"{command} -json {self.path(kind)}.json")
            speed = self.place(kind, device)[1]
            area = f"{self.cells(kind, 'SB_LUT4')} / {self.cells(kind, 'SB_DFF.*')}"
            area += f" / {self.blocks(kind, 'SB_MAC16')}" if device == "up5k" else ""
            columns += [area, speed, self.latency(kind + ".free.v")]
        return [label, *columns, self.ecp5(f"{name}{more}.up.v", name + more)]

    def others(self, name, label):
        """Synthesis for other chips and for a plain gate library; not placed."""
        nodsp = "" if re.search("dsp|rom", name) else "-nodsp"
        top = name + ".others.v"
        self.wrapped(name, top)
        ecp5 = self.ecp5(top, name, nodsp)
        self.synthesise(top, name + ".xc7", f"synth_xilinx -family xc7 {nodsp} -flatten -noiopad -top top")
        gates = "-"
        if nodsp:
            self.synthesise(top, name + ".gates", "synth -flatten -top top; abc -g AND,OR,XOR,NAND,NOR,XNOR")
            gates = self.cells(name + ".gates", GATES)
        # All flip-flops may be inside the multipliers.
        xc7 = [self.cells(name + ".xc7", "LUT[1-6]"), self.blocks(name + ".xc7", "FD.*"), self.blocks(name + ".xc7", "DSP48E1")]
        return [label, ecp5, " / ".join(map(str, xc7)), gates]
