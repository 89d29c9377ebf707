"""Runs pstripack and checks output, files, messages and exit codes.

Environment: PSTRIPACK and COMPARE, the programs; NETCDF, if they read NetCDF; MPIRUN, mpirun and its options.
"""
import csv
import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import time
from itertools import takewhile
from pathlib import Path

import pytest

PROGRAM, COMPARE = os.environ["PSTRIPACK"], os.environ["COMPARE"]
ROOT = Path(__file__).parents[2]
DATA = ROOT / "tests/data"
OCTAHEDRON = "1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n"

needs_netcdf = pytest.mark.skipif(not os.environ.get("NETCDF"), reason="built without NetCDF")
needs_ncgen = pytest.mark.skipif(not shutil.which("ncgen"), reason="no ncgen: Debian: apt-get install netcdf-bin")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write("octahedron.txt", OCTAHEDRON)


def write(name, text):
    Path(name).write_text(text, encoding="utf-8")


def read(name):
    return Path(name).read_text(encoding="utf-8")


def lines(name):
    return read(name).splitlines()


def rows(name):
    """The words of each line that is no comment."""
    return [line.split() for line in lines(name) if not line.startswith("#")]


def table(name):
    """The fields of each row of a CSV file, the header first."""
    return list(csv.reader(lines(name)))


def with_value(text, value):
    """Each line with this value behind it, or that which a function gives for the line's number."""
    of_line = value if callable(value) else lambda number: value
    return "".join(f"{line} {of_line(k)}\n" for k, line in enumerate(text.splitlines()))


def start(command, stdin="", before=(), program=PROGRAM, **options):
    """A finished run; `before`: what starts the program."""
    return subprocess.run([*before, program, *shlex.split(command)], input=stdin, capture_output=True, text=True, **options)


def output(command, stdin=""):
    """On stdout, of a run that must succeed without messages."""
    result = start("-q " + command, stdin)
    assert (result.returncode, result.stderr) == (0, ""), f"{command}: {result.stderr}"
    return result.stdout


def messages(command, *patterns, **options):
    """On stderr, of a run that must succeed; each of the patterns must be found."""
    result = start(command, **options)
    assert result.returncode == 0, f"{command}: {result.stderr}"
    for pattern in patterns:
        assert re.search(pattern, result.stderr, re.MULTILINE), f"{command}: {pattern} in {result.stderr}"
    return result.stderr


def refuses(code, command, words, stdin="", **options):
    """The run must end with this code and one line on stderr that has the words, and write no file."""
    there = sorted(os.listdir())
    result = start(command, stdin, **options)
    assert result.returncode == code and result.stderr.count("\n") == 1 and words in result.stderr, f"{command}: {result}"
    assert sorted(os.listdir()) == there, command


def content(name):
    """Of a NetCDF file, but for its history; without ncdump, its vectors."""
    if not shutil.which("ncdump"):
        return output(f"convert {name} -o - --to xyz")
    text = subprocess.run(["ncdump", "-p", "9,17", name], check=True, capture_output=True, text=True).stdout
    return re.sub(r"(?ms)^\t*:history = .*? ;$", "", text.split("\n", 1)[1])


def nodes_of(name):
    return output(f"convert {name} -o - --to xyz")


def vtu_values(name, array):
    return re.search(rf'Name="{array}" format="ascii">([^<]*)<', read(name))[1].split()


def features(name):
    return json.loads(read(name))["features"]


# The whole program.


def test_documented_formats_and_densities_are_those_of_help():
    def section(command, title):
        return re.search(rf"(?m)^{title}\n((?: .*\n)*)", output(command + " --help"))[1].splitlines()

    document = re.findall(r"\(`([a-z]*)`; (`\.[^)]*)\)", read(ROOT / "docs/pstripack.md"))
    written = [[name, *re.findall(r"[^`, ]+", suffixes)] for name, suffixes in document]
    offered = [line.split() for line in section("triangulate", "Formats and their suffixes:")]
    offered = [[words[0], *takewhile(lambda word: word.startswith("."), words[1:])] for words in offered]
    assert sorted(written) == sorted(words for words in offered if len(words) > 1)
    formulas = re.search(r"(?s)\nFormulas are (.*?)\(`--help`\)", read(ROOT / "docs/scvt.md"))[1]
    densities = [re.match(r"  ([a-z]*)", line)[1] for line in section("scvt", "Densities:")]
    assert set(re.findall(r"`([a-z]*)`", formulas)) == set(densities) - {""}


def test_pipes():
    assert output("triangulate - -o - --to off", OCTAHEDRON).splitlines()[1] == "6 8 0"
    assert json.loads(output("info - --json", output("points fibonacci 100")))["triangles"] == 196
    steps = r"^pstripack: 6 nodes \(text, x y z\), 8 triangles; reading .* s; triangulating .* s; writing .* s$"
    messages("triangulate octahedron.txt -o mesh.off", steps)
    assert ", 1 triangle; " in messages("triangulate - -o -  --to lists", stdin="1 0 0\n0 1 0\n0 0 1\n")
    os.mkfifo("pipe")  # as <(zcat stations.csv.gz)
    with subprocess.Popen("cat octahedron.txt > pipe", shell=True):
        assert output("triangulate pipe -o - --to off") == read("mesh.off")


@pytest.mark.parametrize("stdout", ["> /dev/full", ">&-"])
def test_a_full_or_closed_stdout_is_an_error_of_each_command_that_prints(stdout):
    output("triangulate octahedron.txt -o nodes.off")
    for program, code, commands in (
            (PROGRAM, 1, ["--help", "--version", "info octahedron.txt", "points random 5", "points random 100000",
                          "triangulate octahedron.txt -o - --to off", "plot octahedron.txt -o - --to svg"]),
            (COMPARE, 1, ["--help", "--version"]),
            (COMPARE, 2, ["run --points random --n 50 --repeats 1"])):
        for command in commands:
            quiet = "-q " if program == PROGRAM else ""
            result = start(quiet + command, before=["sh", "-c", f'exec "$0" "$@" {stdout}'], program=program)
            assert result.returncode == code, (command, result)
            assert re.fullmatch("[a-z-]*: (stdout: cannot be written|cannot write).*\n", result.stderr), (command, result)
    # Where nothing is printed, closed streams do no harm: no file gets their numbers.
    for streams in (">&- 2>&- <&-", "2> /dev/full"):
        messages("triangulate octahedron.txt -o mesh.off", before=["sh", "-c", f'exec "$0" "$@" {streams}'])
        assert read("mesh.off") == read("nodes.off")
    refuses(1, "info -", "stdin: read error: Bad file descriptor", before=["sh", "-c", 'exec "$0" "$@" <&-'])
    assert start("triangulate no.txt -o no.off", before=["sh", "-c", 'exec "$0" "$@" 2> /dev/full']).returncode == 1


def test_command_lines_that_are_refused():
    write("a.gpkg", "SQLite format 3")
    for arguments, words in {
            "triangulate octahedron.txt": "required",
            "triangulate octahedron.txt -o mesh.xxx": "mesh.xxx: no format has this suffix: give --to",
            "voronoi octahedron.txt -o a.b.gpkg": "a.b.gpkg: write GeoJSON and convert it: ogr2ogr a.b.gpkg a.b.geojson",
            "triangulate octahedron.txt --radius 6371229 -o mesh.off": "--radius: only MPAS meshes have a radius",
            "triangulate octahedron.txt --radius=-1 -o a.mpas.nc": "--radius: '-1' is not a number of metres above 0",
            "convert octahedron.txt --edges -o mesh.off": "--edges: it is for UGRID",
            "triangulate octahedron.txt -o mesh.off --to ugird":
                "--to: 'ugird' is none of ugrid, mpas, scrip, esmf, vtu, off, gmsh, fesom, lists, gmt, geojson, csv, xyz, "
                "lonlat, nodes, raw; did you mean ugrid?",
            "triangulate octahedron.txt -o mesh.off --duplicates frist":
                "--duplicates: 'frist' is none of error, first, mean; did you mean first?",
            "points rndom 10": "earthquakes; did you mean random?",
            "points random 10 -o mesh.off":
                "points are nodes, not a mesh: give --to xyz, lonlat, nodes, csv, geojson or raw",
            "triangulate octahedron.txt -o mesh.off --units gradians": "degrees",
            "polygons": "there is no subcommand 'polygons': expected triangulate, voronoi, info",
            "triangluate octahedron.txt -o mesh.off": "no subcommand 'triangluate'; did you mean triangulate?",
            "triangulate octahedron.txt --outptu mesh.off": "there is no option --outptu; did you mean --output?",
            "--qiet info octahedron.txt": "there is no option --qiet; did you mean --quiet?",
            "info octahedron.txt --potato": "there is no option --potato\n",
            "info octahedron.txt more.txt": "expected",
            "points random 1.5": "'1.5' is not a whole number"}.items():
        refuses(2, arguments, words)
    refuses(1, "voronoi octahedron.txt --clip-to a.gpkg -o failed.off", "a.gpkg: a GeoPackage: convert it first, by")
    assert output("points random 1e3").count("\n") == 1000
    assert re.fullmatch(r"pstripack \d+\.\d+\.\d+(-rc\d+)?\n", output("--version"))


def test_no_partial_output():
    write("mesh.off", "old\n")
    refuses(1, "triangulate - -o mesh.off", "are in the same place", "1 0 0\n0 1 0\n0 0 1\n1 0 0\n")
    refuses(1, "triangulate octahedron.txt -o no/folder/mesh.off", "no/folder/mesh.off: cannot be written: No such file")
    refuses(1, "triangulate octahedron.txt -o /tmp --to off", "/tmp: cannot be written")
    for command in "triangulate", "voronoi", "plot":
        to = "--to svg" if command == "plot" else "--to off"
        refuses(1, f"{command} octahedron.txt -o /dev/full {to}", "/dev/full: cannot be written: No space left")
    # A limit on file size, in blocks of 512 bytes, acts as a full disk.
    output("points random 20000 -o many.txt")
    refuses(1, "-q triangulate many.txt -o mesh.off", "mesh.off: cannot be written: File too large",
            before=["sh", "-c", "trap '' XFSZ; ulimit -f 100; exec \"$0\" \"$@\""])
    assert read("mesh.off") == "old\n"


# Nodes.


@pytest.mark.parametrize("nodes, words", [
    ("10 20 300\n30 400 -5\n50 60 70\n", "are not on one sphere; say --coordinates lonlat"),
    ("x,y,z\n465000,5247000,400\n467000,5243000,520\n461000,5249000,610\n",
     "x y z of nodes at the equator, but not on one sphere: if they are metres of a map projection, convert"),
    ("10 20\n-999 40\n50 60\n",
     "node 2 (line 2): longitude -999 is more than two turns: if it means a missing place, remove the row"),
    ("1 0 0\n0 1 0\n0 0 0\n", "node 3 (line 3) is zero or not finite: remove it"),
    ("1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n", "all nodes lie on one great circle"),
    ("1 0 0\n0 1 0\n", "needs at least 3 nodes, here are 2"),
])
def test_nodes_that_are_refused(nodes, words):
    write("a.txt", nodes)
    refuses(1, "triangulate a.txt -o mesh.off", words)


