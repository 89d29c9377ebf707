"""Reads files that pstripack writes by other programs: netCDF4, xarray, meshio.

other_readers.py PSTRIPACK FOLDER
"""
import math
import subprocess
import sys
from pathlib import Path

import meshio
import netCDF4
import numpy as np
import xarray

PROGRAM, FOLDER = sys.argv[1], Path(sys.argv[2])
N = 642  # icosahedral: 12 nodes have five neighbours, all others six
TRIANGLES = 2 * N - 4


def run(*arguments):
    subprocess.run([PROGRAM, "-q", *map(str, arguments)], check=True)


def unit_vectors(lon, lat):
    lon, lat = np.radians(lon), np.radians(lat)
    return np.stack([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)], axis=1)


def signed_volumes(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c))


def check_ugrid(nodes, mesh_file, cells_file):
    with netCDF4.Dataset(mesh_file) as mesh:
        faces = mesh["mesh_face_nodes"]
        assert mesh["mesh"].cf_role == "mesh_topology" and (faces.start_index, faces._FillValue) == (1, -1)
        triangles = faces[:] - faces.start_index
        assert not np.ma.is_masked(triangles) and triangles.shape == (TRIANGLES, 3)
        points = unit_vectors(mesh["mesh_node_lon"][:], mesh["mesh_node_lat"][:])
        assert np.allclose(points, nodes, rtol=0, atol=1e-14)
        assert (signed_volumes(points, triangles) > 0).all()

    with xarray.open_dataset(cells_file) as cells:  # missing values become NaN
        assert cells["mesh_face_nodes"].shape == (N, 6)
        missing = np.isnan(cells["mesh_face_nodes"].values)
        assert missing.sum() == 12 and missing[:, 5].sum() == 12
        assert cells.sizes["mesh_nodes"] == TRIANGLES


def check_scrip(nodes, file):
    with netCDF4.Dataset(file) as grid:
        assert grid["grid_dims"][:].tolist() == [N] and (grid["grid_imask"][:] == 1).all()
        centres = unit_vectors(grid["grid_center_lon"][:], grid["grid_center_lat"][:])
        assert np.allclose(centres, nodes, rtol=0, atol=1e-14)
        lon, lat = grid["grid_corner_lon"][:], grid["grid_corner_lat"][:]
        assert lon.shape == (N, 6)
        area = grid["grid_area"]
        assert area.units == "radians^2" and abs(area[:].sum() - 4 * math.pi) < 1e-10 and area[:].min() > 0.01
        assert ((lon[:, 5] == lon[:, 4]) & (lat[:, 5] == lat[:, 4])).sum() == 12  # pentagons: padded


def check_edges():
    """UGRID with edges: of triangles, of cells, and of a mesh with a boundary."""
    run("points", "hemisphere", 60, "-o", FOLDER / "half.txt")
    run("convert", FOLDER / "mesh.nc", "--edges", "-o", FOLDER / "edges_triangles.nc")
    run("voronoi", FOLDER / "nodes.txt", "--edges", "-o", FOLDER / "edges_cells.nc")
    run("triangulate", FOLDER / "half.txt", "--edges", "-o", FOLDER / "edges_half.nc")
    for name, count in (("triangles", 3 * N - 6), ("cells", 3 * N - 6), ("half", None)):
        with netCDF4.Dataset(FOLDER / f"edges_{name}.nc") as mesh:
            topology = mesh["mesh"]
            faces, of_faces, ends, sides = (
                np.ma.filled(mesh[getattr(topology, role + "_connectivity")][:], -1)
                for role in ("face_node", "face_edge", "edge_node", "edge_face"))
            assert topology.edge_dimension == "mesh_edges" and (ends[:, 0] < ends[:, 1]).all()
            assert len(np.unique(ends, axis=0)) == len(ends) == (count or len(ends))
            assert (sides.min() == -1) == (count is None) and (faces > 0).sum() == (sides > 0).sum()
            for f, (row, edges) in enumerate(zip(faces, of_faces)):
                row, edges = row[row > 0], edges[edges > 0]
                for a, b, e in zip(row, np.roll(row, -1), edges):
                    assert set(ends[e - 1]) == {a, b} and sides[e - 1][0 if a < b else 1] == f + 1


