"""What meshes show: repr, tables, pictures. A test whose package is missing is skipped."""
import subprocess
import sys

import numpy as np
import pytest

import pstripack
from nodes import in_cap, random_nodes
from pstripack import Delaunay, SphericalVoronoi, scvt, to_lonlat, to_xyz

EARTH = 6371.0


def meshes():
    rng = np.random.default_rng(7)
    yield "sphere", Delaunay(random_nodes(400))
    yield "poles and dateline", Delaunay.from_lonlat([0, 0, 180, 180, -90, 90, 45, -120], [90, -90, 0, 40, 10, -20, 60, -50])
    yield "dateline", Delaunay.from_lonlat(rng.uniform(160, 200, 60), rng.uniform(-30, 10, 60))
    yield "cap around the south pole", Delaunay(-in_cap(80))
    yield "one circle", Delaunay.from_lonlat([0, 90, 180, 270], [10, 10, 10, 10])


def test_repr_is_one_line_with_counts_and_coverage():
    assert repr(Delaunay(random_nodes(50))) == "<pstripack.Delaunay: 50 nodes, 96 triangles, whole sphere>"
    for name, mesh in meshes():
        assert f" {mesh.npoints} nodes, {mesh.nsimplex} triangles, " in repr(mesh), name
        assert ("whole sphere" in repr(mesh)) == (len(mesh.convex_hull) == 0), name
    cap = Delaunay(in_cap(40))
    assert repr(cap).endswith(f", boundary of {len(cap.convex_hull)} arcs>")
    assert repr(SphericalVoronoi(random_nodes(50))) == ("<pstripack.SphericalVoronoi: 50 regions, 96 vertices, radius 1, "
                                                        "whole sphere>")
    assert f"boundary of {len(cap.convex_hull)} arcs" in repr(SphericalVoronoi(cap.points))
    run = repr(scvt(30, tolerance=1e-2))
    assert run.startswith("<pstripack.Tessellation: 30 generators, energy ") and run.endswith(" converged>")
    assert all("\n" not in repr(x) for x in (cap, SphericalVoronoi(cap.points), scvt(30, tolerance=1e-2)))


def test_a_missing_package_is_one_line_that_names_it(monkeypatch):
    mesh = Delaunay(random_nodes(20))
    for use, package, call in (("to_xarray()", "xarray", mesh.to_xarray), ("to_geodataframe()", "geopandas", mesh.to_geodataframe),
                               ("plot()", "matplotlib", mesh.plot)):
        with monkeypatch.context() as patch:
            patch.setattr(pstripack._tables.importlib, "import_module", lambda name: missing(name))
            with pytest.raises(ImportError) as error:
                call()
        assert str(error.value) == f"{use} needs {package}: pip install {package} (Debian: apt-get install python3-{package})"


def missing(name):
    raise ModuleNotFoundError(f"No module named '{name}'", name=name.partition(".")[0])