def test_nodes_are_taken_as_options_say():
    output("triangulate - --units degrees -o mesh.off", "0 0\n1 0\n0 1\n")
    for coordinates in "lonlat", "xyz":
        output(f"triangulate - --coordinates {coordinates} -o mesh.off", "10 20 300\n30 40 -5\n50 60 70\n")


@pytest.mark.parametrize("file, begin, words", [
    ("a.b.shp", "\0\0'\n", "a shapefile: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 out.geojson a.b.shp`"),
    ("a.gpkg", "SQLite format 3",
     "a GeoPackage: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 out.geojson a.gpkg`"),
    ("a.kml", "<?xml\n<kml>", "KML: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 out.geojson a.kml`"),
    ("a.kmz", "PK\3\4doc.kml", "KMZ: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 out.geojson a.kmz`"),
    ("a.xlsx", "PK\3\4xl/workbook.xml",
     "a spreadsheet: convert it first, by `libreoffice --headless --convert-to csv a.xlsx`"),
    ("a.parquet", "PAR1", "Parquet: convert it first, by `python3 -c \"import pandas; "
     "pandas.read_parquet('a.parquet').to_csv('out.csv', index=False)\"`"),
    ("a", "GRIB", "GRIB: convert it first, by `cdo -f nc copy a out.nc`"),
    ("a.vtu", "<?xml?>\n<VTKFile>", "a VTK mesh: convert it first, by `python3 -c \"import meshio; "
     "meshio.read('a.vtu').write('out.off')\"`"),
    ("a.msh", "$MeshFormat", "a mesh of gmsh: convert it first, by `python3 -c"),
    ("a.msh", "# made by hand\nMSHID=3;EUCLIDEAN-MESH\nPOINT=1\n1;0;0;0\n", "a mesh of JIGSAW: convert it first, by `awk"),
    ("fort.14", "a bay\n1 3\n1 0 0 5\n2 1 0 5\n3 0 1 5\n1 3 1 2 3\n",
     "a grid of ADCIRC or SCHISM: convert it first, by `awk"),
])
def test_formats_that_other_programs_convert(file, begin, words):
    write(file, begin)
    refuses(1, f"triangulate {file} -o mesh.off", f"{file}: {words}")


def test_duplicates():
    write("twice.txt", OCTAHEDRON + OCTAHEDRON)
    refuses(1, "triangulate twice.txt -o twice.off", "twice.txt: node 1 (line 1) and node 7 (line 7) are in the same place: "
            "remove one, or say --duplicates=first")
    messages("triangulate twice.txt --duplicates first -o dropped.off", "6 nodes dropped")
    assert read("dropped.off") == output("triangulate octahedron.txt -o - --to off")
    info = output("info twice.txt")
    assert re.search(r"(?m)^duplicates *6, the first is node 7 \(line 7\); left out below", info)
    assert re.search("(?m)^triangles *8$", info)
    info = output("info -", OCTAHEDRON + "1 1e-7 0\n")
    assert re.search(r"(?m)^tightest pair *1e-07 rad, .*: node 1 \(line 1\) and node 7 \(line 7\)$", info)
    assert re.search("(?m)^near duplicates *1 pair closer", info)
    # A longitude-latitude grid in radians has one node at each pole.
    grid = DATA / "radian_grid.csv"
    refuses(1, f"voronoi {grid} -o failed.csv", "node 1 (line 2) and node 2 (line 3) are in the same place")
    refuses(1, f"-q scvt --start {grid} -o failed.off", "are in the same place")
    output(f"voronoi {grid} --duplicates first -o cells.csv")
    assert [",".join(row[1:5]) for row in table("cells.csv")[1:]] == [
        "-90,1,2,3", "0,4,5,4", "0,5,6,4", "0,6,7,4", "90,7,8,3"]


def test_tiny_cells():
    # Copies of a pole up to rounding, whose cells are a 24th of the sphere each, and a garden of 2 m.
    output(f"voronoi {DATA}/nine_nodes.csv -o cells.csv")
    assert all(abs(float(row[5]) / 0.523598775598299 - 1) < 1e-14 for row in table("cells.csv")[6:])
    info = output(f"info {DATA}/garden.csv")
    assert re.search("(?m)^triangles *15$", info) and re.search("(?m)^smallest angle *3.78752 degrees", info)
    output(f"plot {DATA}/garden.csv --what cells -o garden.svg")


def test_near_nodes():
    # 0.1 mm, 1 m and 1 km from node 1.
    places = ["0,0,1", "90,0,1", "180,0,1", "-90,0,1", "0,90,1", "0,-90,1", "9e-10,0,3", "9e-6,0,5", "0.009,0,7"]
    write("near.csv", "\n".join(["lon,lat,value", *places]) + "\n")
    line = (r"near.csv: 2 nodes are less than 1 mm apart on the Earth, but not in the same place: node 1 \(line 2\) and "
            r"node 7 \(line 8\); --duplicates first --duplicates-within 1mm keeps one")
    keep = "--units degrees --duplicates first --duplicates-within"
    for command in ("triangulate near.csv -o a.off", "voronoi near.csv -o a.off",
                    "interpolate near.csv --to-grid 2x2 -o a.txt", "scvt --start near.csv -o a.off"):
        assert messages(command + " --units degrees", line).count(" apart on the Earth") == 1
        output(command + " --units degrees")
        kept = messages(f"{command} {keep} 1mm", "near.csv: 1 node dropped that is within 1mm of earlier ones$")
        assert " apart on the Earth" not in kept
    for within, count in ("0.09mm", 10), ("0.11mm", 9), ("0.0011km", 8), ("1e-8deg", 9), ("0.00016rad", 7):
        assert output(f"convert near.csv {keep} {within} -o - --to csv").count("\n") == count, within
    mean = output("convert near.csv --units degrees --duplicates mean --duplicates-within 2km -o - --to csv")
    assert mean.splitlines()[1] == "0,0,4"
    refuses(1, "triangulate near.csv --units degrees --duplicates-within 1mm -o failed.off", "near.csv: node 1 (line 2) and "
            "node 7 (line 8) are within 1mm of each other: remove one, or say --duplicates=first")
    for within in "1", "1foot", "-1mm", "90deg":
        refuses(2, f"triangulate near.csv --duplicates-within={within} -o a.off", f"--duplicates-within: '{within}': expected")


# Formats.


def test_lists_and_fesom():
    output("points random 500 -o nodes.txt")
    output("triangulate nodes.txt -o a.lists")
    output("triangulate nodes.txt -o a.off")
    output("convert a.off -o b.lists")
    assert start("lists a.lists b.lists", program=COMPARE).returncode == 0
    assert read("a.lists") == read("b.lists") and lines("a.lists")[0] == "500 2989"  # N and LNEW
    # Numbered nodes with a flag at the boundary, and triangles in the order of OFF.
    output("points hemisphere 60 -o half.txt")
    output("triangulate half.txt --to fesom -o nod2d.out")
    nodes, triangles = rows("nod2d.out")[1:], rows("elem2d.out")
    assert [" ".join(row[1:3]) for row in nodes] == output("convert half.txt -o - --to lonlat").splitlines()
    assert [int(row[0]) for row in nodes] == list(range(1, 61)) and sum(int(row[3]) for row in nodes) >= 3
    off = output("triangulate half.txt -o - --to off").splitlines()[-int(triangles[0][0]):]
    assert [[int(word) - 1 for word in row] for row in triangles[1:]] == [[int(w) for w in row.split()[1:]] for row in off]
    refuses(1, "triangulate half.txt --to fesom -o half.txt2", "has files called nod2d.out and elem2d.out")


@needs_netcdf
@pytest.mark.parametrize("family", ["random", "hemisphere"])
def test_the_same_bytes_through_formats(family):
    output(f"points {family} 500 -o nodes.txt")
    output("triangulate nodes.txt -o direct.lists")
    for suffix in ["nc", "off"] + ["mpas.nc"] * (family == "random"):  # mpas leaves out nodes at the boundary
        output(f"triangulate nodes.txt -o mesh.{suffix}")
        output(f"convert mesh.{suffix} -o through.lists")
        assert read("through.lists") == read("direct.lists")
    for name, options in ("a.nc", ""), ("a.raw", "--from raw --coordinates xyz"), ("a.csv", "--coordinates xyz"), (
            "a.json", "--coordinates xyz"):
        output(f"convert nodes.txt -o {name}")
        assert output(f"convert {name} {options} -o - --to xyz") == read("nodes.txt")


@needs_netcdf
def test_what_formats_cannot_hold():
    output("points random 50 -o nodes.nc")
    for name in "mesh.mpas.nc", "mesh.off", "mesh.gmt":
        refuses(1, f"convert nodes.nc -o {name}", "holds nodes without triangles")
    refuses(1, "voronoi nodes.nc -o cells.msh", "gmsh cannot hold polygons")
    refuses(1, "voronoi nodes.nc -o cells.mpas.nc", "mpas cannot hold polygons")
    output("voronoi nodes.nc -o cells.nc")
    refuses(1, "convert cells.nc -o cells.off", "50 of its faces have more than three corners")
    write("broken.nc", "CDF, it says")
    refuses(1, "triangulate broken.nc -o mesh.nc", "broken.nc: NetCDF: Unknown file format")


def test_places_are_written_as_given():
    # Longitudes and latitudes without exact vectors, beyond 180 degrees or in unusual notation.
    given = "\n".join(f"{(k * 137.50776) % 360:.14g} {(k * 61.80339887) % 180 - 90:.14g}" for k in range(200)) + "\n"
    back = output("convert - -o - --to lonlat", given + "30 40\n-179.99999999999997 1e-300\n")
    assert back.endswith("\n30 40\n-179.99999999999997 1e-300\n")
    assert [float(word) for word in back.split()[:400]] == [float(word) for word in given.split()]
    # Also as places of interpolate, as x y z, and with the places' own columns.
    write("given.txt", back)
    write("values.txt", with_value(output("points random 50"), 1))
    output("interpolate values.txt --to-points given.txt -o places.txt")
    assert [row[:2] for row in rows("places.txt")] == rows("given.txt")
    write("places.xyz", "x y z name\n" + with_value(output("points random 20 --seed 3"), '"a b"'))
    output("interpolate values.txt --to-points places.xyz -o places.txt")
    assert lines("places.txt")[0] == "# lon lat value name x y z"
    assert [row[5:] + row[3:5] for row in rows("places.txt")] == rows("places.xyz")[1:]
    # Given radians are written as degrees.
    assert output("convert - --units radians -o - --to lonlat", "1.1 -0.3\n3 1.5\n6.2 0.1\n").startswith("63.02535")


