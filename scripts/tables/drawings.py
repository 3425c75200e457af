"""The figures of docs/hardware.md."""
import os
import re
import tempfile

from page import ROOT, Refused, csv_rows, need, read, run, write

STYLE = os.path.join(ROOT, "program", "plot", "figures", "style.gp")
# Chip, unit, lobe, side of its point on which its name is, name. Units of the family: two rows at a time, or with multipliers.
UNITS = """hx8k taylor_rows2 taylor:2 left taylor
hx8k shift7_rows2 shift7 left shift7
hx8k shift3 shift3 left shift3
hx8k energy energy:2 right energy
hx8k taylor4 taylor:4 below-left order 4
hx8k taylor8 taylor:8 left order 8
hx8k taylor16 taylor:16 left order 16
hx8k schlick_16 schlick right Schlick
hx8k schlick_8 schlick left Schlick, 8 bits
up5k taylor_dsp taylor:2 above-right taylor
up5k shift7_dsp shift7 right shift7
up5k shift3_dsp shift3 right shift3
up5k energy_dsp energy:2 right energy
up5k taylor4_dsp taylor:4 below-right order 4
up5k schlick_16_dsp schlick right Schlick
up5k schlick_rom_8 schlick left Schlick from memory, 8 bits"""
SETTINGS = """id = "rtl_area"
format = "svg"
width = 860.0
height = 670.0
lines = 1
array letters[1] = [0]
names = "beside"
x_title = "four-input look-up tables (LUT4) of an iCE40"
y_title = "largest absolute error from cos^{{/:Italic n}}, {/:Italic n} = 64"
x_log = 1
y_log = 1
x_low = 5
x_high = 3000
low = 0.005
high = 0.5
"""
FONT = 'text{font-family:"DejaVu Sans",Verdana,sans-serif}'


def rtl_area(burnish, area, svg):
    """BURNISH CSV SVG: draws docs/images/rtl-area.svg, cells of a unit against its error from cos^64, from the CSV of rtl

    The error is the sum of the exact lobe's error and the unit's error from that lobe, which may add up.
    """
    need("figures", "gnuplot")
    units = [line.split(" ", 4) for line in UNITS.splitlines()]
    lobes = ",".join(sorted({lobe for _, _, lobe, _, _ in units}))
    found = csv_rows(run(burnish, "lobe", "table", f"--lobes={lobes}", "--exponents=64", "--metrics=max-error", "--format=csv"))
    errors = {re.sub(":2$", "", lobe): float(value) for _, lobe, value in found}
    rows = {(line[0], line[1]): line for line in csv_rows(read(area))}
    points = {}
    for chip, unit, lobe, side, name in units:
        if (chip, unit) not in rows:
            raise Refused(f"{area}: expected a row of {chip} {unit}, found none")
        _, _, lut, _, _, mhz, error, bits = rows[chip, unit]
        series = "opponents" if "schlick" in unit else "family"
        y = errors[re.sub(":2$", "", lobe)] + float(error) / 2 ** int(bits)
        points.setdefault((series, chip), []).append((int(lut), y, side, f"{name}, {mhz} MHz"))
    with tempfile.TemporaryDirectory() as work:
        style = read(STYLE)
        script = SETTINGS + re.sub(r'^eval drawing\n|^(if) \(!exists\("drawing"\)\) \{$', lambda match: "if (0) {" if match[1] else "", style, flags=re.M)
        script += "set multiplot; set xlabel \"\"\n" + panel(work, points, "up5k", 48.0, 302.0, "with multipliers: UP5K")
        script += "y_title = \"\"; set xlabel x_title offset 0, 0.4 textcolor rgb ink(1)\n" + panel(work, points, "hx8k", 350.0, 604.0, "without: HX8K")
        write(f"{work}/script.gp", script)
        write(svg, dressed(run("gnuplot", "--default-settings", f"{work}/script.gp"), style))


