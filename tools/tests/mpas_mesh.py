"""Recomputes all of an MPAS mesh that pstripack writes from its cells, vertices and cellsOnVertex: by the definitions, in
extended precision, and not by the program's ways. Compares with what MPAS' converter makes of the same input.

mpas_mesh.py PSTRIPACK DATA FOLDER
"""
import itertools
import json
import math
import subprocess
import sys
from pathlib import Path

import netCDF4
import numpy as np

PROGRAM, DATA, FOLDER = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
REAL = np.longdouble


def run(*arguments):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stderr


class Mesh:
    """Variables by name; indices of the file, which begin with 1, as they are."""

    def __init__(self, file):
        with netCDF4.Dataset(file) as data:
            for name, variable in data.variables.items():
                setattr(self, name, np.array(variable[:]))
            self.attributes = {name: data.getncattr(name) for name in data.ncattrs()}
            self.dimensions = list(data.dimensions)
            self.kind = data.data_model
            self.units = {name: (variable.__dict__.get("units"), variable.__dict__.get("long_name"))
                          for name, variable in data.variables.items()}
        radius = REAL(self.attributes.get("sphere_radius", 1))
        for of in ("Cell", "Edge", "Vertex"):
            if hasattr(self, "x" + of):
                points = np.stack([getattr(self, axis + of).astype(REAL) for axis in "xyz"], axis=1) / radius
                setattr(self, of.lower(), points / np.sqrt((points**2).sum(axis=1))[:, None])


def dot(a, b):
    return (a * b).sum(axis=-1)


def arc(a, b):
    """Angle between unit vectors."""
    return 2 * np.arctan2(np.sqrt(dot(a - b, a - b)), np.sqrt(dot(a + b, a + b)))


def area(a, b, c):
    """Area of spherical triangles, negative if clockwise."""
    return 2 * np.arctan2(dot(a, np.cross(b - a, c - a)), 1 + dot(a, b) + dot(b, c) + dot(c, a))


def check_who_touches_whom(mesh):
    n_cells, n_edges, n_vertices = len(mesh.cell), len(mesh.edge), len(mesh.vertex)
    for of, n in (("Cell", n_cells), ("Edge", n_edges), ("Vertex", n_vertices)):
        assert (getattr(mesh, f"indexTo{of}ID") == np.arange(n) + 1).all()
    assert (mesh.boundaryVertex == (mesh.cellsOnVertex == 0).any(axis=1)).all()
    width = mesh.nEdgesOnCell.max()
    assert mesh.edgesOnCell.shape == (n_cells, width) and mesh.weightsOnEdge.shape == (n_edges, 2 * width)
    pairs = set()
    for e in range(n_edges):
        c, d = mesh.cellsOnEdge[e]
        assert 0 < c and (c < d or d == 0)
        v, w = mesh.verticesOnEdge[e]
        pairs.add((min(v, w) - 1, max(v, w) - 1))
        # k x n leads from v to w, so around c the next vertex after v is w.
        ring = list(mesh.verticesOnCell[c - 1, :mesh.nEdgesOnCell[c - 1]])
        assert ring[(ring.index(v) + 1) % len(ring)] == w
    assert len(pairs) == n_edges
    for c in range(n_cells):
        n = mesh.nEdgesOnCell[c]
        edges, cells, vertices = (a[c, :n] for a in (mesh.edgesOnCell, mesh.cellsOnCell, mesh.verticesOnCell))
        assert all((a[c, n:] == 0).all() for a in (mesh.edgesOnCell, mesh.cellsOnCell, mesh.verticesOnCell))
        assert edges[0] == edges.min() and len(set(edges)) == n == len(set(vertices))
        for j in range(n):
            assert set(mesh.cellsOnEdge[edges[j] - 1]) == {c + 1, cells[j]}
            assert vertices[j] in mesh.verticesOnEdge[edges[j] - 1]
            assert vertices[j] in mesh.verticesOnEdge[edges[(j + 1) % n] - 1]
    for v in range(n_vertices):
        cells, edges = mesh.cellsOnVertex[v], mesh.edgesOnVertex[v]
        for j in range(3):
            if cells[j] == 0:
                assert (cells[j:] == 0).all()
                continue
            for e in (edges[j], edges[(j + 1) % 3]):
                assert cells[j] in mesh.cellsOnEdge[e - 1] and v + 1 in mesh.verticesOnEdge[e - 1]
        if (cells > 0).all():
            assert edges[0] == edges.min()
        assert (edges > 0).sum() == min(3, (cells > 0).sum() + 1)