def test_optional_packages_are_imported_only_where_they_are_used():
    code = "import sys, pstripack; print([m for m in ('pandas', 'xarray', 'geopandas', 'shapely', 'matplotlib') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_nodes_are_found_in_the_columns_of_a_table():
    pandas = pytest.importorskip("pandas")
    lon, lat = np.array([0, 90.5, 180, -90, 20]), np.array([0, 0, 0, 5, 80.25])
    xyz = to_xyz(lon, lat)
    index = list("abcde")
    for names in (("lon", "lat"), ("LON", "Lat"), ("longitude", "latitude"), ("lng", "lat"), ("lon_deg", "lat_degrees")):
        mesh = Delaunay.from_dataframe(pandas.DataFrame({"t": 1.0, names[0]: lon, names[1]: lat}, index=index))
        assert np.array_equal(mesh.points, xyz) and list(mesh.labels) == index, names
    for names in ("clon", "clat"), ("nav_lon", "nav_lat"), ("lon [deg]", "lat [deg]"), ("XLONG", "XLAT"):
        assert np.array_equal(Delaunay.from_dataframe(pandas.DataFrame({names[0]: lon, names[1]: lat})).points, xyz), names
    header = pandas.DataFrame({"lon [rad]": np.radians(lon), "lat [rad]": np.radians(lat)})
    assert np.allclose(Delaunay.from_dataframe(header).points, xyz, rtol=0, atol=1e-15)
    with pytest.raises(ValueError, match=r"in the index: pass table.reset_index\(\)"):
        Delaunay.from_dataframe(pandas.DataFrame({"lon": lon, "lat": lat, "t": 1}).set_index(["lon", "lat"]))
    with pytest.raises(pstripack.BadCoordinateError, match="node 2 "):
        Delaunay.from_dataframe(pandas.DataFrame({"lon": lon, "lat": pandas.array([1, 2, None, 4, 5], "Float64")}))
    radians = pandas.DataFrame({"lat_rad": np.radians(lat), "lon_rad": np.radians(lon)})
    assert np.allclose(Delaunay.from_dataframe(radians).points, xyz, rtol=0, atol=1e-15)
    assert np.array_equal(Delaunay.from_dataframe(pandas.DataFrame(xyz, columns=list("xyz"))).points, xyz)
    for metres in (5e5, 5.2e6, 400), (5e5, 9.9e6, 2000), (1, 2, 3):
        utm = pandas.DataFrame(np.array(metres) + np.random.default_rng(1).uniform(0, 0.1 * metres[0], (9, 3)), columns=list("xyz"))
        with pytest.raises(ValueError, match=r"not on one sphere: .* to_crs\(4326\)"):
            Delaunay.from_dataframe(utm)
        assert Delaunay.from_dataframe(utm, columns=("x", "y", "z")).npoints == 9
    both = pandas.DataFrame({"lon": lon, "longitude": lon + 1, "lat": lat, "x": xyz[:, 0], "y": xyz[:, 1], "z": xyz[:, 2]})
    assert np.array_equal(Delaunay.from_dataframe(both, columns=("lon", "lat")).points, xyz)
    assert np.array_equal(Delaunay.from_dataframe(both, columns=["x", "y", "z"]).points, xyz)
    with pytest.raises(ValueError, match=r"several of the columns lon, longitude, lat, x, y, z: name .* columns=\(longitude, latitude\)"):
        Delaunay.from_dataframe(both)
    with pytest.raises(ValueError, match=r"several of the columns lon, longitude, lat:"):
        Delaunay.from_dataframe(both[["lon", "longitude", "lat"]])
    with pytest.raises(ValueError, match=r"none of the columns a, b are called lon and lat, or x, y and z: name them by columns="):
        Delaunay.from_dataframe(pandas.DataFrame({"a": lon, "b": lat}))
    with pytest.raises(ValueError, match=r"use Delaunay.from_lonlat\(table.geometry.x, table.geometry.y\)"):
        Delaunay.from_dataframe(pandas.DataFrame({"a": lon, "geometry": lat}))
    for wrong in ("lon", ("lon",), ("lon", "nowhere")):
        with pytest.raises(ValueError, match="columns must be two names"):
            Delaunay.from_dataframe(both, columns=wrong)
    with pytest.raises(ValueError, match="may be degrees or radians"):
        Delaunay.from_dataframe(pandas.DataFrame({"lon": lon / 100, "lat": lat / 100}))
    with pytest.raises(pstripack.BadCoordinateError, match="node 2 "):
        Delaunay.from_dataframe(pandas.DataFrame({"lon": lon, "lat": [1, 2, np.nan, 4, 5]}))


def ways_in(mesh):
    """Each way to pass values, and the numbers it made of them."""
    everywhere = mesh.points
    ways = {"interpolate": lambda v: mesh.interpolate(v, everywhere), "nearest": lambda v: mesh.interpolate(v, everywhere, "nearest"),
            "cubic": lambda v: mesh.interpolate(v, everywhere, "cubic"), "gradient": mesh.gradient,
            "gradient_lonlat": lambda v: np.array(mesh.gradient_lonlat(v))}
    for name, package in ("xarray", "xarray"), ("geodataframe", "geopandas"), ("plot", "matplotlib"):
        try:
            __import__(package)
        except ImportError:
            continue
        ways[name] = {"xarray": lambda v: mesh.to_xarray({"t": v})["t"].values, "plot": lambda v: np.sort(mesh.plot(v, "cells").get_array()),
                      "geodataframe": lambda v: mesh.to_geodataframe(values={"t": v})["t"].to_numpy()}[name]
    return ways


