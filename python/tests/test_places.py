"""What a triangulation tells of places, against 340 digits and rationals."""
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
import scipy.sparse
import scipy.spatial
import many_digits as exact
from nodes import in_cap, random_nodes
from pstripack import Delaunay, to_xyz


def grid(step):
    lon, lat = np.meshgrid(np.arange(0, 360, step), np.arange(step - 90, 90, step))
    return np.vstack([to_xyz(lon.ravel(), lat.ravel()), [[0, 0, 1], [0, 0, -1]]])


def tight(scale):
    """A few nodes near each other among others."""
    near = [[1, 0, 0], [1, scale, 0], [1, 0, scale], [1, -scale, -2 * scale], [1, scale, 3 * scale]]
    return np.vstack([near, random_nodes(30, 4)])


SETS = {
    "random": random_nodes(80) * np.random.default_rng(5).uniform(0.1, 10, (80, 1)),
    "octahedron": np.vstack([np.eye(3), -np.eye(3)]),
    "cube": np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)]),
    "grid": grid(30),
    "cap": in_cap(60),
    "hemisphere": np.vstack([to_xyz(np.arange(0, 360, 15), np.full(24, 1e-9)), in_cap(30, 2, 0)]),
    "small_cap": in_cap(40) * [1e-6, 1e-6, 1],
    "three": to_xyz([0, 170, 200], [0, 5, -5]),
    "tight": tight(1e-20),
    "tighter": tight(1e-150),
}


def places_for(points):
    centres = Delaunay(points).circumcenters
    return np.vstack([points[:12], -points[:12], centres[:12], -centres[:12], 2 * points[:6] + points[::-1][:6], np.eye(3),
                      [[1, 1, 1], [1, 1, 0]], np.random.default_rng(3).normal(size=(20, 3))])


def by_distance(points, place):
    """The nodes by their exact distances, equally near ones by their numbers."""
    def cosine(p):  # times |place|, and its square with its sign
        d = sum(Fraction(float(a)) * Fraction(float(b)) for a, b in zip(p, place))
        return abs(d) * d / sum(Fraction(float(a)) ** 2 for a in p)
    cosines = [cosine(p) for p in points]
    return sorted(range(len(points)), key=lambda i: (-cosines[i], i))


