"""Every test has one label that says what it needs, and no label is unknown: test/CMakeLists.txt lists them.

Usage: labels.py BUILD
"""
import json
import subprocess
import sys
import tempfile

NEEDS = set("unit cli figures shaders view python hardware firmware cross bits importers scale job".split())
OTHERS = set("asan asan-long tsan tsan-long msan msan-long long".split())

with tempfile.TemporaryDirectory() as folder: # in the build's own, ctest would replace the log of the run that this test is part of
    with open(folder + "/CTestTestfile.cmake", "w", encoding="utf-8") as file:
        file.write(f'subdirs("{sys.argv[1]}")')
    listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=folder, check=True, capture_output=True, text=True).stdout
failed = 0
tests = json.loads(listed)["tests"]
for test in tests:
    labels = next((set(each["value"]) for each in test["properties"] if each["name"] == "LABELS"), set())
    wrong = []
    if len(labels & NEEDS) != 1:
        wrong.append(f"expected one label of {' '.join(sorted(NEEDS))}")
    wrong += [f'unknown label "{label}"' for label in labels - NEEDS - OTHERS]
    wrong += [f"{name} and {name}-long" for name in ("asan", "tsan", "msan") if {name, f"{name}-long"} <= labels]
    for problem in wrong:
        failed += 1
        print(f"FAIL: {test['name']} ({' '.join(sorted(labels)) or 'no label'}): {problem}")
print(f"labels: {len(tests)} tests, {failed} failed")
sys.exit(failed > 0 or len(tests) < 50)
