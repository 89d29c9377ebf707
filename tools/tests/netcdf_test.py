"""NetCDF files as netCDF4-python and xarray read them, and as conventions mean them.

Environment: PSTRIPACK, the program.
"""
import csv
import itertools
import os
import subprocess

import netCDF4
import numpy as np
import pytest
import xarray

N = 7
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]
PACKINGS = [{}, {"scale_factor": 0.5}, {"add_offset": 10.0}, {"scale_factor": 0.25, "add_offset": -3.0}]
MISSING = ["nothing", "fill", "missing_value", "double missing_value", "vector", "fill and missing_value",
           "valid_min and valid_max", "valid_range", "library's fill", "_Unsigned", "1e20 of another type"]
# Which of the two readers is followed where they differ.
RULES = {"valid_min and valid_max": "netCDF4", "valid_range": "netCDF4", "library's fill": "netCDF4",
         "1e20 of another type": "xarray"}


def raw_values(kind, missing):
    """Numbers of the type: 1 to 100, the largest, and some that an attribute calls missing."""
    values = np.array([1, 2, 3, 5, 90, 100, 4], dtype=kind)
    if missing == "_Unsigned":
        values[2] = -56
    if missing.startswith("1e20"):
        values[2] = 1e20
    if missing == "library's fill" and kind[1] != "1":
        values[3] = netCDF4.default_fillvals[kind]
    return values


def write(file, name, kind, packing, missing, order, values):
    dimensions = {"n": ("n",), "1n": ("one", "n"), "n1": ("n", "one")}[order]
    fill = values.dtype.type(5) if missing.startswith("fill") else None
    v = file.createVariable(name, kind, dimensions, fill_value=fill)
    v.set_auto_maskandscale(False)
    if "double" in missing:
        v.missing_value = np.float64(90)
    elif missing.startswith("1e20"):
        v.missing_value = np.float64(1e20)
    elif "missing_value" in missing:
        v.missing_value = values.dtype.type(90)
    elif missing == "vector":
        v.missing_value = np.array([2, 90], dtype=kind)
    elif missing == "valid_range":
        v.valid_range = np.array([2, 99], dtype=kind)
    elif missing.startswith("valid"):
        v.valid_min, v.valid_max = values.dtype.type(2), values.dtype.type(99)
    elif missing == "_Unsigned":
        v.setncattr("_Unsigned", "true")
    v.setncatts(packing)
    v[:] = values.reshape({"n": (N,), "1n": (1, N), "n1": (N, 1)}[order])


def by_netcdf4(name, group):
    with netCDF4.Dataset(name) as file:
        return {v: np.ma.filled(x[:].astype(float), np.nan).ravel()
                for v, x in (file[group] if group else file).variables.items()}


def by_xarray(name, group):
    with xarray.open_dataset(name, group=group or None, decode_times=False) as file:
        return {str(v): np.asarray(x.values, dtype=float).ravel() for v, x in file.variables.items()}


def pstripack(*arguments):
    """What it prints, on stdout and as messages."""
    result = subprocess.run([os.environ["PSTRIPACK"], *arguments], capture_output=True, text=True)
    return result.stdout + result.stderr


def convert(file, *options, to="csv"):
    return pstripack("-q", "convert", file, "-o", "-", *([] if "--to" in options else ["--to", to]), *options)


def columns_of(text):
    """Each column of a CSV by its name, numbers if all are."""
    rows = list(csv.reader(text.splitlines()))
    return {name: np.array([float(row[k]) if row[k] else np.nan for row in rows[1:]]) for k, name in enumerate(rows[0])}


def same(a, b):
    return np.allclose(a, b, rtol=1e-6, atol=0, equal_nan=True)