def check_esmf(nodes, file):
    with netCDF4.Dataset(file) as grid:
        assert grid.gridType == "unstructured" and grid["elementConn"].start_index == 1
        centres = unit_vectors(*grid["centerCoords"][:].T)
        assert np.allclose(centres, nodes, rtol=0, atol=1e-14)
        count, corners = grid["numElementConn"][:], grid["elementConn"][:]
        assert corners.shape == (N, 6) and (count == 5).sum() == 12 and (corners.mask.sum(axis=1) == 6 - count).all()
        places = unit_vectors(*grid["nodeCoords"][:].T)
        assert len(places) == TRIANGLES
        for k in range(5):  # counterclockwise
            assert (np.einsum("ij,ij->i", centres, np.cross(places[corners[:, k] - 1], places[corners[:, (k + 1)] - 1])) > 0)[
                k + 1 < count].all()
        assert abs(grid["elementArea"][:].sum() - 4 * math.pi) < 1e-10 and (grid["elementMask"][:] == 1).all()


def check_scrip_of_a_grid():
    """Each corner inside a longitude-latitude grid is that of two triangles, which differ by rounding."""
    lon, lat = np.meshgrid(np.arange(0, 360, 10), np.arange(-85, 90, 10))
    np.savetxt(FOLDER / "grid.lonlat", np.stack([lon.ravel(), lat.ravel()], axis=1), fmt="%g")
    run("voronoi", FOLDER / "grid.lonlat", "-o", FOLDER / "grid.scrip.nc")
    with netCDF4.Dataset(FOLDER / "grid.scrip.nc") as grid:
        lon, lat = grid["grid_corner_lon"][:], grid["grid_corner_lat"][:]
    assert lon.shape == (36 * 18, 4)
    corners = unit_vectors(lon.ravel(), lat.ravel()).reshape(-1, 4, 3)
    sides = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2)
    # A cell at a pole is a triangle, whose last corner is repeated.
    assert (sides < 1e-12).sum() == 72 and (sides[36:-36] > 0.01).all()


def check_columns(nodes):
    """Numbers, texts, areas and attributes of a table, by netCDF4, xarray and meshio."""
    lon = np.round(np.degrees(np.arctan2(nodes[:, 1], nodes[:, 0])) % 360, 3)
    lat = np.round(np.degrees(np.arcsin(nodes[:, 2])), 3)
    with open(FOLDER / "table.csv", "w") as table:
        table.write("name,lat,lon,depth (km)\n")
        for k in range(N):
            table.write(f"n{k},{lat[k]},{lon[k]},{'' if k == 7 else k / 8}\n")
        table.write(f"again,{lat[0]},{lon[0]},1000\n")
    depth = np.arange(N) / 8
    depth[0], depth[7] = 500, np.nan
    run("triangulate", FOLDER / "table.csv", "--duplicates", "mean", "-o", FOLDER / "table.nc")
    run("voronoi", FOLDER / "table.csv", "--duplicates", "mean", "-o", FOLDER / "table_cells.nc")
    for file, where, location in (("table.nc", "mesh_node", "node"), ("table_cells.nc", "mesh_face", "face")):
        with xarray.open_dataset(FOLDER / file) as mesh:
            assert (mesh[f"{where}_lon"].values == lon).all() and (mesh[f"{where}_lat"].values == lat).all()
            assert np.array_equal(mesh["depth"].values, depth, equal_nan=True)
            assert (mesh["depth"].units, mesh["depth"].location, mesh["depth"].mesh) == ("km", location, "mesh")
            assert mesh["name"].values[3] == b"n3" and (mesh["line"].values == np.arange(N) + 2).all()
            assert (mesh["degree"].values == 5).sum() == 12 and (mesh["node"].values == np.arange(N) + 1).all()
            assert abs(mesh["area"].values.sum() - 4 * math.pi) < 1e-10
            assert np.allclose(mesh["area_km2"].values, mesh["area"].values * 6371**2, rtol=1e-15)
            assert mesh.history.startswith("pstripack ") and "--duplicates mean" in mesh.history
    with netCDF4.Dataset(FOLDER / "table.nc", "a") as mesh:
        mesh.title = "a title"
        mesh["depth"].long_name = "depth of the focus"
    run("convert", FOLDER / "table.nc", "-o", FOLDER / "again.nc")
    with xarray.open_dataset(FOLDER / "again.nc") as again, xarray.open_dataset(FOLDER / "table.nc") as mesh:
        assert set(again) == set(mesh) and all((again[v].values == mesh[v].values).all() or v == "depth" for v in mesh)
        assert again.title == "a title" and again["depth"].long_name == "depth of the focus"
        first, second = again.history.split("\n")
        assert first.startswith("pstripack convert ") and second == mesh.history
    run("interpolate", FOLDER / "table.nc", "--variable", "depth", "--skip-missing", "--grid-step", 30, "-o",
        FOLDER / "depth.nc")
    with xarray.open_dataset(FOLDER / "depth.nc") as field:
        assert field["depth"].long_name == "depth of the focus" and field.title == "a title"
    run("interpolate", FOLDER / "table.nc", "--variable", "depth", "--skip-missing", "--to-points", FOLDER / "table.csv",
        "-o", FOLDER / "depth.nc")
    with xarray.open_dataset(FOLDER / "depth.nc") as field:
        assert (field["depth"].long_name, field["depth"].units) == ("depth of the focus", "km")
        assert (field["lon"].values[:N] == lon).all() and field["depth_given"].units == "km"
    for suffix in ("vtu", "msh"):
        run("convert", FOLDER / "table.nc", "-o", FOLDER / f"table.{suffix}")
        mesh = meshio.read(FOLDER / f"table.{suffix}")
        assert (mesh.point_data["lon"].ravel() == lon).all(), suffix
        assert np.array_equal(mesh.point_data["depth"].ravel(), depth, equal_nan=True), suffix
        assert abs(mesh.cell_data["area"][0].sum() - 4 * math.pi) < 1e-10, suffix