def panel(work, points, chip, top, bottom, words):
    """gnuplot's commands for one chip, between these heights; each name next to its point."""
    stairs, best = [], None
    for x, y, _, _ in sorted(points["family", chip]):  # every other unit of the family is to their right or above
        if best is None or y < best:
            stairs += [(x, best)] * (best is not None) + [(x, y)]
            best = y
    lines = [f"unset label; set tmargin at screen 1 - {top} / height; set bmargin at screen 1 - {bottom} / height"]
    for series, ink in (("family", 6), ("opponents", 7)):
        for x, y, side, name in points[series, chip]:
            left = "left" in side
            rise = 0.6 if "above" in side else -0.7 if "below" in side else 0
            lines.append(f"set label \"{name}\" at first {x}, first {y:.6g} {'right' if left else 'left'} offset {-1 if left else 1}, {rise} textcolor rgb ink({ink})")
        write(f"{work}/{series}.{chip}", "".join(f"{x} {y:.6g}\n" for x, y, _, _ in points[series, chip]))
    write(f"{work}/stairs.{chip}", "".join(f"{x} {y:.6g}\n" for x, y in stairs))
    return "\n".join(lines) + f"""
set label y_title at screen 22.0 / width, screen 1 - 24.0 / height textcolor rgb ink(1)
set label "{words}" at graph 0.01, graph 0.06 left textcolor rgb ink(2)
plot "{work}/stairs.{chip}" using 1:2 with lines linewidth 1 linecolor rgb ink(2) notitle, \\
    "{work}/family.{chip}" using 1:2 with points pointtype 7 pointsize 0.7 linecolor rgb ink(6) notitle, \\
    "{work}/opponents.{chip}" using 1:2 with points pointtype 6 pointsize 0.7 linewidth 1.4 linecolor rgb ink(7) notitle
"""


def dressed(svg, style):
    """As plot_dress of program/plot/gnuplot.c: a title, and the style's dark inks on dark pages."""
    light, dark = (re.search(rf'^{name} = "(.*)"', style, re.M)[1].split() for name in ("light", "dark"))
    rules = []
    for before, after in zip(light, dark):
        channels = tuple(int(before[at:at + 2], 16) for at in (1, 3, 5))
        wide, narrow = "rgb(%3d, %3d, %3d)" % channels, "rgb(%d,%d,%d)" % channels
        if wide in svg:
            rules.append(f'[stroke="{wide}"]{{stroke:{after}}}[color="{wide}"]{{color:{after}}}')
        if narrow in svg:
            rules.append(f'[fill="{narrow}"]{{fill:{after}}}')
        if before == "#ffffff":
            rules.append(f'[fill="#ffffff"],[fill="#FFFFFF"]{{fill:{after}}}')
    title = "<title>Cells of every unit and of what it is measured against, and the error from the power</title>\n<style>\n"
    title += 'text,tspan{font-family:"DejaVu Sans",Verdana,sans-serif}\n@media (prefers-color-scheme:dark){\n' + "\n".join(rules) + "\n}\n</style>"
    svg = re.sub("^<svg", '<svg xml:space="preserve"', svg, flags=re.M)
    return re.sub(r"^.*<title>.*$", lambda match: title, svg, count=1, flags=re.M)


# ---- The timing diagram ----

INK, BLUE, RED, GREY, PALE = "rgb(47,54,63)", "rgb(0, 114, 178)", "rgb(213,94,0)", "rgb(106, 115, 125)", "rgb(231, 234, 238)"
DARK = (("fill", INK, "#c9d1d9"), ("stroke", INK, "#c9d1d9"), ("stroke", GREY, "#7d8791"), ("fill", PALE, "#2a313a"), ("stroke", PALE, "#2a313a"),
        ("fill", "#ffffff", "#161b22"), ("stroke", BLUE, "#58a6e8"), ("fill", RED, "#f5874a"))
SIGNALS = "clk s_valid s_ready s_angle m_valid m_ready m_value".split()
LEFT, SCALE, HIGH, ROW, TOP, START, STOP, CLOCK = 92, 4, 22, 44, 52, 35, 225, 10  # pixels, then ns


def rtl_wave(*arguments):
    """[--check] SVG: draws a simulation of burnish_stream (hardware/rtl/test/bench/wave.v); --check fails if SVG is another image"""
    need("rtl", "iverilog")
    with tempfile.TemporaryDirectory() as work:
        run("iverilog", "-g2001", "-Wall", "-Wno-timescale", "-Ihardware/rtl", "-yhardware/rtl", "-s", "wave", "-o", f"{work}/wave",
            "hardware/rtl/test/bench/wave.v", cwd=ROOT)
        run("vvp", "-n", "wave", cwd=work)
        text = draw_wave(read(f"{work}/wave.vcd"))
    if arguments[0] == "--check" and text != read(arguments[1]):
        raise Refused(f"{arguments[1]} is not the image of the simulation; run scripts/tables rtl-wave {arguments[1]}")
    write(arguments[-1], text)


