"""What a triangulation measures, against 340 digits."""
import copy
import pickle

import many_digits as exact
import mpmath
import numpy as np
import pytest
import scipy.spatial
from many_digits import direction, relative_error
from nodes import in_cap, random_nodes
from pstripack import CoincidentNodesError, Delaunay, SphericalVoronoi, to_lonlat, to_xyz


def nest(scale):
    return np.vstack([[[1, 0, 0], [1, scale, 0], [1, 0, scale], [1, -scale, -2 * scale]], random_nodes(20, 4)])


SETS = {
    "random": random_nodes(60) * np.random.default_rng(5).uniform(0.1, 10, (60, 1)),
    "octahedron": np.vstack([np.eye(3), -np.eye(3)]),
    "cap": in_cap(40),
    "small_cap": in_cap(30) * [1e-7, 1e-7, 1],
    "cluster": np.vstack([in_cap(30) * [1e-7, 1e-7, 1], random_nodes(30)]),
    "needles": np.vstack([to_xyz(np.linspace(0, 1e-3, 20), np.zeros(20)), random_nodes(30)]),
    "three": to_xyz([0, 120, 240], [5, 5, 5]),
    "nearly_a_great_circle": np.vstack([to_xyz(np.arange(0, 360, 30), np.full(12, 1e-10)), [[0, 0, 1]]]),
    "nearly_opposite": np.array([[1, 0, 0], [-1, 1e-9, 1e-12], [0, 0, 1], [0.3, -1, 0.2]]),
    "stations": to_xyz([5.97, 18.7, 1.23, -6.69, 28.79], [52.35, 54.69, 52.73, 49.79, 39.55]),
    "four_in_a_town": to_xyz([8.5, 8.501, 8.5, 8.5013], [47.3, 47.3, 47.301, 47.3012]),
    "near_copies": np.vstack([random_nodes(20), random_nodes(20)[:3] + [[1e-10, 0, 0], [0, 4e-16, 0], [0, 0, 3e-13]]]),
    "nest": nest(1e-20),
    "deep_nest": nest(1e-150),
}
SOME = 60


