import numpy as np
import pytest
import scipy.spatial
from nodes import as_sets, defect, in_cap, random_nodes, trmesh
from pstripack import CoincidentNodesError, Delaunay, to_lonlat, to_xyz


def outward_facets(points):
    """The facets of the convex hull that have the centre of the sphere below them."""
    hull = scipy.spatial.ConvexHull(points)
    return hull.simplices[hull.equations[:, 3] < 0]


@pytest.mark.parametrize("points", [random_nodes(2000), in_cap(500), random_nodes(4, 3)],
                         ids=["sphere", "cap", "four"])
class TestTriangles:
    def test_are_those_of_the_convex_hull(self, points):
        mesh = Delaunay(points)
        assert as_sets(mesh.simplices) == as_sets(outward_facets(points))
        assert mesh.simplices.dtype == np.int32 and mesh.nsimplex == len(mesh.simplices)

    def test_are_counterclockwise_with_the_smallest_corner_first(self, points):
        simplices = Delaunay(points).simplices
        assert np.all(np.linalg.det(points[simplices]) > 0)
        assert np.all(simplices[:, 0] == simplices.min(axis=1))

    def test_neighbors_share_the_side_opposite_each_corner(self, points):
        mesh = Delaunay(points)
        sides = {}
        for t, corners in enumerate(mesh.simplices.tolist()):
            for k in range(3):
                sides[corners[(k + 1) % 3], corners[(k + 2) % 3]] = t
        for corners, beyond in zip(mesh.simplices.tolist(), mesh.neighbors.tolist()):
            for k in range(3):
                assert beyond[k] == sides.get((corners[(k + 2) % 3], corners[(k + 1) % 3]), -1)

    def test_vertex_neighbor_vertices_are_round_each_node(self, points):
        mesh = Delaunay(points)
        indptr, indices = mesh.vertex_neighbor_vertices
        triangles = {tuple(t) for t in mesh.simplices.tolist()}
        on_boundary = set(mesh.convex_hull.ravel().tolist())
        found = set()
        for k in range(mesh.npoints):
            ring = indices[indptr[k]:indptr[k + 1]].tolist()
            pairs = list(zip(ring, ring[1:] + ring[:1]))
            if k in on_boundary:
                pairs.pop()
            for pair in pairs:
                corners = (k, *pair)
                least = corners.index(min(corners))
                found.add(corners[least:] + corners[:least])
        assert found == triangles

    def test_boundary_arcs_are_the_sides_of_one_triangle_only(self, points):
        mesh = Delaunay(points)
        rows, sides = np.nonzero(mesh.neighbors == -1)
        expected = {(mesh.simplices[t, (k + 1) % 3], mesh.simplices[t, (k + 2) % 3]) for t, k in zip(rows, sides)}
        arcs = mesh.convex_hull
        assert {tuple(arc) for arc in arcs.tolist()} == expected and len(arcs) == len(expected)
        assert np.array_equal(arcs[:, 1], np.roll(arcs[:, 0], -1))

    def test_each_node_is_a_corner_of_its_triangle(self, points):
        mesh = Delaunay(points)
        of_node = mesh.simplices[mesh.vertex_to_simplex]
        assert np.all((of_node == np.arange(len(points))[:, np.newaxis]).any(axis=1))

    def test_circumcenters_are_as_far_from_all_corners(self, points):
        mesh = Delaunay(points)
        centers = mesh.circumcenters
        assert np.allclose(np.linalg.norm(centers, axis=1), 1, atol=1e-15)
        cosines = np.einsum("tkx,tx->tk", points[mesh.simplices], centers)
        assert np.allclose(cosines, cosines[:, :1], atol=1e-12)

    def test_lists_are_the_library_s_bit_by_bit(self, points):
        mesh = Delaunay(points)
        for ours, theirs in zip(mesh.lists, trmesh(points)):
            assert np.array_equal(ours, theirs)