def test_values_with_labels_enter_by_them(monkeypatch):
    """In any order, and among others; in each way in."""
    pandas = pytest.importorskip("pandas")
    rng = np.random.default_rng(4)
    labels = [f"G{k:03}" for k in range(30)]
    table = pandas.DataFrame({"lon": rng.uniform(5, 15, 30), "lat": rng.uniform(45, 50, 30), "t": rng.normal(size=30)}, index=labels)
    seen = []
    monkeypatch.setattr(pstripack._delaunay, "globe", lambda mesh, values, *_: seen.append(values))
    for mesh in Delaunay.from_dataframe(table), Delaunay.from_lonlat(table["lon"], table["lat"][::-1]), Delaunay.from_dataframe(table[::-1]):
        t = table["t"].loc[mesh.labels]
        more = pandas.concat([table["t"].sort_values(), pandas.Series({"other": 7.0})])
        for name, way in {**ways_in(mesh), "globe": lambda v: mesh.globe(v) or seen[-1]}.items():
            expected = way(t.to_numpy())
            for values in t, t.sort_values(), more, t.sort_values().astype("Float64"):
                assert np.array_equal(way(values), expected), name
            with pytest.raises(ValueError, match="have no label 'G004', which is that of a node: .* values.to_numpy()"):
                way(table["t"].drop("G004"))
            with pytest.raises(ValueError, match="label 'G003' of the values is there twice"):
                way(pandas.concat([t, t[["G003"]]]))
            with pytest.raises(ValueError, match="one for each of 30 (nodes|cells)"):
                way(np.zeros(29))
        wide = pandas.DataFrame(rng.normal(size=(5, 30)), columns=labels).sort_index(axis=1, ascending=False)
        assert np.array_equal(mesh.interpolate(wide.T, mesh.points), wide.T.loc[mesh.labels].to_numpy())
        with pytest.raises(ValueError, match="pass values.T"):
            mesh.interpolate(wide, mesh.points)
    several = table.assign(name="x", lon=[*table["lon"][:29], table["lon"][3]], lat=[*table["lat"][:29], table["lat"][3]])
    mesh = Delaunay.from_dataframe(several, duplicates="mean")
    assert mesh.labels.tolist() == labels[:29]
    assert mesh.interpolate(several["t"][::-1], mesh.points[3]) == pytest.approx(several["t"].iloc[[3, 29]].mean())


def test_values_of_xarray_enter_by_their_dimension_and_labels():
    xarray = pytest.importorskip("xarray")
    labels = list("abcde")
    data = xarray.Dataset({"t": (("time", "station"), np.arange(15.0).reshape(3, 5), {"units": "K", "long_name": "temperature"})},
                          {"station": labels, "time": [1, 2, 3], "lon": ("station", [0.0, 100, 200, 300, 50]),
                           "lat": ("station", [0.0, 10, -10, 60, -70])})
    mesh = Delaunay.from_lonlat(data.lon, data.lat)
    assert list(mesh.labels) == labels
    for values in data.t, data.t[:, ::-1], data.t.T:
        assert np.array_equal(mesh.interpolate(values, mesh.points[2]), [2, 7, 12])
        made = mesh.to_xarray(values)
        assert made["t"].dims == ("mesh_nodes", "time") and made["t"].attrs["units"] == "K" and made["t"].attrs["long_name"] == "temperature"
        assert np.array_equal(made["t"].sel(mesh_nodes="c"), [2, 7, 12]) and made["time"].values.tolist() == [1, 2, 3]
    assert set(mesh.to_xarray(data[["t"]]).data_vars) == {"t", "mesh", "mesh_face_nodes"}
    with pytest.raises(ValueError, match="a Dataset: pass one of its variables: 't'"):
        mesh.interpolate(data, mesh.points)
    field = xarray.DataArray(np.zeros((4, 4)), {"lat": [0, 10, 20, 30], "lon": [0, 10, 20, 30]}, ("lat", "lon"))
    with pytest.raises(ValueError, match=r"longitudes \('lon',\) \(4,\) and latitudes \('lat',\) \(4,\) do not fit.*meshgrid"):
        Delaunay.from_lonlat(field.lon, field.lat)
    with pytest.raises(TypeError, match="a table with columns is needed, not Dataset"):
        Delaunay.from_dataframe(data)