def check_values(mesh, tolerance=4e-13):
    """All lengths, areas and weights. The tolerance is relative to the size of a cell, of a triangle, of an edge."""
    radius = REAL(mesh.attributes["sphere_radius"])

    def near(name, value, scale):
        error = np.abs(getattr(mesh, name) - value) / scale
        assert error.max() <= tolerance, (name, int(error.argmax()), float(error.max()))

    for of in ("Cell", "Edge", "Vertex"):
        points, lon, lat = getattr(mesh, of.lower()), getattr(mesh, "lon" + of), getattr(mesh, "lat" + of)
        assert lon.min() >= 0 and lon.max() < 2 * math.pi
        near("lat" + of, np.arctan2(points[:, 2], np.hypot(points[:, 0], points[:, 1])), 1)
        turned = np.arctan2(points[:, 1], points[:, 0]) - lon
        assert (np.abs(np.sin(turned / 2)) * np.hypot(points[:, 0], points[:, 1])).max() < 1e-14
    c, d = mesh.cellsOnEdge.T - 1
    v, w = mesh.verticesOnEdge.T - 1
    inner = d >= 0
    middle = mesh.cell[c] + mesh.cell[d]
    middle /= np.sqrt(dot(middle, middle))[:, None]
    apart = arc(mesh.cell[c], mesh.cell[d])
    if not inner.all():  # the other cell is the mirror image
        p, q = mesh.vertex[v[~inner]], mesh.vertex[w[~inner]]
        normal = np.cross(p, q - p)
        normal /= np.sqrt(dot(normal, normal))[:, None]
        foot = mesh.cell[c[~inner]] - dot(mesh.cell[c[~inner]], normal)[:, None] * normal
        middle[~inner] = foot / np.sqrt(dot(foot, foot))[:, None]
        apart[~inner] = 2 * arc(mesh.cell[c[~inner]], middle[~inner])
    scale = np.maximum(apart, 1e-3)
    near("xEdge", radius * middle[:, 0], radius * scale)
    near("yEdge", radius * middle[:, 1], radius * scale)
    near("zEdge", radius * middle[:, 2], radius * scale)
    near("dcEdge", radius * apart, radius * apart)
    long = np.array([mesh.dcEdge[mesh.edgesOnVertex[[a, b]][mesh.edgesOnVertex[[a, b]] > 0] - 1].max() for a, b in
                     zip(v, w)])
    near("dvEdge", radius * arc(mesh.vertex[v], mesh.vertex[w]), long)
    ahead = mesh.cell[d] - mesh.cell[c]
    ahead[~inner] = middle[~inner] - mesh.cell[c[~inner]]
    # By longitude and latitude: at a pole the longitude that the file has counts.
    east = np.stack([-np.sin(mesh.lonEdge), np.cos(mesh.lonEdge), 0 * mesh.lonEdge], axis=1)
    north = np.cross(middle, east)
    turned = np.arctan2(dot(north, ahead), dot(east, ahead)) - mesh.angleEdge
    assert np.abs(np.sin(turned / 2)).max() < 1e-9 / min(1, float(apart.min())) * 1e-6, np.abs(np.sin(turned / 2)).max()

    sums, spacing, least, most = (np.zeros(len(mesh.cell), REAL) for _ in range(4))
    for cell in range(len(mesh.cell)):
        n = mesh.nEdgesOnCell[cell]
        ring = mesh.vertex[mesh.verticesOnCell[cell, :n] - 1]
        sums[cell] = area(mesh.cell[cell], ring, np.roll(ring, -1, axis=0)).sum()
        edges = mesh.edgesOnCell[cell, :n] - 1
        spacing[cell] = mesh.dcEdge[edges].astype(REAL).mean()
        least[cell], most[cell] = mesh.dvEdge[edges].min(), mesh.dvEdge[edges].max()
    near("areaCell", radius**2 * sums, radius**2 * sums)
    near("gridSpacing", spacing, spacing)
    near("cellQuality", least / most, 1)

    of_cell, triangles = np.zeros(len(mesh.cell), REAL), np.zeros(len(mesh.vertex), REAL)
    kites = np.zeros(mesh.kiteAreasOnVertex.shape, REAL)
    for j in range(3):
        known = mesh.cellsOnVertex[:, j] > 0
        cell = mesh.cellsOnVertex[known, j] - 1
        place, centre = mesh.vertex[known], mesh.cell[cell]
        before, after = (middle[mesh.edgesOnVertex[known, k % 3] - 1] for k in (j, j + 1))
        kites[known, j] = area(place, before, centre) + area(place, centre, after)
        triangles[known] += mesh.kiteAreasOnVertex[known, j]
        np.add.at(of_cell, cell, mesh.kiteAreasOnVertex[known, j])
    size = np.maximum(np.abs(kites).max(axis=1), np.array([mesh.areaCell[row[row > 0] - 1].min() for row in
                                                           mesh.cellsOnVertex]) / radius**2)
    near("kiteAreasOnVertex", radius**2 * kites, radius**2 * size[:, None])
    near("areaTriangle", triangles, radius**2 * size)  # kites add up
    near("areaCell", of_cell, radius**2 * sums)
    whole = (mesh.cellsOnVertex > 0).all(axis=1)
    corners = mesh.cell[mesh.cellsOnVertex - 1]
    exact = area(corners[:, 0], corners[:, 1], corners[:, 2])
    assert (np.abs(mesh.areaTriangle - radius**2 * exact)[whole] <= tolerance * radius**2 * exact[whole]).all()
    sides = [arc(corners[:, k], corners[:, (k + 1) % 3]) for k in range(3)]
    with np.errstate(invalid="ignore"):
        even = np.min(sides, axis=0) / np.max(sides, axis=0)
    near("triangleQuality", np.where(whole, even, mesh.triangleQuality), 1)
    chords = [corners[:, (k + 1) % 3] - corners[:, k] for k in range(3)]
    dots = np.array([-dot(chords[k], chords[k - 1]) for k in range(3)])
    across = np.sqrt(dot(np.cross(chords[0], chords[1]), np.cross(chords[0], chords[1])))
    angles = np.arctan2(across, dots)
    near("triangleAngleQuality", np.where(whole, angles.min(axis=0) / angles.max(axis=0), 0), 1)
    assert ((mesh.obtuseTriangle == 1) == (whole & (dots.min(axis=0) < 0)))[np.abs(dots).min(axis=0) > 1e-15].all()

    weights, around = np.zeros(mesh.weightsOnEdge.shape, REAL), np.zeros(mesh.edgesOnEdge.shape, int)
    for e in range(len(mesh.edge)):
        column = 0
        for sign, i in ((1, c[e]), (-1, d[e])):
            if i < 0:
                continue
            n = mesh.nEdgesOnCell[i]
            at, passed = list(mesh.edgesOnCell[i, :n]).index(e + 1), REAL(0)
            for k in range(1, n):
                vertex, other = mesh.verticesOnCell[i, (at + k - 1) % n] - 1, mesh.edgesOnCell[i, (at + k) % n] - 1
                passed += mesh.kiteAreasOnVertex[vertex, list(mesh.cellsOnVertex[vertex]).index(i + 1)] / REAL(mesh.areaCell[i])
                outwards = 1 if c[other] == i else -1
                weights[e, column] = sign * outwards * (0.5 - passed) * mesh.dvEdge[other] / mesh.dcEdge[e]
                around[e, column] = other + 1
                column += 1
        assert mesh.nEdgesOnEdge[e] == column
    assert (mesh.edgesOnEdge == around).all()
    near("weightsOnEdge", weights, np.maximum(1, (long / apart / radius))[:, None])
    assert 0 < mesh.meshDensity.min() and mesh.meshDensity.max() <= 1


