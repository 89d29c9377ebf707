#!/usr/bin/env python3
"""Mutation testing of the predicates and the validators.

  tests/mutation/mutate.py BUILD [PART]      PART: of the name of a file

Plants one bug at a time in a copy of the sources: operators, constants, conditions, arguments, dropped statements. Of
each line it draws one mutant, the same in every run. It builds the tests that should notice and runs them, the
quickest first. A mutant is caught if a test fails, crashes or takes 20 times its usual time. A mutant is equivalent,
and not counted, if the compiler makes the same code of it.

Prints the survivors, to be read: those that matter need a test. Most change no result: a filter with a larger bound, an
arc judged from its other end, too, a read ahead, more room, other threads. Fails if more than a quarter of the mutants
of a file survive. Takes some three hours of one processor.
"""

import pathlib
import random
import re
import resource
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PER_LINE = 1
# Of each file the lines from the first text to the second; the tests: (executable, filter, share of the cases).
QUICK = ("predicates_test", "-Exact.*", 0.01)
LONGER = ("predicates_test", "-Exact.*", 0.05)
KERNEL = ("parallel_test", "Nasty.*:Coincident.*", 1)
FLIPS = ("flips_test", "*", 0.5)
WARM = ("warm_start_test", "*", 1)
MEMORY = ("allocation_test", "*LastMesh*", 1)
STARS = ("moving_stars_test", "*", 1)
VALIDATOR = ("validator_test", "-*Mutants*:*RandomTriangles*:*ReadsNothing*", 1)
LISTS = ("validator_test", "*Mutants*:*RandomTriangles*:*ReadsNothing*", 0.1)
SUBJECTS = {
    "src/cxx/geometry/predicates.cpp": ("constexpr double u", "}  // namespace pstripack", [QUICK, LONGER, KERNEL]),
    "src/cxx/geometry/directions.cpp": ("double largest(", "}  // namespace pstripack", [QUICK, LONGER, KERNEL]),
    "src/cxx/geometry/exact_signs.h": ("constexpr int kSmallBits", "}  // namespace pstripack::exact", [QUICK, LONGER]),
    "src/cxx/geometry/predicates.h": ("inline bool length_is_one", "/// Counts in this thread since", [QUICK, KERNEL]),
    "src/cxx/mesh/flips.cpp": ("struct Spokes {", "}  // namespace pstripack", [FLIPS, WARM, STARS]),
    "src/cxx/trmesh/warm_start.cpp": ("SampleOfStars sample_of(", "}  // namespace pstripack", [WARM, MEMORY]),
    "src/cxx/parallel/moving_stars.cpp": ("bool MovingStars::propose(", "MeshNode MovingStars::find(", [STARS]),
    "src/cxx/mesh/validate.cpp": ("Verdict defect(", "const char* name(", [VALIDATOR, LISTS]),
    "src/cxx/lists/adjacency_lists.cpp": ("Verdict malformed(", "}  // namespace pstripack", [VALIDATOR, LISTS]),
}

REPLACEMENTS = [
    (r" < ", [" <= ", " >= "]), (r" <= ", [" < ", " > "]), (r" > ", [" >= ", " <= "]), (r" >= ", [" > ", " < "]),
    (r" == ", [" != "]), (r" != ", [" == "]), (r" && ", [" || "]), (r" \|\| ", [" && "]),
    (r" \+ ", [" - "]), (r" - ", [" + "]), (r" \* ", [" + "]), (r" / ", [" * "]), (r" & ", [" | "]),
    (r" << ", [" >> "]), (r" >> ", [" << "]), (r" \+= ", [" -= "]), (r" -= ", [" += "]), (r" = ", [" += "]),
    (r"\+\+", ["--"]), (r"--", ["++"]), (r"!(?=[\w(])", [""]), (r"~", [""]), (r"(?<=[ ({])-(?=[\w(])", [""]),
    (r"\btrue\b", ["false"]), (r"\bfalse\b", ["true"]), (r"\bmin\b", ["max"]), (r"\bmax\b", ["min"]),
    (r"\bhigh\b", ["low"]), (r"(?<=[.\w])\.x\b", [".y"]), (r"\bcontinue;", [";"]), (r"\blower_bound\b", ["upper_bound"]),
    (r"\breturn [^;]+;", ["return {};"]),
]


