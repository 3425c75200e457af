"""Fills the tables and draws the figures of the pages in docs/.

Usage: python3 scripts/tables NAME ARGUMENT..., or NAME alone for its arguments.
"""
import glob
import inspect
import os
import sys

sys.dont_write_bytecode = True

import drawings
import files
import latency
import lobes
import machine_code
import measurements
import page
import rtl


def check(name, *exceptions):
    """[--empty] PAGE [HEADING...]: refuses a table whose numbers can't be right; those below a HEADING may be 0; --empty: cells may be empty"""
    empty = name == "--empty"
    name, *exceptions = exceptions if empty else (name, *exceptions)
    page.check(name, page.read(name), exceptions, empty)


def fill(folder, name, *exceptions):
    """[--keep] FOLDER PAGE [HEADING...]: fills the page with FOLDER/NAME for its table NAME, and checks it; --keep: other tables stay"""
    keep = folder == "--keep"
    folder, name, *exceptions = (name, *exceptions) if keep else (folder, name, *exceptions)
    tables = {os.path.basename(path): page.read(path).splitlines() for path in glob.glob(os.path.join(folder, "*"))}
    page.fill(name, tables, exceptions, keep, empty=keep)


COMMANDS = [check, fill, lobes.theory, lobes.figures, measurements.performance, measurements.frames, measurements.scale, measurements.shaders,
            files.importers, files.gallery, machine_code.firmware, machine_code.operations, rtl.rtl,
            drawings.rtl_area, drawings.rtl_wave, latency.rtl_latency]


def main(arguments):
    commands = {command.__name__.replace("_", "-"): command for command in COMMANDS}
    command = commands.get(arguments[0] if arguments else "")
    if not command:
        return __doc__ + "".join(f"\n  {name} {command.__doc__.splitlines()[0]}" for name, command in commands.items())
    try:
        inspect.signature(command).bind(*arguments[1:])
    except TypeError:
        return f"Usage: python3 scripts/tables {arguments[0]} {inspect.getdoc(command)}"
    try:
        return command(*arguments[1:])
    except page.Refused as refused:
        print(f"tables: {refused}", file=sys.stderr)
        return refused.code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