@pytest.mark.parametrize("name", SETS)
class TestNearest:
    def test_order_is_exact(self, name):
        points = SETS[name]
        mesh, places = Delaunay(points), places_for(points)
        expected = np.array([by_distance(points, place) for place in places])
        assert np.array_equal(mesh.nearest(places), expected[:, 0])
        for k in 2, min(7, len(points)), len(points):
            assert np.array_equal(mesh.nearest(places, k), expected[:, :k])
        for place, order in zip(places, expected):  # the same alone as among others
            assert mesh.nearest(place) == order[0]

    def test_distances_are_right_relative_to_themselves(self, name):
        points = SETS[name]
        mesh, places = Delaunay(points), places_for(points)
        distances, nodes = mesh.nearest(places, len(points), distance=True)
        one, first = mesh.nearest(places, distance=True)
        assert np.array_equal(one, distances[:, 0]) and np.array_equal(first, nodes[:, 0])
        directions = [exact.direction(p) for p in points]
        for i, place in enumerate(map(exact.direction, places)):
            for k in {0, 1, len(points) // 2, len(points) - 1}:
                angle = exact.angle(place, directions[nodes[i, k]])
                assert abs(float(distances[i, k] - angle)) <= 1e-15 * float(angle) + (4e-16 if angle > 3 else 0)

    def test_all_nodes_within_a_radius(self, name):
        points = SETS[name]
        mesh, places = Delaunay(points), places_for(points)
        distances, nodes = mesh.nearest(places, len(points), distance=True)
        for radius in (0, 1e-160, 3e-20, 0.3, 1.5, np.pi / 2, 2.0, 3.1, np.pi, *distances[3, :5]):
            found, indptr, indices = mesh.nearest(places, radius=radius, distance=True)
            for i in range(len(places)):
                inside = distances[i] <= radius
                assert np.array_equal(indices[indptr[i]:indptr[i + 1]], nodes[i, inside])
                assert np.array_equal(found[indptr[i]:indptr[i + 1]], distances[i, inside])


def test_many_nodes_and_threads():
    points, places = random_nodes(5000), random_nodes(8000, 2)
    mesh = Delaunay(points)
    tree = scipy.spatial.cKDTree(points)
    chords, nodes = tree.query(places, 6)
    distances, found = mesh.nearest(places, 6, distance=True)
    assert np.array_equal(found, nodes) and distances == pytest.approx(2 * np.arcsin(chords / 2), rel=1e-12)
    assert np.all(mesh.nearest(points, distance=True)[0] == 0)  # at once
    indptr, indices = mesh.nearest(places, radius=0.04)
    for i, ball in enumerate(tree.query_ball_point(places[:300], 2 * np.sin(0.02))):
        assert sorted(ball) == sorted(indices[indptr[i]:indptr[i + 1]].tolist())
    alone = [mesh.nearest(places, 6, threads=1), *mesh.nearest(places, radius=0.04, threads=1),
             mesh.weights(places, "natural", threads=1).data]
    for one, other in zip(alone, [found, indptr, indices, mesh.weights(places, "natural", threads=3).data]):
        assert np.array_equal(one, other)


class TestWeights:
    points = random_nodes(300)
    mesh, cap = Delaunay(points), Delaunay(in_cap(60))
    places = np.random.default_rng(9).normal(size=(400, 3))

    @pytest.mark.parametrize("name", SETS)
    def test_barycentric_coordinates(self, name):
        points = SETS[name]
        mesh = Delaunay(points)
        corners = points[mesh.simplices[:20]] / np.linalg.norm(points[mesh.simplices[:20]], axis=2)[..., np.newaxis]
        mix = np.random.default_rng(1).dirichlet([1, 1, 1], len(corners))
        places = np.vstack([np.einsum("tk,tkx->tx", mix, corners), corners[:, 0] + corners[:, 1], points[:20]])
        simplex, coordinates = mesh.barycentric(places)
        assert np.array_equal(simplex, mesh.find_simplex(places))
        on = simplex >= 0
        has_border = len(mesh.hull_polygon) > 0  # on it, rounding may be as large as 4e-16 over the size of a triangle
        assert np.count_nonzero(on) > 0.6 * len(places) and np.all(np.isnan(coordinates[~on]))
        assert np.all(coordinates[on] >= 0) and np.abs(coordinates[on].sum(axis=1) - 1).max() <= 4e-16
        for place, t, found in zip(places[on], simplex[on], coordinates[on]):
            p, a, b, c = map(exact.direction, [place, *points[mesh.simplices[t]]])
            parts = [exact.det(p, b, c), exact.det(a, p, c), exact.det(a, b, p)]
            for one, part in zip(found, parts):
                assert abs(float(one - part / sum(parts))) <= 1e-13 * one + (1e-9 if has_border else 1e-24)
        of_nodes, at_nodes = mesh.barycentric(points)
        assert np.all(np.sort(at_nodes, axis=1) == [0, 0, 1])
        assert np.array_equal(mesh.simplices[of_nodes][at_nodes == 1], np.arange(len(points)))

    def test_a_place_on_an_arc_has_the_weights_of_its_ends(self):
        mesh = Delaunay(np.vstack([np.eye(3), -np.eye(3)]))
        simplex, coordinates = mesh.barycentric([[3, 1, 0], [0, 1, -1]])
        assert mesh.simplices[simplex].tolist() == [[0, 1, 2], [0, 5, 1]] and coordinates.tolist() == [[0.75, 0.25, 0], [0, 0.5, 0.5]]
        assert (mesh.weights([[3, 1, 0]]).toarray() == [[0.75, 0.25, 0, 0, 0, 0]]).all()

    def test_linear_functions_on_the_planes_of_triangles(self):
        """The weights give the point where the ray to the place meets the plane of its triangle."""
        simplex, coordinates = self.mesh.barycentric(self.places)
        met = self.mesh.weights(self.places) @ self.points
        assert np.einsum("pk,pkx->px", coordinates, self.points[self.mesh.simplices[simplex]]) == pytest.approx(met, abs=1e-15)
        unit = self.places / np.linalg.norm(self.places, axis=1)[:, np.newaxis]
        assert met / np.linalg.norm(met, axis=1)[:, np.newaxis] == pytest.approx(unit, abs=1e-14)

    @pytest.mark.parametrize("method", ["linear", "natural", "cubic"])
    def test_the_product_with_values_is_the_interpolated_value(self, method):
        values = np.random.default_rng(1).normal(size=(300, 2))
        matrix = self.mesh.weights(self.places.reshape(20, 20, 3), method)
        assert isinstance(matrix, scipy.sparse.csr_matrix) and matrix.shape == (400, 300) and matrix.has_sorted_indices == (method == "cubic")
        assert (method == "cubic" or matrix.data.min() > 0) and np.abs(matrix.sum(axis=1) - 1).max() <= 4e-15
        assert matrix @ values == pytest.approx(self.mesh.interpolate(values, self.places, method), abs=4e-15)
        at_nodes = self.mesh.weights(self.points, method)
        assert (at_nodes != scipy.sparse.identity(300)).nnz == 0

    @pytest.mark.parametrize("method", ["linear", "natural", "cubic"])
    def test_rows_of_places_outside(self, method):
        outside = self.cap.find_simplex(self.places) < 0
        matrix = self.cap.weights(self.places, method)
        assert 0 < np.count_nonzero(outside) < 400 and np.array_equal(np.diff(matrix.indptr) == 0, outside)
        values = np.random.default_rng(1).normal(size=60)
        filled = self.cap.weights(self.places, method, outside="nearest")
        expected = self.cap.interpolate(values, self.places, method, outside="nearest")
        assert filled @ values == pytest.approx(expected, abs=1e-13)
        assert np.abs(filled.sum(axis=1) - 1).max() <= 1e-14
        nan = self.cap.weights(self.places, method, outside="nan") @ values
        assert np.array_equal(np.isnan(nan), outside) and nan[~outside] == pytest.approx(expected[~outside], abs=1e-13)

    def test_wrong_arguments(self):
        for options, message in (({"method": "nearest"}, "'natural' or 'cubic', not 'nearest'"),
                                 ({"outside": "zero"}, "'empty', 'nearest' or 'nan', not 'zero'")):
            with pytest.raises(ValueError, match=message):
                self.mesh.weights(self.places, **options)


CALLS = {
    "find_simplex": lambda mesh, *xi, **places: mesh.find_simplex(*xi, **places),
    "barycentric": lambda mesh, *xi, **places: mesh.barycentric(*xi, **places)[1],
    "nearest": lambda mesh, *xi, **places: mesh.nearest(*xi, **places),
    "three nearest": lambda mesh, *xi, **places: mesh.nearest(*xi, k=3, distance=True, **places)[0],
    "within": lambda mesh, *xi, **places: mesh.nearest(*xi, radius=0.2, **places)[1],
    "weights": lambda mesh, *xi, **places: mesh.weights(*xi, **places).toarray(),
    "natural weights": lambda mesh, *xi, **places: mesh.weights(*xi, method="natural", **places).toarray(),
    **{"interpolate " + method: lambda mesh, *xi, method=method, **places: mesh.interpolate(1 + np.arange(mesh.npoints), *xi,
                                                                                           method=method, **places)
       for method in ("linear", "cubic", "nearest")},
}


@pytest.mark.parametrize("name", CALLS)
class TestPlacesByLongitudeAndLatitude:
    lon, lat = np.linspace(-180, 355, 6), np.linspace(-90, 80, 4)[:, np.newaxis]
    mesh = Delaunay(random_nodes(200))

    def test_are_those_of_their_vectors(self, name):
        call = CALLS[name]
        expected = call(self.mesh, to_xyz(self.lon, self.lat))
        assert np.array_equal(call(self.mesh, lon=self.lon, lat=self.lat), expected)
        in_radians = call(self.mesh, lon=np.radians(self.lon), lat=np.radians(self.lat), units="radians")
        assert in_radians.shape == expected.shape and in_radians == pytest.approx(expected, abs=1e-9)

    def test_units_are_those_of_the_nodes_or_certain(self, name):
        call = CALLS[name]
        small = {"lon": [1, 2], "lat": [0.5, 1]}
        with pytest.raises(ValueError, match="may be degrees or radians: say units="):
            call(self.mesh, **small)
        for units in "degrees", "radians":
            nodes = self.lon[:-1] % 360, np.linspace(-80, 80, 5)
            mesh = Delaunay.from_lonlat(*(nodes if units == "degrees" else map(np.radians, nodes)), units=units)
            expected = call(mesh, to_xyz(small["lon"], small["lat"], units == "degrees"))
            assert np.array_equal(call(mesh, **small), expected, equal_nan=expected.dtype.kind == "f")
        with pytest.raises(ValueError, match=r"latitude 91 of place 1 \(counted from 0\) is beyond the pole"):
            call(self.mesh, lon=[0, 1], lat=[0, 91])

    def test_vectors_and_angles_do_not_mix(self, name):
        call = CALLS[name]
        for wrong in {"lon": 1}, {"lat": 1}, {}:
            with pytest.raises(TypeError, match="give vectors, or lon and lat"):
                call(self.mesh, **wrong)
        for wrong in {"lon": [1]}, {"lat": [1]}, {"units": "degrees"}:
            with pytest.raises(TypeError, match="not both"):
                call(self.mesh, np.eye(3), **wrong)
        with pytest.raises(ValueError, match="masked"):
            call(self.mesh, lon=np.ma.masked_equal([1, 90], 1), lat=[1, 2])

    def test_a_place_without_direction_is_named(self, name):
        """Where there would be no other sign of it; find_simplex has -1 and interpolate NaN."""
        call = CALLS[name]
        places = [[1, 0, 0], [0, np.nan, 0], [0, 0, 0]]
        if name == "find_simplex" or name.startswith("interpolate"):
            found = call(self.mesh, places)
            assert found[0] > 0 and np.all(np.isnan(found[1:]) if name != "find_simplex" else found[1:] == -1)
            return
        for wrong, message in ((places, r"place 1 \(counted from 0\) is \(0, nan, 0\): it has no direction"),
                               ([places[:2]], r"place \(0, 1\) \(counted from 0\) is"), (places[2], r"the place .* is \(0, 0, 0\)")):
            with pytest.raises(ValueError, match=message):
                call(self.mesh, wrong)
        with pytest.raises(ValueError, match=r"place 2 \(counted from 0\) is at longitude 12, latitude nan"):
            call(self.mesh, lon=[10, 11, 12], lat=[5, 6, np.nan])


def test_one_place_has_numbers_as_of_a_tree():
    mesh = Delaunay(random_nodes(20))
    distance, node = mesh.nearest([1, 0, 0], distance=True)
    found = distance, node, mesh.nearest([1, 0, 0]), mesh.find_simplex([1, 0, 0]), mesh.barycentric([1, 0, 0])[0]
    assert all(np.isscalar(number) for number in found) and node == found[2]
    for method in "linear", "natural", "cubic", "nearest":
        assert np.isscalar(mesh.interpolate(np.arange(20.0), [1, 0, 0], method))


def test_ctrl_c_ends_a_long_search():
    program = """if True:
        import os, signal, threading, time
        import numpy as np
        from pstripack import Delaunay
        mesh = Delaunay(np.random.default_rng(1).normal(size=(20000, 3)))
        places = np.random.default_rng(2).normal(size=(300000, 3))
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        try:
            mesh.nearest(places, 200)
        except KeyboardInterrupt:
            print("ended", mesh.nearest([1, 0, 0]) >= 0, time.monotonic() - begin < 30)"""
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=250)
    assert run.stdout == "ended True True\n", run


