"""The public headers as Markdown pages of the API reference.

Usage: headers.py FOLDER HEADER...: writes FOLDER/NAME.md for each HEADER of include/burnish

CONTRIBUTING.md says what it expects of a header: a doc block directly above each public item, `  name  text` per parameter, a
comment next to each field. Bodies of functions and everything between #if and #endif are skipped.
"""
import html
import os
import re
import string
import sys

KEYWORDS = set("const void int char float double size_t uint8_t uint16_t uint32_t uint64_t int16_t int32_t uint_fast16_t struct enum typedef unsigned define".split())
INLINE = r"(?:static inline|BURNISH_[A-Z0-9_]*INLINE)\b"


# ---- From lines to items ----

def comment_lines(text):
    """The lines of a comment without its markers; indentation beyond one space stays."""
    lines = re.sub(r"\s*\*/\s*$", "", text).split("\n")
    lines = [re.sub(r"^\s*/?\*", "", line) for line in lines]
    return [line[line.startswith(" "):].rstrip() for line in lines]


def name_of(declaration):
    """What a declaration declares, and its kind."""
    kind = re.match(r"typedef\s+([a-z]+)", declaration)
    for pattern, what in ((r"#define\s+(\w+)", "macro"), (r"}\s*(\w+)\s*;\s*$", kind and kind[1]), (r"^enum\s*{\W*(\w+)", "constants"),
                          (r"(\w+)\s*\(", "function type" if kind else "function"),
                          (r"(\w+)\s*;\s*(?:/\*.*)?$", "opaque type" if kind and kind[1] in ("struct", "union") else "type")):
        found = re.match(pattern, declaration) if pattern[0] == "#" else re.search(pattern, declaration)
        if found:
            return found[1], what
    raise ValueError("headers.py: no name in: " + declaration)


class Item:
    """A section, a text, or an entry: declarations that share a doc block."""

    def __init__(self, kind, lines, title=None):
        self.kind, self.lines, self.title, self.declarations = kind, lines, title, []


def is_public(name):
    """Macros that spell attributes are private to a header, and so is what it takes from one that it includes."""
    return not (name.endswith("_INLINE") or name in ("BURNISH_API", "BURNISH_THEORY_API", "BURNISH_Q15_AVR"))


def items_of(text):
    lines, items, doc, entry, depth = text.split("\n"), [], None, None, 0

    def gather(ends):
        taken = [lines.pop(0)]
        while not ends(taken[-1], "\n".join(taken)):
            taken.append(lines.pop(0))
        return "\n".join(taken)

    while lines:
        line, declaration = lines[0], None
        if re.match(r"#(if|endif)", line) or depth or re.match(r"#define\s+\w+_H$|#[^d]", line):
            depth += line.startswith("#if") and not line.endswith("_H")
            doc = doc if depth == 0 else None
            depth = max(0, depth - 1) if line.startswith("#endif") else depth
            lines.pop(0)
        elif line.startswith("#define"):
            declaration = gather(lambda last, _: not last.endswith("\\"))
        elif line.startswith("/*") or not line.strip():
            comment = comment_lines(gather(lambda last, _: "*/" in last)) if line.strip() else lines.pop(0) and None
            entry, title = None, comment and re.match(r"---- (.*?) ---", comment[0])
            if doc and not title:
                items.append(Item("text", doc))
            if title:
                items.append(Item("section", comment[1:], title[1]))
            doc = doc if title else comment
        elif re.match(INLINE, line):
            head = gather(lambda last, _: "{" in last)
            if not head.endswith("}"):
                gather(lambda last, _: last.startswith("}"))
            declaration = re.sub(r"\s*{.*", ";", head.replace("\n", " "))
        elif re.match("[A-Za-z]", line) and not line.startswith("extern"):
            declaration = gather(lambda _, all: all.count("{") == all.count("}") and re.sub(r"/\*.*?\*/", "", all, flags=re.S).rstrip().endswith(";"))
        else:
            lines.pop(0)
        if declaration:
            if not entry:
                entry, doc = Item("entry", doc or []), None
                items.append(entry)
            entry.declarations.append(declaration)
    return [item for item in items if item.kind != "entry" or is_public(name_of(item.declarations[0])[0])]