def test_areas_add_up_to_the_sphere_s():
    points = random_nodes(3000)
    mesh = Delaunay(points)
    assert mesh.areas.sum() == pytest.approx(4 * np.pi, rel=1e-13)
    assert mesh.cell_areas.sum() == pytest.approx(4 * np.pi, rel=1e-13)
    octants = Delaunay(np.vstack([np.eye(3), -np.eye(3)]))
    assert octants.areas == pytest.approx(np.full(8, np.pi / 2), rel=1e-15)
    assert octants.cell_areas == pytest.approx(np.full(6, 2 * np.pi / 3), rel=1e-15)


def shrunk(points, scale):
    """Nodes with z > 0, moved towards the pole."""
    near = points * [scale, scale, 1]
    return near / np.linalg.norm(near, axis=1)[:, np.newaxis]


@pytest.mark.parametrize("points", [
    in_cap(300), in_cap(3), shrunk(in_cap(300), 1e-3), shrunk(in_cap(300), 1e-5),
    to_xyz([0, 1, 3], [0, 0.1, 0]), to_xyz([0, 1, 3, 2], [0, 0.1, 0, -0.1]),
    to_xyz([0, 120, 240], [80, 80, 80]), to_xyz(np.arange(0, 360, 15), np.full(24, 60)),
    to_xyz([0, 90, 0], [0, 0, 90])], ids=["cap", "three", "small_cap", "tiny_cap",
                                                            "obtuse", "flat", "symmetric_three", "small_circle", "octant"])
def test_cells_of_nodes_in_a_hemisphere_cover_the_sphere(points):
    areas = Delaunay(points).cell_areas
    assert areas.sum() == pytest.approx(4 * np.pi, rel=1e-9) and areas.min() > 0


def test_cells_of_nodes_on_a_small_circle_are_lunes():
    lon = np.array([0, 10, 40, 90, 200.0])
    gaps = (np.roll(lon, -1) - lon) % 360
    areas = Delaunay.from_lonlat(lon, np.full(5, 70.0)).cell_areas
    assert areas == pytest.approx(np.radians((gaps + np.roll(gaps, 1)) / 2) * 2, rel=1e-10)


LAYOUTS = {
    "c": lambda x: x,
    "fortran": np.asfortranarray,
    "every_second": lambda x: np.repeat(x, 2, axis=0)[::2],
    "backwards": lambda x: np.ascontiguousarray(x[::-1])[::-1],
    "wide": lambda x: np.hstack([x, x])[:, :3],
    "columns_backwards": lambda x: np.ascontiguousarray(x[:, ::-1])[:, ::-1],
    "big_endian": lambda x: x.astype(">f8"),
    "lists": lambda x: x.tolist(),
    "unaligned": lambda x: np.frombuffer(b"1" + x.tobytes(), np.uint8)[1:].view(np.float64).reshape(-1, 3),
}


@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_gives_the_same_triangulation(layout):
    points = random_nodes(300)
    given = LAYOUTS[layout](points)
    mesh = Delaunay(given)
    assert np.array_equal(mesh.simplices, Delaunay(points.copy()).simplices)
    assert np.array_equal(mesh.points, points)


def test_nodes_in_single_precision_are_those_numbers():
    points = random_nodes(500).astype(np.float32)
    assert np.array_equal(Delaunay(points).lists[0], trmesh(points.astype(np.float64))[0])


def test_only_directions_count():
    points = random_nodes(500)
    lengths = np.random.default_rng(5).uniform(0.1, 1e3, size=(500, 1))
    mesh = Delaunay(points * lengths)
    unit = Delaunay(points)
    assert as_sets(mesh.simplices) == as_sets(unit.simplices)
    # Triangle by triangle: by PSTRIPACK_ORDER=original unit vectors have the original's order of LIST, others cannot.
    areas = [{frozenset(t): area for t, area in zip(m.simplices.tolist(), m.areas)} for m in (mesh, unit)]
    assert areas[0] == pytest.approx(areas[1], rel=1e-9)
    assert mesh.cell_areas == pytest.approx(unit.cell_areas, rel=1e-9)