@pytest.mark.filterwarnings("ignore")
def test_values_are_those_of_netcdf4_and_xarray(tmp_path):
    """Type x packing x missing x order x group. Where the two differ, the rule is one of RULES, which
    docs/pstripack.md has."""
    count, differ = 0, {}
    for kind, missing in itertools.product(TYPES, MISSING):
        if (missing == "_Unsigned" and kind[0] != "i") or (missing.startswith("1e20") and kind != "f4"):
            continue
        order, group = ["n", "1n", "n1"][count % 3], ["", "observations"][count // 3 % 2]
        name = str(tmp_path / f"{count}.nc")
        with netCDF4.Dataset(name, "w") as file:
            file.createDimension("n", N)
            file.createDimension("one", 1)
            place = file.createGroup(group) if group else file
            for axis, units in (("lon", "degrees_east"), ("lat", "Degrees North")):
                v = place.createVariable(axis, "i2", ("n",))
                v.units, v.scale_factor = units, 0.5
                v.set_auto_maskandscale(False)
                v[:] = np.arange(N)
            for k, packing in enumerate(PACKINGS):
                write(place, f"v{k}", kind, packing, missing, order, raw_values(kind, missing))
        ours, one, other = columns_of(convert(name)), by_netcdf4(name, group), by_xarray(name, group)
        assert same(ours["lon"], np.arange(N) / 2), (name, ours["lon"])
        for v in (f"v{k}" for k in range(len(PACKINGS))):
            what = f"{name}: {kind}, {missing}, {v}: ours {ours[v]}, netCDF4 {one[v]}, xarray {other[v]}"
            if same(one[v], other[v]):
                assert same(ours[v], one[v]), what
            else:
                differ[missing] = differ.get(missing, 0) + 1
                assert missing in RULES, what
                assert same(ours[v], {"netCDF4": one, "xarray": other}[RULES[missing]][v]), what
        count += 1
    assert count > 90 and set(differ) == set(RULES), differ


def made(tmp_path, cdl):
    """The NetCDF file of this text of CDL."""
    (tmp_path / "x.cdl").write_text("netcdf x {" + cdl + "}")
    subprocess.run(["ncgen", "-4", "-o", tmp_path / "x.nc", tmp_path / "x.cdl"], check=True)
    return str(tmp_path / "x.nc")


PLACES = """double lon(n); lon:units="degrees_east"; double lat(n); lat:units="degrees_north"; """
BARE = "double lon(n), lat(n);"
PLACES_DATA = "lon=0,10,20; lat=0,20,10; "
RADIANS = "%s lonCell(n); %s latCell(n);"
GRID = 'double longitude(n); longitude:units="degrees"; double latitude(time); latitude:units="degrees";'
VECTORS = PLACES + "double xCell(n), yCell(n), zCell(n);"
MESH = """dimensions: n=4; f=2; four=4; three=3; variables: int line; line:cf_role="mesh_topology";
  line:topology_dimension=1; line:node_coordinates="bx by"; double bx(f); bx:units="degrees_east"; double by(f);
  by:units="degrees_north"; int m; m:cf_role="mesh_topology"; m:topology_dimension=2; m:node_coordinates=%s;
  m:face_node_connectivity="faces"; m:face_dimension="f"; double m_node_x(n); m_node_x:standard_name="longitude";
  m_node_x:units="degree"; double m_node_y(n); m_node_y:standard_name="latitude"; m_node_y:units="degree";
  double m_node_z(n); m_node_z:units="m"; int faces(%s); faces:_FillValue=-9; faces:start_index=1;
  data: bx=1,2; by=3,4; m_node_x=4,4.4,4.4,4; m_node_y=52,52,52.3,52.3; m_node_z=-1,-3,-2,-4; faces=%s;"""


@pytest.mark.parametrize("coordinates, shape, faces", [
    ('"m_node_x m_node_y"', "f,three", "1,2,3, 1,3,4"), ('"m_node_y m_node_x"', "three,f", "1,1, 2,3, 3,4"),
    ('"m_node_x m_node_y"', "f,four", "1,2,3,-9, 1,3,4,-9"), ('"m_node_x m_node_y"', "four,f", "1,1, 2,3, 3,4, -9,-9")])
def test_a_mesh_of_ugrid_is_that_of_its_attributes(tmp_path, coordinates, shape, faces):
    """The mesh of faces, not the first; its third variable of places is a depth, not a vector's part."""
    table = columns_of(convert(made(tmp_path, MESH % (coordinates, shape, faces))))
    assert table["area_km2"] == pytest.approx([456.733, 453.666], abs=1e-3)


def test_faces_of_more_than_three_corners_are_told(tmp_path):
    file = made(tmp_path, MESH % ('"m_node_x m_node_y"', "f,four", "1,2,3,4, 1,3,4,-9"))
    assert "1 of its faces have more than three corners" in convert(file, to="fesom")
    assert len(columns_of(convert(file))["lon"]) == 4  # its nodes


@pytest.mark.parametrize("variables, data, options, words", [
    # ICON: no rotated pole, unless a grid mapping says so, and --columns wins over that.
    ('double clon(n); clon:standard_name="grid_longitude"; clon:units="Radian"; double clat(n); '
     'clat:standard_name="grid_latitude"; clat:units="radian";', "clon=0,1,2; clat=0,1,-1;", [], "57.29577951308232"),
    ('double clon(n); clon:standard_name="grid_longitude"; clon:units="radian"; double clat(n); clat:units="radian"; '
     'clat:standard_name="grid_latitude"; int p; p:grid_mapping_name="rotated_latitude_longitude";',
     "clon=0,1,2; clat=0,1,-1;", [], "angles of a rotated pole"),
    ('double rlon(n); rlon:standard_name="grid_longitude"; rlon:units="degrees"; double rlat(n); rlat:units="degrees"; '
     'rlat:standard_name="grid_latitude";', "rlon=1,2,3; rlat=4,5,7;", ["--columns", "rlon,rlat"], "3,7"),
    ('double rlon(n); rlon:standard_name="grid_longitude"; rlon:units="degrees"; double rlat(n); rlat:units="degrees"; '
     'rlat:standard_name="grid_latitude";', "rlon=1,2,3; rlat=4,5,7;", [], "rlon, rlat: angles of a rotated pole"),
    # CICE: the pair of the wanted variable, else ask.
    ('float TLON(n); TLON:units="degrees_east"; float TLAT(n); TLAT:units="degrees_north"; float ULON(n); '
     'ULON:units="degrees_east"; float ULAT(n); ULAT:units="degrees_north";', "", [], "name two of them by --columns"),
    # Units without regard to case and blanks; west is no unit of CF.
    ('double a(n); a:units="Degrees East"; double b(n); b:units="degree_N";', "a=1,2,3; b=4,5,6;", [], "3,6"),
    ('double lon(n); lon:units="degrees_west"; double lat(n); lat:units="degrees_north";', PLACES_DATA, [],
     "units 'degrees_west'"),
    (BARE, "lon=0,180,3; lat=-90,30,1;", [], "180,30\n"),  # no radians
    (BARE, "lon=1,2,3; lat=1,2,1;", [], "variable lon: units ''; expected degrees or radians"),
    (BARE, "lon=1,2,3; lat=1,2,1;", ["--units", "degrees"], "1,1\n2,2\n3,1\n"),
    ('double lon(n); lon:units="radian"; double lat(n); lat:units="degrees_north";', "lon=0,1,2; lat=0,50,-3;", [],
     "57.29577951308232,50\n"),
    # Radians without units are those of MPAS; the number nearest to a right angle means it, also of floats.
    (RADIANS % ("double", "double"), "lonCell=0,1.5707963267948966,0; latCell=1.5707963267948966,0,-1.5707963267948966;",
     ["--to", "xyz"], "0 0 1\n0 1 0\n0 0 -1\n"),
    (RADIANS % ("float", "float"), "lonCell=0,3.1415927,4.712389; latCell=1.5707964,0,0;", ["--to", "xyz"],
     "0 0 1\n-1 0 0\n0 -1 0\n"),
    (RADIANS % ("double", "double"), "lonCell=0,1,2; latCell=1.5707964,0,1;", ["--to", "xyz"], "-7.320510347335801e-08 "),
    # Axes are a grid, fields of one shape are pairs.
    (GRID, "longitude=0,90,180; latitude=0,30;", [], "0,0\n90,0\n180,0\n0,30\n90,30\n180,30\n"),
    (GRID.replace("time", "one, n").replace("(n)", "(one, n)"), "longitude=0,90,180; latitude=0,30,60;", [],
     "lat\n0,0\n90,30\n180,60\n"),
    # Vectors as they are; angles beside them unless those are of other nodes; planar meshes.
    (VECTORS, "lon=-270,180,0; lat=0,0,0; xCell=0,-2,6371229; yCell=3,0,0; zCell=0,0,0;", [], "lat\n-270,0\n180,0\n0,0\n"),
    (VECTORS, "lon=-270,170,0; lat=0,0,0; xCell=0,-2,6371229; yCell=3,0,0; zCell=0,0,0;", [],
     "\n90,0,0,3,0\n180,0,-2,0,0\n0,0,6371229,0,0\n"),
    (VECTORS + ':on_a_sphere="NO              ";', PLACES_DATA, [], "on_a_sphere is NO: a planar mesh"),
    # Places may be missing if the caller says so.
    ('double TLONG(n); TLONG:units="degrees_east"; double TLAT(n); TLAT:units="degrees_north"; TLAT:missing_value=1e30;',
     "TLONG=1,_,3; TLAT=1e30,2,4;", ["--skip-missing"], "lon,lat\n3,4\n"),
    # Columns that are chosen.
    (PLACES + 'double a(n), t(n); t:units="K";', PLACES_DATA + "t=5,_,6;", ["--columns", "lat,lon,t"], "variable lat holds latitudes: give the longitudes first"),
    (PLACES + 'double east(n), north(n), t(n); t:units="K";', PLACES_DATA + "east=1,2,90; north=3,4,5; t=5,_,6;",
     ["--columns", "east,north,t", "--units", "degrees"], "lon,lat,t [K]\n1,3,5\n2,4,\n90,5,6\n"),
    (PLACES + "double north(n);", PLACES_DATA, ["--columns", "lon,nroth"], "no variable 'nroth'; did you mean north?"),
    (PLACES, PLACES_DATA, ["--columns", "lon"], "--columns names 1 variable: expected longitude and latitude"),
    (PLACES, PLACES_DATA, ["--columns", "lon,lat,lon"], "variable 'lon' is chosen twice"),
    (PLACES + "double other(time);", PLACES_DATA, ["--columns", "lon,lat,other"],
     "variable other(time=2): expected one value per node, other(n=3)"),
    # Nodes that are none.
    ("double depth(n);", "", [], "expected variables xCell"),
    ("double lon(n);", "", [], "there is no variable of latitudes beside lon"),
    (PLACES, "lon=1,2,3; lat=1,91,2;", [], "variable lat, value 2: 91 is beyond the pole"),
    (PLACES, "lon=1,_,3; lat=1,2,3;", [], "variable lon, value 2: missing or not finite: remove the node, or say"),
    (BARE.replace("lat(n)", "lat(n, n)"), f"lon=1,2,3; lat={'4,' * 8}4;", ["--units", "degrees"], "expected one shape"),
    ("double xCell(n), yCell(n), zCell(one);", "xCell=1,2,3; yCell=1,2,3; zCell=1;", [], "expected one shape"),
    (PLACES + 'double a(n); a:units="degrees_east"; double b(n); b:units="degrees_north";', PLACES_DATA + "a=1,2,3; b=4,5,6;",
     ["--columns", "b,a"], "variable b holds latitudes: give the longitudes first, --columns LON,LAT"),
    ("double XLONG(time,n,time), XLAT(time,n,time);", f"XLONG={'0,' * 11}0; XLAT={'0,' * 11}0;", [],
     "variable XLONG(time=2, n=3, time=2): expected one place per node; extract one time, say by ncks -d time,0"),
    # Layers and times.
    (PLACES + "float pr(n, time);", PLACES_DATA, ["--columns", "lon,lat,pr"], "ncks -d time,0"),
    (PLACES + "float pr(time, n);", PLACES_DATA, ["--columns", "lon,lat,pr"], "ncks -d time,0"),
    (PLACES + "float pr(one, n, one2);", PLACES_DATA + "pr=7,8,9;", [], "20,10,9"),
    # Texts, and integers of more digits than a double has.
    (PLACES + "string id(n); char c(n,one); int64 big(n);", PLACES_DATA + 'id="007","b c",""; c="x","y","z"; '
     "big=17179869184000001,2,-3;", [], "0,0,007,x,17179869184000001"),
    (PLACES + "char c(n, none);", PLACES_DATA, [], "10,20,\n"),  # of length 0
    # Several groups have the name.
    (PLACES + "group: g { variables: float v(n); data: v=1,2,3; } group: h { variables: float v(n); data: v=4,5,6; }",
     PLACES_DATA, ["--columns", "lon,lat,h/v"], "20,10,6"),
])
def test_variables_are_what_their_attributes_say(tmp_path, variables, data, options, words):
    groups = variables.find("group:")
    head, inner = (variables, "") if groups < 0 else (variables[:groups], variables[groups:])
    file = made(tmp_path, f"dimensions: n=3; time=2; one=1; one2=1; none=UNLIMITED; variables: {head} data: {data} {inner}")
    assert words in convert(file, *options)


@pytest.mark.parametrize("attribute, radius", [("", 6371220), (":sphere_radius=7.;", 7)])
def test_vectors_of_one_length_tell_the_radius(tmp_path, attribute, radius):
    """Unless the attribute does."""
    r = "6371220"
    file = made(tmp_path, f"""dimensions: n=6; variables: double xCell(n), yCell(n), zCell(n); {attribute}
      data: xCell={r},0,0,-{r},0,0; yCell=0,{r},0,0,-{r},0; zCell=0,0,{r},0,0,-{r};""")
    pstripack("triangulate", file, "-o", str(tmp_path / "o.mpas.nc"))
    with netCDF4.Dataset(tmp_path / "o.mpas.nc") as made_of_it:
        assert made_of_it.sphere_radius == radius


@pytest.mark.parametrize("lengths, words", [
    ((357913944,), "357913944 times 1"), ((20000, 20000), "20000 times 20000"), ((2**32, 2**32), "4294967296 times 1")])
def test_what_a_header_announces_is_bounded(tmp_path, lengths, words):
    name = str(tmp_path / "x.nc")
    with netCDF4.Dataset(name, "w") as file:
        dimensions = [file.createDimension(f"n{k}", length).name for k, length in enumerate(lengths)]
        for axis in "lon", "lat":
            file.createVariable(axis, "f8", dimensions, chunksizes=[100] * len(lengths), fill_value=False)
    assert words + " values; there can be 357913943 nodes at most" in convert(name)


@pytest.mark.parametrize("time", ["", "Time, "])
@pytest.mark.parametrize("lon, lat", [("nav_lon", "nav_lat"), ("glamt", "gphit"), ("XLONG", "XLAT"), ("TLONG", "TLAT"),
                                      ("lon", "lat")])
def test_coordinates_of_models_are_found(tmp_path, lon, lat, time):
    """NEMO, WRF, POP and CORDEX: the nodes are where each file has its longitudes and latitudes; or those of the variable."""
    of = f"{time}y,x"
    file = made(tmp_path, f"""dimensions: Time=1; y=2; x=3; variables: double {lon}({of}), {lat}({of}), ULON({of}), ULAT({of});
      {lat}:units="degree_north"; ULON:units="degrees_east"; ULAT:units="degrees_north"; double T(Time,y,x), U(y,x);
      U:coordinates="time ULAT ULON"; data: {lon}=0,40,80,5,45,85; {lat}=0,1,2,30,31,32; ULON=0,1,2,30,31,32;
      ULAT=0,1,2,30,31,32; T=1,2,3,4,5,6; U=1,2,3,4,5,6;""")
    for variable, names in ([], f"{lon} {lat}"), (["--variable", "T"], f"{lon} {lat}"), (["--variable", "U"], "ULON ULAT"):
        command = ["interpolate", file, *variable, "--to-grid", "2x2", "-o", "-"] if variable else ["info", file]
        assert f"NetCDF, {names} in degrees" in pstripack(*command)


def test_a_pair_of_usual_names_may_be_that_of_another_grid(tmp_path):
    file = made(tmp_path, """dimensions: n=3; m=4; k=2; variables: double clon(m); clon:units="radian"; double clat(m);
      clat:units="radian"; double a(n); a:standard_name="longitude"; a:units="radian"; double b(n); b:units="degreeN";
      b:bounds="b_bounds"; double b_bounds(n,k); b_bounds:units="degreeN"; double s(n); data: clon=0,1,2,3; clat=0,1,0,-1;
      a=0,1,2; b=0,50,-3; s=1,2,3;""")
    assert "NetCDF, a b in degrees" in pstripack("interpolate", file, "--variable", "s", "--to-grid", "2x2", "-o", "-")
    assert "NetCDF, clon clat in radians" in pstripack("info", file)


@pytest.mark.parametrize("variable, words", [
    ("t", "\n180 0 3 3 130\n0 30 4 4 140\n90 30 2 nan nan\n"), ("packed", "\n180 30 130 6 nan\n"),
    ("turned", "expected turned(lat=2, lon=3); exchange the dimensions, by ncpdq -a lat,lon"),
    ("elsewhere", "expected elsewhere(lat=2, lon=3)\n"),
    ("deep", "expected deep(lat=2, lon=3); extract one layer, say by ncks -d layers,0"),
    ("none", "variables with one value per node: t, packed"), ("", "say --variable NAME; variables with one value per node: t")])
def test_values_have_the_dimensions_of_the_nodes(tmp_path, variable, words):
    file = made(tmp_path, """dimensions: time=1; lat=2; lon=3; other=3; layers=2; variables: double lon(lon);
      lon:units="degrees_east"; double lat(lat); lat:units="degrees_north"; double t(time,lat,lon); t:units="K";
      double turned(lon,lat), elsewhere(lat,other), deep(layers,lat,lon), packed(lat,lon); packed:scale_factor=10.;
      packed:add_offset=100.; packed:missing_value=-5.; data: lon=0,90,180; lat=0,30; t=1,2,3,4,_,6;
      packed=1,2,3,4,_,-5;""")
    said = pstripack("-q", "interpolate", file, *(["--variable", variable] if variable else []), "--skip-missing", "--method",
                     "nearest", "--to-points", file, "-o", "-")
    assert words in said


@pytest.mark.parametrize("kind", ["NETCDF3_CLASSIC", "NETCDF3_64BIT_OFFSET", "NETCDF3_64BIT_DATA", "NETCDF4"])
def test_a_truncated_file_is_refused(tmp_path, kind):
    """Past failure: libnetcdf reads what a truncated file lacks as zeros."""
    name = tmp_path / "x.nc"
    with netCDF4.Dataset(name, "w", format=kind) as file:
        file.createDimension("n", 20)
        file.createDimension("time", None)
        for axis, units in ("lon", "degrees_east"), ("lat", "degrees_north"):
            v = file.createVariable(axis, "f8", ("n",))
            v.units = units
            v[:] = np.arange(20)
        file.createVariable("T", "f4", ("time", "n"))[0] = np.arange(20)
    whole = name.read_bytes()
    assert "18,18,18\n19,19,19\n" in convert(str(name))
    for size in (len(whole) - 1, *range(8, len(whole) - 1, 1 + len(whole) // 12)):
        name.write_bytes(whole[:size])
        assert ("NetCDF: " if kind == "NETCDF4" else ": incomplete NetCDF file: it ends before") in convert(str(name)), size