def check_graph(mesh, file):
    lines = file.read_text().splitlines()
    assert lines[0].split() == [str(len(mesh.cell)), str((mesh.cellsOnEdge > 0).all(axis=1).sum())]
    for c, line in enumerate(lines[1:]):
        row = mesh.cellsOnCell[c, :mesh.nEdgesOnCell[c]]
        assert line.split() == [str(other) for other in row[row > 0]]
    assert len(lines) == len(mesh.cell) + 1


def check(name, tolerance=4e-13):
    mesh = Mesh(FOLDER / f"{name}.mpas.nc")
    assert mesh.kind == "NETCDF3_64BIT_DATA" and mesh.attributes["Conventions"] == "MPAS"
    assert all(units in ("rad", "m", "m2", "1") and words for units, words in mesh.units.values()), mesh.units
    check_who_touches_whom(mesh)
    check_values(mesh, tolerance)
    check_graph(mesh, FOLDER / f"{name}.graph.info")
    return mesh


def check_against_the_converter(name):
    """The converter's own file: the same indices everywhere, the same numbers up to its single-precision powers."""
    run("convert", DATA / f"{name}.mpas.nc", "-o", FOLDER / f"{name}.mpas.nc")
    mesh, theirs = check(name), Mesh(DATA / f"{name}.mesh.nc")
    assert set(vars(mesh)) == set(vars(theirs)) and mesh.dimensions == theirs.dimensions
    for variable, value in vars(theirs).items():
        # angleEdge is another angle there. Of three angles triangleAngleQuality takes one by a wrong formula.
        if isinstance(value, np.ndarray) and variable not in ("angleEdge", "triangleAngleQuality"):
            error = np.abs(getattr(mesh, variable) - value).max()
            assert error == 0 if value.dtype.kind == "i" else error < 1.2e-7, (variable, error)
    assert (FOLDER / f"{name}.graph.info").read_bytes() == (DATA / f"{name}.graph.info").read_bytes()
    return mesh


