"""Prints a shader with its includes in place, each once. Usage: includes.py FILE"""
import os
import re
import sys


def show(path, seen):
    path = os.path.normpath(path)
    if path in seen:
        return
    seen.add(path)
    for line in open(path, encoding="utf-8"):
        include = re.match(r'#include "(.*)"', line)
        if include:
            show(os.path.join(os.path.dirname(path), include[1]), seen)
        else:
            sys.stdout.write(line)


show(sys.argv[1], set())
