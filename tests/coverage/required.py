#!/usr/bin/env python3
"""required.py BUILD: fails if required branches are not covered.

gcov counted lines and branches in the folder BUILD. These lines must be covered with all their branches, unless
untested.txt excuses them:
  - the files of REQUIRED: the predicates and the validators;
  - the error paths of all of src/: every line that raises, catches or returns an error (ERROR), and the
    condition that leads there.

Only the first pairs of branches of a line count, one pair per condition in its text: after them gcov lists the branches
of the clean-up after exceptions, and those of other instances of a template. The pair of a call that returns or throws
does not count. (gcovr cannot tell that pair from others where the call was never made.)

An excuse that is not needed any more is an error, too.
"""

import collections
import json
import os
import pathlib
import re
import subprocess
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
    r"\bthrow\b|\bcatch \(|return \{?(-\d|PSTRIPACK_(?!OK\b))|return (defect|malformed)\(|Status::(?!done\b)\w+|"
    r"\b(out_of_memory|not_finite|no_such_node|no_neighbour|broken_lists)\b|PSTRIPACK_[A-Z_]*(MEMORY|FINITE|MANY)")

source = pathlib.Path(__file__).resolve().parents[2]


def code_of(line):
    return "" if line.lstrip().startswith("//") else line.split("//")[0].strip()


def may_be_untested(name, code):
    """The numbers, from 0, of the lines of the statements in a file that untested.txt excuses."""
    excuses = (pathlib.Path(__file__).parent / "untested.txt").read_text()
    for first in re.findall(rf"^{re.escape(name)}: .*\n    (.*)$", excuses, re.MULTILINE):
        begin = code.index(code_of(first))
        end = next(i for i in range(begin, len(code)) if code[i][-1:] in ("{", ";"))
        yield set(range(begin, end + 1))


def conditions(text):
    """The number of conditions in a line of code: `a && b` has two, as a value or in `if (a && b)`."""
    operators = len(re.findall(r"&&|\|\||\?", text))
    return 100 if "switch (" in text else operators + bool(operators or re.search(r"\b(if|while|for) \(", text))


def condition_of(code, k):
    """The lines of the condition before line k (from 0), if there is one."""
    above = []
    while k > 0:
        k -= 1
        if not code[k]:
            continue
        if code[k][-1] in ";}" or code[k].endswith("{}"):
            return []
        above.append(k)
        if re.match(r"(\} )?(else )?(if|while|for) \(", code[k]):
            return above
    return []


def pairs_of(branches):
    """The counts of a line's branches, without the pairs of calls that return or throw."""
    counts = []
    for branch in branches:
        if branch["throw"]:
            counts = counts[:-1]
        else:
            counts.append(branch["count"])
    return counts


def counted(build):
    """By file and line, from 0: how often the line ran, and its branches, over all objects that include it."""
    files = collections.defaultdict(dict)
    for object_file in sorted(build.rglob("*.gcno")):
        output = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", object_file],
                                capture_output=True, check=True).stdout
        for part in output.splitlines():
            report = json.loads(part)
            for file in report["files"]:
                path = os.path.normpath(os.path.join(report["current_working_directory"], file["file"]))
                name = os.path.relpath(path, source)
                if not name.startswith("src/cxx/"):
                    continue
                for line in file["lines"]:
                    all_of_line = files[name].setdefault(line["line_number"] - 1, {"count": 0, "branches": []})
                    all_of_line["count"] += line["count"]
                    for k, branch in enumerate(line["branches"]):
                        if k == len(all_of_line["branches"]):
                            all_of_line["branches"].append({"count": 0, "throw": False})
                        all_of_line["branches"][k]["count"] += branch["count"]
                        all_of_line["branches"][k]["throw"] |= branch["throw"]
    return files


def main():
    left_out, missing, idle, paths = 0, [], [], 0
    for name, covered in sorted(counted(pathlib.Path(sys.argv[1]).resolve()).items()):
        lines = (source / name).read_text().splitlines()
        code = [code_of(line) for line in lines]
        allowed = list(may_be_untested(name, code))
        used = set()
        covered = {k: line for k, line in covered.items() if re.search(r"\w", code[k])}
        wanted = set(covered) if name in REQUIRED else set()
        for k, text in enumerate(code):
            if ERROR.search(text) and k in covered:
                paths += 1
                wanted |= {k, *condition_of(code, k)} & set(covered)
        for k in sorted(wanted):
            line = covered[k]
            branches = [count > 0 for count in pairs_of(line["branches"])][:2 * conditions(code[k])]
            if line["count"] > 0 and all(branches):
                continue
            used.add(k)
            if not any(k in statement for statement in allowed):
                missing.append(f"{name}:{k + 1}: {branches.count(False) or 'all'} not taken: {code[k]}")
        left_out += len(allowed)
        idle += [f"{name}:{min(statement) + 1}: is tested" for statement in allowed if not statement & used]
    if paths == 0:
        sys.exit(f"required.py: {sys.argv[1]}: no counts of src/cxx")
    print(f"{paths} lines of error paths; {left_out} statements left out")
    print("\n".join(missing + idle))
    sys.exit(1 if missing or idle else 0)


main()
