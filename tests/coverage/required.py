#!/usr/bin/env python3
"""required.py COVERAGE.json: fails if required branches are not covered.

These lines of gcovr's report must be covered with all their branches, except those of left-out.txt:
  - the files of REQUIRED: the predicates and the validators;
  - the error paths of all of src/: every line that raises, catches or returns an error (ERROR), and the
    condition that leads there.

Only the first pairs of branches of a line count, one pair per condition in its text: after them gcov lists the branches
of the clean-up after exceptions.

left-out.txt has lines "file | text of the line | reason"; a line that is not needed any more is an error, too.
"""

import json
import pathlib
import re
import sys

REQUIRED = [
    "src/cxx/geometry/predicates.cpp",
    "src/cxx/geometry/predicates.h",
    "src/cxx/geometry/exact_signs.h",
    "src/cxx/mesh/validate.cpp",
    "src/cxx/mesh/validate.h",
    "src/cxx/lists/adjacency_lists.cpp",
]
ERROR = re.compile(
    r"\bthrow\b|\bcatch \(|return \{?-\d|return (defect|malformed)\(|Status::(?!done\b)\w+|"
    r"\b(out_of_memory|not_finite|no_such_node|no_neighbour|broken_lists)\b|PSTRIPACK_[A-Z_]*(MEMORY|FINITE|MANY)")

source = pathlib.Path(__file__).resolve().parents[2]


def left_out():
    for line in (source / "tests/coverage/left-out.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            file, text, _ = [part.strip() for part in line.split(" | ")]
            yield file, text


def code_of(line):
    return "" if line.lstrip().startswith("//") else line.split("//")[0].strip()


def conditions(text):
    """The number of conditions in a line of code: `a && b` has two, as a value or in `if (a && b)`."""
    operators = len(re.findall(r"&&|\|\||\?", text))
    return 100 if "switch (" in text else operators + bool(operators or re.search(r"\b(if|while|for) \(", text))


def condition_of(code, k):
    """The lines of the condition before line k (from 0), if there is one."""
    above = []
    while k > 0:
        k -= 1
        if not code[k] or code[k][-1] in ";}" or code[k].endswith("{}"):
            return []
        above.append(k)
        if re.match(r"(\} )?(else )?(if|while|for) \(", code[k]):
            return above
    return []


def main():
    allowed, needed, missing, paths = set(left_out()), set(), [], 0
    for file in json.load(open(sys.argv[1]))["files"]:
        name = file["file"]
        code = [code_of(line) for line in (source / name).read_text().splitlines()]
        covered = {line["line_number"] - 1: line for line in file["lines"] if not line["gcovr/noncode"]}
        wanted = set(covered) if name in REQUIRED else set()
        for k, text in enumerate(code):
            if ERROR.search(text) and k in covered:
                paths += 1
                wanted |= {k, *condition_of(code, k)} & set(covered)
        for k in sorted(wanted):
            line = covered[k]
            branches = [b["count"] > 0 for b in line.get("branches", [])][:2 * conditions(code[k])]
            if line["count"] > 0 and all(branches):
                continue
            needed.add((name, code[k]))
            if (name, code[k]) not in allowed:
                missing.append(f"{name}:{k + 1}: {branches.count(False) or 'all'} not taken: {code[k]}")
    print(f"{paths} lines of error paths; {len(needed)} lines left out or missing")
    print("\n".join(missing))
    for name, text in sorted(allowed - needed):
        print(f"left-out.txt: not needed: {name} | {text}")
    sys.exit(1 if missing or allowed - needed else 0)


main()