def cut(mesh, kept, file):
    """Removes cells as MPAS' culler does: vertices stay while one of their cells does."""
    number = np.zeros(len(mesh.cell) + 1, int)
    number[1:][kept] = np.arange(kept.sum()) + 1
    cells_on_vertex = number[mesh.cellsOnVertex]
    vertices = (cells_on_vertex > 0).any(axis=1)
    radius = mesh.attributes["sphere_radius"]
    with netCDF4.Dataset(file, "w", format="NETCDF3_64BIT_OFFSET") as out:
        for dimension, n in (("nCells", kept.sum()), ("nVertices", vertices.sum()), ("vertexDegree", 3)):
            out.createDimension(dimension, n)
        for of, rows, dimension in (("Cell", kept, "nCells"), ("Vertex", vertices, "nVertices")):
            for axis in "xyz":
                out.createVariable(axis + of, "f8", dimension)[:] = getattr(mesh, axis + of)[rows]
        out.createVariable("cellsOnVertex", "i4", ("nVertices", "vertexDegree"))[:] = cells_on_vertex[vertices]
        out.createVariable("meshDensity", "f8", "nCells")[:] = mesh.meshDensity[kept]
        out.sphere_radius, out.on_a_sphere, out.file_id = radius, "YES", mesh.attributes["file_id"]


def check_cut(mesh, name, kept):
    """A mesh with a boundary: what is left has the values that it had."""
    cut(mesh, kept, FOLDER / f"{name}.nc")
    run("convert", FOLDER / f"{name}.nc", "--to", "mpas", "-o", FOLDER / f"{name}.mpas.nc")
    part = check(name, 1e-10)
    assert part.attributes["parent_id"] == mesh.attributes["file_id"]
    assert part.attributes["sphere_radius"] == mesh.attributes["sphere_radius"]
    assert np.allclose(part.areaCell, mesh.areaCell[kept], rtol=1e-13) and (part.meshDensity == mesh.meshDensity[kept]).all()


def are_inside(cells, circle, polygons):
    """The sides of polygons are straight on the map: crossed by a parallel, east of the place, an odd number of times."""
    if circle:
        return cells @ unit_vectors(circle[2], circle[1]) > math.cos(circle[0] / 6371.22)
    lon, lat = np.degrees(np.arctan2(cells[:, 1], cells[:, 0])), np.degrees(np.arcsin(cells[:, 2]))
    inside = np.zeros(len(cells), bool)
    for polygon, turn in itertools.product(polygons, (-360, 0, 360)):
        crossings = [((y1 <= lat) != (y2 <= lat)) & (x1 + (lat - y1) / (y2 - y1) * (x2 - x1) > lon + turn)
                     for ring in polygon for (x1, y1), (x2, y2) in zip(ring, ring[1:]) if y1 != y2]
        inside |= np.sum(crossings, axis=0) % 2 == 1
    return inside


def places_on_boundary(circle, polygons, count=20000):
    """Places all along the boundary, as unit vectors."""
    t = np.linspace(0, 1, count)
    if circle:
        p, q, r = math.radians(circle[1]), math.radians(circle[2]), circle[0] / 6371.22
        centre = np.array([math.cos(q) * math.cos(p), math.cos(q) * math.sin(p), math.sin(q)])
        east = np.array([-math.sin(p), math.cos(p), 0])
        around = np.outer(np.cos(2 * math.pi * t), east) + np.outer(np.sin(2 * math.pi * t), np.cross(centre, east))
        return math.cos(r) * centre + math.sin(r) * around
    sides = [side for polygon in polygons for ring in polygon for side in zip(ring, ring[1:])]
    part = t[::len(sides)]
    lon, lat = (np.concatenate([a[k] + part * (b[k] - a[k]) for a, b in sides]) for k in (0, 1))
    return unit_vectors(lat, lon)