def rows_of(declaration):
    """The rows of an X macro: X(OK, 0, "success") ..."""
    text = re.sub(r"^#define\s+\w+\(X\)", "", declaration.replace("\\\n", " "))
    calls = re.findall(r'X\(((?:"[^"]*"|[^()"]|\([^()]*\))*)\)', text)
    return [[re.sub(r'"\s+"', "", cell.strip()) for cell in re.findall(r'((?:"[^"]*"|[^,"])+)', call)] for call in calls]


def members_of(declaration, lists):
    """(text, lines of its comment) of each member of a struct or an enum."""
    body = declaration[declaration.index("{") + 1:declaration.rindex("}")]
    ends = "," if re.match("(typedef )?enum", declaration) else ";"
    members, above = [], None
    prefix, expanded = re.search(r"#define \w+\([^)]*\) (\w*?)##name", body), re.search(r"\n\s*(\w+_LIST)\(\w+\)", body)
    body = re.sub(r"#(define|undef)[^\n]*\n", "", body)
    if prefix and expanded:
        members = [[prefix[1] + row[0], [row[-1].strip('"')] if row[-1].startswith('"') else None] for row in lists[expanded[1]]]
        body = body.replace(expanded[0], "", 1)
    gap = ""
    for piece in [*re.findall(rf"/\*.*?\*/|(?:(?!/\*)[^{ends}])+{ends}?", body, re.S), ends]:
        lines = [line.strip() for line in comment_lines(piece)] if piece.startswith("/*") else None
        if lines and members and "\n" not in gap and not gap.strip():
            members[-1][1] = lines
        elif lines and not gap.strip():
            above = lines
        elif lines or piece.endswith(ends):  # the last of an enum has no comma
            text = " ".join((gap if lines else gap + piece[:-1]).split())
            members += [[text, lines or above]] if text else []
            above = None
        gap = "" if lines or piece.endswith(ends) else piece
    return members


def member_name(text):
    return (re.search(r"\(\*(\w+)\)", text) or re.search(r"(\w+)\s*$", re.sub(r"\s*=.*|\[.*", "", text)))[1]


# ---- From text to Markdown ----

def escape(text):
    return re.sub(f"[{re.escape(string.punctuation)}]", r"\\\g<0>", text)


def raw(text):
    return ["```{=html}", text, "```", ""]