@pytest.mark.parametrize("front", [[[1, 0, 0], [0, 1, 0], [-1, 0, 0]], [[1, 0, 0], [0.6, 0.8, 0], [0, 1, 0]],
                                   [[0, 0, 1], [0, 0, -1], [1, 0, 0]]], ids=["equator", "arc", "poles"])
@pytest.mark.parametrize("rest", [random_nodes(200), in_cap(200)], ids=["sphere", "cap"])
def test_the_first_three_nodes_may_lie_on_one_great_circle(front, rest):
    points = np.vstack([front, rest])
    mesh = Delaunay(points)
    assert defect(points, mesh.lists) == ""
    list_, lptr, lend, lnew = mesh.lists
    assert lnew == lend[-1] + 1  # canonical: the lists of the nodes follow each other
    begin = np.concatenate([[0], lend[:-1]])
    for first, last in zip(begin, lend):
        ring = list_[first:last]
        assert np.array_equal(lptr[first:last], [*range(first + 2, last + 1), first + 1])
        assert ring[-1] < 0 or ring[0] == ring.min()
    order = np.roll(np.arange(len(points)), -3)  # other nodes in front
    other = Delaunay(points[order])
    assert as_sets(mesh.simplices) == as_sets(order[other.simplices])


class TestPlaces:
    points = random_nodes(1000)
    mesh = Delaunay(points)
    cap_points = in_cap(300)
    cap = Delaunay(cap_points)
    places = np.random.default_rng(9).normal(size=(3000, 3))

    @staticmethod
    def contains(mesh, places, simplices):
        corners = mesh.points[mesh.simplices[simplices]]
        sides = [np.einsum("px,px->p", np.cross(corners[:, k], corners[:, (k + 1) % 3]), places) for k in range(3)]
        return np.min(sides, axis=0) > -1e-11

    def test_find_simplex_finds_the_triangle_that_contains_a_place(self):
        found = self.mesh.find_simplex(self.places)
        assert found.shape == (3000,) and found.min() >= 0
        assert np.all(self.contains(self.mesh, self.places, found))

    def test_find_simplex_is_minus_one_outside_only(self):
        found = self.cap.find_simplex(self.places)
        inside = found >= 0
        assert 0 < np.count_nonzero(inside) < 3000
        assert np.all(self.contains(self.cap, self.places[inside], found[inside]))
        corners = self.cap_points[self.cap.simplices]
        for place in self.places[~inside]:
            sides = [np.cross(corners[:, k], corners[:, (k + 1) % 3]) @ place for k in range(3)]
            assert np.min(sides, axis=0).max() < 0

    def test_nodes_are_found_in_a_triangle_of_theirs(self):
        for mesh in self.mesh, self.cap:
            found = mesh.find_simplex(mesh.points)
            assert found.min() >= 0
            assert np.all((mesh.simplices[found] == np.arange(mesh.npoints)[:, np.newaxis]).any(axis=1))

    def test_nearest_is_that_of_a_tree(self):
        places = self.places / np.linalg.norm(self.places, axis=1)[:, np.newaxis]
        for mesh in self.mesh, self.cap:
            distance, _ = scipy.spatial.cKDTree(mesh.points).query(places)
            found = np.linalg.norm(mesh.points[mesh.nearest(self.places)] - places, axis=1)
            assert found == pytest.approx(distance, rel=1e-12, abs=1e-12)

    def test_places_have_any_shape_and_may_be_missing(self):
        grid = self.places[:12].reshape(3, 4, 3).copy()
        assert self.mesh.find_simplex(grid).shape == (3, 4)
        assert self.mesh.nearest(grid[0, 0]).shape == ()
        assert self.mesh.find_simplex(np.empty((0, 3))).shape == (0,)
        grid[1, 1] = np.nan
        grid[2, 2] = 0
        assert np.argwhere(self.mesh.find_simplex(grid) < 0).tolist() == [[1, 1], [2, 2]]
        with pytest.raises(ValueError, match=r"place \(1, 1\) \(counted from 0\) is \(nan, nan, nan\): it has no direction"):
            self.mesh.nearest(grid)
        assert np.isnan(self.mesh.interpolate(self.points[:, 0], grid)).sum() == 2

    def test_linear_interpolation_is_exact_on_the_planes_of_triangles(self):
        slope = np.array([1.0, -2.0, 3.0])
        corners = self.points[self.mesh.simplices[self.mesh.find_simplex(self.places)]]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        scale = np.einsum("px,px->p", normal, corners[:, 0]) / np.einsum("px,px->p", normal, self.places)
        expected = (self.places * scale[:, np.newaxis]) @ slope
        assert self.mesh.interpolate(self.points @ slope, self.places) == pytest.approx(expected, rel=1e-9, abs=1e-9)

    def test_values_of_nodes_are_kept(self):
        values = np.random.default_rng(1).normal(size=1000)
        assert np.array_equal(self.mesh.interpolate(values, self.points), values)
        longer = Delaunay(self.points * np.where(np.arange(1000) % 3, 1, 2)[:, np.newaxis])
        assert np.array_equal(longer.interpolate(values, longer.points), values)
        for method in "natural", "cubic":
            assert np.array_equal(self.mesh.interpolate(values, self.points, method), values)
            assert np.array_equal(longer.interpolate(values, longer.points, method), values)
        values[::2] = np.nan
        for method in "linear", "natural":
            assert np.array_equal(self.mesh.interpolate(values, self.points, method), values, equal_nan=True)

    def test_natural_neighbours_lose_their_shares_of_the_cell(self):
        values = np.random.default_rng(1).normal(size=1000)
        before = self.mesh.cell_areas
        result = self.mesh.interpolate(values, self.places[:20], "natural")
        for place, found in zip(self.places[:20] / np.linalg.norm(self.places[:20], axis=1)[:, np.newaxis], result):
            after = Delaunay(np.vstack([self.points, place])).cell_areas
            shares = (before - after[:-1]) / after[-1]
            assert found == pytest.approx(shares @ values, abs=1e-9)

    def test_the_cubic_method_is_much_closer_to_a_smooth_function(self):
        def smooth(p):
            p = p / np.linalg.norm(p, axis=1)[:, np.newaxis]
            return np.exp(p[:, 0]) * np.sin(2 * p[:, 1]) + p[:, 2] ** 2
        error = {method: np.sqrt(np.mean((self.mesh.interpolate(smooth(self.points), self.places, method)
                                          - smooth(self.places)) ** 2)) for method in ("linear", "cubic")}
        assert error["cubic"] < 0.2 * error["linear"]

    def test_several_values_of_each_node(self):
        values = np.random.default_rng(1).normal(size=(1000, 2, 2))
        for method in "linear", "natural", "cubic":
            result = self.mesh.interpolate(values, self.places.reshape(30, 100, 3), method)
            assert result.shape == (30, 100, 2, 2)
            for i in range(2):
                for j in range(2):
                    one = self.mesh.interpolate(values[:, i, j], self.places, method)
                    assert np.array_equal(result[..., i, j].ravel(), one)

    def test_nearest_values_and_what_is_outside(self):
        values = np.arange(300)
        nearest = self.cap.interpolate(values, self.places, "nearest")
        assert nearest.dtype == values.dtype and np.array_equal(nearest, self.cap.nearest(self.places))
        outside = self.cap.find_simplex(self.places) < 0
        for method in "linear", "natural", "cubic":
            inside = self.cap.interpolate(values, self.places, method)
            assert np.array_equal(np.isnan(inside), outside)
            filled = self.cap.interpolate(values, self.places, method, outside="nearest")
            assert np.array_equal(filled, np.where(outside, nearest, inside))

    def test_arguments_that_are_wrong(self):
        for values, places, options in (
                (np.zeros(5), self.places, {}), (np.zeros(1000), np.zeros((4, 2)), {}), (3.0, self.places, {}),
                (np.zeros(1000), self.places, {"method": "cubic spline"}),
                (np.zeros(1000), self.places, {"outside": "zero"})):
            with pytest.raises(ValueError):
                self.mesh.interpolate(values, places, **options)