def layers_by_definition(mesh, circle, polygons):
    """bdyMaskCell: 0 where the node is inside or a place on the boundary is nearest to it, then rings of neighbours; 8: none."""
    mask = np.full(len(mesh.cell), 8)
    cells = mesh.cell.astype(float)
    for places in np.array_split(places_on_boundary(circle, polygons), 40):
        mask[(places @ cells.T).argmax(axis=1)] = 0
    inside = are_inside(cells, circle, polygons)
    assert inside.any()
    mask[inside] = 0
    return with_layers(mesh, mask)


def neighbours(mesh, cell):
    around = mesh.cellsOnCell[cell, :mesh.nEdgesOnCell[cell]] - 1
    return around[around >= 0]


def unit_vectors(lat, lon):
    lat, lon = np.radians(lat), np.radians(lon)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=-1)


def layers_by_chains(mesh, lines, inside):
    """bdyMaskCell as MPAS-Limited-Area finds it. lines: of corners (lat, lon); inside: a place (lat, lon). From the cell
    nearest to a corner to that nearest to the next: of the neighbours nearer to it, the one nearest to the great circle.
    Then all that can be reached from the cell nearest to `inside`."""
    cells = mesh.cell.astype(float)
    mask = np.full(len(cells), 8)
    for line in lines:
        ends = (unit_vectors(*np.transpose(line)) @ cells.T).argmax(axis=1)
        for cell, end in zip(ends, np.roll(ends, -1)):
            mask[[cell, end]] = 0
            normal = np.cross(cells[cell], cells[end])
            while cell != end:
                around = neighbours(mesh, cell)
                around = around[cells[around] @ cells[end] > cells[cell] @ cells[end]]
                cell = around[np.abs(cells[around] @ normal).argmin()]
                mask[cell] = 0
    stack = [(unit_vectors(*inside) @ cells.T).argmax()]
    while stack:
        cell = stack.pop()
        if mask[cell] == 8:
            mask[cell] = 0
            stack += list(neighbours(mesh, cell))
    return with_layers(mesh, mask)


def with_layers(mesh, mask):
    for layer in range(1, 8):
        for cell in np.flatnonzero(mask == layer - 1):
            around = neighbours(mesh, cell)
            mask[around[mask[around] == 8]] = layer
    return mask


def check_masks(part, mask):
    """The masks of a regional mesh, those of its cells being known."""
    assert (part.bdyMaskCell == mask).all() and set(mask) == set(range(8))
    padded = np.append(8, part.bdyMaskCell)
    for name, cells in (("bdyMaskEdge", part.cellsOnEdge), ("bdyMaskVertex", part.cellsOnVertex)):
        assert (getattr(part, name) == padded[cells].min(axis=1)).all() and getattr(part, name).dtype == "i4"
    # Only the last layer is at the boundary.
    rim = (np.where(np.arange(part.cellsOnCell.shape[1]) < part.nEdgesOnCell[:, None], part.cellsOnCell, 1) == 0).any(axis=1)
    assert rim.any() and (part.bdyMaskCell[rim] == 7).all()
    assert ((part.boundaryVertex == 1) == (part.cellsOnVertex == 0).any(axis=1)).all()


def check_rows(mesh, name, kept):
    """All variables of a part are those of the whole mesh: rows of cells, edges and vertices that stay, with new indices."""
    kept = {"nCells": kept}
    for of in ("Edge", "Vertex"):
        kept["n" + {"Edge": "Edges", "Vertex": "Vertices"}[of]] = np.append(False, kept["nCells"])[getattr(mesh, f"cellsOn{of}")].any(axis=1)
    number = {key: np.append(0, np.cumsum(rows) * rows) for key, rows in kept.items()}
    with netCDF4.Dataset(FOLDER / f"{name}.mpas.nc") as whole, netCDF4.Dataset(FOLDER / f"{name}_part.mpas.nc") as part:
        for dimension in ("Cell", "nCells"), ("Edge", "nEdges"), ("Vertex", "nVertices"):
            assert (part["mapCulledToBase" + dimension[0]][:] == np.flatnonzero(kept[dimension[1]])).all()
        for variable, ours in whole.variables.items():
            if variable == "boundaryVertex":  # check_masks()
                continue
            ours.set_auto_mask(False)
            values, theirs = ours[:], part[variable]
            theirs.set_auto_mask(False)
            assert (theirs.dtype, theirs.dimensions) == (ours.dtype, ours.dimensions) and str(vars(theirs)) == str(vars(ours)), variable
            for axis, dimension in enumerate(ours.dimensions):
                if dimension in kept:
                    values = np.compress(kept[dimension], values, axis)
            for key, word in ("nCells", "Cell"), ("nEdges", "Edge"), ("nVertices", "Vertex"):
                if variable.startswith({"Vertex": "vertices"}.get(word, word.lower() + "s") + "On") or variable == f"indexTo{word}ID":
                    values = number[key][values].astype(ours.dtype)
            assert values.tobytes() == np.asarray(theirs[:]).tobytes(), variable
        assert {key: value.isunlimited() for key, value in whole.dimensions.items()} == {
            key: value.isunlimited() for key, value in part.dimensions.items()}
        assert part.file_id != whole.file_id == part.parent_id.split()[0] and part.history.startswith("pstripack convert ")
        assert all(part.getncattr(key) == whole.getncattr(key) for key in whole.ncattrs() if key not in ("file_id", "parent_id", "history"))