class Reference:
    """All headers: which public name is where."""

    def __init__(self, paths):
        self.headers, self.lists, self.symbols, self.fields, self.statuses = {}, {}, {}, set(), {}
        for path in paths:
            with open(path, encoding="utf-8") as file:
                self.headers[os.path.basename(path)[:-2]] = items_of(file.read())
        for header, items in self.headers.items():
            self.symbols[header + ".h"] = page = header + ".html"
            for declaration in (declaration for item in items for declaration in item.declarations):
                own, kind = name_of(declaration)
                self.symbols[own] = f"{page}#{own}"
                if own.endswith("_LIST"):
                    self.lists[own] = rows_of(declaration)
                if kind in ("struct", "enum", "constants"):
                    names = [member_name(text) for text, _ in members_of(declaration, self.lists)]
                    if kind == "struct":
                        self.fields.update(f"{own}.{name}" for name in names)
                    else:
                        self.symbols.update((name, f"{page}#{name}") for name in names if name not in self.symbols)
        for words, prefix in (("BURNISH_LOBE_STATUS_LIST", "lobe.html#BURNISH_LOBE_"), ("BURNISH_STATUS_LIST", "core.html#BURNISH_STATUS_")):
            self.statuses.update((row[0], prefix + row[0]) for row in self.lists[words])

    def prose(self, text, errors=False):
        """Names become links, words with an underscore and `quoted` ones code."""
        def token(match):
            quoted, page, header, word, called = match.groups()
            if quoted:
                return f"`{quoted}`"
            if page:
                return f"[{escape(match[0])}](../{page}.html)"
            if header and header in self.symbols:
                return f"[`{match[0]}`]({self.symbols[header]})"
            if header:
                return escape(match[0])
            target = self.statuses.get(word) if errors else None
            target = target or self.symbols.get(word)
            if called and called.startswith("."):
                if word + called in self.fields:
                    return f"[`{word + called}`]({self.symbols[word] + called})"
                return token(re.fullmatch(TOKEN, word)) + self.prose(called, errors)
            if target:
                return f"[`{word}`]({target})"
            return f"`{word}`" if "_" in word or re.match(r"burnish\w", word) else match[0].replace("()", r"\(\)")

        out, at = [], 0
        for match in re.finditer(TOKEN, text):
            out += [escape(text[at:match.start()]), token(match)]
            at = match.end()
        return "".join(out) + escape(text[at:])

    def paragraph(self, text):
        if text.startswith("Errors:"):
            return ["::: errors", self.prose(text, True), ":::", ""]
        title = re.match(r"(What it [a-z ]+[.:]|How to use it\.)(.*)", text)
        return [f"**{self.prose(title[1])}**{self.prose(title[2])}" if title else self.prose(text), ""]

    def blocks(self, lines):
        """Markdown of a doc block's lines."""
        out, text, at = [], [], 0

        def flush():
            # The formatter of the sources joins lines; these words begin a paragraph.
            parts = re.sub(r"([.)]) (?=(?:Errors: |Sources?[:.] ))", r"\1\n", " ".join(text)).split("\n")
            out.extend(line for part in parts if part for line in self.paragraph(part))
            text.clear()

        while at < len(lines):
            line = lines[at]
            indent = len(line) - len(line.lstrip())
            item = re.match(r" *(\d+\. |- )", line)
            term = re.match(r"  ([A-Za-z_][\w, -]*?)  +(\S.*)$", line)
            end = at + 1
            while end < len(lines) and (not lines[end] or len(lines[end]) - len(lines[end].lstrip()) > (1 if not item and not term and indent > 1 else indent)):
                end += 1
            while not lines[end - 1] and end > at + 1:
                end -= 1
            if not line:
                flush()
            elif item:
                flush()
                inner = [line[item.end():]] + [other[indent + len(item[1]):] for other in lines[at + 1:end]]
                out.extend(self.indented(("-   " if item[1] == "- " else "1.  "), inner))
                at = end - 1
            elif term and not re.search(r"\S   +\S", term[2]):
                flush()
                out.extend([f"`{term[1]}`", "", *self.indented(":   ", [term[2], *(other.strip() for other in lines[at + 1:end])])])
                at = end - 1
            elif indent >= 2:
                flush()
                least = min(len(other) - len(other.lstrip()) for other in lines[at:end] if other)
                code = "\n".join(other[least:] for other in lines[at:end])
                out.extend(["```" + (" c" if re.search(r"[;{]\s*\n", code) else ""), code, "```", ""])
                at = end - 1
            else:
                if re.match(r"Errors:|Returns |Sources?[:.]", line):
                    flush()
                text.append(line)
            at += 1
        flush()
        return out

    def indented(self, mark, lines):
        inner = "\n".join(self.blocks(lines)).split("\n")
        return [mark + inner[0], *("    " + line if line else line for line in inner[1:])]

    # ---- From items to pages ----

    def code(self, text, own):
        """C as HTML: names of types are links, the declared name is bold."""
        def word(match):
            name = match[0]
            if name == own:
                return f"<b>{name}</b>"
            if name in KEYWORDS:
                return f'<span class="kw">{name}</span>'
            return f'<a href="{self.symbols[name]}">{name}</a>' if name in self.symbols else name

        parts = re.split(r"([A-Za-z_]\w*)", text)
        return "".join(re.sub(r".+", word, part) if at % 2 else html.escape(part) for at, part in enumerate(parts))

    def members(self, declaration, doc):
        """The members of a struct or an enum; one without a comment of its own takes what the doc block says of its name."""
        name, kind = name_of(declaration)
        out = [f"::: {{.members .{'fields' if kind == 'struct' else 'constants'}}}", ""]
        for text, lines in members_of(declaration, self.lists):
            own = member_name(text)
            anchor = f"{name}.{own}" if kind == "struct" else own
            term = f'<dt><code id="{anchor}">{self.code(text, own)}</code></dt>\n<dd>'
            out += raw(("<dl>\n" if len(out) == 2 else "</dd>\n") + term) + self.blocks(lines or doc.get(own, []))
        return out + raw("</dd>\n</dl>") + [":::", ""]

    def rows_table(self, declaration, doc):
        """The rows of an X macro as a table, whose header row is what the doc block says of X(...)."""
        heads = re.search(r"X\((.*?)\)", " ".join(doc))
        rows = rows_of(declaration)
        heads = [self.prose(head.strip()) for head in heads[1].split(",")] if heads else []
        heads += [""] * (len(rows[0]) - len(heads))
        cells = [[self.prose(cell.strip('"')) if cell[:1] == '"' or not re.search("[A-Za-z]", cell) else f"`{cell}`" for cell in row] for row in rows]
        lines = ["| " + " | ".join(row) + " |" for row in [heads, *cells]]
        return [lines[0], "|" + "---|" * len(heads), *lines[1:], ""]

    def entry(self, item):
        name, kind = name_of(item.declarations[0])
        title = name
        if kind == "constants":  # an enum without a name is known by what its constants' names begin with
            names = [member_name(text) for text, _ in members_of(item.declarations[0], self.lists)]
            start = os.path.commonprefix(names)
            name = start[:start.rfind("_") + 1] or start
            title = name + "…"
        shown, after, lines = [], [], item.lines
        for declaration in item.declarations:
            own, what = name_of(declaration)
            if own in self.lists:
                after += self.rows_table(declaration, item.lines)
            elif what in ("struct", "enum", "constants"):
                lines, doc = take_definitions(lines, [member_name(text) for text, about in members_of(declaration, self.lists) if not about])
                after += self.members(declaration, doc)
            else:
                anchor = f'<span id="{own}"></span>' if own != title else ""
                text = " ".join(declaration.replace("\\\n", " ").split()) if what == "macro" else signature(declaration)
                shown.append(anchor + self.code(text, own))
        out = [f"### `{title}` {{#{name} .item kind=\"{kind}\"}}", ""]
        out += raw('<pre class="signature"><code>' + "\n".join(shown) + "</code></pre>") if shown else []
        return out + self.blocks(lines) + after

    def page(self, header):
        out = [f"# `burnish/{header}.h`", ""]
        for at, item in enumerate(self.headers[header]):
            if item.kind == "entry":
                out += self.entry(item)
                continue
            lines = [line for line in item.lines if not re.match("SPDX|Copyright", line)]
            if item.kind == "section":
                out += [f"## {self.prose(item.title)} {{#{re.sub('[^a-z0-9]+', '-', item.title.lower())}}}", ""]
            elif at == 0:
                lines[0] = re.sub(r"^burnish/\w+\.h: ", "", lines[0])
                lines[0] = lines[0][:1].upper() + lines[0][1:]
            out += self.blocks(lines)
        return "\n".join(out)