def check_by_meshio(nodes, file, cells, count):
    mesh = meshio.read(file)
    assert [(block.type, len(block)) for block in mesh.cells] == [(cells, count)], mesh.cells
    if nodes is not None:
        assert (mesh.points == nodes).all()


def check_field(nodes):
    """A regional field on a grid and at points."""
    north = nodes[nodes[:, 2] > 0.1]
    np.savetxt(FOLDER / "values.txt", np.column_stack([north, 280 + north[:, 2]]), fmt="%.17g")
    run("interpolate", FOLDER / "values.txt", "--grid-step", 5, "-o", FOLDER / "grid.nc")
    with xarray.open_dataset(FOLDER / "grid.nc") as grid:
        value = grid["value"]
        assert value.dims == ("lat", "lon") and value.shape == (36, 72) and grid.Conventions == "CF-1.8"
        assert grid.lon.units == "degrees_east" and grid.lat.standard_name == "latitude"
        assert grid.lat.values[[0, -1]].tolist() == [-87.5, 87.5] and grid.lon.values[[0, -1]].tolist() == [-177.5, 177.5]
        exact = 280 + np.sin(np.radians(grid.lat.values))[:, None]
        assert np.isnan(value.values[:18]).all() and np.abs(value.values[20:] - exact[20:]).max() < 0.01
    run("interpolate", FOLDER / "values.txt", "--to-points", FOLDER / "nodes.txt", "-o", FOLDER / "points.nc")
    with xarray.open_dataset(FOLDER / "points.nc") as points:
        assert points["value"].dims == ("point",) and {"lon", "lat"} <= set(points["value"].coords)
        assert np.allclose(unit_vectors(points.lon.values, points.lat.values), nodes, rtol=0, atol=1e-14)
        assert (points["value"].values[nodes[:, 2] > 0.1] == 280 + north[:, 2]).all()


def check_scvt():
    run("scvt", 100, "--density", "bump", "--evaluations", 5, "-o", FOLDER / "scvt.mpas.nc")
    run("scvt", 100, "--density", "bump", "--evaluations", 5, "--well-centred", "-o", FOLDER / "scvt.nc")
    with netCDF4.Dataset(FOLDER / "scvt.mpas.nc") as mpas, xarray.open_dataset(FOLDER / "scvt.nc") as ugrid:
        density = mpas["meshDensity"][:]
        given = ugrid["meshDensity"].values
        assert 1 <= given.min() < 1.1 and 60 < given.max() <= 81 and ugrid["meshDensity"].location == "node"
        assert density.max() == 1 and (given / given.max() == density).all()
        assert ugrid.scvt_iterations == "5" and mpas.scvt_density == "bump"