def check_region(mesh, name, circle=None, polygons=None, text=None, mask=None, options=()):
    """Cuts a limited area out of the mesh in FOLDER/name.mpas.nc. mask: bdyMaskCell, if not that by definition."""
    if text is None:
        text = FOLDER / f"{name}_region.geojson"
        text.write_text(json.dumps({"type": "MultiPolygon", "coordinates": polygons}))
    by_definition = mask is None
    if by_definition:
        mask = layers_by_definition(mesh, circle, polygons)
    kept = mask < 8
    assert 0 < kept.sum() < len(kept)
    run("convert", FOLDER / f"{name}.mpas.nc", "--region", text, *options, "-o", FOLDER / f"{name}_part.mpas.nc")
    part = Mesh(FOLDER / f"{name}_part.mpas.nc")
    check_masks(part, mask[kept])
    check_rows(mesh, name, kept)
    check_graph(part, FOLDER / f"{name}_part.graph.info")
    if not by_definition:
        return part
    # What is cut can be read, and numbered as the converter does.
    run("convert", FOLDER / f"{name}_part.mpas.nc", "-o", FOLDER / f"{name}_again.mpas.nc")
    again = check(f"{name}_again", 1e-10)
    check_masks(again, mask[kept])
    assert all((getattr(again, axis) == getattr(mesh, axis)[kept]).all() for axis in ("xCell", "yCell", "zCell", "lonCell"))
    assert np.allclose(again.areaCell, mesh.areaCell[kept], rtol=1e-13)
    assert getattr(again, "nominalMinDc", 0) == getattr(mesh, "nominalMinDc", 0)
    return part


def check_pts(mesh, name, text, lines, inside):
    """A region as MPAS-Limited-Area's file describes it."""
    (FOLDER / f"{name}.pts").write_text(text)
    return check_region(mesh, name, text=FOLDER / f"{name}.pts", mask=layers_by_chains(mesh, lines, inside))


def ellipse(lat, lon, a, b, turn):
    """100 corners (lat, lon). a, b: metres; turn: of a, degrees from north to east."""
    angle = np.radians(np.arange(100) * 3.6)
    radius = a * b / np.hypot(a * np.sin(angle), b * np.cos(angle)) / 6371220
    towards = angle + math.radians(turn)
    up = math.radians(lat)
    sine = math.sin(up) * np.cos(radius) + math.cos(up) * np.sin(radius) * np.cos(towards)
    east = np.arctan2(np.sin(towards) * np.sin(radius) * math.cos(up), np.cos(radius) - math.sin(up) * sine)
    return np.degrees(np.stack([np.arcsin(sine), math.radians(lon) + east], axis=1))


def check_other_formats(part, name, text):
    """Cut, or read after the cut: the triangles that have all corners."""
    for source, more in ((name, ("--region", text)), (f"{name}_part", ())):
        run("convert", FOLDER / f"{source}.mpas.nc", *more, "-o", FOLDER / f"{name}.ugrid.nc")
        with netCDF4.Dataset(FOLDER / f"{name}.ugrid.nc") as data:
            assert (data["bdyMaskCell"][:] == part.bdyMaskCell).all()
            corners = {tuple(sorted(row)) for row in data["mesh_face_nodes"][:].tolist()}
        assert corners == {tuple(sorted(row)) for row in part.cellsOnVertex.tolist() if min(row) > 0}


