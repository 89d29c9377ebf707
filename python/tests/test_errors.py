import pickle

import numpy as np
import pytest
from nodes import random_nodes
from pstripack import (BadCoordinateError, CoincidentNodesError, CollinearNodesError, Delaunay, SphericalVoronoi,
                       TriangulationError, _core, scvt, to_lonlat, to_xyz)

POINTS = random_nodes(50)


def changed(index, value):
    points = POINTS.copy()
    points[index] = value
    return points


@pytest.mark.parametrize("points, kind, nodes, message", [
    (changed(17, np.nan), BadCoordinateError, (17,), "node 17 (counted from 0) is (nan, nan, nan)"),
    (changed((31, 1), np.inf), BadCoordinateError, (31,), "node 31"),
    (changed([40, 9, 22], 0), BadCoordinateError, (9,), "node 9 (counted from 0) is (0, 0, 0)"),
    (changed(30, POINTS[12]), CoincidentNodesError, (12, 30), "nodes 12 and 30 (counted from 0)"),
    (changed(30, 2 * POINTS[12]), CoincidentNodesError, (12, 30), "same direction"),
    (changed(1, POINTS[0]), CoincidentNodesError, (0, 1), "nodes 0 and 1"),
    (changed(2, POINTS[0]), CoincidentNodesError, (0, 2), "nodes 0 and 2"),
    (changed([0, 1, 2], [POINTS[40], -POINTS[40], POINTS[41]]), CoincidentNodesError, None, "counted from 0"),
    (to_xyz(np.arange(0, 360, 10), np.zeros(36)), CollinearNodesError, (), "one great circle"),
    (np.array([[1.0, 2, 3]] * 5), CollinearNodesError, (), "one great circle"),
    (POINTS[:2], TriangulationError, (), "three nodes, not 2"),
    (POINTS[:0], TriangulationError, (), "three nodes, not 0"),
], ids=["nan", "infinite", "zero", "coincident", "one_direction", "second", "third", "front", "great_circle",
        "all_equal", "two", "none"])
def test_why_there_is_no_triangulation(points, kind, nodes, message, capfd):
    with pytest.raises(kind) as caught:
        Delaunay(points)
    assert isinstance(caught.value, ValueError) and message in str(caught.value)
    if nodes is not None:
        assert caught.value.nodes == nodes
    assert capfd.readouterr() == ("", "")  # the library prints nothing on its own
    copy = pickle.loads(pickle.dumps(caught.value))
    assert copy.nodes == caught.value.nodes and str(copy) == str(caught.value)


@pytest.mark.parametrize("lon, lat, node", [
    ([10, 20, np.nan, 40], [1, 2, 3, 4], "node 2 (counted from 0) is at longitude nan, latitude 3:"),
    ([10, 20, 30, 40], [1, np.nan, np.nan, 4], "node 1 (counted from 0) is at longitude 20, latitude nan:"),
    ([10, 20, 30, np.inf], 5, "node 3 (counted from 0) is at longitude inf, latitude 5:"),
    ([1, np.nan, 1], [1, 1, 1], "node 1 "),
])
def test_an_angle_that_is_not_finite_is_reported_as_it_was_given(lon, lat, node):
    with pytest.raises(BadCoordinateError) as caught:
        Delaunay.from_lonlat(lon, lat)
    assert node in str(caught.value) and len(caught.value.nodes) == 1


def test_every_pair_that_coincides_is_found_among_many_nodes():
    points = random_nodes(40000)
    points[34321] = points[12345]
    with pytest.raises(CoincidentNodesError) as caught:
        Delaunay(points)
    assert caught.value.nodes == (12345, 34321)


@pytest.mark.parametrize("distance", [1e-150, 1e-20, 1e-12, 1e-3])
def test_nodes_within_the_threshold_are_refused(distance):
    points = np.vstack([np.eye(3), -np.eye(3), [1, 0, distance]])
    for make in (Delaunay, scvt):
        with pytest.raises(CoincidentNodesError, match="nodes 0 and 6 .* radians apart, within the threshold") as caught:
            make(points, threshold=1.01 * distance)
        assert caught.value.nodes == (0, 6)
    assert Delaunay(points, threshold=0.99 * distance).npoints == 7
    assert Delaunay(points).npoints == 7
    with pytest.raises(ValueError, match="threshold must be at least 0"):
        Delaunay(points, threshold=np.nan)


def test_the_closest_pair_is_that_of_the_directions():
    points = random_nodes(500)
    points[[3, 4]] = [1, 2e-160, 0], [3, 0, 0]
    points[[70, 400]] = [0, 1, 0], [1e-17, 1, 0]
    points[[80, 90]] = points[12] + [[1e-15, 0, 0], [0, 1e-15, 0]]
    distance, *nodes = _core.Mesh(points, 2).closest_pair(2)
    assert (distance, nodes) == (pytest.approx(2e-160, rel=1e-14, abs=0), [3, 4])


