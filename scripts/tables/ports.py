"""The parameters and ports of hardware/rtl's top modules, read from the Verilog, for docs/hardware.md and VHDL."""
import os
import re

from page import ROOT, Refused, fill, read, table, write

MODULES = "taylor shift7 shift3 energy zeta lobe boundary stream axis register wishbone axi_lite pixel pixel_stream light channel highlight dot chord normalize".split()
VHDL_HEAD = """-- burnish_components: the modules of rtl/ for VHDL, as scripts/tables rtl-ports reads them from the Verilog.
--
-- Compile it with the Verilog in a tool that takes both languages.
--
-- SPDX-License-Identifier: MIT
-- Copyright (c) the burnish authors
library ieee;
use ieee.std_logic_1164.all;

package burnish_components is
    -- Widths that a parameter chooses.
    function choose(condition : boolean; yes, no : natural) return natural;

"""
VHDL_END = """end package;

package body burnish_components is
    function choose(condition : boolean; yes, no : natural) return natural is
    begin
        if condition then
            return yes;
        end if;
        return no;
    end function;
end package body;
"""


def rtl_ports(page, vhdl):
    """PAGE VHDL: the parameters and ports of hardware/rtl's modules as tables of docs/hardware.md and as VHDL components"""
    modules = {f"burnish_{name}": declarations(f"burnish_{name}") for name in MODULES}
    lines = []
    for module, items in modules.items():
        rows = table("name|kind|width or default|meaning", [[f"`{name}`", kind, shown(kind, width), meaning] for kind, name, width, meaning in items])
        lines += ["", f"### {module}", "", rows[0], "| --- | --- | --- | --- |", *rows[2:]]
    fill(page, {"ports": lines[1:]}, ("MAC", "RAM"), keep=True)
    write(vhdl, VHDL_HEAD + "".join(component(module, items) for module, items in modules.items()) + VHDL_END)


def declarations(module):
    """(kind, name, width or default, meaning): one per line of the module's head, the meaning as the line's comment."""
    items, inside = [], False
    path = next(path for path in (f"hardware/rtl/{folder}{module}.v" for folder in ("", "bus/")) if os.path.exists(f"{ROOT}/{path}"))
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


def shown(kind, width):
    width = "= " + width if kind == "parameter" else re.sub(r"^\(([^()]*)\)$", r"\1", width)
    return f"`{width}`" if re.search('[A-Z"]', width) else width


def component(module, items):
    """A width "(a == 4 ? x : y)" becomes choose(a = 4, x, y); FILE, a keyword of VHDL, becomes an extended identifier."""
    groups = {True: [], False: []}
    for kind, name, width, meaning in items:
        name = "\\FILE\\" if name == "FILE" else name
        if kind == "parameter":
            text = f"{name} : {'string' if width.startswith(chr(34)) else 'integer'} := {width}"
        else:
            def choose(match):
                return f"choose({match[1]} {'=' if match[2] == '==' else '/='} {match[3]}, {match[4]}, {match[5]})"

            high = str(int(width) - 1) if width.isdigit() else re.sub(r"\(([A-Z]+) ([!=]=) (\d+) \? (\d+) : (\d+)\)", choose, width) + " - 1"
            text = f"{name} : {'in' if kind == 'input' else 'out'} std_logic" + ("" if width == "1" else f"_vector({high} downto 0)")
        groups[kind == "parameter"].append((text, meaning))
    parts = []
    for lines in groups.values():
        parts.append("".join(f"            {text}{';' if at < len(lines) else ''}  -- {meaning}\n" for at, (text, meaning) in enumerate(lines, 1)))
    return f"    component {module} is\n        generic (\n{parts[0]}        );\n        port (\n{parts[1]}        );\n    end component;\n\n"