FOLDER.mkdir(parents=True, exist_ok=True)
meshes = [check_against_the_converter(name) for name in ("u42", "u162")]
run("scvt", 642, "--tolerance", 1e-6, "--radius", 6371229, "-o", FOLDER / "earth.mpas.nc")
earth = check("earth")
assert (earth.obtuseTriangle == 0).all() and earth.attributes["sphere_radius"] == 6371229
assert earth.attributes["history"].startswith("pstripack ")
assert abs(earth.areaCell.sum() / (4 * math.pi * 6371229.0**2) - 1) < 1e-13
assert abs(earth.nominalMinDc / earth.dcEdge.mean() - 1) < 0.01  # the width of regular hexagons

# With a boundary: holes, single cells, rows of cells, and one whose edges are all cut.
band = np.abs(earth.latCell) < 0.9
check_cut(earth, "band", band)
check_cut(meshes[1], "holes", np.arange(162) % 7 > 0)
check_cut(meshes[1], "few", np.isin(np.arange(162), (0, 50, 51, 100)))

# Obtuse triangles, poles, the dateline, cells whose vertices coincide.
for name, family, n in (("random", "random", 400), ("grid", "latlon", 200), ("cube", "cubed-sphere", 96)):
    run("points", family, n, "-o", FOLDER / f"{name}.txt")
    run("triangulate", FOLDER / f"{name}.txt", "-o", FOLDER / f"{name}.mpas.nc")
    mesh = check(name)
    assert family != "random" or (mesh.obtuseTriangle.sum() > 50 and mesh.kiteAreasOnVertex.min() < 0)

# Few nodes; an edge in a pole; nodes 1e-9 rad apart, where the coordinates of vertices have seven digits of a cell.
OCTAHEDRON = [(0, 0), (90, 0), (180, 0), (-90, 0), (0, 90), (0, -90)]
for name, nodes, tolerance in (("4", [(0, 90), (0, -20), (120, -20), (-120, -20)], 4e-13), ("6", OCTAHEDRON, 4e-13),
                               ("12", [(0, 90), (0, -90)] + [(36 * k, 26.565 * (-1)**k) for k in range(10)], 4e-13),
                               ("pole", [(0, 80), (180, 80), (90, 60), (-90, 60)] + OCTAHEDRON[:4] + [(7, -90)], 4e-13),
                               ("near", OCTAHEDRON + [(6e-8, 0), (0, 6e-8), (180, 6e-8), (33, 89.99999994)], 1e-6)):
    (FOLDER / f"n{name}.txt").write_text("".join(f"{lon!r} {lat!r}\n" for lon, lat in nodes))
    run("triangulate", FOLDER / f"n{name}.txt", "--units", "degrees", "-o", FOLDER / f"n{name}.mpas.nc")
    check(f"n{name}", tolerance)

# Limited areas: over a pole, across the dateline, concave, of two parts that touch, with cells of all shapes.
run("points", "random", 1000, "-o", FOLDER / "sphere.txt")
run("triangulate", FOLDER / "sphere.txt", "-o", FOLDER / "sphere.mpas.nc")
sphere = Mesh(FOLDER / "sphere.mpas.nc")
check_region(sphere, "sphere", circle=(1500, 20, 84), text="circle:1500,20,84")
check_region(sphere, "sphere", polygons=[[[(170, -12), (190, -12), (190, 5), (170, 5), (170, -12)]]], text="170,-170,-12,5")
check_region(sphere, "sphere", polygons=[[[(-180, -40), (-170, -30), (-180, -20), (-180, -40)]],
                                         [[(180, -40), (180, -20), (176, -30), (180, -40)]]])
concave = check_region(sphere, "sphere", polygons=[[[(0, 20), (30, 20), (30, 26), (8, 27), (7, 50), (0, 50), (0, 20)]]])
check_other_formats(concave, "sphere", FOLDER / "sphere_region.geojson")
# With a hole; all but a hole.
check_region(sphere, "sphere", polygons=[[[(0, 0), (60, 0), (60, 50), (0, 50), (0, 0)], [(20, 12), (45, 12), (45, 38), (20, 38), (20, 12)]]])
check_region(sphere, "sphere", polygons=[[[(-180, -90), (180, -90), (180, 90), (-180, 90), (-180, -90)],
                                          [(-140, -75), (0, -75), (140, -75), (140, 75), (0, 75), (-140, 75), (-140, -75)]]])