def test_a_mesh_comes_back_from_a_dataset(tmp_path):
    xarray = pytest.importorskip("xarray")
    pandas = pytest.importorskip("pandas")
    rng = np.random.default_rng(5)
    table = pandas.DataFrame({"lon": rng.uniform(5, 15, 30), "lat": rng.uniform(45, 50, 30)}, index=pandas.Index([f"G{k}" for k in range(30)], name="gauge"))
    for mesh in Delaunay.from_dataframe(table), Delaunay(3 * random_nodes(40)):
        for what in "triangles", "cells":
            mesh.to_xarray({"t": np.arange(mesh.npoints)}, what).to_netcdf(tmp_path / "mesh.nc")
            with xarray.open_dataset(tmp_path / "mesh.nc") as read:
                back = Delaunay.from_xarray(read)
                assert what == "cells" or read["mesh_face_nodes"].dtype == np.int32
                assert np.array_equal(back.interpolate(read["t"], mesh.points), np.arange(mesh.npoints))
            assert np.array_equal(back.points, mesh.points)
            assert back.labels is mesh.labels or (back.labels.equals(mesh.labels) and back.labels.name == "gauge")
    with pytest.raises(ValueError, match="no mesh_node_x"):
        Delaunay.from_xarray(xarray.Dataset())


def check_ugrid(ds):
    """What the UGRID conventions, version 1.0, ask of a mesh of faces. Returns longitudes and latitudes of its nodes, and
    its faces."""
    assert "UGRID-1.0" in ds.attrs["Conventions"]
    [mesh] = [v for v in ds.variables.values() if v.attrs.get("cf_role") == "mesh_topology"]
    # Required: an integer, no dimension, topology_dimension, node_coordinates, face_node_connectivity.
    assert mesh.dims == () and mesh.dtype.kind == "i" and mesh.attrs["topology_dimension"] == 2
    faces = ds[mesh.attrs["face_node_connectivity"]]
    assert faces.attrs["cf_role"] == "face_node_connectivity" and faces.dims[0] == mesh.attrs["face_dimension"]
    places = {}
    for of in ("node", "face"):
        if of == "face" and "face_coordinates" not in mesh.attrs:  # optional
            continue
        lon, lat = (ds[name] for name in mesh.attrs[f"{of}_coordinates"].split())
        assert (lon.attrs["standard_name"], lon.attrs["units"]) == ("longitude", "degrees_east")
        assert (lat.attrs["standard_name"], lat.attrs["units"]) == ("latitude", "degrees_north")
        assert lon.dims == lat.dims and len(lon.dims) == 1
        places[of] = to_xyz(lon.values, lat.values), lon.dims[0]
    assert faces.dims[0] == places.get("face", (None, faces.dims[0]))[1]
    for name, v in ds.data_vars.items():
        if v.attrs.get("location"):
            assert v.attrs["mesh"] in ds and v.dims[0] == {"node": places["node"][1], "face": faces.dims[0]}[v.attrs["location"]]
    fill, start = (faces.attrs.get(name, faces.encoding.get(name)) for name in ("_FillValue", "start_index"))
    assert start in (0, 1)
    rows = faces.values
    if rows.dtype.kind == "f":  # as xarray reads integers with a _FillValue
        rows = np.where(np.isnan(rows), fill, rows).astype(int)
    assert fill in (None, -1) and (fill == -1 or rows.dtype == np.int32)  # without it triangles stay integers in xarray
    given = [row[row != fill] - start for row in rows]
    assert all(len(row) >= 3 and np.array_equal(np.flatnonzero(all_ != fill), np.arange(len(row)))
               for row, all_ in zip(given, rows))  # fill values only in the end
    return places, given