TOKEN = r"`([^`]+)`|docs/(\w+)\.md|(?:burnish/)?\b([A-Za-z]\w*\.h)\b|([A-Za-z_]\w*)(\(\)|\.[A-Za-z_]\w*)?"


def take_definitions(lines, names):
    """The lines without definitions of the names, and {name: lines} of these."""
    rest, taken, at = [], {}, 0
    while at < len(lines):
        term = re.match(r"  ([A-Za-z_]\w*)  +(\S.*)$", lines[at])
        if term and term[1] in names:
            taken[term[1]] = [term[2]]
            while at + 1 < len(lines) and lines[at + 1].startswith("   "):
                at += 1
                taken[term[1]].append(lines[at].strip())
        else:
            rest.append(lines[at])
        at += 1
    return rest, taken


def signature(declaration):
    """Without what only compilers read; one parameter a line if it is long."""
    text = " ".join(re.sub(rf"BURNISH_(?:THEORY_)?API |{INLINE} ?", "", declaration).split()).replace("( ", "(")
    parts = re.match(r"(.*?\()(.*)\);$", text) if len(text) > 76 else None
    return f"{parts[1]}\n    " + parts[2].replace(", ", ",\n    ") + ");" if parts else text


def main(folder, *paths):
    reference = Reference(paths)
    for header in reference.headers:
        with open(os.path.join(folder, header + ".md"), "w", encoding="utf-8") as file:
            file.write(reference.page(header) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
