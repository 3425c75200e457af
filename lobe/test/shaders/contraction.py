"""Fails where an add or subtraction of a product may be fused. Usage: contraction.py DISASSEMBLY
Both must be decorated NoContraction, or the compiler may make a fused multiply-add of them.
At least ten such adds must be there, or nothing has been tried."""
import re
import sys

text = open(sys.argv[1], encoding="utf-8").read()
marked = set(re.findall(r"OpDecorate (%\w+) NoContraction", text))
operations = dict(re.findall(r"(%\w+) = (Op\w+ .*)", text))
products = {name for name, body in operations.items() if re.match(r"Op(FMul|VectorTimesScalar) ", body)}
adds = 0
for name, body in operations.items():
    if re.match(r"Op(FAdd|FSub) ", body):
        for operand in set(body.split()[2:]) & products:
            adds += 1
            if name not in marked:
                sys.exit(f"{name} = {body} may be fused with {operand} = {operations[operand]}")
if adds < 10:
    sys.exit(f"expected at least 10 adds of products, found {adds}")
