"""Runs the tools of a build, which write CSV files into one folder, and reads those files."""
import csv
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

FAMILIES = ("latlon", "random")


@dataclass
class Plan:
    curve_sizes: tuple  # numbers of nodes for one process
    sizes: tuple        # numbers of nodes for several processes
    constant_n: tuple   # those of `sizes` that are drawn over the number of processes
    work: int           # nodes per process in the figures of constant work
    ranks: tuple
    picture: tuple      # of patches: nodes, processes
    repeats: int
    curve_time_limit: float  # seconds of one measurement
    time_limit: float        # the same for several processes, and for the original in these figures
    generators: int          # generators of the centroidal tessellations
    evaluations: int         # their largest number of evaluations


FULL = Plan(curve_sizes=(100, 1000, 10_000, 100_000, 1_000_000, 10_000_000),
            sizes=(10_000, 30_000, 100_000, 300_000, 1_000_000), constant_n=(100_000, 1_000_000), work=10_000,
            ranks=(1, 2, 4, 8, 16, 32, 64), picture=(10_000, 16), repeats=3,
            curve_time_limit=30, time_limit=60, generators=40_000, evaluations=3000)
QUICK = Plan(curve_sizes=(100, 300), sizes=(2000,), constant_n=(2000,), work=500, ranks=(1, 4),
             picture=(1000, 16), repeats=1,
             curve_time_limit=5, time_limit=20, generators=3000, evaluations=50)


def benchmark(build):
    return build / "compare/pstripack-benchmark"


def scaling(build):
    return build / "compare/pstripack-scaling"


def _mpirun(ranks):
    return ["mpirun", "--oversubscribe", "--bind-to", "none", "-np", str(ranks)]


def _environment():
    as_root = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"} if os.geteuid() == 0 else {}
    return {**os.environ, "OMP_NUM_THREADS": "1", **as_root}


def _run(command, **options):
    words = [str(word) for word in command]
    print("  " + " ".join(words), file=sys.stderr, flush=True)
    return subprocess.Popen(words, env=_environment(), **options)


def _must_run(command, **options):
    with _run(command, **options) as process:
        pass
    if process.returncode != 0:
        sys.exit(f"make-figures: exit code {process.returncode} of {command[0]}")


def _list(values):
    return ",".join(map(str, values))


def _run_curves(plan, program, data):
    with open(data / "machine.txt", "w") as out:
        _must_run([program, "curves", "--sizes", _list(plan.curve_sizes), "--repeats", plan.repeats,
                   "--time-limit", plan.curve_time_limit, "--csv", data / "curves.csv"], stdout=out)
    sizes = sorted({*plan.sizes, *(plan.work * p for p in plan.ranks)})
    for family in FAMILIES:
        _must_run([program, "curves", "--points", family, "--orders", "given,shuffled", "--sizes", _list(sizes),
                   "--contenders", "pstripack,original", "--repeats", plan.repeats,
                   "--time-limit", plan.time_limit, "--csv", data / "serial.csv"], stdout=sys.stderr)


def _run_descents(plan, program, data):
    _must_run([program, "descents", "--n", plan.generators, "--evaluations", plan.evaluations,
               "--csv", data / "descents.csv"], stdout=sys.stderr)


def _run_ours(plan, program, data):
    def tables(family, kind, modes, sizes):
        _must_run([program, "--family", family, "--tables", kind, "--modes", modes, "--sizes", _list(sizes),
                   "--ranks", _list(plan.ranks), "--repeats", plan.repeats, "--csv", data / "ours.csv"],
                  stdout=sys.stderr)
    for family in FAMILIES:
        tables(family, "constant-n", "messages", plan.sizes)
        tables(family, "constant-n", "distributed", plan.constant_n)
        tables(family, "constant-work", "messages,distributed", [plan.work])
    n, ranks = plan.picture
    _must_run([*_mpirun(ranks), program, "--mode", "distributed", "--repeats", 1, "--n", n, "--owners",
               data / f"owners-ours-{n}-{ranks}.csv"], stdout=sys.stderr)


def _baseline(program, ranks, family, n, time_limit, *options):
    """False if it exceeded the time limit. Nodes are in random order, which keeps the baseline's history shallow."""
    command = [*_mpirun(ranks), program, "--points", family, "--n", n, "--shuffle", *options]
    with _run(command, stdout=sys.stderr) as process:
        try:
            process.wait(time_limit)
        except subprocess.TimeoutExpired:
            process.terminate()  # mpirun ends its ranks
            return False
    if process.returncode != 0:
        print(f"  exit code {process.returncode}", file=sys.stderr)
    return True


def _run_baseline(plan, program, data):
    times = ("--repeats", plan.repeats, "--csv", data / "baseline.csv")
    for family in FAMILIES:
        for ranks in plan.ranks:
            for n in sorted({*plan.sizes, plan.work * ranks}):
                if not _baseline(program, ranks, family, n, plan.time_limit, *times):
                    break  # larger ones take longer
    n, ranks = plan.picture
    _baseline(program, ranks, "random", n, plan.time_limit, "--check", "--csv", data / "baseline-check.csv",
              "--owners", data / f"owners-baseline-{n}-{ranks}.csv")


def measure(plan, build, data):
    """Makes all measurements and replaces the CSV files in the folder `data`."""
    data.mkdir(parents=True, exist_ok=True)
    for old in data.glob("*.csv"):
        old.unlink()
    _run_curves(plan, benchmark(build), data)
    _run_descents(plan, benchmark(build), data)
    _run_ours(plan, scaling(build), data)
    baseline = next(filter(Path.is_file, build.rglob("stripe-baseline")), None)
    if baseline is None:
        print("make-figures: this build has no stripe-baseline: the figures do not show it", file=sys.stderr)
    else:
        _run_baseline(plan, baseline, data)


class Table:
    """The rows of a CSV file; none if the file does not exist."""

    def __init__(self, path):
        self.rows = list(csv.DictReader(open(path, newline=""))) if path.exists() else []

    def __bool__(self):
        return bool(self.rows)

    def points(self, x, y, **key):
        """(x, y) of the rows whose columns have the values in key; y is a function of a row. Rows without a
        figure are left out; of rows with equal x the last one counts."""
        found = {}
        for row in self.rows:
            if all(row[column] == str(value) for column, value in key.items()):
                found[float(row[x])] = y(row)
        return [(a, b) for a, b in sorted(found.items()) if b > 0]

    def value(self, y, **key):
        """y of the last row whose columns have the values in key; None if there is no such row or no figure."""
        rows = [row for row in self.rows if all(row[column] == str(value) for column, value in key.items())]
        return (rows and y(rows[-1])) or None

    def nearest_n(self, n, **key):
        """The number of nodes nearest to n that was measured: grids have only certain numbers."""
        counts = [int(row["n"]) for row in self.rows if all(row[c] == str(v) for c, v in key.items())]
        return min(counts, key=lambda count: abs(count - n), default=n)


def machine(data):
    """The benchmark's lines about the machine, by their first word."""
    with open(data / "machine.txt") as file:
        return dict(line.rstrip("\n").split(maxsplit=1) for line in file if line.strip() and line[0].isalpha()
                    and len(line.split(maxsplit=1)) == 2)
