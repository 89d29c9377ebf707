#!/usr/bin/env python3
"""The catalogue's rows (rows.toml).

rows.py check CTEST BUILD   fails unless every row has tests, all names in it exist, and every record has a row
rows.py print               prints the table with the records as Markdown
"""

import fnmatch
import json
import pathlib
import subprocess
import sys
import tomllib

here = pathlib.Path(__file__).resolve().parent
recorded_as = "record_test.Of/Catalogue.{}IsAsRecorded/"


def catalogue():
    with open(here / "rows.toml", "rb") as file:
        return tomllib.load(file)


def cases_of(program, options):
    """The cases of GoogleTest that a test runs: Suite.Case."""
    out = subprocess.run([program, "--gtest_list_tests", *options], check=True, capture_output=True, text=True)
    suite = ""
    for line in out.stdout.splitlines():
        name = line.split("#")[0].rstrip()  # then a comment shows the parameter
        if line.startswith("  "):
            yield suite + name.lstrip()
        else:
            suite = name


def tests_of(ctest, build):
    # -C long: a row may name a test that only runs in this configuration.
    out = subprocess.run([ctest, "--test-dir", build, "-C", "long", "--show-only=json-v1"],
                         check=True, capture_output=True)
    names = []
    for test in json.loads(out.stdout)["tests"]:
        names.append(test["name"])
        program, *options = test.get("command", [""])
        if options and options[0].startswith("--gtest_filter="):
            names += [test["name"].split(".")[0] + "." + case for case in cases_of(program, options)]
    return names


def faults(rows, tests):
    covered = set()
    for row in rows:
        if not row["tests"]:
            yield f"no test: {row['input']}"
        for pattern in row["tests"]:
            if not fnmatch.filter(tests, pattern):
                yield f"no test is named {pattern}: {row['input']}"
        for pattern in row.get("record", []):
            for who in "Original", "Ours":
                found = fnmatch.filter(tests, recorded_as.format(who) + pattern)
                covered.update(found)
                if not found:
                    yield f"no record of {who.lower()} for {pattern}: {row['input']}"
    for test in tests:
        if test.startswith("record_test.") and test not in covered:
            yield f"in no row: {test}"


def record():
    """The original's behaviour, by name of the input."""
    found = {}
    for line in (here / "record.txt").read_text().splitlines():
        name, separator, text = line.partition(" original: ")
        if separator:
            found[name] = text
    for file in (here.parent / "data").glob("*.txt"):
        for line in file.read_text().splitlines():
            if line.startswith("# original: "):
                found["file_" + file.stem.replace("-", "m")] = line.removeprefix("# original: ")
    return found


def print_table(sections, rows):
    originals = record()
    for number, section in enumerate(sections, 1):
        print(f"## {section}\n\n| input | original | ours | tests |\n| --- | --- | --- | --- |")
        for row in rows:
            if row["section"] != number:
                continue
            names = [name for pattern in row.get("record", []) for name in sorted(fnmatch.filter(originals, pattern))]
            original = "<br>".join(f"{name}: {originals[name]}" for name in names)
            tests = "<br>".join(row["tests"] + ([f"`{row['measured']}`"] if "measured" in row else []))
            print(f"| {row['input']} | {original} | {row['ours']} | {tests} |")
        print()


def main():
    read = catalogue()
    if sys.argv[1:] == ["print"]:
        print_table(read["section"], read["row"])
    elif len(sys.argv) == 4 and sys.argv[1] == "check":
        found = list(faults(read["row"], tests_of(sys.argv[2], sys.argv[3])))
        print(*found, sep="\n")
        sys.exit(1 if found else 0)
    else:
        sys.exit(__doc__)


main()
