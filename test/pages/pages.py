"""Compares pages and comments with the program: commands, flags, make targets, hashes, numbers, file names.

pages.py PROGRAM SOURCE_DIR SCRATCH

Commands. Lines of a page's code blocks, a page's `burnish ...` and the examples of the help screens are run, each in a folder
with stand-ins for the reader's files. So are commands in comments, if every word looks like a flag, a value or a file.
Other mentions of a command (with a placeholder in capitals, in prose, or listed in pages.txt) must use its existing flags.
The test guides runs the blocks marked sh in docs/guides.
Hashes. 16 hexadecimal digits in a page must be printed by the command in the comment above their paragraph or block:
    <!-- prints: burnish render :teapot --json -->
Hashes in comments of sources must be in test/golden/pixels.txt.
Numbers. pages.txt lists sentences with numbers, and the table cell or the command that each number comes from. A number of
cycles or LUTs in a page needs such a line, unless it is in a table that a script writes.
Names. Flags, make targets and their variables, CMake options, identifiers and files in pages must exist, and so must files and
targets in comments of sources. Images in pages need a text.
"""
import collections
import os
import re
import subprocess
import sys
import threading

PROGRAM, SOURCE, SCRATCH = (os.path.abspath(argument) for argument in sys.argv[1:4])
LIST = "test/pages/pages.txt"
problems = []
counts = collections.Counter()


def problem(path, line, text):
    problems.append(f"{path}:{line}: {text}")


# ---- The sources ----

def read_sources():
    """{path: lines} of every file of the tree; no lines for binary files, data and the changelog."""
    found = {}
    for folder, folders, names in os.walk(SOURCE):
        here = os.path.relpath(folder, SOURCE)
        folders[:] = [name for name in folders if (name[0] != "." or name == ".ci") and (here != "." or name not in ("build", "out", "shared"))]
        for path in (os.path.normpath(os.path.join(here, name)) for name in names):
            found[path] = []
            if re.match(r"test/(data|golden|fuzz/seeds)/|CHANGELOG.md", path) or path.endswith((".svg", ".csv", ".mem", ".igs")):
                continue
            try:
                with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
                    found[path] = file.read().split("\n")
            except UnicodeDecodeError:
                pass
    return found


FILES = read_sources()
PAGES = {path: lines for path, lines in FILES.items() if path.endswith(".md")}
RULES = collections.defaultdict(list) # of pages.txt: {keyword: [(line, rest)]}
for at, rule in enumerate(FILES[LIST], 1):
    if rule and not rule.startswith("#"):
        RULES[rule.split()[0]].append((at, rule.partition(" ")[2]))
exempt_used = set()


def exempt(keyword, text):
    """Whether a line "KEYWORD EXPRESSION -- REASON" of pages.txt matches the text."""
    found = [number for number, rest in RULES[keyword] if re.search(rest.split(" -- ")[0], text)]
    exempt_used.update(found)
    return bool(found)


def comment(path, line):
    """The part of a source line that is a comment, or looks like one."""
    shell = path.endswith((".py", ".txt", ".cmake", "Makefile")) or "." not in os.path.basename(path)
    found = re.search(r"(?:^|\s)#(?!include|define|if|el|end)(.*)" if shell else r"(?:/\*|//|^ \*|^\s+\*\s|^ {3}\w)(.*)", line)
    return found.group(1) if found else ""


def prose_lines():
    """(path, line number, line, its text or comment) of all pages and comments."""
    for path, lines in FILES.items():
        for number, line in enumerate(lines, 1):
            text = line if path in PAGES else comment(path, line)
            if text and path != LIST:
                yield path, number, line, text


# ---- The program ----