@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_radians_nearest_to_a_right_angle_mean_it(kind):
    lon = np.array([0, 2, -3, 1, 2, 3, 4, -2], kind) * kind(np.pi / 2)
    lat = np.array([1, 1, -1, 0, 0, 0, 0, 0], kind) * kind(np.pi / 2)
    expected = [[0, 0, 1], [0, 0, 1], [0, 0, -1], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0]]
    assert np.array_equal(to_xyz(lon, lat, degrees=False), expected)
    for radians in {"degrees": False}, {"units": "radians"}:
        with pytest.raises(CoincidentNodesError):  # of one pole
            Delaunay.from_lonlat(lon, lat, **radians)
    if kind == np.float32:  # a double is not a float
        with pytest.raises(ValueError, match="beyond the pole"):
            to_xyz(0, np.float64(lat[0]), degrees=False)
    beside = np.nextafter(np.pi / 2, [0, 2])
    assert to_xyz(0, beside, degrees=False)[:, 0] == pytest.approx(np.cos(beside), rel=1e-15, abs=0)


def test_longitudes_and_latitudes():
    assert np.array_equal(to_xyz([0, 77, -180, 360, 450], [90, -90, 0, 0, 0]),
                          [[0, 0, 1], [0, 0, -1], [-1, 0, 0], [1, 0, 0], [0, 1, 0]])
    lon, lat = np.random.default_rng(1).uniform(-180, 180, 100), np.random.default_rng(2).uniform(-90, 90, 100)
    for degrees in True, False:
        given = (lon, lat) if degrees else (np.radians(lon), np.radians(lat))
        for back, angle in zip(to_lonlat(to_xyz(*given, degrees), degrees), given):
            assert back == pytest.approx(angle, abs=1e-12)
    assert to_xyz(np.zeros((4, 1)), np.zeros(5)).shape == (4, 5, 3)
    assert np.array_equal(Delaunay.from_lonlat(lon, lat).points, to_xyz(lon, lat))
    with pytest.raises(ValueError, match=r"latitude 91 of node 1 \(counted from 0\)"):
        to_xyz([0, 0, 0], [0, 91, 92])


def test_angles_that_may_be_degrees_or_radians_are_refused_unless_units_says():
    """As the command refuses them."""
    lon, lat = np.random.default_rng(1).uniform(-np.pi, 2 * np.pi, 50), np.linspace(-np.pi / 2, 1, 50)
    for kind in np.float64, np.float32:
        with pytest.raises(ValueError, match="may be degrees or radians: say units='degrees' or units='radians'"):
            Delaunay.from_lonlat(lon.astype(kind), lat.astype(kind))
    assert np.array_equal(Delaunay.from_lonlat(lon, lat, units="degrees").points, to_xyz(lon, lat))
    assert np.array_equal(Delaunay.from_lonlat(lon, lat, units="radians").points, to_xyz(lon, lat, degrees=False))
    assert Delaunay.from_lonlat([0, 7, 3], [0, 0, 1]).npoints == Delaunay.from_lonlat([0, 1, 3], [0, 2, 0]).npoints == 3
    with pytest.raises(ValueError, match="units must be 'degrees' or 'radians'"):
        Delaunay.from_lonlat(lon, lat, units="rad")
