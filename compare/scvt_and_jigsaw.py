#!/usr/bin/env python3
"""Makes meshes of the same widths by `pstripack scvt` and, where it is found, by JIGSAW; prints a table of both.

  scvt_and_jigsaw.py PSTRIPACK [--jigsaw PATH] [--coarser FACTOR] [--folder DIR]

Both read the widths from a grid of 0.25 degrees; pstripack has a uniform one as a number. Time is that of the
processor, user and system, on one thread, with reading and writing. Angles are those of the plane triangles. The last
column is the length of an arc over the width asked for in its middle, mean and standard deviation. --coarser 4 makes
all widths, and the cells of the grid, four times as large; widths then change faster, and pstripack limits that. Needs
numpy and netCDF4. JIGSAW is the program `jigsaw` of https://github.com/dengwirda/jigsaw, with the options of mpas_tools.
"""
import argparse
import os
import resource
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import netCDF4
import numpy as np

RADIUS = 6371.22  # km


def smooth(t):
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)


def uniform(lon, lat):
    return np.full(np.broadcast(lon, lat).shape, 80.0)


def band(lon, lat):
    """30 km up to 1500 km from the equator, from 3000 km on 60 km."""
    return 30 + 30 * smooth((RADIUS * np.abs(lat) - 1500) / 1500) + 0 * lon


def disc(lon, lat):
    """10 km up to 1000 km from 10 E 50 N, from 3500 km on 120 km."""
    lon_0, lat_0 = np.radians((10, 50))
    cosine = np.sin(lat_0) * np.sin(lat) + np.cos(lat_0) * np.cos(lat) * np.cos(lon - lon_0)
    return 10 + 110 * smooth((RADIUS * np.arccos(np.clip(cosine, -1, 1)) - 1000) / 2500)


CASES = (("uniform, 80 km", uniform), ("band of 30 in 60 km", band), ("disc of 10 in 120 km", disc))


def processor_time_of(command, folder):
    def used():
        of_children = resource.getrusage(resource.RUSAGE_CHILDREN)
        return of_children.ru_utime + of_children.ru_stime

    before = used()
    done = subprocess.run(command, cwd=folder, env=os.environ | {"OMP_NUM_THREADS": "1"}, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)}: {done.stderr or done.stdout}")
    return used() - before


def by_pstripack(program, lon, lat, widths, folder):
    asked = ["--width", f"{widths[0, 0]}km"]
    if np.ptp(widths) > 0:
        asked = ["--width-file", "widths.nc"]
        with netCDF4.Dataset(folder / "widths.nc", "w") as data:
            for name, degrees in ("lat", lat), ("lon", lon):
                data.createDimension(name, len(degrees))
                data.createVariable(name, "f8", (name,))[:] = degrees
            data.createVariable("cellWidth", "f8", ("lat", "lon"))[:] = widths
    command = [program, "scvt", *asked, "--well-centred", "-o", "mesh.off"]
    seconds = processor_time_of(command, folder)
    words = (folder / "mesh.off").read_text().split()
    points, triangles = int(words[1]), int(words[2])
    begin, end = 4, 4 + 3 * points
    return (seconds, np.array(words[begin:end], float).reshape(points, 3),
            np.array(words[end:end + 4 * triangles], int).reshape(triangles, 4)[:, 1:])


