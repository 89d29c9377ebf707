"""Reads files that pstripack writes for maps by Python's own modules: GeoJSON, CSV, GMT.

map_readers.py PSTRIPACK FOLDER
"""
import csv
import json
import math
import random
import subprocess
import sys
from pathlib import Path

PROGRAM, FOLDER = sys.argv[1], Path(sys.argv[2])
HEADER = ["time", "latitude", "longitude", "depth (km)", "mag", "place"]


def run(*arguments):
    subprocess.run([PROGRAM, "-q", *map(str, arguments)], check=True)


def earthquakes(name, west, width, south, height, n, longitude):
    """A table like those of catalogues: latitude first, missing values, texts with commas and quotes."""
    numbers = random.Random(name)
    rows = []
    for k in range(n):
        lon, lat = longitude(west + width * numbers.random()), south + height * numbers.random()
        mag = "" if k % 17 == 0 else f"{2 + 5 * numbers.random():.1f}"
        rows.append([f"2024-01-{k % 28 + 1:02}", f"{lat:.4f}", f"{lon:.4f}", f"{600 * numbers.random():.1f}", mag,
                     f'{k} km S of "Où",\tFiji'])
    with open(FOLDER / f"{name}.csv", "w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([HEADER, *rows])
    return rows


def rings_of(geometry):
    """The rings of a polygon; checks that they are closed, on the map, counterclockwise and without holes."""
    polygons = {"Polygon": [geometry["coordinates"]], "MultiPolygon": geometry["coordinates"]}[geometry["type"]]
    assert (geometry["type"] == "MultiPolygon") == (len(polygons) > 1)
    for polygon in polygons:
        (ring,) = polygon
        assert len(ring) >= 4 and ring[0] == ring[-1], ring
        assert all(-180 <= lon <= 180 and -90 <= lat <= 90 for lon, lat in ring), ring
        assert sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(ring, ring[1:])) > 0, ring
        yield ring


def area_on_sphere(ring):
    """The area on the sphere of a ring with straight sides on the map: the integral of the sine of latitude."""
    total = 0
    for (x, y), (x1, y1) in zip(ring, ring[1:]):
        south, north = math.radians(y), math.radians(y1)
        mean = math.sin(south) if abs(y - y1) < 1e-7 else (math.cos(south) - math.cos(north)) / (north - south)
        total -= mean * math.radians(x1 - x)
    return total


def check_polygons(file, n, exact=None):
    with open(file, encoding="utf-8") as text:
        collection = json.load(text)
    assert collection["type"] == "FeatureCollection" and "pstripack" in collection["history"]
    features = collection["features"]
    assert n is None or len(features) == n
    sums = [0, 0]
    for feature in features:
        area = sum(map(area_on_sphere, rings_of(feature["geometry"])))
        given = feature["properties"]["area"]
        assert abs(area - given) < 2e-4 * math.sqrt(given), (area, feature["properties"])
        assert math.isclose(feature["properties"]["area_km2"], given * 6371**2, rel_tol=1e-12)
        sums = [sums[0] + area, sums[1] + given]
    for total in sums if exact is not None else []:
        assert abs(total - exact) < 5e-5 * math.sqrt(exact), (file, total, exact)
    return features


def same_values(properties, row, k):
    """The values of a row of the table as properties of node k."""
    time, lat, lon, depth, mag, place = row
    assert properties["lon"] == float(lon) and properties["lat"] == float(lat)
    assert (properties["node"], properties["line"]) == (k + 1, k + 2)
    assert (properties["time"], properties["place"]) == (time, place) and properties["depth"] == float(depth)
    assert properties["mag"] == (float(mag) if mag else None)