@pytest.mark.parametrize("name", SETS)
class TestLengthsAndCentres:
    def test_each_edge_is_there_once(self, name):
        mesh = Delaunay(SETS[name])
        sides = np.sort(mesh.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        assert np.array_equal(np.unique(sides, axis=0), np.unique(mesh.edges, axis=0))
        assert len(mesh.edges) == len(np.unique(mesh.edges, axis=0)) == mesh.npoints + mesh.nsimplex - (1 if len(mesh.hull_polygon) else 2)
        assert mesh.edges.dtype == np.int32 and np.all(np.diff(mesh.edges[:, 0]) >= 0) and np.all(np.diff(mesh.edges) > 0)

    def test_edges(self, name):
        mesh = Delaunay(SETS[name])
        for (a, b), length, middle in list(zip(mesh.edges, mesh.edge_lengths, mesh.edge_midpoints))[:SOME]:
            p, q = direction(mesh.points[a]), direction(mesh.points[b])
            assert relative_error(length, exact.angle(p, q)) <= 1e-15
            assert exact.norm(exact.minus(exact.exactly(middle), exact.unit(exact.plus(p, q)))) <= 4e-16

    def test_circumradii(self, name):
        mesh = Delaunay(SETS[name])
        for t in range(min(SOME, mesh.nsimplex)):
            a, b, c = map(direction, mesh.points[mesh.simplices[t]])
            centre = exact.unit(exact.cross(exact.minus(b, a), exact.minus(c, a)))
            radius = exact.angle(a, centre)
            assert relative_error(mesh.circumradii[t], radius) <= (1e-15 if radius < 1 else 7e-15) and mesh.circumradii[t] <= np.pi / 2

    def test_cell_centroids(self, name):
        """The integral of the position over a cell is the sum, over its sides, of half the length times the normal."""
        mesh = Delaunay(SETS[name])
        vertices, begin, corners = mesh._mesh.cells(1)
        nodes_of = np.repeat(np.arange(mesh.npoints), np.diff(begin))[np.argsort(corners, kind="stable")].reshape(-1, 3)
        at = list(map(direction, mesh.points))

        def vertex(v):
            a, b, c = (at[i] for i in nodes_of[v])
            normal = exact.unit(exact.cross(exact.minus(b, a), exact.minus(c, a)))
            return normal if exact.dot(normal, exact.exactly(vertices[v])) > 0 else exact.times(-1, normal)

        assert np.abs(np.linalg.norm(mesh.cell_centroids, axis=1) - 1).max() <= 4e-16
        for k in range(min(40, mesh.npoints)):
            ring = corners[begin[k]:begin[k + 1]]
            integral, length = (0, 0, 0), 0
            for v, w in zip(ring, np.roll(ring, -1)):
                p, q = vertex(v), vertex(w)
                beyond = sorted(set(nodes_of[v]) & set(nodes_of[w]) - {k})
                if len(ring) == 2:  # a lune: both sides are half circles
                    sides = [(mpmath.pi, exact.unit(exact.minus(at[k], at[beyond[0 if v == ring[0] else 1]])))]
                else:
                    normals = [exact.unit(exact.minus(at[k], at[n])) for n in beyond]
                    turns = [mpmath.atan2(exact.det(normal, p, q), exact.dot(p, q)) for normal in normals]
                    sides = [min((turn if turn > -1e-50 else turn + 2 * mpmath.pi, normal) for turn, normal in zip(turns, normals))]
                length += float(sides[0][0]) / 2  # half of the perimeter
                integral = exact.plus(integral, exact.times(sides[0][0] / 2, sides[0][1]))
            error = exact.norm(exact.minus(exact.unit(integral), exact.exactly(mesh.cell_centroids[k])))
            assert error <= 1e-15 * max(1, length**2 / mesh.cell_areas[k])


class TestGradient:
    mesh = Delaunay(random_nodes(4000))

    @staticmethod
    def tangential(vectors, points):
        return vectors - np.einsum("...x,...x->...", vectors, points)[..., np.newaxis] * points

    def test_of_a_linear_function(self):
        """With the slope c it is the part of c in the tangent plane; the error is of the third order in the distances."""
        slope = np.array([1.0, -2, 3])
        for mesh, most in ((Delaunay(random_nodes(400)), 0.06), (self.mesh, 2e-3), (Delaunay(random_nodes(40000)), 6e-5)):
            found = mesh.gradient(mesh.points @ slope)
            assert np.abs(np.einsum("ix,ix->i", found, mesh.points)).max() < 1e-14
            assert np.abs(found - self.tangential(slope, mesh.points)).max() < most
        small = Delaunay(in_cap(300) * [1e-6, 1e-6, 1])
        unit = small.points / np.linalg.norm(small.points, axis=1)[:, np.newaxis]
        assert small.gradient(unit[:, 0]) == pytest.approx(self.tangential(np.eye(3)[0], unit), abs=1e-9)
        assert np.all(self.mesh.gradient(np.full(4000, 7.5)) == 0)

    def test_of_a_quadratic_function(self):
        x, y, z = self.mesh.points.T
        expected = self.tangential(np.stack([y * z, x * z, x * y], axis=1), self.mesh.points)
        assert np.abs(self.mesh.gradient(x * y * z) - expected).max() < 0.02

    def test_east_and_north(self):
        mesh = Delaunay(np.vstack([random_nodes(4000), [[0, 0, 1], [0, 0, -1]]]))
        lon, lat = to_lonlat(mesh.points, degrees=False)
        east, north = mesh.gradient_lonlat(np.cos(lat) * np.sin(lon))
        assert np.abs(east - np.cos(lon)).max() < 2e-3 and np.abs(north + np.sin(lat) * np.sin(lon)).max() < 2e-3
        for scale in 1e-200, 1e200:  # whose squares are not doubles
            of_vectors = Delaunay(mesh.points * scale).gradient_lonlat(np.cos(lat) * np.sin(lon))
            assert np.abs(of_vectors[0] - east).max() < 1e-12 and np.abs(of_vectors[1] - north).max() < 1e-12
        slope = mesh.gradient(mesh.points[:, 1])
        assert np.hypot(east, north) == pytest.approx(np.linalg.norm(slope, axis=1), rel=1e-12)

    def test_of_nodes_on_a_line_is_along_it(self):
        """They tell no more, as along a section or a track."""
        lat = np.arange(-20.0, 61, 5)
        for lon in 30 + 1e-7 * (np.arange(17)**2 % 5), np.full(17, 30.0), 1e-9 * (np.arange(17) % 3):
            east, north = Delaunay.from_lonlat(lon, lat).gradient_lonlat(28 - 0.3 * lat)
            assert np.radians(north) == pytest.approx(np.full(17, -0.3), rel=1e-5) and np.abs(east).max() < 1e-4

    def test_several_values_and_missing_ones(self):
        values = np.random.default_rng(1).normal(size=(4000, 2, 2))
        slopes = self.mesh.gradient(values)
        east, north = self.mesh.gradient_lonlat(values)
        assert slopes.shape == (4000, 2, 2, 3) and east.shape == north.shape == values.shape
        for i in range(2):
            for j in range(2):
                assert np.array_equal(slopes[:, i, j], self.mesh.gradient(values[:, i, j]))
                assert np.array_equal(east[:, i, j], self.mesh.gradient_lonlat(values[:, i, j])[0])
        values[17] = np.nan
        assert 0 < np.isnan(self.mesh.gradient(values[:, 0, 0])).any(axis=1).sum() < 60
        for wrong in np.zeros(3999), 3.0, np.zeros((2, 4000)):
            with pytest.raises(ValueError, match="values must be one for each of 4000 nodes"):
                self.mesh.gradient(wrong)
        with pytest.raises(TypeError, match="complex"):
            self.mesh.gradient(np.zeros(4000, complex))


MEASURES = ("edges", "edge_lengths", "edge_midpoints", "circumcenters", "circumradii", "areas", "cell_areas", "cell_centroids")


@pytest.mark.parametrize("name", MEASURES)
def test_measures_are_computed_once_and_protected(name):
    mesh = Delaunay(random_nodes(200), threads=2)
    array = getattr(mesh, name)
    assert getattr(mesh, name) is array
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 0
    for other in copy.copy(mesh), pickle.loads(pickle.dumps(mesh)):
        assert np.array_equal(getattr(other, name), array) and not getattr(other, name).flags.writeable


def test_measures_on_any_number_of_threads_are_the_same():
    points = random_nodes(25000)
    one, three = Delaunay(points, threads=1), Delaunay(points, threads=3)
    for name in MEASURES:
        assert np.array_equal(getattr(one, name), getattr(three, name))
    assert np.array_equal(one.gradient(points[:, 0]), three.gradient(points[:, 0]))


def test_the_hull_polygon_is_the_arcs_of_the_hull():
    mesh = Delaunay(in_cap(200))
    assert np.array_equal(mesh.hull_polygon, mesh.convex_hull[:, 0]) and len(mesh.hull_polygon) > 3
    assert len(Delaunay(random_nodes(50)).hull_polygon) == 0


def test_near_duplicates_are_refused_by_every_constructor():
    lon, lat = np.array([0, 90, 180, 270, 0, 0, 10]), np.array([0, 0, 0, 0, 90, -90, 1e-9])
    lon[6] = 0
    angle = np.radians(1e-9)
    xyz = to_xyz(lon, lat)
    makers = (lambda threshold: Delaunay(xyz, threshold=threshold), lambda threshold: Delaunay.from_lonlat(lon, lat, threshold=threshold),
              lambda threshold: Delaunay.from_lonlat(np.radians(lon), np.radians(lat), units="radians", threshold=threshold),
              lambda threshold: SphericalVoronoi(xyz, threshold=threshold), lambda threshold: SphericalVoronoi(3 * xyz, 3, threshold=threshold))
    for make in makers:
        with pytest.raises(CoincidentNodesError) as caught:
            make(1.01 * angle)
        assert caught.value.nodes == (0, 6)
        make(0.99 * angle)


@pytest.mark.parametrize("points", [random_nodes(100), in_cap(100)], ids=["sphere", "cap"])
def test_the_simplices_of_a_diagram_are_scipy_s(points):
    ours, theirs = SphericalVoronoi(points), scipy.spatial.SphericalVoronoi(points)
    assert {frozenset(t) for t in ours._simplices.tolist()} == {frozenset(t) for t in theirs._simplices.tolist()}
    corners = points[ours._simplices]
    for vertex, triangle in zip(ours.vertices, corners):
        assert triangle @ vertex == pytest.approx(np.full(3, triangle[0] @ vertex), abs=1e-12)
    with pytest.raises(ValueError, match=r"shape \(n, 3\)"):
        SphericalVoronoi(points[:, :2])