def by_jigsaw(program, lon, lat, widths, folder):
    (folder / "sphere.msh").write_text("MSHID=3;ELLIPSOID-MESH\n" + f"RADII={RADIUS};{RADIUS};{RADIUS}\n")
    with open(folder / "widths.msh", "w") as file:
        file.write(f"MSHID=3;ELLIPSOID-GRID\nRADII={RADIUS};{RADIUS};{RADIUS}\nNDIMS=2\n")
        for axis, degrees in enumerate((lon, lat), 1):
            file.write(f"COORD={axis};{len(degrees)}\n" + "".join(f"{x:.17g}\n" for x in np.radians(degrees)))
        file.write(f"VALUE={widths.size};1\n" + "".join(f"{w:.9g}\n" for w in widths.ravel(order="F")))
    (folder / "mesh.jig").write_text("GEOM_FILE = sphere.msh\nHFUN_FILE = widths.msh\nMESH_FILE = mesh.msh\n"
                                     "MESH_DIMS = 2\nHFUN_SCAL = absolute\nHFUN_HMAX = inf\nHFUN_HMIN = 0.0\nOPTM_QLIM = 0.9375\n")
    seconds = processor_time_of([program, "mesh.jig"], folder)
    tables, lines = {}, iter((folder / "mesh.msh").read_text().splitlines())
    for line in lines:
        name, _, count = line.partition("=")
        if name in ("POINT", "TRIA3"):
            tables[name] = np.array([next(lines).split(";")[:3] for _ in range(int(count))], float)
    return seconds, tables["POINT"], tables["TRIA3"].astype(int)


def row_of(points, triangles, width_at):
    """Numbers of cells, and of those with 5, 6, 7 and other sides; angles; obtuse triangles; arc over width."""
    points = points / np.linalg.norm(points, axis=1)[:, None]
    sides = np.bincount(triangles.ravel())
    counts = [int((sides == k).sum()) for k in (5, 6, 7)]
    a, b, c = (points[triangles[:, k]] for k in range(3))

    def angles_at(p, q, r):
        return np.degrees(np.arctan2(np.linalg.norm(np.cross(q - p, r - p), axis=1), ((q - p) * (r - p)).sum(axis=1)))

    angles = np.stack([angles_at(a, b, c), angles_at(b, c, a), angles_at(c, a, b)])
    arcs = np.sort(np.concatenate([triangles[:, (0, 1)], triangles[:, (1, 2)], triangles[:, (2, 0)]]), axis=1)
    ends = points[np.unique(arcs, axis=0).T]
    middle = ends.sum(axis=0)
    middle /= np.linalg.norm(middle, axis=1)[:, None]
    asked = width_at(np.arctan2(middle[:, 1], middle[:, 0]), np.arcsin(np.clip(middle[:, 2], -1, 1)))
    ratio = 2 * RADIUS * np.arcsin(np.linalg.norm(ends[0] - ends[1], axis=1) / 2) / asked
    counts.append(len(sides) - sum(counts))
    return [len(points), "/".join(map(str, counts)), f"{angles.min():.1f} to {angles.max():.1f}",
            int((angles.max(axis=0) >= 90).sum()), f"{ratio.mean():.4f} +- {ratio.std():.4f}"]


def main():
    options = argparse.ArgumentParser(usage=__doc__)
    options.add_argument("pstripack")
    options.add_argument("--jigsaw", default=shutil.which("jigsaw"))
    options.add_argument("--coarser", type=float, default=1)
    options.add_argument("--folder", help="keep the files of the last case here")
    given = options.parse_args()
    tools = [("pstripack", by_pstripack, str(Path(given.pstripack).resolve()))]
    if given.jigsaw:
        tools.append(("JIGSAW", by_jigsaw, str(Path(given.jigsaw).resolve())))
    else:
        print("JIGSAW: not found: say --jigsaw PATH", file=sys.stderr)
    rows = round(720 / given.coarser)
    lon, lat = np.linspace(-180, 180, 2 * rows + 1), np.linspace(-90, 90, rows + 1)
    print("| widths | by | cells | seconds | 5/6/7/other sides | angles | obtuse | arc over width |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(given.folder or temporary)
        folder.mkdir(exist_ok=True)
        for name, width in CASES:
            def width_at(x, y, width=width):
                return given.coarser * width(x, y)

            widths = width_at(*np.meshgrid(np.radians(lon), np.radians(lat)))
            for tool, make, program in tools:
                seconds, points, triangles = make(program, lon, lat, widths, folder)
                cells, *rest = row_of(points, triangles, width_at)
                print("|", " | ".join(map(str, [name, tool, cells, f"{seconds:.2f}", *rest])), "|", flush=True)


main()