# Regions of MPAS-Limited-Area, of a file with all that a model's has: records, levels, texts, types.
levels = np.random.default_rng(1)
with netCDF4.Dataset(FOLDER / "sphere.mpas.nc", "a") as data:
    for dimension, n in (("nVertLevels", 3), ("StrLen", 8), ("nMonths", 12)):
        data.createDimension(dimension, n)
    for variable, kind, dimensions in (
            ("theta", "f4", ("Time", "nCells", "nVertLevels")), ("u", "f8", ("Time", "nEdges", "nVertLevels")),
            ("greenfrac", "f4", ("nCells", "nMonths")), ("monthly", "f4", ("nMonths", "nCells")), ("xtime", "S1", ("Time", "StrLen")),
            ("landmask", "i1", ("nCells",)), ("number", "i8", ("nVertices",)), ("rdzw", "f8", ("nVertLevels",)), ("cf1", "f8", ())):
        v = data.createVariable(variable, kind, dimensions)
        v.setncatts({"units": "-", "missing": np.arange(3, dtype="f4")})
        size = [2 if d == "Time" else len(data.dimensions[d]) for d in dimensions]
        values = levels.integers(65, 90, size).astype("u1" if kind == "S1" else kind)
        v[...] = values.view("S1") if kind == "S1" else values
lines = [[(62, -70), (55, 60), (0, 75), (-60, 80), (-62, -60)], [(10 * (k % 3) - 10, 60 * k) for k in range(6)]]
for inside in (3, 2), (-4, 200):  # between great circles, or all but that; around the pole
    check_pts(sphere, "sphere", "Name: a b\nTYPE: Custom\n\nPoint: %g, %g\n" % inside + "".join("%g , %g # corner\n" % corner for corner in lines[0]),
              lines[:1], inside)
for inside in (88, 10), (-60, 0):
    check_pts(sphere, "sphere", "Type: custom\nPoint: %g, %g\n" % inside + "".join("%g,%g\n" % corner for corner in lines[1]), lines[1:], inside)
check_pts(sphere, "sphere", "Name: Circle\nType: circle\nPoint: -40, 175\nradius: 2500000 # metres\n",
          [ellipse(-40, 175, 25e5, 25e5, 0)], (-40, 175))
check_pts(sphere, "sphere", "Type: ellipse\nPoint: 60, 20\nSemi-major-axis: 4e6\nsemi-minor-axis: 2e6\nOrientation-angle: 30\n",
          [ellipse(60, 20, 4e6, 2e6, 30)], (60, 20))
for south, north in (-10, 20), (30, 90), (-70, -30):
    check_pts(sphere, "sphere", f"Type: channel\nUpper-lat: {north}\nLower-lat: {south}\n",
              [[(lat, 3.6 * k) for k in range(100)] for lat in (south, north)], ((south + north) / 2, 0))
# Polygons of GeoJSON, a box and a circle by great circles.
check_region(sphere, "sphere", polygons=[[[corner[::-1] for corner in lines[0] + lines[0][:1]]]], options=("--sides", "great-circle"),
             mask=layers_by_chains(sphere, lines[:1], (3, 2)))
check_region(sphere, "sphere", text="170,-150,50,70", options=("--sides", "great-circle"),
             mask=layers_by_chains(sphere, [[(50, 170), (50, 210), (70, 210), (70, 170)]], (62, 190)))
check_region(sphere, "sphere", text="circle:2500,175,-40", options=("--sides", "great-circle"),
             mask=layers_by_chains(sphere, [ellipse(-40, 175, 25e5, 25e5, 0)], (-40, 175)))

# A mesh made for a limited area: 7 layers of the width asked for, and hexagons.
said = run("scvt", "--width", "150km", "--region", "circle:900,10,50", "-o", FOLDER / "limited.mpas.nc")
limited = check("limited", 1e-10)
check_masks(limited, layers_by_definition(limited, (900, 10, 50), None))
assert limited.meshDensity.min() > 0.99 and (limited.obtuseTriangle == 0).all() and (limited.nEdgesOnCell != 6).sum() < 6
widths = limited.dcEdge[(limited.cellsOnEdge > 0).all(axis=1)] * 6371.22 / 150
assert abs(widths.mean() - 1) < 5e-3 and widths.std() < 0.03, (widths.mean(), widths.std())
assert abs(limited.nominalMinDc * 6371.22 / 150 - 1) < 1e-4, limited.nominalMinDc
assert f" of {said.split('the widths give ')[2].split()[0]} cells kept: {(limited.bdyMaskCell == 0).sum()} in the region, " in said, said

# At the boundary of a hemisphere nodes have no whole cells.
run("points", "hemisphere", 60, "-o", FOLDER / "half.txt")
said = run("triangulate", FOLDER / "half.txt", "-o", FOLDER / "half.mpas.nc")
assert f"{60 - len(check('half').cell)} nodes have no whole cell, at the boundary of the mesh" in said, said
print("all meshes are as they should be")