def variants_of_number(text, is_constant):
    """Bounds become much too small or too large; other numbers change by one."""
    if text.startswith("0x1p"):
        exponent = int(text[4:])
        return [f"0x1p{exponent - 2}", f"0x1p{exponent + 2}", "0x0p0"]
    if not text.isdigit():
        return ["0.0", text.replace("e-", "e+")]
    n = int(text)
    return [str(n // 4), str(4 * n), "0"] if is_constant else [str(n + 1), str(max(n - 1, 0))]


def mutants_of(line):
    """All mutants of a line of code."""
    code = line.split("//")[0].rstrip()
    masked = re.sub(r'"[^"]*"', lambda m: "_" * len(m.group()), code)
    found = []

    def put(begin, end, text):
        found.append(code[:begin] + text + code[end:])

    if not masked.strip() or re.match(r"\s*(#|template|using|namespace|struct|class|case|[}\])]+;?$)", masked):
        return []
    for pattern, texts in REPLACEMENTS:
        for m in re.finditer(pattern, masked):
            for text in texts:
                put(m.start(), m.end(), text)
    for m in re.finditer(r"(?<![\w.])(0x1p-?\d+|\d+e-?\d+|\d+)(?![\w.])", masked):
        for text in variants_of_number(m.group(), "constexpr" in masked):
            put(m.start(), m.end(), text)
    for m in re.finditer(r"\b(?:if|while) \((.*)\)(?= |$)", masked):
        if m.group(1).count("(") == m.group(1).count(")") and ";" not in m.group(1):
            put(m.start(1), m.end(1), f"!({code[m.start(1):m.end(1)]})")
    for m in re.finditer(r"\b\w+\((\w+), (\w+)", masked):
        put(m.start(1), m.end(2), f"{m.group(2)}, {m.group(1)}")
    for m in re.finditer(r" \? ([^?:]+) : ([^?:;]+?)(?=[;,)])", masked):
        put(m.start(1), m.end(2), f"{code[m.start(2):m.end(2)]} : {code[m.start(1):m.end(1)]}")
    if masked.endswith(";") and not re.match(r"\s*(return|const|auto|break|std::\w+[<&*])", masked):
        put(len(code) - len(code.lstrip()), len(code), ";")
    return sorted(set(found) - {code})


def run(command, **options):
    return subprocess.run(command, capture_output=True, text=True, **options)


class Mutation:
    def __init__(self, build):
        self.build, self.tree = build / "build", build / "source"
        for name in run(["git", "ls-files", "-co", "--exclude-standard"], cwd=SOURCE, check=True).stdout.split("\n"):
            if (SOURCE / name).is_file():
                text, copy = (SOURCE / name).read_bytes(), self.tree / name
                if not copy.exists() or copy.read_bytes() != text:
                    copy.parent.mkdir(parents=True, exist_ok=True)
                    copy.write_bytes(text)
        run(["cmake", "-S", self.tree, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
             "-DCMAKE_CXX_FLAGS_RELEASE=-O1", "-DPSTRIPACK_TOOLS=OFF", "-DPSTRIPACK_EXAMPLES=OFF",
             "-DPSTRIPACK_WITH_MPI=OFF"], check=True)

    def makes(self, target):
        return run(["ninja", "-C", self.build, target]).returncode == 0

    def objects(self):
        """The object code of the library."""
        return {p: p.read_bytes() for p in sorted((self.build / "src/cxx").rglob("*.o"))}

    def passes(self, stage, seconds):
        """True if the tests of the stage pass within this processor time, in seconds."""
        test, pattern, share = stage

        def limits():
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if test != "parallel_test":  # many threads, each with its share of addresses
                resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

        folder = "faults" if test == "allocation_test" else "cxx"
        return run([self.build / "tests" / folder / test, f"--gtest_filter={pattern}", "--gtest_brief=1"],
                   env={"GTEST_FAIL_FAST": "1", "PSTRIPACK_CASES": str(share), "OMP_NUM_THREADS": "2"},
                   preexec_fn=limits, errors="replace").returncode == 0

    def seconds(self, stage):
        """Builds and runs a stage without a mutant; the processor time to allow for it."""
        is_built = self.makes(stage[0])
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not is_built or not self.passes(stage, 3600):
            sys.exit(f"{stage[0]} fails without a mutant")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return int(20 * (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)) + 5

    def outcome(self, stages, seconds, original):
        for stage, limit in zip(stages, seconds):
            if not self.makes(stage[0]):
                return "no program"
            if original and self.objects() == original:
                return "equivalent"
            if not self.passes(stage, limit):
                return "caught"
        return "survived"


def lines_of(name):
    """The lines of a file, and of those to mutate the first and the one after the last."""
    first, last, _ = SUBJECTS[name]
    lines = (SOURCE / name).read_text().split("\n")
    begin = next((k for k, line in enumerate(lines) if first in line), len(lines))
    end = next((k for k, line in enumerate(lines) if k > begin and last in line), None)
    return (lines, begin, end) if end else sys.exit(f"{name}: no line with {first}, or none with {last} after it")


def main():
    subjects = {name: lines_of(name) for name in SUBJECTS}
    mutation, poor = Mutation(pathlib.Path(sys.argv[1]).resolve()), []
    for name, (lines, begin, end) in subjects.items():
        if len(sys.argv) > 2 and sys.argv[2] not in name:
            continue
        copy, stages = mutation.tree / name, SUBJECTS[name][2]
        seconds = [mutation.seconds(stage) for stage in stages]
        original = {} if name.endswith("predicates.h") else mutation.objects()  # inlined elsewhere
        count = {"caught": 0, "survived": 0}
        for k in range(begin, end):
            mutants, left = mutants_of(lines[k]), PER_LINE
            random.Random(lines[k]).shuffle(mutants)
            while mutants and left > 0:
                mutant = mutants.pop()
                copy.write_text("\n".join(lines[:k] + [mutant] + lines[k + 1:]))
                outcome = mutation.outcome(stages, seconds, original)
                if outcome in count:
                    count[outcome] += 1
                    left -= 1
                if outcome == "survived":
                    print(f"survived {name}:{k + 1}: {lines[k].strip()}\n    {mutant.strip()}", flush=True)
        copy.write_text("\n".join(lines))
        print(f"{name}: {count['caught']} caught, {count['survived']} survived", flush=True)
        if 3 * count["survived"] > count["caught"]:
            poor.append(name)
    for name in poor:
        print("too many survive:", name)
    sys.exit(1 if poor else 0)


main()