def check_weights():
    """Weights give the values of interpolate bit for bit; rows and columns count all that is in the files."""
    rng = np.random.default_rng(1)
    lon, lat, value = rng.uniform(-60, 60, 300), rng.uniform(-60, 60, 300), rng.uniform(-1, 1, 300)
    lon[7] = lat[7] = -999  # missing
    lon[9], lat[9] = lon[5], lat[5]  # a duplicate
    with netCDF4.Dataset(FOLDER / "curvilinear.nc", "w") as data:
        for name, length in (("time", 1), ("y", 20), ("x", 15)):
            data.createDimension(name, length)
        for name, numbers in (("nav_lon", lon), ("nav_lat", lat), ("sst", value)):
            variable = data.createVariable(name, "f8", ("time", "y", "x") if name == "sst" else ("y", "x"), fill_value=-999)
            variable[:] = numbers.reshape(variable.shape)
    common = [FOLDER / "curvilinear.nc", "--variable", "sst", "--skip-missing", "--duplicates", "first"]
    for method in ("linear", "natural", "nearest"):
        for registration in ("cell", "node"):
            out, weights = FOLDER / "grid.nc", FOLDER / "weights.nc"
            run("interpolate", *common, "--grid-step", 30, "--registration", registration, "--method", method,
                "-o", out, "--weights", weights)
            with netCDF4.Dataset(weights) as w, netCDF4.Dataset(out) as grid:
                expected = np.ma.filled(grid["value" if "value" in grid.variables else "sst"][:], np.nan)
                row, col, part = (w[name][:] - (name != "S") for name in ("row", "col", "S"))
                got = np.bincount(row, part * value[col], len(w.dimensions["n_b"]))
                has_value = np.isin(np.arange(got.size), row)
                assert (w["frac_b"][:] == has_value).all() and (has_value.all() == (method == "nearest"))
                assert np.array_equal(np.where(has_value, got, np.nan).reshape(expected.shape), expected, equal_nan=True)
                assert list(w["src_grid_dims"][:]) == [15, 20] and list(w["dst_grid_dims"][:]) == list(expected.shape[::-1])
                assert list(np.flatnonzero(w["mask_a"][:] == 0)) == [7, 9] and not np.isin([7, 9], col).any()
                assert np.array_equal(w["xc_a"][:][w["mask_a"][:] == 1], np.delete(lon, [7, 9]))
                assert abs(w["area_b"][:].sum() - 4 * math.pi) < 1e-14 * 4 * math.pi
                assert ((w["xv_b"][:, 0] < w["xc_b"][:]) & (w["xc_b"][:] < w["xv_b"][:, 1])).all()
    # Without values, to points.
    run("interpolate", common[0], *common[3:], "--to-points", common[0], "--method", "nearest", "--weights", weights)
    with netCDF4.Dataset(weights) as w:
        assert list(w["row"][:] - 1) == [i for i in range(300) if i != 7] and list(w["dst_grid_dims"][:]) == [15, 20]
        assert (w["S"][:] == 1).all() and (w["col"][:] - 1 == [5 if i == 9 else i for i in range(300) if i != 7]).all()


FOLDER.mkdir(parents=True, exist_ok=True)
run("points", "icosahedral", N, "-o", FOLDER / "nodes.txt")
nodes = np.loadtxt(FOLDER / "nodes.txt")
for suffix in ("nc", "vtu", "off", "msh"):
    run("triangulate", FOLDER / "nodes.txt", "-o", FOLDER / f"mesh.{suffix}")
for suffix in ("nc", "scrip.nc", "esmf.nc"):
    run("voronoi", FOLDER / "nodes.txt", "-o", FOLDER / f"cells.{suffix}")
check_ugrid(nodes, FOLDER / "mesh.nc", FOLDER / "cells.nc")
check_scrip(nodes, FOLDER / "cells.scrip.nc")
check_esmf(nodes, FOLDER / "cells.esmf.nc")
check_edges()
check_scrip_of_a_grid()
for suffix in ("vtu", "off", "msh"):
    check_by_meshio(nodes, FOLDER / f"mesh.{suffix}", "triangle", TRIANGLES)
run("points", "cubed-sphere", 96, "-o", FOLDER / "cube.txt")
run("voronoi", FOLDER / "cube.txt", "-o", FOLDER / "cube.vtu")
assert sum(len(block) for block in meshio.read(FOLDER / "cube.vtu").cells) == 96
check_field(nodes)
check_columns(nodes)
check_scvt()
check_weights()
print("all files are as they should be")