def test_xarray_is_ugrid(tmp_path):
    xarray = pytest.importorskip("xarray")
    for name, mesh in meshes():
        for what in ("triangles", "cells"):
            n = mesh.npoints
            ds = mesh.to_xarray({"height": np.arange(n, dtype=float), "number": np.arange(n)}, what)
            areas = mesh.areas if what == "triangles" else mesh.cell_areas
            count = len(areas)
            if what == "triangles" and count != n:
                ds = ds.merge(mesh.to_xarray({"area": areas}))
                assert ds["area"].attrs["location"] == "face"
            file = tmp_path / "mesh.nc"
            ds.to_netcdf(file)
            with xarray.open_dataset(file) as read:
                for each in (ds, read):
                    places, faces = check_ugrid(each)
                    assert len(faces) == count and each["height"].attrs["location"] == ("face" if what == "cells" else "node")
                    nodes, of = (places["face"][0], "face") if what == "cells" else (places["node"][0], "node")
                    assert np.allclose(nodes, mesh.points, rtol=0, atol=1e-15) and each["height"].dims == (f"mesh_{of}s",)
                    assert each["number"].dtype.kind == "i"
                    # Counterclockwise, in the order of the mesh: the faces have its areas.
                    for f in range(0, count, 1 + count // 30):
                        corners = places["node"][0][faces[f]]
                        centre = nodes[f] if what == "cells" else corners[0]
                        assert abs(area_of(centre, corners) - areas[f]) < 1e-12, (name, what, f)
            if what == "triangles":
                assert np.array_equal(ds["mesh_face_nodes"].values, mesh.simplices) and ds["mesh_face_nodes"].dtype == np.int32


def area_of(centre, corners):
    """Area of a polygon that is counterclockwise, by triangles from a place in it."""
    next_ = np.roll(corners, -1, axis=0)
    volumes = np.cross(corners, next_) @ centre
    return float(2 * np.arctan2(volumes, 1 + corners @ centre + next_ @ centre + (corners * next_).sum(axis=1)).sum())


def test_wrong_values_of_a_dataset_are_refused():
    pytest.importorskip("xarray")
    mesh = Delaunay(random_nodes(20))
    with pytest.raises(ValueError, match=r"one for each of 20 nodes or 36 faces of the mesh, not 7 \(values\)"):
        mesh.to_xarray(np.zeros(7))
    with pytest.raises(ValueError, match="must have one dimension"):
        mesh.to_xarray(np.zeros((20, 2)))
    with pytest.raises(ValueError, match="must not be called mesh_node_lon"):
        mesh.to_xarray({"mesh_node_lon": np.zeros(20)})
    with pytest.raises(ValueError, match="what must be 'triangles' or 'cells', not 'faces'"):
        mesh.to_xarray(what="faces")
    masked = mesh.to_xarray(np.ma.array(np.arange(20), mask=np.arange(20) == 3))["values"].values
    assert np.flatnonzero(np.isnan(masked)).tolist() == [3] and masked[4] == 4


def area_on_sphere(polygon):
    """Area, in steradians, of a polygon whose sides are straight in longitude and latitude: the integral of the sine of the
    latitude, as in an equal-area map, but exact along each side."""
    lon, lat = np.radians(np.array(polygon.exterior.coords)).T
    assert len(polygon.interiors) == 0
    width, half, middle, south = np.diff(lon), np.diff(lat) / 2, (lat[:-1] + lat[1:]) / 2, lat.min()
    # The mean of the sine along each side, less its value in the south: differences keep the digits of small polygons.
    mean = 2 * np.cos((middle + south) / 2) * np.sin((middle - south) / 2) + np.sin(middle) * (np.sinc(half / np.pi) - 1)
    return -(width * mean).sum()


def area_with_holes(polygon):
    return abs(area_on_sphere(type(polygon)(polygon.exterior))) - sum(abs(area_on_sphere(type(polygon)(hole)))
                                                                     for hole in polygon.interiors)


def test_polygons_of_a_geodataframe_have_the_areas_of_the_mesh():
    pytest.importorskip("geopandas")
    for name, mesh in meshes():
        for what, areas in (("cells", mesh.cell_areas), ("triangles", mesh.areas)):
            frame = mesh.to_geodataframe(what)
            assert frame.crs == "EPSG:4326" and frame.geometry.is_valid.all(), (name, what)
            assert np.allclose(frame["area_km2"], areas * EARTH**2, rtol=1e-15)
            parts = [list(getattr(shape, "geoms", [shape])) for shape in frame.geometry]
            found = np.array([sum(map(area_on_sphere, polygons)) for polygons in parts])
            # Sides are within 0.001 degrees of the arcs: 2e-5 times the perimeter, here 10 at most.
            assert np.abs(found - areas).max() < 1e-4, (name, what)
            on_hull = what == "triangles" and len(mesh.convex_hull) > 0
            assert abs(found.sum() - areas.sum()) < (1e-4 if on_hull else 1e-13 * len(areas)), (name, what)
            west, south, east, north = frame.total_bounds
            assert -180 <= west and east <= 180 and -90 <= south and north <= 90
            assert all(p.exterior.is_ccw for polygons in parts for p in polygons)
            # No polygon reaches around the dateline: none is wider than 180 degrees unless it holds a pole.
            for polygons in parts:
                for p in polygons:
                    w, s, e, n = p.bounds
                    assert e - w <= 180 + 1e-9 or max(-s, n) == 90, (name, what)


def test_each_node_is_in_the_polygon_of_its_cell():
    geopandas = pytest.importorskip("geopandas")
    mesh = Delaunay(random_nodes(300))
    frame = mesh.to_geodataframe(values={"node": np.arange(300)})
    at = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*to_lonlat(mesh.points)), crs=frame.crs)
    cell = [np.flatnonzero(frame.geometry.contains(point)).tolist() for point in at.geometry[::20]]
    assert cell == [[i] for i in range(0, 300, 20)] and frame["node"].tolist() == list(range(300))
    with pytest.raises(ValueError, match=r"one for each of 596 triangles, not 300 \(values\)"):
        mesh.to_geodataframe("triangles", np.zeros(300))


