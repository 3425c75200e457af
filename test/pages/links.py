"""Checks links of Markdown files, as GitHub renders them, or of the site: each file and each heading must exist.

links.py FOLDER FILE...      Markdown files below FOLDER, their names relative to it
links.py --site FOLDER       every .html below FOLDER; pages load nothing from other servers, and each is linked from another
"""
import os
import re
import sys

FENCE = re.compile(r"^(```|~~~).*?^\1[ \t]*$", re.M | re.S)
COMMENT = re.compile(r"<!--.*?-->", re.S)
CODE = re.compile(r"(`+)(.+?)\1")


def blank(match):
    """Keeps the number of lines, for the line numbers of messages."""
    return "\n" * match.group(0).count("\n")


def slug(heading):
    """GitHub's anchor of a heading."""
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    text = re.sub(r"[`*]|<[^>]*>", "", text).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


class Markdown:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            text = COMMENT.sub(blank, FENCE.sub(blank, file.read()))
        self.anchors = set()
        for heading in re.findall(r"^#{1,6}[ \t]+(.+?)[ \t#]*$", text, re.M):
            name, number = slug(heading), 0
            while name + (f"-{number}" if number else "") in self.anchors:
                number += 1
            self.anchors.add(name + (f"-{number}" if number else ""))
        self.links = []
        for number, line in enumerate(text.split("\n"), 1):
            line = CODE.sub("", line)
            self.links += [(number, target) for target in re.findall(r"\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)", line)]


class Page:
    def __init__(self, path):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        ids = re.findall(r"\sid=\"([^\"]+)\"", text)
        self.anchors = set(ids)
        self.doubled = sorted({name for name in ids if ids.count(name) > 1}) if len(ids) > len(self.anchors) else []
        self.links = []
        for number, line in enumerate(re.sub(r"<pre.*?</pre>", keep_links, text, flags=re.S).split("\n"), 1):
            self.links += [(number, target.replace("&amp;", "&")) for target in re.findall(r"\s(?:href|src)=\"([^\"]*)\"", line)]
        self.loads = re.findall(r"<(?:script|img|link|iframe|source|use)\b[^>]*?\s(?:src|href)=\"((?:https?:)?//[^\"]*)\"", text)


def keep_links(match):
    return "".join(re.findall(r"<a [^>]*>|\n", match.group(0)))


def check(paths, read, outside):
    pages, problems, count = {}, [], 0
    reached = set()
    for path in paths:
        page = pages.setdefault(path, read(path))
        problems += [f"{path}: loads from another server: {load}" for load in getattr(page, "loads", [])]
        problems += [f"{path}: two headings or names have the anchor {name}" for name in getattr(page, "doubled", [])]
        for line, target in page.links:
            count += 1
            if re.match(r"[a-z]+:", target):
                if outside and not re.match(r"(https?|mailto):", target):
                    problems.append(f"{path}:{line}: {target}")
                continue
            name, _, anchor = target.partition("#")
            other = os.path.normpath(os.path.join(os.path.dirname(path), name)) if name else path
            reached.add(other)
            if not os.path.exists(other):
                problems.append(f"{path}:{line}: {target}: {other} does not exist")
            elif anchor and other.endswith((".md", ".html")):
                if other not in pages:
                    pages[other] = read(other)
                if anchor not in pages[other].anchors:
                    problems.append(f"{path}:{line}: {target}: {other} has no heading {anchor}")
    return problems, count, reached


def main():
    if sys.argv[1] == "--site":
        os.chdir(sys.argv[2])
        paths = sorted(os.path.normpath(os.path.join(folder, name)) for folder, _, names in os.walk(".")
                       for name in names if name.endswith(".html") and not folder.startswith("./explorer"))
        problems, count, reached = check(paths, Page, True)
        problems += [f"{path}: no page links to it" for path in paths if path not in reached]
    else:
        os.chdir(sys.argv[1])
        paths = sys.argv[2:]
        problems, count, _ = check(paths, Markdown, True)
    print("\n".join(problems + [f"links: {len(paths)} pages, {count} links, {len(problems)} broken"]))
    return bool(problems) or count < 50


sys.exit(main())