@needs_netcdf
def test_netcdf_has_the_columns_of_tables():
    # Numbers, texts, attributes and longitudes beyond 180 degrees are the same after writing and reading.
    write("table.csv", "lon,lat,depth (km),place\n300.1,40,7.25,a\n100,40,,b c\n70,-20.7,-1,\n300.1,40,9,d\n")
    output("convert table.csv -o nodes.nc")
    assert output("convert nodes.nc -o - --to lonlat") == "300.1 40\n100 40\n70 -20.7\n300.1 40\n"
    output("triangulate nodes.nc --duplicates first -o mesh.nc")
    output("convert mesh.nc -o again.nc")
    assert output("convert again.nc -o - --to lonlat") == "300.1 40\n100 40\n70 -20.7\n"
    output("convert again.nc -o mesh.vtu")
    assert vtu_values("mesh.vtu", "depth") == ["7.25", "nan", "-1"]
    assert vtu_values("mesh.vtu", "lon") == ["300.1", "100", "70"] and read("mesh.vtu").count('Name="degree') == 1
    write("table.csv", "lon,lat,depth (km),place\n300,40,7,a\n100,40,8,b\n70,-20.7,-1,\n")
    output("interpolate table.csv --variable depth --to-points table.csv -o points.nc")
    output("interpolate points.nc --variable depth --to-points points.nc -o out.txt")
    assert lines("out.txt")[:2] == ["# lon lat depth [km] depth_given [km] depth_given_given [km] place", '300 40 7 7 7 "a"']


def test_tables():
    # A catalogue with a byte order mark, quotes, missing values, latitude first and a duplicate.
    write("quakes.csv", "\ufefftime,latitude,longitude,mag,place\r\n"
          '2020-01-01,61.2,-150.1,4.5,"10 km S of ""A"" #2"\r\n2020-01-02,40,30,3,\r\n,-10.3,170.7,,Fiji\r\n'
          '2020-01-04,40,30,5,"again"\r\n2020-01-05,50.1,20.3,1,e\r\n')
    for options in "", "--duplicates error":
        refuses(1, f"triangulate quakes.csv {options} -o mesh.vtu", "node 2 (line 3) and node 4 (line 5) are in the same "
                "place: remove one, or say --duplicates=first")
    for rule, value in ("first", "3"), ("mean", "4"):
        messages(f"triangulate quakes.csv --duplicates {rule} -o mesh.vtu",
                 "quakes.csv: 1 node dropped that coincides with earlier ones")
        assert vtu_values("mesh.vtu", "node") == ["1", "2", "3", "5"]
        assert vtu_values("mesh.vtu", "line") == ["2", "3", "4", "6"]
        assert vtu_values("mesh.vtu", "lon") == ["-150.1", "30", "170.7", "20.3"]
        assert vtu_values("mesh.vtu", "mag") == ["4.5", value, "nan", "1"]
    skip = "--skip-missing --duplicates"
    assert output("info quakes.csv").splitlines()[-1] == "duplicate        node 2 (line 3) and node 4 (line 5)"
    assert json.loads(output("info quakes.csv --json"))["duplicate_pairs"] == [[2, 4]]
    # Columns by name and number; the value of interpolate.
    for columns in "longitude,latitude,mag", "3,2,4":
        output(f"interpolate quakes.csv --columns {columns} {skip} mean --to-points quakes.csv -o out.txt")
        assert lines("out.txt")[0] == "# lon lat mag time mag_given place"
        assert lines("out.txt")[2] == '30 40 4 "2020-01-02" 3 ""'
    # What interpolate writes is read again.
    output(f"interpolate out.txt --variable mag {skip} first --to-points quakes.csv -o again.txt")
    assert [row[:3] for row in rows("again.txt")] == [row[:3] for row in rows("out.txt")]
    # Stations without a place or a value are left out on request; numbers are those in the input.
    write("gaps.csv", "name,lon,lat,t\na,10,20,1\nb,,30,2\nc,100,40,3\nd,20,-50,\ne,NA,5,5\nf,100,40,7\ng,170,5,7\nh,80,7,7\n")
    refuses(1, "triangulate gaps.csv -o a.vtu", "gaps.csv:3: nothing in column 'lon': remove the row, say --skip-missing")
    refuses(1, "-q triangulate gaps.csv --skip-missing -o failed.vtu",
            "gaps.csv: node 3 (line 4) and node 6 (line 7) are in the same place")
    messages(f"triangulate gaps.csv {skip} first -o mesh.vtu", "gaps.csv: 2 nodes without place left out")
    assert vtu_values("mesh.vtu", "node") == ["1", "3", "4", "7", "8"]
    left = messages(f"interpolate gaps.csv --variable t {skip} first --to-points gaps.csv -o out.txt",
                    "gaps.csv: 1 node without value left out")
    assert left.count("gaps.csv: 2 nodes without place left out") == 2
    assert [row[2] for row in rows("out.txt")] == ["1", "3", "nan", "3", "7", "7"]
    assert json.loads(output("info gaps.csv --skip-missing --json"))["duplicate_pairs"] == [[3, 6]]
    output("triangulate - -o mesh.vtu", "> -Z1\n100\t0\n110\t5\n> -Z2\n100\t50\n")  # segments of GMT
    assert vtu_values("mesh.vtu", "segment") == ["1", "1", "2"]


def test_tables_that_would_take_any_memory():
    places = [(k % 360, k // 50) for k in range(4000)]
    write("notes.csv", "lon,lat,note\n" + "".join(f"{lon},{lat},a\n" for lon, lat in places) + "7.5,80.5," + 20000 * "x")
    if os.environ.get("NETCDF"):
        refuses(1, "convert notes.csv -o notes.nc", "notes.nc: column 'note' has a text of 20000 bytes, and NetCDF "
                "stores all texts as long as this, 80 MB: leave the column out by --columns")
    write("own.geojson", json.dumps({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {f"p{k}": 1}, "geometry": {"type": "Point", "coordinates": place}}
        for k, place in enumerate(places)]}))
    result = start("info own.geojson").stderr
    assert re.search("own.geojson: feature 2.* the properties have .* different names, the last .p2.*: give all features "
                     "the same", result), result


def test_geojson():
    # Reading a written file gives the same longitudes beyond 180 degrees, missing values, texts, history and vectors.
    write("table.csv", 'lon,lat,depth,place\n300.1,40,7.25,a\n100,40,,"b ""c"" d"\n-70,-20.7,-1,\n180,89.99,3,d\n')
    output("convert table.csv -o nodes.geojson")
    assert output("convert nodes.geojson -o - --to csv") == read("table.csv")
    output("convert nodes.geojson -o again.geojson")
    assert lines("again.geojson")[1:] == lines("nodes.geojson")[1:]
    assert re.search(r"nodes.geojson -o again.geojson .*\\npstripack .*table.csv", lines("again.geojson")[0])
    # A value by name or as the first column after the coordinates; also as places.
    for option in "--variable depth", "--columns lon,lat,depth":
        output(f"interpolate nodes.geojson {option} --skip-missing --to-points nodes.geojson -o values.txt")
        assert lines("values.txt")[:2] == ["# lon lat depth depth_given place", '300.1 40 7.25 7.25 "a"']
    # Files of other programs: a byte order mark, several points per feature, altitudes, nested properties.
    write("other.geojson", '\ufeff{"type": "FeatureCollection", "name": "x", "features": [\n'
          '{"geometry": {"coordinates": [[0, 0, 5], [10, 50]], "type": "MultiPoint"}, "type": "Feature", "properties": '
          '{"mag": 1, "features": {"a": [1]}}},\n{"type": "Feature", "properties": null, "geometry": {"type": "Point", '
          '"coordinates": [-1e1, 3]}}], "title": "T"}\n')
    assert output("convert other.geojson -o - --to csv") == (
        'lon,lat,altitude,mag,features\n0,0,5,1,"{""a"":[1]}"\n10,50,,1,"{""a"":[1]}"\n-10,3,,,\n')
    output("voronoi other.geojson -o cells.csv")
    assert [",".join(row[:4]) for row in table("cells.csv")] == ["lon,lat,node,feature", "0,0,1,1", "10,50,2,1", "-10,3,3,2"]
    refuses(1, "interpolate nodes.geojson --variable place --to-grid 2x2 -o a.txt",
            "no property 'place' is a number; properties that are numbers: depth")


FEATURES = ('{"type": "FeatureCollection", "features": [\n'
            '{"type": "Feature", "properties": {"mag": 1}, "geometry": {"type": "Point", "coordinates": [10, 20]}},\n')


def point(coordinates, kind="Point"):
    return FEATURES + '{"type": "Feature", "geometry": {"type": "%s", "coordinates": %s}}]}' % (kind, coordinates)


@pytest.mark.parametrize("text, options, words", [
    (point("[1, NaN]"), "", "3: not valid JSON: "),
    ("1 2\n", "--from geojson", "1: not valid JSON"),
    (point("[1, 1e400]"), "", " feature 2: a number is larger than 1e308"),
    (point('[1, "2"]'), "", " feature 2: expected coordinates [longitude, latitude]"),
    (point("[30, 95]"), "", " node 2 (feature 2): latitude 95 is beyond the pole: GeoJSON has [longitude, latitude] in "
     "degrees; are they exchanged?"),
    (point("[[10, 20], [30, 40], [50, 10]]", "MultiPoint"), "--columns lon,lat",
     " node 1 (feature 1) and node 2 (feature 2) are in the same place"),
    (point("[[[1, 2]]]", "Polygon"), "",
     " feature 2: 'Polygon' is not a Point or MultiPoint: nodes are points; meshes are read from UGRID"),
    (FEATURES + " null]}", "", ' "features" must be an array of features'),
    (FEATURES + ' {"type": "Feature", "geometry": null}]}', "", " feature 2: has no geometry: remove it"),
    ('{"type": "FeatureCollection", "features": []}', "", " no points"),
    ('{"type": "Topology"}', "", " not GeoJSON of points: the type is 'Topology', expected FeatureCollection"),
    ('{"crs": {"type": "name", "properties": {"name": "EPSG:3857"}}, ' + point("[1, 2]")[1:], "",
     " coordinates are in EPSG:3857: write the file in longitudes and latitudes, EPSG:4326"),
    (point("[1, 2]"), "--columns lon,lat,mga", " there is no property 'mga'; did you mean mag?; the features have mag"),
    (point("[1, 2]"), "--columns mag", " the coordinates are those of the geometry: give --columns lon,lat,NAME"),
    (point("[1, 2]"), "--coordinates xyz", " --coordinates xyz needs the property 'x'"),
])
def test_geojson_that_is_refused(text, options, words):
    write("bad.geojson", text)
    refuses(1, f"triangulate bad.geojson {options} -o mesh.off", f"bad.geojson:{words}")


# Maps.


def ring(west, east, south, north):
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