def test_cells_are_cut_at_polygons():
    geopandas = pytest.importorskip("geopandas")
    from shapely.geometry import MultiPolygon, Point, Polygon
    rng = np.random.default_rng(3)
    for size in 0.01, 1.0, 20.0:  # degrees: a hillside, a catchment, a continent
        lon, lat = rng.uniform(10, 10 + size, 40), rng.uniform(47, 47 + size, 40)
        mesh = Delaunay.from_lonlat(np.append(lon, -120), np.append(lat, -40))

        def at(*corners):
            return [(10 + size * x, 47 + size * y) for x, y in corners]

        hole = at((0.5, 0.5), (0.6, 0.5), (0.6, 0.6), (0.5, 0.6))
        catchment = MultiPolygon([Polygon(at((0.1, 0.2), (0.8, 0.1), (0.9, 0.7), (0.4, 0.9)), [hole]),
                                  Polygon(at((0.05, 0.6), (0.3, 0.9), (0.05, 0.9)))])
        frame = mesh.to_geodataframe(clip=catchment)
        assert frame.geometry.iloc[-1] is None and frame["area_km2"].iloc[-1] == 0 and len(frame) == 41
        all_inside = sum(map(area_with_holes, catchment.geoms)) * EARTH**2
        assert frame["area_km2"].sum() == pytest.approx(all_inside, rel=1e-4)
        for shape, area in zip(frame.geometry, frame["area_km2"]):
            found = sum(map(area_on_sphere, getattr(shape, "geoms", [shape]))) * EARTH**2 if shape is not None else 0
            # The sides of cells are arcs, drawn as lines within 0.001 degrees.
            assert found == pytest.approx(area, rel=min(0.3 * np.radians(size), 0.02 / size), abs=1e-7 * all_inside)
        x, y = rng.uniform(10, 10 + size, 300), rng.uniform(47, 47 + size, 300)
        distance, node = mesh.nearest(lon=x, lat=y, k=2, distance=True)
        near_a_side = distance[:, 1] - distance[:, 0] < 1e-4 * np.radians(size)
        for i in np.flatnonzero(~near_a_side):
            shape = frame.geometry.iloc[node[i, 0]]
            assert catchment.contains(Point(x[i], y[i])) == (shape is not None and shape.contains(Point(x[i], y[i])))
        # Any table of polygons, in its coordinates; catchments that overlap count once.
        table = geopandas.GeoDataFrame(geometry=[catchment, *catchment.geoms], crs="EPSG:4326")
        assert np.allclose(mesh.to_geodataframe(clip=table)["area_km2"], frame["area_km2"], rtol=1e-9)
        metres = mesh.to_geodataframe(clip=table.to_crs("EPSG:3035"))["area_km2"]
        assert np.allclose(metres, frame["area_km2"], rtol=1e-5, atol=1e-6 * all_inside)
    for wrong, message in ((Point(10, 47), "must be a polygon, not Point"), (Polygon(), "must be a polygon"),
                           (Polygon([(0, 0), (5e5, 0), (0, 5e6)]), r"no longitudes .*: pass clip.to_crs"),
                           (Polygon([(0, 0), (2, 2), (2, 0), (0, 2)]), "crosses or lies on")):
        with pytest.raises(ValueError, match=message):
            mesh.to_geodataframe(clip=wrong)
    with pytest.raises(ValueError, match="clip cuts cells"):
        mesh.to_geodataframe("triangles", clip=catchment)