def read_dump(text):
    """{signal: [(time, value)...]} of a value change dump."""
    names, changes, time = {}, {}, 0
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["$var"]:
            names[words[3]] = words[4]
        elif line.startswith("#"):
            time = int(line[1:])
        elif re.match("[01]|b", line):
            value, code = (words[0][1:], words[1]) if line[0] == "b" else (line[0], line[1:])
            changes.setdefault(names[code], []).append((time, int(re.sub("[^1]", "0", value), 2)))
    return changes


def x_of(time):
    return LEFT + (time - START) * SCALE


def text_at(x, y, anchor, size, text):
    return f'<text x="{x:g}" y="{y:g}" text-anchor="{anchor}" font-size="{size}" fill="{INK}">{text}</text>'


def draw_wave(dump):
    changes = read_dump(dump)
    for name in SIGNALS:
        if name not in changes:
            raise Refused(f"the dump has no {name}")
    width, height = x_of(STOP) + 20, TOP + ROW * len(SIGNALS) + 24
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
             "<title>burnish_stream under two stalls, as simulated</title>", "<style>", FONT, "@media (prefers-color-scheme:dark){",
             *(f'[{what}="{light}"]{{{what}:{dark}}}' for what, light, dark in DARK), "}", "</style>",
             f'<rect width="{width}" height="{height}" fill="#ffffff"/>']
    for time in range(START, STOP + 1, CLOCK):
        lines.append(f'<path d="M{x_of(time)},{TOP - HIGH - 8}V{height - 30}" stroke="{PALE}"/>')
        if time < STOP:
            lines.append(text_at(x_of(time) + 5 * SCALE, TOP - HIGH - 10, "middle", 10, (time - START) // CLOCK))
    for at, name in enumerate(SIGNALS):
        y = TOP + ROW * at + (4 if at > 0 else 0) + (8 if at > 3 else 0)
        lines.append(text_at(LEFT - 10, y - 6, "end", 13, name))
        bus = name in ("s_angle", "m_value")
        lines += draw_bus(changes, name, y) if bus else [draw_line(changes[name], y)]
    return "\n".join([*lines, "</svg>", ""])


def before(changes, time):
    return next((value for at, value in reversed(changes) if at < time), 0)


def after(changes, time):
    return before(changes, time + 0.5)


def draw_line(changes, y):
    path = f"M{x_of(START)},{y - after(changes, START) * HIGH}"
    for time, value in changes:
        if START < time < STOP:
            path += f"H{x_of(time) - 2}L{x_of(time) + 2},{y - value * HIGH}"
    return f'<path d="{path}H{x_of(STOP)}" fill="none" stroke="{INK}" stroke-width="1.5"/>'


def draw_bus(changes, name, y):
    """A value where its VALID is 1, and a dot at an edge where READY is, too."""
    valid, ready = changes[name[:2] + "valid"], changes[name[:2] + "ready"]
    lines, time = [], START
    while time < STOP:
        value, is_shown = after(changes[name], time), after(valid, time)
        end = time + CLOCK
        while end < STOP and after(valid, end) == is_shown and (not is_shown or after(changes[name], end) == value):
            end += CLOCK
        a, b, middle = x_of(time), x_of(end), y - HIGH / 2
        path = f"M{a + 2},{y}L{a - (2 if time > START else -2)},{middle:g}L{a + 2},{y - HIGH}"
        path += f"H{b - 2}L{b + (2 if end < STOP else -2)},{middle:g}L{b - 2},{y}Z"
        lines.append(f'<path d="{path}" fill="{"#ffffff" if is_shown else PALE}" stroke="{BLUE if is_shown else GREY}" stroke-width="1.5"/>')
        if is_shown:
            lines.append(text_at((a + b) / 2, middle + 4, "middle", 11, "%04X" % value))
        time = end
    for time in range(START + CLOCK, STOP + 1, CLOCK):
        if before(valid, time) and before(ready, time):
            lines.append(f'<circle cx="{x_of(time) - 3}" cy="{y - HIGH - 5}" r="3" fill="{RED}"/>')
    return lines