def check_table(name, rows):
    n, table = len(rows), FOLDER / f"{name}.csv"
    run("voronoi", table, "-o", FOLDER / "cells.geojson")
    cells = check_polygons(FOLDER / "cells.geojson", n, 4 * math.pi)
    run("triangulate", table, "-o", FOLDER / "mesh.geojson")
    triangles = check_polygons(FOLDER / "mesh.geojson", None)
    hull = sum(triangle["properties"]["area"] for triangle in triangles)
    run("voronoi", table, "--clip-to-hull", "-o", FOLDER / "hull.geojson")
    check_polygons(FOLDER / "hull.geojson", n, hull)
    for k, (cell, row) in enumerate(zip(cells, rows)):
        same_values(cell["properties"], row, k)
    # The corners of triangles are the nodes, to the last bit, where longitudes are from -180 to 180.
    for triangle in triangles:
        corners = {tuple(corner) for ring in rings_of(triangle["geometry"]) for corner in ring}
        for k in ("node1", "node2", "node3"):
            row = rows[triangle["properties"][k] - 1]
            lon, lat = float(row[2]), float(row[1])
            assert (lon if lon <= 180 else lon - 360, lat) in corners
    run("convert", table, "-o", FOLDER / "nodes.geojson")
    with open(FOLDER / "nodes.geojson", encoding="utf-8") as text:
        for node, row in zip(json.load(text)["features"], rows, strict=True):
            lon = float(row[2])
            assert node["geometry"] == {"type": "Point",
                                        "coordinates": [lon if lon <= 180 else lon - 360, float(row[1])]}
            assert node["properties"]["lon"] == lon and node["properties"]["place"] == row[5]


def check_csv(name, rows):
    table = FOLDER / f"{name}.csv"
    run("voronoi", table, "-o", FOLDER / "cells.csv")
    with open(FOLDER / "cells.csv", newline="", encoding="utf-8") as file:
        for k, (cell, row) in enumerate(zip(csv.DictReader(file), rows, strict=True)):
            values = {name.split(" [")[0]: value for name, value in cell.items()}
            for column in ("lon", "lat", "depth", "area", "area_km2"):
                values[column] = float(values[column])
            values.update(node=int(values["node"]), line=int(values["line"]),
                          mag=float(values["mag"]) if values["mag"] else None)
            assert "depth [km]" in cell and "area [sr]" in cell and "area_km2" in cell
            same_values(values, row, k)
    run("triangulate", table, "-o", FOLDER / "mesh.csv")
    with open(FOLDER / "mesh.csv", newline="") as file:
        triangles = list(csv.DictReader(file))
    corners = {int(triangle[f"node{k}"]) for triangle in triangles for k in (1, 2, 3)}
    assert corners == set(range(1, len(rows) + 1))
    # pstripack reads the file again, with the same bits and texts.
    run("convert", table, "-o", FOLDER / "once.csv")
    run("convert", FOLDER / "once.csv", "-o", FOLDER / "twice.csv")
    assert (FOLDER / "once.csv").read_bytes() == (FOLDER / "twice.csv").read_bytes()


def check_gmt(name, rows):
    """By the rules of GMT's manual, appendix OGR/GMT."""
    run("voronoi", FOLDER / f"{name}.csv", "-o", FOLDER / "cells.gmt")
    lines = (FOLDER / "cells.gmt").read_text(encoding="utf-8").split("\n")
    assert lines[0] == "# @VGMT1.0 @GPOLYGON @Je4326"
    names, types = lines[1].removeprefix("# @N").split("|"), lines[2].removeprefix("# @T").split("|")
    assert lines[3] == "# FEATURE_DATA" and len(names) == len(types)
    segments = "\n".join(lines[4:]).removeprefix(">\n").split("\n>\n")
    for k, (segment, row) in enumerate(zip(segments, rows, strict=True)):
        data, polygon, *corners = segment.rstrip("\n").split("\n")
        assert polygon == "# @P" and len(corners) >= 4 and corners[0] == corners[-1]
        values = {}
        for column, kind, word in zip(names, types, next(csv.reader([data.removeprefix("# @D")], delimiter="|",
                                                                    escapechar="\\")), strict=True):
            values[column] = word if kind == "string" else {"integer": int, "double": float}[kind](word)
        if math.isnan(values["mag"]):
            values["mag"] = None
        same_values(values, row, k)
    run("triangulate", FOLDER / "cells.gmt", "--duplicates", "first", "-o", FOLDER / "again.csv")  # we read it, too


FOLDER.mkdir(parents=True, exist_ok=True)
east = earthquakes("fiji", 173, 13, -25, 14, 150, lambda lon: lon)  # to 186
check_table("fiji", east)
check_csv("fiji", east)
check_gmt("fiji", east)
for place in (("alaska", 160, 50, 45, 20, 100), ("antarctica", -180, 360, -89.9, 20, 100)):
    check_table(place[0], earthquakes(*place, lambda lon: (lon + 180) % 360 - 180))
print("all files are as they should be")