def test_numbers_of_nodes_and_radii_that_are_wrong():
    mesh = Delaunay(random_nodes(20))
    with pytest.raises(ValueError, match="radius is 500, more than pi: it is in radians"):
        mesh.nearest([1, 0, 0], radius=500)
    with pytest.raises(ValueError, match="threshold is 5, more than pi"):
        Delaunay(random_nodes(20), threshold=5)
    with pytest.raises(ValueError, match="longitudes and latitudes are passed as lon=, lat="):
        mesh.nearest(9.5, 46.9)
    for k in 0, 21, -1:
        with pytest.raises(ValueError, match="k must be from 1 to 20"):
            mesh.nearest([1, 0, 0], k)
    with pytest.raises(ValueError, match="k must be a whole number, not 1.5"):
        mesh.nearest([1, 0, 0], 1.5)
    for radius in -1, np.nan:
        with pytest.raises(ValueError, match="radius must be at least 0, in radians"):
            mesh.nearest([1, 0, 0], radius=radius)
    with pytest.raises(ValueError, match="k or radius"):
        mesh.nearest([1, 0, 0], 2, radius=1)
    for places in np.empty((0, 3)), np.empty((0, 4, 3)):
        assert mesh.nearest(places, 2).shape == places.shape[:-1] + (2,) and mesh.weights(places).shape == (0, 20)
        assert [len(part) for part in mesh.nearest(places, radius=1)] == [1, 0]