def polygon(*rings, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": "Polygon", "coordinates": rings}}


def write_json(name, value):
    write(name, json.dumps(value))


def test_triangles_and_cells_on_maps():
    write("table.csv", 'lon,lat,depth (km),place\n170,-10,7.25,"a, ""b"" c"\n-170,-10,,c\n180,10,-1,"d # e"\n')
    # A row for each triangle, cell or node.
    output("triangulate table.csv -o mesh.csv")
    assert [row[:3] for row in table("mesh.csv")] == [["node1", "node2", "node3"], ["1", "2", "3"]]
    output("voronoi table.csv --clip-to-hull -o cells.csv")
    assert lines("cells.csv")[0] == "lon,lat,node,line,depth [km],place,degree,area [sr],area_km2,centroid_lon,centroid_lat"
    # The triangle crosses the dateline: two polygons, with the nodes to the last bit.
    output("triangulate table.csv -o mesh.geojson")
    (triangle,) = features("mesh.geojson")
    assert triangle["geometry"]["type"] == "MultiPolygon"
    for corner in "170,-10", "180,10", "-180,10", "-170,-10":
        assert f"[{corner}]" in read("mesh.geojson")
    output("points random 20 -o nodes.txt")
    left = int(re.search(r"nodes.txt: (\d*) triangles with a side longer than 60deg left out$",
                         messages("triangulate nodes.txt --longest 60deg -o some.csv"), re.MULTILINE)[1])
    assert len(lines("some.csv")) == 37 - left
    for code, arguments, words in (
            (1, "table.csv --longest 1000km -o a.off", "each triangle has a side longer than 1000km"),
            (1, "-q nodes.txt --longest 5000km -o a.lists", "holds whole triangulations: leave out --longest"),
            (2, "table.csv --longest 0km -o a.off", "--longest: '0km' leaves out everything"),
            (2, "table.csv --longest 5 -o a.off", "--longest: '5': expected a number and its unit"),
            (2, "nodes.txt --region 0,10,0,10 -o a.off", "there is no option --region")):
        refuses(code, "triangulate " + arguments, words)


def test_cells_in_regions_and_polygons():
    write("table.csv", "lon,lat\n170,-10\n-170,-10\n180,10\n")
    output("points random 20 -o nodes.txt")
    # A region within one cell; other formats also get the cut cells.
    output("voronoi table.csv --clip-to 0,0.1,10,10.1 -o one.geojson")
    (cell,) = features("one.geojson")
    for corner in [0, 10], [0.1, 10], [0.1, 10.1], [0, 10.1]:
        assert corner in cell["geometry"]["coordinates"][0]
    for suffix in "vtu", "off", "gmt":
        output(f"voronoi table.csv --clip-to 170,-170,-20,20 -o part.{suffix}")
    assert lines("part.off")[1].split()[1] == "3"
    # Polygons with a hole, two of them, and their names.
    both = {"type": "MultiPolygon",
            "coordinates": [[ring(10, 30, -10, 10), ring(15, 20, -5, 5)], [ring(40, 41, 3, 4)]]}
    write_json("two.json", both)
    output("voronoi nodes.txt --clip-to two.json -o parts.geojson")
    area = sum(feature["properties"]["area_km2"] for feature in features("parts.geojson"))
    assert abs(area / 4315587 - 1) < 1e-5
    other = {**polygon(ring(5, 10, -10, 10)), "id": 7}
    write_json("named.json", {"type": "FeatureCollection", "features": [polygon(ring(10, 30, -10, 10), NAME="east\nbank"),
                                                                         other]})
    output("voronoi nodes.txt --clip-to named.json -o parts.csv")
    assert {tuple(row[-6:-4]) for row in table("parts.csv")[1:]} == {("1", "east bank"), ("2", "7")}
    # Regions of MPAS-Limited-Area, whose circles have 100 corners.
    for text, part in (("Type: circle\nName: c\nPoint: 0, 50\nradius: 1e6\n", (1 - math.cos(1000 / 6371)) / 2),
                       ("Type: channel\nName: c\nUpper-lat: -30\nLower-lat: -60\n", (math.sin(math.pi / 3) - 0.5) / 2)):
        write("area.pts", text)
        output("voronoi nodes.txt --clip-to area.pts -o parts.geojson")
        area = sum(feature["properties"]["area"] for feature in features("parts.geojson"))
        assert abs(area / (4 * math.pi * part) - 1) < 1e-3 and features("parts.geojson")[0]["properties"]["polygon_name"] == "c"
    write("cap.txt", "0 0\n10 0\n0 10\n3 3\n")
    for code, arguments, words in (
            (1, "nodes.txt --clip-to missing.json", "missing.json: cannot be opened"),
            (2, "nodes.txt --clip-to 0,10,5,-5", "170,-170 crosses the dateline"),
            (2, "nodes.txt --clip-to 0,1,0,1,2", "is not 4 numbers"),
            (1, "cap.txt --units degrees --clip-to-hull --clip-to 100,110,0,10",
             "cap.txt: 100,110,0,10 holds no part of the cells that is wider than rounding"),
            (1, "nodes.txt --clip-to 0,1e-13,0,1e-13", "0,1e-13,0,1e-13 holds no part of the cells")):
        refuses(code, f"voronoi {arguments} -o failed.csv", words)
    for box in "10,10,0,1", "0,10,20,20", "0,10,-91,0", "-200,170,0,1":
        refuses(2, f"voronoi nodes.txt --clip-to={box} -o failed.csv", f"--clip-to: '{box}'")
    # If the nodes surround the sphere, the hull cuts nothing.
    messages("voronoi nodes.txt --clip-to-hull -o hull.off",
             "^pstripack: nodes.txt: the nodes surround the sphere: --clip-to-hull cuts nothing$")
    assert read("hull.off") == output("voronoi nodes.txt -o - --to off")
    one, three = (output(f"--threads {threads} voronoi nodes.txt -o - --to geojson") for threads in (1, 3))
    assert one.splitlines()[1:] == three.splitlines()[1:]


def test_huge_cells_are_told():
    # Stations of a region, whose outer cells reach around the sphere. On a whole sphere no cell is huge.
    write("stations.lonlat", "".join(f"{129 + 16 * (k * 0.618 % 1)} {31 + 14 * (k * 0.414 % 1)}\n" for k in range(60)))
    told = (r"pstripack: stations.lonlat: the cell of node \d* has \d* km2, \d* times the median: .* --clip-to or "
            "--clip-to-hull$")
    messages("voronoi stations.lonlat -o cells.geojson", told)
    for cut in "--clip-to-hull", "--clip-to 129,145,31,45":
        assert "the median" not in messages(f"voronoi stations.lonlat {cut} -o cells.geojson")
    output("voronoi stations.lonlat -o cells.geojson")
    output("points random 5000 -o nodes.txt")
    assert messages("voronoi nodes.txt -o cells.off").count("\n") == 1


# Pictures.


def test_pictures():
    output("points random 300 -o nodes.txt")
    picture = output("plot nodes.txt -o - --to svg")
    assert ">nodes.txt: 300 nodes, 596 triangles<" in picture
    assert output('plot - -o - --to svg --title "nodes.txt: 300 nodes, 596 triangles"', read("nodes.txt")) == picture
    owners = "plot nodes.txt --what cells --colour owner:5"
    stripes = [output(f"--threads {threads} {owners}:stripes -o - --to svg") for threads in (1, 2)]
    assert stripes[0] == stripes[1] != output(owners + " -o - --to svg")
    # The triangles of a mesh are drawn as they are: the other diagonal of a square on the equator.
    off = "OFF\n4 2 0\n0.9 0.3 0.3\n0.9 -0.3 0.3\n0.9 -0.3 -0.3\n0.9 0.3 -0.31\n"
    one, other = (output('plot - --title "" -o - --to svg', off + triangles)
                  for triangles in ("3 0 1 2\n3 0 2 3\n", "3 0 1 3\n3 1 2 3\n"))
    assert one != other
    part = output("plot nodes.txt --what cells --colour area --range 1e5,1e6 --dots --box 170,-170,-30,-10 "
                  "-o - --to svg")
    assert ">nodes.txt: 300 cells<" in part and "fde725" in part
    # Cells that voronoi has written, and their columns; of another command's, or another program's, not.
    output("voronoi nodes.txt -o cells.geojson")
    messages("plot cells.geojson --what cells --colour area_km2 --title '' -o cells.svg",
             "cells.geojson: whole cells of its nodes are drawn")
    assert "area_km2" in read("cells.svg")
    degrees = [output(f"plot {name} --what cells --colour degree --title '' -o - --to svg").count("<path")
               for name in ("nodes.txt", "cells.geojson")]
    assert degrees[0] == degrees[1]
    output("triangulate nodes.txt -o mesh.geojson")
    refuses(1, "plot mesh.geojson -o c.svg",
            "meshes are read from UGRID, MPAS and OFF, `plot` also takes the cells of `pstripack voronoi`")
    write("quakes.csv", "lon,lat,mag,place\n0,0,1,a\n90,0,2,b\n180,0,3,a\n270,0,4,b\n0,90,5,a\n0,-90,,\n")
    for column, texts in ("mag", [">mag<", ">no value: 1 cell<"]), ("place", [">a (3)<", ">b (2)<"]):
        drawn = output(f"plot quakes.csv --what cells --colour {column} -o - --to svg")
        assert all(text in drawn for text in texts)
    refuses(1, "plot quakes.csv -o c.svg --colour place", "place is a column of words: say --what cells")
    output("plot - --what cells -o lunes.svg", "1 0 0\n0 1 0\n0 0 1\n")


def test_pictures_that_are_refused():
    output("points random 300 -o nodes.txt")
    for code, arguments, words in (
            (2, "-o picture.gif", "picture.gif: expected FILE.svg or FILE.html"),
            (2, "-o c.svg --view mercator", "--view: mercator: expected orthographic, lonlat"),
            (2, "-o c.svg --view orthographic:0,91", "--view: orthographic:0,91: expected"),
            (2, "-o c.svg --colour owner:0", "owner:0: expected owner:P or owner:P:stripes for 1 to 4096 ranks"),
            (2, "-o c.svg --colour owner:4:boxes", "--colour: owner:4:boxes: expected"),
            (2, "-o c.svg --colour degree", "degree is a property of nodes: say --what cells"),
            (1, "-o c.svg --colour aera", "nodes.txt: --colour aera: no column has this name; did you mean area? (expected "
             "none, area, degree, owner:P, node, line)"),
            (1, "-o c.svg --coast-file no.shp", "no.shp: cannot be opened: No such file"),
            (1, "-o c.svg --coast-file nodes.txt", "nodes.txt: not a shapefile (.shp) of lines or polygons"),
            (2, "-o c.svg --box 0,10,20,30 --zoom 5", "--box: it is a map of longitude and latitude: leave out --zoom"),
            (2, "-o c.svg --box 0,10,20,30 --view orthographic", "--box: it is a map of longitude and latitude: leave out"),
            (2, "-o c.svg --box 0,10,30,20", "--box: '0,10,30,20': expected WEST,EAST,SOUTH,NORTH"),
            (2, "-o c.svg --zoom nan", "--zoom: 'nan' is not a number from 1e-06 to 180"),
            (2, "-o c.svg --colour area --range 5,2", "--range: '5,2': expected LOW,HIGH, the lower first"),
            (2, "-o c.svg --range 2,5", "--range: a colour bar is needed: --colour area or a column of numbers"),
            (2, "-o c.html --view lonlat", "a globe has no --view lonlat, --box, --dots or --width"),
            (2, "-o c.html --width 500", "a globe has no --view lonlat, --box, --dots or --width")):
        refuses(code, "plot nodes.txt " + arguments, words)


# Values.


def test_interpolate():
    write("values.txt", with_value(OCTAHEDRON, lambda line: 1 if line < 3 else 3))
    write("places.txt", "0 0\n45 0\n90 90\n225 0\n")
    # By natural neighbours the nodes across the arc have a share.
    for method, values in ("linear", [1, 1, 1, 3]), ("natural", [1, 1.08915, 1, 2.91085]):
        messages(f"interpolate values.txt --to-points places.txt --method {method} -o out.txt",
                 r"^pstripack: 6 nodes \(text, x y z\), 4 places, 0 outside the nodes; ")
        assert [float(row[2]) for row in rows("out.txt")] == pytest.approx(values, rel=1e-5)
    # The nodes themselves, to the last bit; through a pipe; lon lat and a column; threads.
    output("points random 300 -o nodes.txt")
    values = [float(x) * float(y) + float(z) for x, y, z in rows("nodes.txt")]
    write("values.txt", with_value(read("nodes.txt"), lambda line: repr(values[line])))
    given = output("interpolate - --to-points nodes.txt --method natural -o -", read("values.txt"))
    assert [float(line.split()[2]) for line in given.splitlines()[1:]] == values
    one = output("--threads 1 interpolate values.txt --grid-step 5 --method natural -o -")
    assert one == output("--threads 3 interpolate values.txt --to-grid 36x72 --method natural -o -")
    assert one.splitlines()[1].startswith("-177.5 -87.5 ")
    places = output("convert nodes.txt -o - --to lonlat")
    write("fourth.txt", with_value(with_value(places, 7), lambda line: line + 1))
    output("interpolate fourth.txt --coordinates lonlat --variable 4 --to-points nodes.txt -o out.txt")
    assert [float(row[2]) for row in rows("out.txt")] == pytest.approx(range(1, 301), abs=1e-8)
    # The value is in column 3, so the first two are lon lat.
    write("third.txt", with_value(with_value(places, lambda line: line + 1), 7))
    assert output("interpolate third.txt --variable 3 --to-points nodes.txt -o -") == read("out.txt")


def test_interpolate_outside_of_a_region_and_by_the_nearest_node():
    write("region.txt", with_value(output("points cap:0.3 100"), lambda line: line + 1))
    outside = int(re.search(r" places, (\d*) outside the nodes",
                            messages("interpolate region.txt --grid-step 10 -o missing.txt"))[1])
    assert outside > 600 and [row[2] for row in rows("missing.txt")].count("nan") == outside
    assert "nan" not in output("interpolate region.txt --grid-step 10 --outside nearest -o -")
    output("interpolate region.txt --to-grid 2x3 --box 10,40,-20,0 -o grid.txt --outside nearest")
    assert [f"{lon} {lat}" for lon, lat, _ in rows("grid.txt")] == [
        "15 -15", "25 -15", "35 -15", "15 -5", "25 -5", "35 -5"]
    # The value of the nearest node, also beyond the region.
    write("few.csv", "lon,lat,v\n10,0,1\n,0,9\n12,0,2\n10,2,3\n12,0,2\n")
    write("two.csv", "lon,lat,name\n10,-1,a\n100,0,b\n")
    output("interpolate few.csv --units degrees --skip-missing --duplicates first --method nearest --to-points two.csv -o out.csv")
    assert table("out.csv")[1:] == [["10", "-1", "1", "a"], ["100", "0", "2", "b"]]
    # Missing values and duplicates.
    region = lines("region.txt")
    region[4] = region[4].rsplit(" ", 1)[0] + " nan"
    write("odd.txt", "\n".join([region[0], *region]) + "\n")
    write("places.txt", output("points cap:0.3 100"))
    messages("interpolate odd.txt --skip-missing --duplicates first --to-points places.txt -o out.txt",
             "odd.txt: 1 node without value left out", "odd.txt: 1 node dropped that coincides with earlier ones")
    assert all(float(row[2]) == k + 1 for k, row in enumerate(rows("out.txt")) if k != 4)


def test_values_and_grids_that_are_refused():
    write("a.txt", with_value(OCTAHEDRON, lambda line: "nan" if line == 1 else 1))
    write("two.txt", "10 20\n30 40\n")
    write("three.txt", "10 20 1\n30 40 1\n")
    write("twice.txt", with_value(OCTAHEDRON + OCTAHEDRON, 1))
    write("cap.txt", with_value(output("points cap:0.3 100"), 1))
    for code, arguments, words in (
            (1, "a.txt --grid-step 30 -o b.txt", "a.txt: node 2 (line 2) has no value: remove it, or say --skip-missing"),
            (2, "a.txt -o b.txt", "give one of --to-points, --to-grid, --grid-step"),
            (2, "a.txt --grid-step 30 --to-grid 2x2 -o b.txt", "--to-grid excludes --grid-step"),
            (2, "a.txt --grid-step 1km -o b.txt", "--grid-step: '1km' is not a number of degrees above 0"),
            (2, "a.txt --grid-step 7 -o b.txt", "180 degrees are not a multiple of 7"),
            (2, "a.txt --grid-step 30", "--output or --weights is required"),
            (2, "a.txt --grid-step 30 --duplicates mean --weights b.nc", "--weights: need one node for each place"),
            (1, "three.txt --grid-step 30 --weights b.nc", "three.txt: has 3 columns: say --coordinates lonlat or xyz"),
            (2, "a.txt --to-grid 180 -o b.txt", "'180' is not 2 numbers"),
            (2, "a.txt --to-grid 1x5 --registration node -o b.txt", "expected NLATxNLON"),
            (2, "a.txt --grid-step 1 --box 5,5,0,1 -o b.txt", "--box: '5,5,0,1': expected WEST,EAST,SOUTH,NORTH"),
            (2, "a.txt --grid-step 30 -o b.xxx", "neither .nc nor .txt nor .csv: give --to"),
            (2, "a.txt --to-points a.txt --registration node -o b.txt", "--to-points excludes --registration"),
            (1, "octahedron.txt --grid-step 30 -o b.txt", "may be degrees or radians"),
            (1, "two.txt --grid-step 30 -o b.txt", "two.txt: has 2 columns: say --coordinates lonlat or xyz"),
            (1, "twice.txt --grid-step 30 -o b.txt", "are in the same place: remove one, or say --duplicates=first"),
            (1, "cap.txt --to-points no.txt -o b.txt", "no.txt: cannot be opened")):
        refuses(code, "interpolate " + arguments, words)


def test_grids():
    # Grids of nodes include the region's edges, but no meridian twice; grids of cells lie between the edges.
    nodes = output("points random 300").splitlines()
    write("values.txt", "".join(f"{line} {1 + float(line.split()[0]) + 2 * float(line.split()[2])!r}\n" for line in nodes))

    def grid(options):
        output(f"interpolate values.txt {options} -o grid.txt")
        return [tuple(map(float, row)) for row in rows("grid.txt")]

    def axes(places):
        return sorted({lon for lon, _, _ in places}), sorted({lat for _, lat, _ in places})

    part = grid("--registration node --box 170,-170,-30,-10 --grid-step 10")
    assert axes(part) == ([170, 180, 190], [-30, -20, -10])
    assert axes(grid("--box 170,-170,-30,-10 --grid-step 10")) == ([175, 185], [-25, -15])
    assert grid("--registration node --to-grid 3x3 --box 170,-170,-30,-10") == part
    for method in "linear", "natural", "cubic":
        everywhere = grid(f"--method {method} --registration node --box 0,360,-90,90 --grid-step 30")
        assert axes(everywhere) == (list(range(0, 360, 30)), list(range(-90, 91, 30)))
        for pole in -90, 90:  # one place, one value
            assert len({value for _, lat, value in everywhere if lat == pole}) == 1
    # CSV: a header, and nothing where a value is missing.
    write("region.txt", with_value(output("points cap:0.3 50"), 7))
    output("interpolate region.txt --grid-step 30 -o region.csv")
    assert lines("region.csv")[:2] == ["lon,lat,value", "-165,-75,"]


@needs_netcdf
def test_values_in_netcdf():
    nodes = output("points random 200").splitlines()
    write("values.txt", "".join(f"{line} {280 + float(line.split()[2])!r}\n" for line in nodes))
    # To a grid, and from the grid in NetCDF to points and nodes.
    output("interpolate values.txt --grid-step 2 -o grid.nc")
    output("interpolate values.txt --grid-step 2 -o grid.txt")
    values = [row[2] for row in rows("grid.txt")]
    write("places.txt", "".join(f"{lon} {lat}\n" for lon, lat, _ in rows("grid.txt")))
    output("interpolate grid.nc --variable value --to-points places.txt -o back.txt")
    assert [row[2] for row in rows("back.txt")] == values
    # Values missing in the input are missing in the output.
    write("region.txt", with_value(output("points cap:0.5 100"), 1))
    output("interpolate region.txt --grid-step 10 -o region.nc")
    for variable in "--variable value", "":  # the only variable
        output(f"interpolate region.nc {variable} --skip-missing --grid-step 30 --outside nearest -o out.txt")
        assert all(row[2] == "1" for row in rows("out.txt"))
    for arguments, words in (("value", "node 1 has no value: remove it, or say --skip-missing"),
                             ("depth", "there is no variable depth; say"),
                             ("lon", "variable lon(lon=36): expected lon(lat=18, lon=36)")):
        refuses(1, f"interpolate region.nc --variable {arguments} --grid-step 30 -o failed.nc", words)


# Centroidal tessellations.

BY_SIDES = r"^pstripack: cells by sides: .* (all triangles hold their|triangles do not hold their|1 triangle does not hold its) circumcentre$"


def wait_for(name):
    for _ in range(3000):
        if os.path.exists(name):
            return
        time.sleep(0.02)


@needs_netcdf
def test_scvt_continues_to_the_same_bytes():
    messages("scvt 300 --density bump --evaluations 30 --tolerance 1e-6 -o direct.nodes.nc",
             "^pstripack: 300 generators, 3[0-9] evaluations, NOT converged to 1e-06: gradient .*, energy .*; iterating .* s; "
             ".*writing .* s$",
             "^pstripack: cells by sides: .*; angles .* to .* degrees; neighbouring areas up to .* : 1; .* triangles .* hold "
             "their circumcentre$")
    # Cut short within the first steps, with some and with all pairs of the quasi-Newton method, and from two formats.
    for every, checkpoint in (2, "checkpoint.nc"), (5, "checkpoint.ugrid.nc"), (11, "checkpoint.nc"):
        output(f"scvt 300 --density bump --evaluations 14 --tolerance 1e-6 --checkpoint {checkpoint} --every {every} "
               "-o short.mpas.nc")
        messages(f"scvt --start {checkpoint} --evaluations 30 --tolerance 1e-6 -o resumed.nodes.nc", " 3[0-9] evaluations, ")
        assert content("resumed.nodes.nc") == content("direct.nodes.nc")
        assert nodes_of(checkpoint).count("\n") == 300
    # Without the pairs the run starts new ones; evaluations are counted from where the other run ended.
    messages("scvt --start short.mpas.nc --evaluations 200 --tolerance 1e-4 -o a.off", " evaluations, converged to 0.0001: ")
    messages("scvt --start direct.nodes.nc --evaluations 12 --tolerance 1e-6 -o again.nodes.nc", "none was left to do")
    assert content("again.nodes.nc") == content("direct.nodes.nc")
    # With another density the pairs are useless; the run still converges.
    messages("scvt --start checkpoint.nc --density bump:0,0,30,10,2 --evaluations 1e3 -o other.off", ", converged to 0.0001: ")
    # Lloyd's method has no memory: it also continues from its output.
    lloyd = "--method lloyd --evaluations"
    output(f"scvt 300 --first random {lloyd} 12 -o lloyd.nodes.nc")
    output(f"scvt 300 --first random {lloyd} 9 --checkpoint checkpoint.nc --every 4 -o short.ugrid.nc")
    for first in "checkpoint.nc", "short.ugrid.nc":
        messages(f"scvt --start {first} {lloyd} 12 -o resumed.nodes.nc", " 12 evaluations, ")
        assert content("resumed.nodes.nc") == content("lloyd.nodes.nc")
    # Other threads, and a format without density.
    output("--threads 3 scvt 300 --density bump --evaluations 30 --tolerance 1e-6 -o threads.txt")
    assert read("threads.txt") == nodes_of("direct.nodes.nc")
    # Each file has the command, and before it the history of the start.
    if shutil.which("ncdump"):
        for name in "checkpoint.nc", "short.ugrid.nc", "short.mpas.nc", "resumed.nodes.nc":
            header = subprocess.run(["ncdump", "-h", name], check=True, capture_output=True, text=True).stdout
            assert ':history = "pstripack scvt ' in header
        assert re.search("(?s)scvt --start short.ugrid.nc .*scvt 300 --first random --method lloyd", header)


@needs_netcdf
def test_scvt_ends_by_a_signal_or_a_limit_of_time():
    command = [PROGRAM, *"scvt 3000 --density bump --tolerance 1e-12 --checkpoint a.nc --every 1 -o term.mpas.nc".split()]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as job:
        wait_for("a.nc")
        job.send_signal(signal.SIGTERM)
        errors = job.communicate()[1]
    assert job.returncode == 128 + signal.SIGTERM, errors
    for pattern in "^pstripack: 3000 generators, .*, ended by TERM, NOT converged to 1e-12, then .*: gradient ", BY_SIDES:
        assert re.search(pattern, errors, re.MULTILINE), errors
    output("info term.mpas.nc")
    messages("scvt 3000 --density bump --tolerance 1e-12 --time-limit 0.1 -o limit.off",
             " ended by --time-limit, NOT converged to 1e-12: gradient ")


def test_scvt_first_generators():
    messages("scvt 50 --tolerance 0.1 -o loose.off", " evaluations, converged to 0.1: ")
    front, levels, chance = (output(f"scvt 3e3 --first {first} --evaluations 1 --tolerance 0.01 -o - --to xyz")
                             for first in ("front", "levels", "random"))
    assert output("scvt 3000 --evaluations 1 --tolerance 0.01 -o - --to xyz") == front != levels != chance
    messages("scvt 10242 --first levels -o ten.txt", "cells by sides: 5: 12, 6: 10230; ")


@needs_netcdf
def test_scvt_densities_in_files():
    places = output("points latlon 100")
    write("two.txt", with_value(places, 2))
    output("points random 300 -o start.txt")
    constant, same = (output(f"scvt --start start.txt {density} --evaluations 5 -o - --to xyz").split()
                      for density in ("", "--density-file two.txt"))
    assert [float(x) for x in same] == pytest.approx([float(x) for x in constant], abs=1e-6)
    # The output stores the file's name.
    of_file = "scvt 300 --density-file two.txt --first random --evaluations"
    output(f"{of_file} 6 --checkpoint checkpoint.nc --every 1 -o six.nodes.nc")
    output("scvt --start checkpoint.nc --evaluations 8 -o more.nodes.nc")
    output(f"{of_file} 8 -o eight.nodes.nc")
    assert content("more.nodes.nc") == content("eight.nodes.nc")
    os.remove("two.txt")
    refuses(1, "-q scvt --start six.nodes.nc --evaluations 7 -o failed.nc", "two.txt: cannot be opened")
    messages("scvt --start start.txt --evaluations 0 -o a.off",
             "^pstripack: start.txt: holds no density: constant; say --density or widths for another one$")
    # On a grid.
    field = output("points latlon 3000 -o - --to lonlat").splitlines()
    write("values.txt", "".join(f"{line} {2 + math.sin(math.radians(float(line.split()[1])))!r}\n" for line in field))
    output("interpolate values.txt --to-grid 36x72 -o grid.nc")
    messages("scvt 300 --density-file grid.nc --variable value -o grid.mpas.nc", " converged to 0.0001, then ")


@needs_netcdf
def test_scvt_meshes_for_mpas_are_well_centred():
    bump = "scvt 1000 --density bump:0,30,30,10,4 --tolerance 1e-3"
    messages(f"{bump} -o plain.nodes.nc", ", converged to 0.001: gradient", "; [1-9] triangles do not hold their circumcentre$")
    messages(f"{bump} -o centred.mpas.nc",
             ", converged to 0.001, then [0-9]* generators moved for their triangles' circumcentres: gradient",
             " to 79.[0-9] degrees; .* : 1; all triangles hold their circumcentre$",
             "^pstripack: [0-9]* triangles with an angle beyond 43.5 to 78.5 degrees, the first at lon [-.0-9]* lat [-.0-9]*$")
    output(f"{bump} --well-centred --strict -o centred.nodes.nc")
    assert nodes_of("centred.mpas.nc") == nodes_of("centred.nodes.nc")
    left = "triangles do not hold their circumcentre, the first at lon [-.0-9]* lat [-.0-9]*, also after [0-9]* generators "
    early = "scvt 500 --first random --evaluations 1 --well-centred"
    messages(f"{early} -o a.off", f"^pstripack: [0-9]* {left}were moved: try")
    for command, words in (f"-q {early}", "triangles do not hold their circumcentre, the first at lon"), (
            "-q scvt 500 --evaluations 1", "not converged to 0.0001"):
        refuses(1, f"{command} --strict -o a.off", words)


@needs_netcdf
def test_scvt_widths():
    # Widths in km give N: 4 pi R^2 / (sqrt(3)/2 width^2). A given N scales them.
    gives = "^pstripack: the widths give {} cells$"
    messages("scvt --width 1000km --tolerance 0.1 -o width.nodes.nc", gives.format(589))
    output("scvt 589 --tolerance 0.1 -o n.nodes.nc")
    assert content("width.nodes.nc") == content("n.nodes.nc")
    messages("scvt --width 500000m --radius 3185610 --tolerance 0.1 -o half.off", gives.format(589))
    messages("scvt 147 --width 1000 --tolerance 0.1 -o coarse.off",
             "the widths give 589 cells; 147 are asked for: widths times 2.002$")

    def continues(widths, *patterns, start_file="checkpoint.nc"):
        """A run that continues from the checkpoint of a shorter one gives the same bytes."""
        messages(f"scvt {widths} --evaluations 3 --checkpoint {start_file} --every 1 -o short.nodes.nc", *patterns)
        output(f"scvt {widths} --evaluations 5 -o direct.nodes.nc")
        output(f"scvt --start {start_file} --evaluations 5 -o more.nodes.nc")
        assert content("more.nodes.nc") == content("direct.nodes.nc")

    continues("--width disc:500,2000,3000,1000,20,40",
              "^pstripack: transition made 11250 km long, so that widths change by at most 0.2 km per km$", gives.format(618))
    write_json("region.json", polygon(ring(0, 60, 20, 50), width=400, transition="2000"))
    continues("--width 1000km --width-region region.json",
              "^pstripack: widths limited to a change of 0.2 km per km: .* values lowered", gives.format(808))
    write_json("coast.json", {"type": "LineString", "coordinates": [[0, 0], [40, 20]]})
    continues("--width-distance coast.json:500:2000:9000", gives.format(304))
    # A limited area: checkpoints have all generators.
    continues("--width 300km --region 10,50,10,50", "the widths give about 21[0-9] cells in the region")
    write("area.pts", "Type: channel\nUpper-lat: 30\nLower-lat: -30\n")  # half of the sphere
    continues("--width 500km --region area.pts", "the widths give about 11[0-9][0-9] cells in the region")


def widths_file(name, values, attribute="", lats=range(-90, 91, 30), lons=range(-180, 181, 45)):
    """cellWidth(lat, lon) as mpas_tools writes it: no units, the first meridian repeated."""
    lats, lons = list(lats), list(lons)
    text = (f"netcdf w {{ dimensions: lat = {len(lats)}; lon = {len(lons)}; variables: double lat(lat), lon(lon), "
            f"cellWidth(lat, lon); {attribute} data: lat = {str(lats)[1:-1]}; lon = {str(lons)[1:-1]}; "
            f"cellWidth = {', '.join(map(str, values))}; }}")
    subprocess.run(["ncgen", "-o", name, "-"], input=text, text=True, check=True)


@needs_netcdf
@needs_ncgen
def test_scvt_widths_in_files():
    widths_file("same.nc", 63 * [1000])
    messages("scvt --width-file same.nc --tolerance 0.01 -o same.mpas.nc", "^pstripack: the widths give 589 cells$")
    widths_file("metres.nc", 63 * [1e6], 'cellWidth:units = "m";')
    output("scvt --width-file metres.nc --tolerance 0.01 -o metres.mpas.nc")
    assert nodes_of("same.mpas.nc") == nodes_of("metres.mpas.nc")
    # A run continues with the widths of its file.
    messages("scvt --start same.mpas.nc --tolerance 1e-3 -o more.off", "converged to 0.001")
    # On a rough map the energy settles, also in a run that continues.
    rough = [700 + 350 * math.sin(9.1 * k * k) if 24 < k < 300 else 700 for k in range(13 * 25)]
    rough[24::25] = rough[::25]
    widths_file("rough.nc", rough, lats=range(-90, 91, 15), lons=range(-180, 181, 15))
    settles = " evaluations, settled: ten evaluations lower the energy by less than 3e-05 of it: gradient"
    messages("scvt --width-file rough.nc --strict --checkpoint rough_checkpoint.nc --every 20 -o rough.nodes.nc", settles)
    messages("scvt --start rough_checkpoint.nc --strict -o more.nodes.nc", settles)
    assert content("more.nodes.nc") == content("rough.nodes.nc")
    # A step is limited to --grade, also in a run that continues.
    widths_file("step.nc", [4000] * 27 + [1000] * 36)
    limited = "^pstripack: widths limited to a change of"
    messages("scvt --width-file step.nc --tolerance 0.1 -o step.off",
             limited + r" 0.2 km per km: 17 of 42 values lowered, by up to 2333 km \(lon -180 lat -30\): 23 % more cells; if the map")
    step = "scvt --width-file step.nc --grade 0.1 --radius 5e6 --evaluations"
    output(f"{step} 6 --checkpoint checkpoint.nc --every 1 -o six.nodes.nc")
    messages("scvt --start checkpoint.nc --evaluations 8 -o more.nodes.nc",
             limited + " 0.1 km per km: 17 of 42 values lowered, by up to 2738 km")
    output(f"{step} 8 -o eight.nodes.nc")
    assert content("more.nodes.nc") == content("eight.nodes.nc")


@needs_netcdf
@needs_ncgen
@pytest.mark.parametrize("change, attribute, words", [
    ({k: 1e6 for k in range(12)}, "", ": the median width is 1e+06 km: if these are not km, say so: ncatted -a "
     "units,cellWidth,c,c,m w.nc"),
    ({0: "NaN", 3: "NaN"}, "", ": node 1, lon 0 lat -90: there is no width, at 2 of 12 places: fill the holes of the map"),
    ({2: -999}, "cellWidth:_FillValue = -999.;", ": node 3, lon 180 lat -90: there is no width, at 1 of 12 places"),
    ({5: -3, 6: 0}, "", ": node 6, lon 90 lat 0: width -3, one of 2 of 12 that are not positive and finite"),
    ({}, 'cellWidth:units = "miles";', ": variable cellWidth: units 'miles'; expected km or m"),
])
def test_scvt_widths_in_files_that_are_refused(change, attribute, words):
    widths_file("w.nc", [change.get(k, 9) for k in range(12)], attribute, range(-90, 91, 90), range(0, 360, 90))
    refuses(1, "scvt --width-file w.nc -o failed.off", "w.nc" + words)


def test_scvt_command_lines_that_are_refused():
    for arguments, words in {
            "": "give either N or widths, for new generators, or --start FILE",
            "10 --start octahedron.txt": "give either N",
            "10 --density potato": "density 'potato': expected constant, bump or bump:LON,LAT",
            "10 --density bump --density-file octahedron.txt": "excludes",
            "--width 60km --width-file octahedron.txt": "excludes",
            "--width 60km --density bump": "excludes",
            "10 --first middle": "--first: 'middle' is none of front, levels, random",
            "--width band:1,2,3,4": "width 'band:1,2,3,4': expected five numbers: INNER,OUTER,RADIUS,TRANSITION,LAT",
            "--width-region region.json 9": "--width-region requires --width",
            "--width ec60to30 --width-region region.json": "--width-region: not with ec60to30: say a width, as in 60km",
            "--width-distance a.json:10:120": "'a.json:10:120': expected FILE:NEAR:FAR:KM, NEAR and KM above 0 and FAR at least",
            "--width-distance a.json:10:120:900 --width 60km": "excludes",
            "--width qu60 --region circle:500,0,0": "--region: not with qu60: say a width, as in 60km",
            "--width 10km --region 0,0.7,0,0.7": "'0,0.7,0,0.7': these may be radians",
            "100 --region circle:500,0,0": "--region: say also the widths there",
            "--width=-60km": "'-60km' is no width: expected, say, 60km"}.items():
        refuses(2, f"scvt {arguments} -o failed.off", words)
    refuses(2, "scvt 10 -o failed.xxx", "no format has this suffix")
    refuses(1, "scvt 10 -o no/failed.off", "no/failed.off: cannot be written")
    refuses(1, "scvt 10 --checkpoint no/checkpoint.nc -o failed.off", "no/checkpoint.nc: cannot be written")
    refuses(1, "scvt --width 1e6 -o failed.off",
            "the widths give 0.000589 cells, not 4 to 357913943: widths are in km, --radius in metres")
    if os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") < 260e9:
        refuses(1, "-q scvt --width 1.291km -o failed.off", "353404399 generators need about 265 GB, this machine has ")


def test_scvt_generators_and_densities_that_are_refused():
    half = output("points hemisphere 30")
    write("half.txt", half)
    write("twice.txt", OCTAHEDRON + OCTAHEDRON)
    refuses(1, "-q scvt --start half.txt -o failed.off", "half.txt: the generators lie in one hemisphere")
    refuses(1, "-q scvt --start twice.txt -o failed.off", "twice.txt: node 1 (line 1) and node 7 (line 7) are in the same place")
    output("scvt --start twice.txt --duplicates first -o once.off")
    around = [f"{lon} {lat} 60\n" for lon, lat in ((0, 90), (0, 0), (90, 0), (180, 0), (-90, 0), (0, -90))]
    for text, words in (
            (with_value(half, 1), "a.txt: the density is not known on the whole sphere: the nodes leave out lon "),
            (with_value(OCTAHEDRON, lambda line: 0 if line == 3 else 1), "a.txt: node 4 (line 4): density 0: must be positive"),
            # Widths are no density, whatever the file says of itself.
            *(("".join([f"lon lat {name}\n", *around]),
               f"a.txt: {name} is a width, not a density (width^-4): say --width-file in place of --density-file")
              for name in ("cellWidth", "width", "resolution"))):
        write("a.txt", text)
        variable = f"--variable {text.split()[2]}" if text.startswith("lon") else ""
        refuses(1, f"scvt 4 --density-file a.txt {variable} -o failed.off", words)
    refuses(1, "scvt --width-file a.txt --units degrees -o failed.off",
            "a.txt: expected widths on a grid, say cellWidth(lat, lon) in NetCDF")


def test_scvt_regions_of_widths_that_are_refused():
    box = ring(0, 9, 0, 9)
    for shape, words in (({"type": "Feature", "geometry": {"type": "Point", "coordinates": [0, 0]}}, "'Point' is not a LineString"),
                         ({"type": "LineString", "coordinates": [0, 0]}, "expected lists of [longitude, "),
                         ({"type": "LineString", "coordinates": [[0, 0], [541, 0]]}, "longitude 541 is not within -540")):
        write_json("coast.json", shape)
        refuses(1, "scvt --width-distance coast.json:100:900:9000 -o failed.off", "coast.json: feature 1: " + words)
    across = [[170, 0], [-170, 0], [-170, 9], [170, 0]]
    for region, words in (
            *((polygon(box, **bad), "feature 1: it needs the property width, in km and above 0")
              for bad in ({}, {"width": 0}, {"width": "wide"}, {"width": None})),
            (polygon(box, width=30, transition=-1), "feature 1: its property transition must be in km, and not negative"),
            (polygon(box, width=3000),
             "feature 1: it is smaller than a cell of 3000 km: enlarge it, make its width smaller, or use a disc"),
            (polygon(across, width=30),
             "feature 1: its side from longitude 170 to -170 goes around the globe: cut the polygon at 180, or write 190 in "
             "place of -170"),
            (polygon([[-180, 60], [0, 65], [180, 60]] + [[180, 60]], width=30),
             "feature 1: a ring around a pole: continue it by 180,90 -180,90 and its first corner"),
            (polygon([[0, 0], [9, 0], [9, 91], [0, 0]], width=30), "feature 1: latitude 91 is beyond the pole"),
            ({"type": "Point", "coordinates": [0, 0]}, "not GeoJSON of polygons: the type is 'Point', expected "
             "FeatureCollection, Feature, Polygon or MultiPolygon")):
        write_json("region.json", region)
        refuses(1, "scvt --width 900km --width-region region.json -o failed.off", "region.json: " + words)


@needs_netcdf
def test_limited_areas_that_are_refused():
    output("triangulate - -o sphere.nc", output("points fibonacci 600"))
    output("convert sphere.nc --region circle:500,0,0 -o cells.mpas.nc")
    output("triangulate - -o half.nc", output("points hemisphere 300"))
    triangle = [[0, 0], [20, 0], [20, 20], [0, 0]]
    for name, rings in (("bow", [[[0, 0], [40, 40], [40, 0], [0, 40], [0, 0]]]),
                        ("tiny", [[[0, 0], [0.7, 0], [0.7, 0.7], [0, 0]]])):
        write_json(name + ".json", {"type": "Polygon", "coordinates": rings})
    # A ring along a parallel, in any turn, is the cap around the pole.
    output("convert sphere.nc --region 0,360,60,90 -o box.nc")
    for lons in range(0, 361, 90), range(180, -181, -120), [*range(0, 361, 120), 0]:
        write_json("cap.json", polygon([[lon, 60] for lon in lons]))
        output("convert sphere.nc --region cap.json -o cap.nc")
        assert nodes_of("cap.nc") == nodes_of("box.nc")
    write_json("two.json", {"type": "MultiPolygon", "coordinates": [[triangle], [[[90, 0], [110, 0], [100, 20], [90, 0]]]]})
    for code, command, words in (
            (1, "convert sphere.nc --sides great-circle --region cap.json",
             "cap.json: feature 1: its side from 0,60 to 360,60 is no arc of less than 180 degrees: add corners between them"),
            (2, "convert sphere.nc --sides great-circle", "--sides requires --region"),
            (1, "convert sphere.nc --region bow.json", "bow.json: feature 1: side 1 from 0,0 to 40,40 crosses or lies on side "
             "3 from 40,0 to 0,40: mend the polygon"),
            (1, "scvt --width 10km --region tiny.json",
             "within pi/2: GeoJSON is in degrees; if these are degrees, say --units degrees"),
            (1, "convert sphere.nc --units degrees --region tiny.json",
             "tiny.json: no cell has its centre in the region; those at lon "),
            (1, "scvt --width 10km --region circle:3,0,0",
             "circle:3,0,0: the region is smaller than a cell of 10 km: enlarge it"),
            (2, "convert sphere.nc --radius 6371000 --to mpas --region circle:20020,0,0",
             "expected circle:KM,LON,LAT: a radius from 0 to 20015 km"),
            (2, "convert sphere.nc --region potato",
             "there is no file 'potato': expected WEST,EAST,SOUTH,NORTH, circle:KM,LON,LAT, or a file"),
            (1, "convert sphere.nc --region two.json", "two.json: two parts that do not touch, at lon "),
            (1, "convert half.nc --region circle:2000,0,90",
             " the mesh ends within 7 layers of cells around the region: make the region smaller"),
            (1, "convert cells.mpas.nc --region circle:500,0,0", "cells.mpas.nc: cellsOnVertex has a boundary already")):
        refuses(code, f"{command} -o failed.nc", words)
    custom = "Type: custom\nPoint: 5, 5\n"
    for text, words in (
            ("Type: circle\nPoint: 50, 10\nradiu: 5\n", "area.pts:3: unknown key 'radiu'; did you mean radius?"),
            ("Type: circle\nPoint: 50, 10\n", "area.pts: there is no line `radius: ...`"),
            ("Point: 50, 10\n", "area.pts: there is no line `Type: ...`"),
            ("Type: square\n", "area.pts:1: Type 'square': expected circle, ellipse, channel or custom"),
            ("# a\nType: circle\nPoint: 91, 10\nradius: 5\n", "area.pts:3: Point: '91, 10': expected `latitude, longitude` in degrees"),
            ("Type: circle\nPoint: 1, 10\nradius: wide\n", "area.pts:3: radius: 'wide': expected a number from 1 to 2.0015"),
            ("Type: circle\nType: circle\n", "area.pts:2: Type occurs twice: remove one"),
            ("Type: circle\nPoint: 1, 10\nradius: 1e6\n1, 2\n", "area.pts:1: the Type 'circle' has no corners: only custom has"),
            ("Type: channel\nLower-lat: 20\nUpper-lat: 10\n", "area.pts:2: Lower-lat: '20': expected a number from -90 to 10"),
            (custom + "1, 2\n3, 4\n", "area.pts:1: custom needs three corners or more: lines of `lat, lon`"),
            (custom + "0, 0\n0, 180\n50, 50\n", "area.pts:1: corner 1 is opposite the next one: add a corner between them"),
            (custom + "0 0\n", "area.pts:3: a corner: '0 0': expected `latitude, longitude` in degrees")):
        write("area.pts", text)
        refuses(1, "convert sphere.nc --region area.pts -o failed.nc", words)


# Ranks.


def mpirun(ranks):
    """What starts a program on ranks; for `before` of start()."""
    return [*shlex.split(os.environ["MPIRUN"]), "-n", str(ranks)]


def on_ranks(ranks, command, *patterns, stdin=""):
    """The messages of a run of pstripack-mpi that must succeed."""
    return messages(command, *patterns, stdin=stdin, before=mpirun(ranks), program=PROGRAM + "-mpi")


def ranks_refuse(ranks, code, command, words):
    result = start(command, before=mpirun(ranks), program=PROGRAM + "-mpi")
    said = [line for line in result.stderr.splitlines() if line.startswith("pstripack:")]
    assert result.returncode == code and len(said) == 1 and words in said[0], f"{command}: {result}"
    assert not list(Path().glob("failed*"))


needs_ranks = pytest.mark.skipif("MPIRUN" not in os.environ, reason="built without MPI")


@needs_ranks
def test_ranks_write_the_same_bytes():
    output("points random 3000 -o nodes.txt")
    few = "".join(line + "\n" for line in lines("nodes.txt")[:1000])  # Hydra buffers at most 64 KB of stdin
    write("twice.txt", read("nodes.txt") + lines("nodes.txt")[0] + "\n")
    scvt = "scvt 500 --density bump --evaluations 5 --every 2 --checkpoint"
    commands = "triangulate nodes.txt -o a.lists", "voronoi nodes.txt -o a.off", f"-q {scvt} c.off -o a.txt"
    for command in commands:
        messages(command)
    serial = [read(name) for name in ("a.lists", "a.off", "a.txt", "c.off")]
    of_few = output("triangulate - -o - --to lists", few)
    for ranks in 1, 3:
        for command in commands:
            said = on_ranks(ranks, command)
            assert said.count("pstripack:") == (not command.startswith("-q")), said
            assert ranks == 1 or not said or f"; on {ranks} ranks\n" in said, said
        assert [read(name) for name in ("a.lists", "a.off", "a.txt", "c.off")] == serial
        assert len(start("-q points random 10", before=mpirun(ranks), program=PROGRAM + "-mpi").stdout.splitlines()) == 10
        # mpirun of Open MPI 4.1 sometimes crashes in mca_iof_hnp while it forwards stdin: repeat.
        for _ in range(6):
            result = start("-q triangulate - -o read.lists", few, before=mpirun(ranks), program=PROGRAM + "-mpi")
            if "mca_iof_hnp" not in result.stderr:
                break
        assert result.returncode == 0 and read("read.lists") == of_few, result
        ranks_refuse(ranks, 1, "triangulate twice.txt -o failed.lists", "are in the same place")
        ranks_refuse(ranks, 1, "triangulate missing.txt -o failed.lists", "cannot be opened")
        ranks_refuse(ranks, 2, "triangulate nodes.txt --potato -o failed.lists", "there is no option --potato")
    other = [":", "-n", "1", PROGRAM + "-mpi", "triangulate", "twice.txt", "-o", "failed.lists"]
    result = subprocess.run([*mpirun(1), PROGRAM + "-mpi", *"triangulate nodes.txt -o failed.lists".split(), *other],
                            capture_output=True, text=True)
    assert result.returncode == 2 and "the ranks have different command lines" in result.stderr
    assert not os.path.exists("failed.lists")


@needs_ranks
@pytest.mark.parametrize("options, variable, alone", [("", "", False), ("--serial", "", True), ("", "PSTRIPACK_SERIAL=1", True)])
def test_in_a_job_of_several_ranks_pstripack_must_be_told_to_work_alone(options, variable, alone):
    on_rank_0 = f'if [ "${{OMPI_COMM_WORLD_RANK:-$PMI_RANK}}" = 0 ]; then {variable} exec "$0" "$@"; fi'
    result = start(f"-q {options} triangulate octahedron.txt -o a.off", before=[*mpirun(2), "sh", "-c", on_rank_0], timeout=60)
    assert result.returncode == (0 if alone else 2) and os.path.exists("a.off") == alone, result
    assert alone or ("pstripack: this job has 2 ranks: pstripack-mpi uses them; say --serial, or set PSTRIPACK_SERIAL=1, if "
                     "each process is meant to work alone\n") in result.stderr


@needs_ranks
@needs_netcdf
def test_scvt_ranks_write_the_same_bytes(monkeypatch):
    command = "scvt 300 --density bump --tolerance 1e-9 --evaluations 14 --every 4 --checkpoint one.nc -o one.mpas.nc"
    output(command)
    os.mkdir("ranks")  # files hold the command: the same in both folders
    monkeypatch.chdir("ranks")
    on_ranks(3, f"-q --threads 2 {command}")
    for name in sorted(os.listdir()):
        assert Path(name).read_bytes() == Path("..", name).read_bytes(), name
    assert "one.mpas.nc" in os.listdir()


@needs_ranks
@needs_netcdf
def test_scvt_ranks_begin_and_continue_as_one_process():
    # More ranks than generators. Ranks begin with levels where a single process would begin with a front.
    output("scvt 4 -o one.nodes.nc")
    on_ranks(5, "-q scvt 4 -o ranks.nodes.nc")
    assert content("ranks.nodes.nc") == content("one.nodes.nc")
    # Limited areas begin with a front on any number of ranks.
    for first, command in (" --first levels", "scvt 3000 --evaluations 1 --tolerance 0.01"), (
            "", "scvt --width 300km --region 10,50,10,50"):
        one = messages(f"{command}{first} -o one.txt")
        ranks = on_ranks(2, f"{command} -o ranks.txt", "^pstripack: [0-9]* generators, [0-9]* evaluations, .*; on 2 ranks$")
        assert read("ranks.txt") == read("one.txt")
        quality = "cells by sides.*"
        assert re.search(quality, ranks)[0] == re.search(quality, one)[0]
    # Rank 0 makes a front, reads text and writes any format.
    write("start.txt", 2 * output("points random 300"))
    for command in "scvt 3000 --first front --evaluations 6 --tolerance 1e-9", "scvt --start start.txt --duplicates first":
        output(f"{command} -o one.vtu")
        on_ranks(2, f"-q {command} -o ranks.vtu")
        assert read("ranks.vtu") == read("one.vtu")
    for option in "300 --density-file -", "--width-distance -:30:300:1000":
        ranks_refuse(2, 1, f"scvt {option} -o failed.txt", "rank 0 alone has the standard input: name a file")
    # A checkpoint of three ranks continues to the same bytes on two ranks and on one.
    bump = "--density bump --tolerance 1e-9 --evaluations"
    on_ranks(3, f"-q scvt 300 {bump} 14 --every 4 --checkpoint ranks.nc -o short.nc")
    output(f"scvt 300 {bump} 30 -o direct.nodes.nc")
    on_ranks(2, f"-q scvt --start ranks.nc {bump} 30 -o two.nodes.nc")
    output(f"scvt --start ranks.nc {bump} 30 -o one.nodes.nc")
    assert content("two.nodes.nc") == content("one.nodes.nc") == content("direct.nodes.nc")


@needs_ranks
@needs_netcdf
def test_scvt_ranks_end_together_when_one_gets_term():
    output("scvt 3000 --first front --evaluations 0 -o front.nodes.nc")
    options = "scvt --start front.nodes.nc --density bump --tolerance 1e-12 --evaluations"
    command = [*mpirun(3), "sh", "-c", 'echo $$ > rank.pid; exec "$0" "$@"', PROGRAM + "-mpi",
               *f"{options} 1e5 --every 1 --checkpoint ranks.nc -o ended.nc".split()]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as job:
        wait_for("ranks.nc")
        os.kill(int(read("rank.pid")), signal.SIGTERM)
        errors = job.communicate()[1]
    ended = "^pstripack: 3000 generators, .* ended by TERM, NOT converged to 1e-12: gradient .*; on 3 ranks$"
    assert job.returncode != 0 and re.search(ended, errors, re.MULTILINE), errors
    output("info ended.nc")
    output(f"{options} 1000 -o direct.nodes.nc")
    on_ranks(2, "-q scvt --start ranks.nc --tolerance 1e-12 --evaluations 1000 -o resumed.nodes.nc")
    assert content("resumed.nodes.nc") == content("direct.nodes.nc")


@needs_ranks
@needs_netcdf
def test_scvt_ranks_refuse_what_they_cannot():
    write("start.txt", OCTAHEDRON)
    output("points hemisphere 30 -o half.nodes.nc")
    for arguments, words in {
            "10 -o no/failed.nc": "no/failed.nc: cannot be written: No such file",
            "--start half.nodes.nc -o failed.nc": "half.nodes.nc: the generators lie in one hemisphere",
            "10 --density-file start.txt -o failed.nc": "start.txt"}.items():
        ranks_refuse(2, 1, "-q scvt " + arguments, words)