@pytest.mark.parametrize("points", [np.zeros(3), np.zeros((4, 2)), np.zeros((3, 4)), np.zeros((2, 2, 3)), "nodes",
                                    [[1, 2, 3], [4, 5]], None, 5])
def test_what_is_no_array_of_nodes(points):
    with pytest.raises((ValueError, TypeError)):
        Delaunay(points)


class Table(dict):
    """A table as pandas' DataFrame: `columns` are the names, an array of the table has a column for each."""

    columns = property(lambda self: list(self))

    def __getitem__(self, key):
        return Table({name: self[name] for name in key}) if isinstance(key, list) else super().__getitem__(key)

    def __array__(self, dtype=None):
        return np.array(list(self.values()), dtype).T


def test_a_table_needs_the_columns_x_y_z():
    x, y, z = POINTS.T
    table = Table(t=np.arange(50), z=z, x=x, y=y)
    assert np.array_equal(Delaunay(table).points, POINTS) and np.array_equal(Delaunay(POINTS).nearest(table), np.arange(50))
    wrong = Table(lon=x, lat=y, t=z)
    for make in (Delaunay, SphericalVoronoi, scvt, Delaunay(POINTS).nearest):
        with pytest.raises(ValueError, match="columns x, y and z, not lon, lat, t.*from_dataframe"):
            make(wrong)


def test_masked_elements_and_complex_numbers_are_refused():
    lon, lat = np.linspace(0, 350, 50), np.linspace(-80, 80, 50)
    mesh = Delaunay(POINTS)

    def calls(vectors, numbers):
        return (lambda: Delaunay(vectors), lambda: SphericalVoronoi(vectors), lambda: scvt(vectors),
                lambda: mesh.nearest(vectors), lambda: mesh.find_simplex(vectors), lambda: to_lonlat(vectors),
                lambda: mesh.interpolate(np.zeros(50), vectors), lambda: mesh.interpolate(numbers, POINTS),
                lambda: Delaunay.from_lonlat(lon + numbers, lat), lambda: to_xyz(lon, numbers))

    for call in calls(np.ma.masked_inside(POINTS, 0.5, 0.51), np.ma.masked_less(np.arange(50), 1)):
        with pytest.raises(ValueError, match="masked"):
            call()
    with pytest.raises(ValueError, match="masked"):
        mesh.interpolate(np.ma.masked_less(np.arange(50), 1), POINTS, "nearest")
    for call in calls(POINTS + 0j, np.zeros(50, complex)):
        with pytest.raises(TypeError, match="complex"):
            call()
    unmasked = np.ma.array(POINTS)  # as netCDF4 returns arrays without missing values
    assert np.array_equal(Delaunay(unmasked).simplices, mesh.simplices)


@pytest.mark.parametrize("threads", [1.5, 2.0, "2"])
def test_numbers_of_threads_that_are_not_whole(threads):
    with pytest.raises(TypeError, match="threads must be a whole number"):
        Delaunay(POINTS, threads=threads)


@pytest.mark.parametrize("threads", [0, -3])
def test_numbers_of_threads_below_one(threads):
    with pytest.raises(ValueError, match="threads must be at least 1"):
        Delaunay(POINTS, threads=threads)


@pytest.mark.parametrize("order", "CF")
def test_nodes_that_change_afterwards_do_no_harm(order):
    """The mesh keeps a copy, which its pickle has too."""
    points = np.array(random_nodes(500), order=order)
    mesh, expected = Delaunay(points), Delaunay(points.copy())
    points[::2] = -1
    for other in mesh, pickle.loads(pickle.dumps(mesh)):
        assert np.array_equal(other.points, expected.points)
        for name in "simplices", "areas", "circumcenters", "cell_areas":
            assert np.array_equal(getattr(other, name), getattr(expected, name))
        for call in "find_simplex", "nearest":
            assert np.array_equal(getattr(other, call)(POINTS), getattr(expected, call)(POINTS))
        with pytest.raises(ValueError):
            other.points[0] = 0