def test_the_index_of_a_table_is_that_of_its_cells():
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("geopandas")
    table = pandas.DataFrame({"lon": [0, 120, 240, 0], "lat": [0, 0, 0, 90]}, index=list("abcd"))
    mesh = Delaunay.from_dataframe(table)
    given = mesh.to_geodataframe(values={"area_km2": table["lat"][::-1], "geometry": list("wxyz")})
    assert given["area_km2_given"].tolist() == table["lat"].tolist() and given["geometry_given"].tolist() == list("wxyz")
    for wrong in table, "cell":
        with pytest.raises(ValueError, match="what must be 'triangles' or 'cells'"):
            mesh.to_geodataframe(wrong)
    with pytest.raises(ValueError, match="the kind of faces is passed as what='cells'"):
        mesh.plot("cells")
    joined = table.join(mesh.to_geodataframe())
    assert joined["area_km2"].sum() == pytest.approx(4 * np.pi * EARTH**2) and list(joined.index) == list("abcd")


def test_a_side_of_half_a_circle_is_refused_by_its_cell():
    pytest.importorskip("geopandas")
    mesh = Delaunay([[1, 0, 0], [-1, 1e-7, 0], [0, 0.6, 0.8]])
    with pytest.raises(pstripack.TriangulationError, match=r"triangle \d \(counted from 0\) has two corners opposite each other"):
        mesh.to_geodataframe("triangles")


# ---- pictures -------------------------------------------------------------------------------------------------------

@pytest.fixture
def plt():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    yield pyplot
    pyplot.close("all")