def run(command, folder=None):
    """Exit code and output of a command line in a new folder with the stand-ins."""
    if folder is None:
        counts["folders"] += 1
        folder = os.path.join(SCRATCH, f"{threading.get_ident()}-{counts['folders']}")
        subprocess.run(["cp", "-R", os.path.join(SCRATCH, "stand-ins"), folder], check=True)
    environment = dict(os.environ, PATH=os.path.join(SCRATCH, "bin") + ":" + os.environ["PATH"], BURNISH=SOURCE)
    try:
        done = subprocess.run(["sh", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=100)
    except subprocess.TimeoutExpired:
        return 124, "still running after 100 seconds"
    return done.returncode, done.stdout.decode("utf-8", "replace")


def make_stand_ins():
    """Creates the reader's own files from the lines of pages.txt."""
    subprocess.run(["rm", "-rf", SCRATCH], check=True)
    os.makedirs(os.path.join(SCRATCH, "bin"))
    os.makedirs(os.path.join(SCRATCH, "stand-ins"))
    os.symlink(PROGRAM, os.path.join(SCRATCH, "bin", "burnish"))
    for number, rest in RULES["file"]:
        names, command = rest.split(" <- ")
        code, output = run(f"mkdir -p $(dirname {names}) && ({command}) >made && for name in {names}; do cp made $name; done; rm made",
                           os.path.join(SCRATCH, "stand-ins"))
        if code != 0:
            problem(LIST, number, output)


def read_flags():
    """{command: its flags}, "lobe table" being one command; those of one letter are in the help screens only."""
    script = run("burnish help --completion=bash")[1]
    known = {name: set(re.findall(r"--[a-z][a-z-]*", words)) | {"-h"} for name, words in
             re.findall(r"^    '([a-z -]+)'\)\n +flags='([^']*)'", script, re.M)}
    for name in known:
        screen = run(f"burnish {name} --help=all || burnish {name} --help")[1]
        known[name].update(re.findall(r"^ +(-[a-zA-Z]), --", screen, re.M))
    return known


make_stand_ins()
FLAGS = read_flags()
COMMANDS = "|".join([*FLAGS, "lobe"])


# ---- Commands ----

def is_known(path, number, words):
    """Whether the words behind "burnish" are a command of it and flags of that command."""
    counts["named"] += 1
    words = [re.sub(r"^[\[(]+|[\])!?.,;:…]+$", "", word) for word in words]
    if not words or not words[0] or not re.match("[a-z]", words[0]):
        return True
    if "." in words[0]:  # a file: render is implied
        words.insert(0, "render")
    name = " ".join(words[:2]) if words[0] == "lobe" and re.match(r"[a-z]+$", " ".join(words[1:2])) else words[0]
    if name != "lobe" and name not in FLAGS:
        problem(path, number, f"there is no command \"burnish {name}\"; burnish --help lists them")
        return False
    named = [flag.group(0) for flag in (re.match(r"--?[a-z][a-z-]*", word) for word in words) if flag]
    wrong = [flag for flag in named if name in FLAGS and flag not in FLAGS[name]]
    for flag in wrong:
        problem(path, number, f"burnish {name} has no flag {flag}")
    return not wrong


def mentions(path, lines):
    """(line number, command, whether it may be run) of a file."""
    kind = None # of the code block: the word behind its fence
    for number, line in enumerate(lines, 1):
        if path in PAGES:
            fence = re.match(r"\s*```(\w*)", line)
            if fence:
                kind = fence.group(1) if kind is None else None
            line = re.sub(r"^\s*- run: ", "", line).strip()
            if kind in ("", "sh", "yaml") and re.search(rf"(^|[|;] *|exec )burnish [a-z-]|\bburnish(-mpi)? ({COMMANDS}) ", line):
                yield number, line, kind != "sh" or not path.startswith("docs/guides/")
            for span in re.findall(r"`(?:[\w-]+ [^`]*\| )?(burnish [^`]*)`", line):
                yield number, span, kind is None
            continue
        text = comment(path, line)
        line = text if path.startswith("test/") else line # tests have commands that fail
        found = re.findall(r"`(burnish [^`$]*)`", line)
        if path.endswith((".c", ".h")): # in quotes, and bold in texts of the manual
            found += re.findall(rf'(?<![\w`])[*"](burnish (?:{COMMANDS})\b[^"*\\`]*)', line)
        if not found:
            found = re.findall(r"(?<![\w`*\"])(burnish (?:(?!with )[a-z-]+ -|lobe [a-z]+ -|[a-z]+ :)[^\"`*)]*)", line)
        for command in found:
            words = command.split()[1:]
            prose = [word for word in words[2 if words[0] == "lobe" else 1:] if not re.search(r"[-.:=\d]", word)]
            yield number, command.strip(), bool(text) and not prose


def is_complete(command):
    """Whether a reader could type a command: it has no placeholder, and something to work on."""
    if re.search(r"\b[A-Z]{2,}\b(?!\.)|=[A-Z](,|\b)|\[|\.\.\.|%|\$[a-z]", re.sub(r"#.*", "", command)) or exempt("parsed", command):
        return False
    words = command.split()
    return words[1] in ("lobe", "help", "serve-stdio") and len(words) > 2 or any(not word.startswith("-") for word in words[2:])


def check_commands():
    everything = [(path, *mention) for path, lines in FILES.items() if not exempt("ignored", path) for mention in mentions(path, lines)]
    for name in ["", *FLAGS, "lobe"]:
        screen = run(f"burnish {name} --help")[1].partition("\nExamples\n")[2].partition("\n\n")[0]
        shown = re.findall(r"^  (\S*.*?burnish .*?)(?:   *|$)", screen, re.M)
        if not shown and name != "help":
            problem(f"burnish {name} --help", 0, "no examples")
        everything += [(f"burnish {name} --help", 0, re.sub(r"(\{\w+\}\S*|(?<==)\*\S+)", r"'\1'", line), True) for line in shown]
    complete = {}
    for path, number, command, may_run in everything:
        parts = re.findall(r"\bburnish(?:-mpi)? ((?:[^|;'\"`<>#]|'[^']*')*)", command)
        if all([is_known(path, number, part.split()) for part in parts]) and may_run and is_complete(command):
            complete.setdefault(command, []).append((path, number))
    waiting = list(complete)
    threads = [threading.Thread(target=run_commands, args=(waiting, complete)) for _ in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    counts["run"] = len(complete)
    if counts["run"] < 60 or counts["named"] < 300:
        problem(LIST, 0, f"only {counts['run']} commands are run and {counts['named']} read; the search misses some")


def run_commands(waiting, places):
    while True:
        try:
            command = waiting.pop()
        except IndexError:
            return
        plot = " lobe plot " in command # drawn by the test cli_figures, where gnuplot is
        code, output = run(command + " --format=csv -o -" if plot else command)
        if code not in ((0, 10) if re.search("compare|--reference", command) else (0,)):
            for path, number in places[command]:
                problem(path, number, f"exit code {code}: {command}: {' / '.join(output.splitlines()[-2:])[-300:]}")


# ---- Flags, make targets, CMake options, identifiers ----

def check_names():
    make = "\n".join(FILES["Makefile"] + FILES["scripts/job"])
    targets = set(" ".join(re.findall(r"^([a-z][a-z0-9 -]*)(?::|\) ##)", make, re.M)).split())
    code = "\n".join("\n".join(lines) for path, lines in FILES.items() if path not in PAGES and path != LIST)
    identifiers = set(re.findall(r"\bburnish_\w+|BURNISH_[A-Z0-9_]+", code))
    flags = set().union(*FLAGS.values(), {"--version"})
    for path, number, line, text in prose_lines():
        for target, variables in re.findall(r"(?:`|^(?:\./)?|&& )(?:\./)?make ([a-z][a-z0-9-]*)((?: [A-Z_]+=\S*)*)", text):
            counts["targets"] += 1
            missing = [name for name in re.findall(r" ([A-Z_]+)=", variables) if not re.search(rf"\b{name}\b", make)]
            if target not in targets or missing:
                problem(path, number, f"make {target}{variables}: the Makefile has no {missing[0] if missing else 'such target'}")
        if path in PAGES and not exempt("other-names", f"{path}:{line}"):
            names = re.findall(r"`(--[a-z][a-z-]*)|-D(BURNISH_[A-Z0-9_]+)|(?<![\w*-])(burnish_[a-z]\w+)(?![\w.*-])", line)
            for name in filter(None, sum(names, ())):
                if name not in (flags if name.startswith("-") else identifiers):
                    problem(path, number, f"there is no {name}")


# ---- Hashes ----

def with_commands(lines):
    """A page's (line number, line, command): the command of the comment above the paragraph or block that the line is in."""
    command, begun, fenced = None, False, False
    for number, line in enumerate(lines, 1):
        notation = re.match(r"<!-- prints: (.*) -->$", line)
        if notation:
            command, begun = notation.group(1), False
            continue
        fence = line.startswith("```")
        if begun and not fenced and not line.strip():
            command = None
        yield number, line, command
        begun = begun or bool(line.strip())
        command = None if fence and fenced else command
        fenced ^= fence


def check_hashes():
    hexadecimal = re.compile(r"\b(?=[0-9]*[a-f])(?=[a-f]*[0-9])[0-9a-f]{16}\b")
    printed = {None: "\n".join(open(os.path.join(SOURCE, "test/golden/pixels.txt"), encoding="utf-8"))}
    quoted = [(path, number, line, "pixels") for path, number, line, text in prose_lines() if path not in PAGES and hexadecimal.search(text)]
    quoted += [(path, *rest) for path, lines in PAGES.items() for rest in with_commands(lines)]
    for path, number, line, command in quoted:
        for value in hexadecimal.findall(line):
            counts["hashes"] += 1
            if command is None:
                problem(path, number, f"{value}: of which picture? Write <!-- prints: COMMAND --> above")
                continue
            if command not in printed:
                printed[command] = printed[None] if command == "pixels" else run(command)[1]
            if value not in printed[command]:
                now = "is not in test/golden/pixels.txt" if command == "pixels" else f"{command} prints {' '.join(hexadecimal.findall(printed[command]))}"
                problem(path, number, f"{value}: {now}")


# ---- Numbers ----

def value_of(source):
    """The number of PAGE[table][row][column], its row by the first cell; of "$ COMMAND"; of a quotient of two cells."""
    if source.startswith("$ "):
        return float(run(source[2:] if source.startswith("$ burnish ") else f"cd \"$BURNISH\" && {source[2:]}")[1])
    if "] / " in source:
        above, below = source.split(" / ")
        return value_of(above) / value_of(below)
    page, table, row, column = re.match(r"(\S+?)\[(.*?)\]\[(.*?)\]\[(.*?)\]$", source).groups()
    start = PAGES[page].index(f"<!-- table: {table} -->")
    rows = [[part.strip().replace("`", "") for part in line.strip("|").split("|")]
            for line in PAGES[page][start:PAGES[page].index("<!-- end of table -->", start)] if line.startswith("|")]
    text = next(cells for cells in rows if cells[0] == row)[rows[0].index(column)]
    return float(re.search(r"\d[\d.]*", text).group(0))


def check_numbers():
    covered = collections.defaultdict(str)
    for at, rule in RULES["number"]:
        path, sentence, *sources = (part.strip() for part in rule.split(" | "))
        text = "\n".join(FILES.get(path, []))
        pattern = r"\s+".join(re.escape(word).replace(r"\{\}", r"([\d.,]*\d)") for word in sentence.split())
        found = list(re.finditer(pattern, text))
        if not found or len(found[0].groups()) != len(sources):
            problem(LIST, at, f"{path} has no sentence \"{sentence}\" with {len(sources)} numbers; correct it here too")
            continue
        try:
            actual = [value_of(source) for source in sources]
        except (ValueError, KeyError, StopIteration, AttributeError, IndexError) as error:
            problem(LIST, at, f"a source has no number ({error!r})")
            continue
        for match in found:
            covered[path] += " " + match.group(0)
            for quoted, now, source in zip(match.groups(), actual, sources):
                counts["numbers"] += 1
                step = 10.0 ** -len(quoted.partition(".")[2])
                if abs(float(quoted.replace(",", "")) - now) > step * 0.5000001:
                    problem(path, text[:match.start()].count("\n") + 1, f"\"{match.group(0)}\": {quoted} is {now:g} in {source}")
    for path, lines in PAGES.items():
        table = False
        for number, line in enumerate(lines, 1):
            table = table and not line.startswith("<!-- end") or line.startswith("<!-- table:")
            for quoted in re.findall(r"[\d.]+ (?:cycles|LUT4|LUTs?)\b", line):
                if not table and quoted not in covered[path] and not exempt("other-numbers", f"{path}: {line}"):
                    problem(path, number, f"\"{quoted}\" is compared with nothing; add a line to {LIST}")


# ---- Files ----

def check_files():
    folders = {path[:match.start()] for path in FILES for match in re.finditer("/", path)}
    known = {*FILES, *folders, *(os.path.basename(path) for path in FILES)}
    top = "|".join(sorted({re.escape(path.split("/")[0]) for path in folders if "." not in path.split("/")[0]}))
    with_folder = re.compile(rf"(?<![\w/.$:{{}}<*\"-])(?:{top})(?:/[\w*{{}},.-]+)+(?<![.,])")
    alone = re.compile(r"(?<![\w/.$:{}<*\"'%=-])[a-z]\w*\.(?:c|h|cc|v|py|sh|md|mjs|shade|glsl)\b(?![\w/(.*=])")
    for path, number, line, text in prose_lines():
        if path in PAGES and re.search(r"!\[\s*\]", line):
            problem(path, number, "an image without a text; write what it shows")
        if path in PAGES:
            text = " ".join(re.findall(r"`([^`]*)`", line))
        names = [match.group(0) for match in with_folder.finditer(text) if not text.startswith(tuple("<$%({"), match.end())]
        for name in names + alone.findall(text):
            counts["files"] += 1
            if name in known or os.path.normpath(os.path.join(os.path.dirname(path), name)) in known:
                continue
            pattern = r"(?:.*/)?" + re.escape(name).replace(r"\*", "[^/]*").replace("NAME", r"\w+")
            if not any(re.fullmatch(pattern, other) for other in known) and not exempt("other-files", f"{path}:{name}"):
                problem(path, number, f"there is no {name}")


check_commands()
check_names()
check_hashes()
check_numbers()
check_files()
for keyword in ("parsed", "ignored", "other-names", "other-numbers", "other-files"):
    for at, rule in RULES[keyword]:
        if at not in exempt_used:
            problem(LIST, at, f"exempts nothing: {rule}")
print("\n".join(problems))
print("pages: " + ", ".join(f"{count} {name}" for name, count in counts.items() if name != "folders") + f"; {len(problems)} problems")
sys.exit(bool(problems))