def test_arrays_that_are_returned_cannot_harm_a_mesh():
    mesh = Delaunay(POINTS)
    for array in (mesh.simplices, mesh.neighbors, *mesh.vertex_neighbor_vertices, mesh.areas, mesh.points):
        with pytest.raises(ValueError, match="read-only"):
            array += 1
    list_, lptr, lend, _ = mesh.lists
    list_[:] = lptr[:] = lend[:] = 2**30
    assert mesh.find_simplex(POINTS).min() >= 0 and np.array_equal(mesh.areas, Delaunay(POINTS).areas)
    diagram = SphericalVoronoi(POINTS)
    areas = diagram.calculate_areas()
    diagram.vertices[:] = np.nan
    diagram.points[:] = 0
    assert np.array_equal(diagram.calculate_areas(), areas)
    for part in diagram.region_vertices:
        with pytest.raises(ValueError):
            part[:] = 2**30
    diagram.regions[0].clear()
    assert len(diagram.regions[0]) == 0


def test_a_pickle_is_that_of_the_nodes_alone():
    """So that hashes of meshes (joblib, dask) do not change with what was read of them."""
    mesh = Delaunay(POINTS)
    before = pickle.dumps(mesh), mesh.__dask_tokenize__()
    for name in "simplices", "neighbors", "vertex_neighbor_vertices", "areas", "edges":
        getattr(mesh, name)
    assert (pickle.dumps(mesh), mesh.__dask_tokenize__()) == before
    assert Delaunay(POINTS[::-1]).__dask_tokenize__() != before[1]


def test_all_nodes_that_coincide_are_in_the_error_or_joined():
    points = np.vstack([POINTS, POINTS[[3, 7, 3]], 2 * POINTS[:2]])
    with pytest.raises(CoincidentNodesError, match="5 nodes point in the same direction as earlier ones: nodes 3 and 50, 7 and 51, ") as caught:
        Delaunay(points)
    assert caught.value.nodes == (3, 50, 7, 51, 3, 52, 0, 53, 1, 54)
    with pytest.raises(CoincidentNodesError):
        SphericalVoronoi(points[:53])
    values = np.arange(55.0)
    values[51] = np.nan
    for duplicates, at_3, at_7 in ("first", 3, 7), ("mean", (3 + 50 + 52) / 3, 7):
        mesh = Delaunay(points, duplicates=duplicates)
        assert np.array_equal(mesh.points, POINTS) and mesh.node_of_row[50:].tolist() == [3, 7, 3, 0, 1]
        assert mesh.interpolate(values, POINTS[[3, 7, 9]], "nearest") == pytest.approx([at_3, at_7, 9])
        assert mesh.interpolate(np.arange(50), POINTS[9]) == 9
        assert pickle.loads(pickle.dumps(mesh)).interpolate(values, POINTS[3]) == at_3
        with pytest.raises(ValueError, match="one for each of 50 nodes"):
            mesh.gradient(np.zeros(54))
    lon, lat = [180, -180, 0, 360, 5, 17, 90], [10, 10, 20, 20, 90, 90, 0]
    mesh = Delaunay.from_lonlat(lon, lat, duplicates="first")
    assert mesh.npoints == 4 and mesh.node_of_row.tolist() == [0, 0, 1, 1, 2, 2, 3]
    with pytest.raises(ValueError, match="duplicates must be"):
        Delaunay(POINTS, duplicates="last")
    with pytest.raises(CoincidentNodesError, match="within the threshold"):
        Delaunay(points + 1e-12 * np.arange(165).reshape(55, 3), threshold=1e-3, duplicates="first")


def test_what_is_no_number_is_named():
    lon = ["8.5", "6.1", "9,8", "7.4"]
    with pytest.raises(ValueError, match=r"longitude of node 2 \(counted from 0\) is '9,8', not a number: .*decimal=','"):
        Delaunay.from_lonlat(lon, [47, 46, 46.5, 46])
    with pytest.raises(ValueError, match=r"latitude of node 1 \(counted from 0\) is 'n/a', not a number: pandas.to_numeric"):
        Delaunay.from_lonlat([8, 9, 10], np.array([47, "n/a", 46], object))
    with pytest.raises(ValueError, match="value 2 .* is 'x', not a number"):
        Delaunay(POINTS).gradient(["1", "2", "x"] + ["3"] * 47)
    with pytest.raises(TypeError, match="is a date"):
        Delaunay(POINTS).gradient(np.zeros(50, "datetime64[s]"))
    with pytest.raises(ValueError, match=r"metres of a map projection\? to_crs\(4326\)"):
        Delaunay.from_lonlat([6e5, 6.1e5, 6.2e5], [5.19e6, 5.2e6, 5.21e6])
    for make in (lambda: Delaunay.from_lonlat(np.arange(40), np.arange(30)),
                 lambda: Delaunay(POINTS).nearest(lon=np.arange(40), lat=np.arange(30))):
        with pytest.raises(ValueError, match=r"longitudes \(40,\) and latitudes \(30,\) do not fit each other.*meshgrid"):
            make()
    with pytest.raises(TypeError, match="a table with columns is needed, not list"):
        Delaunay.from_dataframe([1, 2])
