"""Markdown tables, their places in a page, and the refusal of numbers that cannot be right."""
import csv
import os
import re
import shutil
import subprocess

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
END = "<!-- end of table -->"


class Refused(Exception):
    """A one-line message for the user, and the exit code."""

    def __init__(self, text, code=1):
        super().__init__(text)
        self.code = code


def need(group, *tools):
    for tool in tools:
        if not shutil.which(tool):
            raise Refused(f"{tool} is missing; run scripts/install-deps {group}", 77)


def run(*command, **options):
    """The command's standard output."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, stdin=subprocess.DEVNULL, **options)
    if done.returncode:
        last = (done.stderr + done.stdout).strip().rpartition("\n")[2]
        raise Refused(f"{command[0]} ended with exit code {done.returncode}: {last}")
    return done.stdout


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    """Leaves a file that already holds the text as it is, with its time."""
    if not os.path.exists(path) or read(path) != text:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


def csv_rows(text):
    """The rows below the header row."""
    return list(csv.reader(text.splitlines()))[1:]


def number(value, form):
    """A number or its text; a dash if there is none."""
    return "–" if value in ("", None) else form % float(value)


def row(cells):
    return "|" + "".join(f" {cell} |" if cell != "" else " |" for cell in cells)


def table(heads, rows, left=1):
    """Lines of Markdown. Only the first `left` columns are aligned to the left."""
    heads = heads.split("|") if isinstance(heads, str) else heads
    return [row(heads), row(["---"] * left + ["---:"] * (len(heads) - left)), *map(row, rows)]


def grid(heading, cells, form, column="%s"):
    """A table of (column, row, value) in order of appearance; combinations without a value are empty."""
    values = {(line, name): value and form % (value if form == "%s" else float(value)) for name, line, value in cells}
    columns = list(dict.fromkeys(name for name, _, _ in cells))
    lines = list(dict.fromkeys(line for _, line, _ in cells))
    return table([heading, *(column % name for name in columns)], [[line, *(values.get((line, name), "") for name in columns)] for line in lines])


def check(page, text, exceptions=(), empty=False):
    """Refuses a table with a cell that is 0, empty, nan or inf, a row as long as no heading, or no rows at all.

    The first column may hold anything, and columns headed by one of the exceptions may hold 0; empty allows empty cells.
    """
    heads, checked = None, 0
    for at, line in enumerate([*text.splitlines(), ""], 1):
        where = f"{page}: line {at}"
        if not line.startswith("|"):
            if heads and rows < 2:
                raise Refused(f"{where}: expected rows below the heading, found none; fix the script that fills the table")
            heads = None
            continue
        cells = [cell.strip() for cell in line.split("|")[1:-1]]
        if heads is None:
            heads, rows = cells, 0
            continue
        rows += 1
        if len(cells) != len(heads):
            raise Refused(f"{where}: expected {len(heads)} cells as in the heading, found {len(cells)}")
        for head, cell in list(zip(heads, cells))[1:] if rows > 1 else []:
            checked += 1
            wrong = not empty if cell == "" else re.fullmatch(r"[-+]?[.0]*0[.0]*", cell)
            if re.search(r"(?<![a-z])(nan|inf)(?![a-z])", cell.lower()) or (wrong and head not in exceptions):
                raise Refused(f"{where}: row {cells[0]}, column {head}: expected a number above 0, found \"{cell}\"; fix the script that fills the table")
    if not checked:
        raise Refused(f"{page}: expected a table, found none")


def filled(page, tables, keep=False):
    """The page's text with the tables ({name: lines}) in their places; with keep, the tables that are not made stay."""
    out, inside, found = [], None, set()
    for at, line in enumerate(read(page).splitlines(), 1):
        if line.startswith("<!-- table: "):
            if inside is not None:
                raise Refused(f"{page}: line {at}: expected \"{END}\" before it")
            inside = line.split()[2]
            found.add(inside)
            if inside not in tables and not keep:
                raise Refused(f"{page}: line {at}: no table {inside} was made")
            out += [line, "", *tables[inside], ""] if inside in tables else [line]
            continue
        if line.startswith(END):
            inside = None
        if inside not in tables:
            out.append(line)
    if inside is not None:
        raise Refused(f"{page}: the last table has no line \"{END}\"; add it")
    for name in sorted(set(tables) - found):
        raise Refused(f"{page}: expected a line \"<!-- table: {name} -->\", found none; add it")
    return "\n".join(out) + "\n"


def fill(page, tables, exceptions=(), keep=False, empty=False):
    text = filled(page, tables, keep)
    check(page, text, exceptions, empty)
    write(page, text)