def area_of_paths(artist):
    """Of each polygon of a picture."""
    areas = []
    for path in artist.get_paths():
        x, y = path.vertices.T
        areas.append(abs(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2)
    return np.array(areas)


def test_polygons_of_a_map_cover_it_once(plt):
    for name, mesh in meshes():
        if len(mesh.convex_hull) > 0:
            continue
        for what in ("triangles", "cells"):
            for center in ((0, 0), (150, 0)):
                artist = mesh.plot(np.arange(mesh.npoints), what, center=center)
                assert area_of_paths(artist).sum() == pytest.approx(360 * 180, rel=1e-4), (name, what)
                assert artist.axes.get_xlim() == (center[0] - 180, center[0] + 180)
                x = np.concatenate([path.vertices[:, 0] for path in artist.get_paths()])
                assert x.min() == center[0] - 180 and x.max() == center[0] + 180
    plt.close("all")


def test_the_hidden_side_is_left_out(plt):
    mesh = Delaunay(random_nodes(500))
    for what in ("triangles", "cells"):
        artist = mesh.plot(np.arange(500), what, projection="orthographic", center=(30, -40))
        assert area_of_paths(artist).sum() == pytest.approx(np.pi, rel=1e-4)
        assert all(np.hypot(*path.vertices.T).max() <= 1 + 1e-9 for path in artist.get_paths())
        lines = mesh.plot(what=what, projection="orthographic", center=(30, -40))
        assert len(lines.get_paths()) < 0.6 * 1494
    # Where a node lies: to the right in the east, upwards in the north.
    small = Delaunay.from_lonlat([29, 31, 31, 29], [-41, -41, -39, -39])
    artist = small.plot(np.array([0.0, 1, 2, 3]), "cells", projection="orthographic")
    where = {value: path.vertices.mean(axis=0) for value, path in zip(artist.get_array(), artist.get_paths())}
    assert where[0][0] < where[1][0] and where[0][1] < where[3][1] and where[1][1] < where[2][1]


def test_colours_are_those_of_the_nodes_and_triangles(plt):
    mesh = Delaunay(random_nodes(100))
    height = mesh.points[:, 2]
    of_triangles = mesh.plot(height).get_array()
    assert of_triangles.min() == height[mesh.simplices].mean(axis=1).min()
    assert mesh.plot(mesh.areas).get_array().max() == mesh.areas.max()
    cells = mesh.plot(np.where(height > 0, height, np.nan), "cells", vmin=-1, vmax=2, cmap="magma", edgecolor="k")
    assert cells.get_clim() == (-1, 2) and cells.get_cmap().name == "magma" and len(cells.axes.collections) == 2
    assert np.ma.count_masked(np.ma.masked_invalid(cells.get_array())) > 40
    assert len(mesh.plot().get_paths()) >= 3 * 100 - 6  # each arc, in two parts at the dateline
    with pytest.raises(ValueError, match="one for each of 100 nodes or 196 triangles, not 3"):
        mesh.plot([1, 2, 3])
    with pytest.raises(ValueError, match="one for each of 100 nodes, not 196"):
        mesh.plot(mesh.areas, "cells")
    with pytest.raises(ValueError, match="projection must be 'map' or 'orthographic', not 'globe'"):
        mesh.plot(projection="globe")
    with pytest.raises(ValueError, match="center must be"):
        mesh.plot(center=(0, 91))
    with pytest.raises(ValueError, match="radius must be"):
        mesh.plot(radius=-1)


def test_a_region_across_the_dateline_is_drawn_in_one_piece(plt):
    rng = np.random.default_rng(3)
    mesh = Delaunay.from_lonlat(rng.uniform(160, 200, 60), rng.uniform(-30, 10, 60))
    lines = mesh.plot()
    arcs = mesh.npoints + mesh.nsimplex - 1  # Euler
    west, east = lines.axes.get_xlim()
    assert len(lines.get_paths()) == arcs and 40 < east - west < 70
    ax = plt.figure().add_subplot()
    ax.set_xlim(5, 6)
    mesh.plot(ax=ax)
    assert ax.get_xlim() == (5, 6)


def test_axes_of_cartopy_draw_in_their_projection(plt):
    """Cells have their areas on an equal-area map, also where the map is cut through the nodes."""
    crs = pytest.importorskip("cartopy.crs")
    rng = np.random.default_rng(3)
    across = Delaunay.from_lonlat(rng.uniform(160, 200, 40), rng.uniform(-30, 10, 40))
    for mesh, middle in ((Delaunay(random_nodes(60)), 70), (across, 0)):
        ax = plt.figure().add_subplot(projection=crs.Mollweide(middle))
        artist = mesh.plot(np.arange(mesh.npoints), "cells", ax=ax, edgecolor="k")
        to_map = artist.get_transform() - ax.transData
        areas = np.zeros(mesh.npoints)
        for cell, path in zip(artist.get_array(), artist.get_paths()):
            for x, y in (polygon.T for polygon in to_map.transform_path(path).to_polygons()):
                areas[int(cell)] += abs(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])) / 2
        assert np.allclose(areas / ax.projection.globe.semimajor_axis**2, mesh.cell_areas, rtol=0.02, atol=1e-3)
    # A region is shown, unless somebody has chosen another.
    for chosen in (False, True):
        ax = plt.figure().add_subplot(projection=crs.PlateCarree(180))
        if chosen:
            ax.set_global()
        across.plot(ax=ax)
        west, east = ax.get_xlim()
        assert (west, east) == (-180, 180) if chosen else -40 < west < -20 and 20 < east < 40
