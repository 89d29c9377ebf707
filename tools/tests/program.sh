#!/bin/sh
# Runs pstripack and checks output, files, messages and exit codes. Usage: program.sh CASE; environment:
# PSTRIPACK, COMPARE (programs), DOCUMENT (docs/pstripack.md), WORK (folder for files), MPIRUN (mpirun and its options).
set -eu
mkdir -p "$WORK/$1"
cd "$WORK/$1"
rm -rf ./* .[!.]*

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# refuses CODE "words" arguments...: pstripack ends with CODE and one line on stderr that contains the words
refuses() {
  expected=$1 words=$2
  shift 2
  code=0
  "$PSTRIPACK" "$@" > out 2> err || code=$?
  [ "$code" = "$expected" ] || fail "$*: exit code $code, expected $expected: $(cat err)"
  [ "$(wc -l < err)" = 1 ] || fail "$*: not one line on stderr: $(cat err)"
  grep -qF -- "$words" err || fail "$*: expected '$words' in: $(cat err)"
}

# same A B: fails unless two NetCDF files differ at most in their history; without ncdump, in the vectors
same() {
  for file in "$1" "$2"; do
    if command -v ncdump > /dev/null; then  # Debian: netcdf-bin
      ncdump -p 9,17 "$file" | sed '1d; /:history = .* ;$/d; /:history = /,/ ;$/d'
    else
      "$PSTRIPACK" -q convert "$file" -o - --to raw
    fi > "$file.content"
  done
  cmp "$1.content" "$2.content"
}

octahedron() { printf '1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n'; }

case $1 in
documented_tables)
  # $DOCUMENT names the formats with their suffixes, (`name`; `.suffix`, ...), and the densities of --help. A test of
  # tests/docs compares the options with pstripack.1.
  rows_of() { # TITLE COMMAND: of --help, from the line after TITLE to one that does not begin with a blank
    "$PSTRIPACK" "$2" --help | awk -v title="$1" '$0 == title { on = 1; next } on && !/^ / { exit } on'
  }
  rows_of "Formats and their suffixes:" triangulate |
    awk '{ line = $1; for (i = 2; $i ~ /^\./; ++i) line = line " " $i; print line }' | sort > help.formats
  [ -s help.formats ] || fail "'pstripack triangulate --help' has no formats"
  grep -o '(`[a-z]*`; `\.[^)]*)' "$DOCUMENT" | tr -d '(`;,)' | sort > document.formats
  diff document.formats help.formats || fail "docs/pstripack.md has other formats or suffixes than --help"
  rows_of "Densities:" scvt | sed -n 's/^  \([a-z]*\).*/\1/p' | grep . | sort -u > help.densities
  [ -s help.densities ] || fail "'pstripack scvt --help' has no densities"
  sed -n '/^Formulas: /,/(`--help`)/p' "$(dirname "$DOCUMENT")/scvt.md" | grep -o '`[a-z]*`' | tr -d '`' | sort -u > document.densities
  diff document.densities help.densities || fail "docs/scvt.md has other densities than --help"
  ;;

pipes)
  octahedron | "$PSTRIPACK" -q triangulate - -o - --to off > mesh.off
  [ "$(head -n 2 mesh.off | tail -n 1)" = "6 8 0" ] || fail "an octahedron has 6 corners and 8 faces"
  "$PSTRIPACK" -q points fibonacci 100 | "$PSTRIPACK" -q info - --json > info.json
  grep -q '"triangles": 196,' info.json || fail "$(cat info.json)"
  octahedron | "$PSTRIPACK" triangulate - -o mesh.vtu 2> err
  grep -q '^pstripack: 6 nodes (text, x y z), 8 triangles; reading .* s; triangulating .* s; writing .* s$' err || fail "$(cat err)"
  # Pipes by their names, as <(zcat stations.csv.gz).
  mkfifo pipe
  octahedron > pipe & "$PSTRIPACK" -q triangulate pipe -o - --to off | cmp mesh.off -
  wait
  ;;

standard_streams)
  # A full or closed stdout is an error of each command that prints: one line on stderr, and never success.
  octahedron > nodes.txt
  "$PSTRIPACK" -q triangulate nodes.txt -o nodes.off
  while read -r program arguments; do
    if [ $program = pstripack ]; then program=$PSTRIPACK expected=1; else expected=$program program=$COMPARE; fi
    for stdout in full closed; do
      code=0
      # shellcheck disable=SC2086
      case $stdout in
      full) "$program" $arguments > /dev/full 2> err || code=$? ;;
      closed) "$program" $arguments >&- 2> err || code=$? ;;
      esac
      [ $code = $expected ] || fail "$arguments, stdout $stdout: exit code $code"
      [ "$(wc -l < err)" = 1 ] && grep -qE '^[a-z-]*: (stdout: cannot be written|cannot write)' err || fail "$arguments, stdout $stdout: $(cat err)"
    done
  done <<END
pstripack -q info nodes.txt
pstripack -q info nodes.txt --json
pstripack --help
pstripack info --help
pstripack --version
pstripack -q points random 5
pstripack -q points random 100000
pstripack -q convert nodes.txt -o - --to csv
pstripack -q triangulate nodes.txt -o - --to off
pstripack -q voronoi nodes.txt -o - --to off
pstripack -q plot nodes.txt -o - --to svg
1 --help
1 --version
2 run --points random --n 50 --repeats 1
END
  # Where nothing is printed, closed streams do no harm: no file gets their numbers.
  "$PSTRIPACK" triangulate nodes.txt -o mesh.off >&- 2>&- <&-
  cmp nodes.off mesh.off
  "$PSTRIPACK" triangulate nodes.txt -o mesh.off 2> /dev/full
  code=0
  "$PSTRIPACK" triangulate missing.txt -o mesh.off 2> /dev/full || code=$?
  [ $code = 1 ] || fail "exit code $code where an error cannot be printed"
  refuses 1 "stdin: read error: Bad file descriptor" info - <&-
  ;;

lists)
  "$PSTRIPACK" -q points random 500 -o nodes.txt
  "$PSTRIPACK" -q triangulate nodes.txt -o a.lists
  "$PSTRIPACK" -q triangulate nodes.txt -o a.off
  "$PSTRIPACK" -q convert a.off -o b.lists
  "$COMPARE" lists a.lists b.lists > compared || fail "$(cat compared)"
  cmp a.lists b.lists
  [ "$(head -n 1 a.lists)" = "500 2989" ] || fail "N and LNEW: $(head -n 1 a.lists)"
  # FESOM: numbered nodes with a flag at the boundary, and triangles in the order of OFF.
  "$PSTRIPACK" -q points hemisphere 60 -o half.txt
  "$PSTRIPACK" -q triangulate half.txt --to fesom -o nod2d.out
  "$PSTRIPACK" -q triangulate half.txt -o half.off
  sed 1d nod2d.out | cut -d ' ' -f 2,3 | cmp - - <<END
$("$PSTRIPACK" -q convert half.txt -o - --to lonlat)
END
  sed 1d nod2d.out | awk '{ if ($1 != NR || $4 != 0 && $4 != 1) exit 1; rim += $4 } END { exit rim < 3 }' || fail "nod2d.out"
  sed 1d elem2d.out > elements
  tail -n "$(head -n 1 elem2d.out)" half.off | awk '{ print $2 + 1, $3 + 1, $4 + 1 }' | cmp - elements
  refuses 1 "has files called nod2d.out and elem2d.out" triangulate half.txt --to fesom -o half.txt2
  ;;

same_bytes_through_formats)
  for family in random hemisphere; do
    "$PSTRIPACK" -q points $family 500 -o nodes.txt
    "$PSTRIPACK" -q triangulate nodes.txt -o direct.lists
    for suffix in nc mpas.nc off; do
      [ $family.$suffix != hemisphere.mpas.nc ] || continue  # without the nodes at the boundary
      "$PSTRIPACK" -q triangulate nodes.txt -o mesh.$suffix
      "$PSTRIPACK" -q convert mesh.$suffix -o through.lists
      cmp direct.lists through.lists
    done
    "$PSTRIPACK" -q convert nodes.txt -o nodes.nc
    "$PSTRIPACK" -q convert nodes.nc -o back.txt
    cmp nodes.txt back.txt
    "$PSTRIPACK" -q convert nodes.txt -o nodes.raw
    "$PSTRIPACK" -q convert nodes.raw --from raw --coordinates xyz -o back.txt
    cmp nodes.txt back.txt
  done
  ;;

bad_nodes)
  printf '10 20\n30 nan\n50 60\n' > nan.txt
  refuses 1 "nan.txt:2: 'nan' is not a finite number" triangulate nan.txt -o mesh.off
  printf '0 0\n1 0\n0 1\n' > angles.txt
  refuses 1 "may be degrees or radians: say --units degrees or --units radians" triangulate angles.txt -o mesh.off
  "$PSTRIPACK" -q triangulate angles.txt --units degrees -o mesh.off
  printf '10 20 300\n30 400 -5\n50 60 70\n' > depth.txt
  refuses 1 "are not on one sphere; say --coordinates lonlat" triangulate depth.txt -o depth.off
  printf 'x,y,z\n465000,5247000,400\n467000,5243000,520\n461000,5249000,610\n' > utm.csv
  refuses 1 "x y z of nodes at the equator, but not on one sphere: if they are metres of a map projection, convert" triangulate utm.csv -o utm.off
  printf '10 20\n-999 40\n50 60\n' > gap.txt
  refuses 1 "node 2 (line 2): longitude -999 is more than two turns: if it means a missing place, remove the row" triangulate gap.txt -o gap.off
  printf '10 20 300\n30 40 -5\n50 60 70\n' > depth.txt
  "$PSTRIPACK" -q triangulate depth.txt --coordinates lonlat -o mesh.off
  "$PSTRIPACK" -q triangulate depth.txt --coordinates xyz -o mesh.off
  printf '1 0 0\n0 1 0\n0 0 0\n' > zero.txt
  refuses 1 "node 3 (line 3) is zero or not finite: remove it" triangulate zero.txt -o zero.off
  printf '1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n' > circle.txt
  refuses 1 "all nodes lie on one great circle" triangulate circle.txt -o circle.off
  printf '1 0 0\n0 1 0\n' > two.txt
  refuses 1 "needs at least 3 nodes, here are 2" info two.txt
  refuses 1 "missing.txt: cannot be opened: No such file" triangulate missing.txt -o missing.off
  printf 'a\0b' > binary
  refuses 1 "raw doubles need --from raw" triangulate binary -o binary.off
  # Formats that other programs convert.
  while read -r file bytes command; do
    printf "$bytes" > $file
    refuses 1 "$file: $command" triangulate $file -o foreign.off
  done <<'END'
a.b.shp \000\000\047\012 a shapefile: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 a.b.geojson a.b.shp`
a.gpkg SQLite\040format\0403 a GeoPackage: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 a.geojson a.gpkg`
a.kml <?xml\n<kml> KML: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 a.geojson a.kml`
a.kmz PK\003\004doc.kml KMZ: convert it first, by `ogr2ogr -f GeoJSON -t_srs EPSG:4326 a.geojson a.kmz`
a.xlsx PK\003\004xl/workbook.xml a spreadsheet: convert it first, by `libreoffice --headless --convert-to csv a.xlsx`
a.parquet PAR1 Parquet: convert it first, by `python3 -c "import pandas; pandas.read_parquet('a.parquet').to_csv('a.csv', index=False)"`
a GRIB GRIB: convert it first, by `cdo -f nc copy a a.nc`
END
  refuses 1 "holds nodes without triangles" convert two.txt -o two.off
  [ "$(echo ./*.off)" = ./mesh.off ] || fail "files of failed runs: $(echo ./*.off)"
  ;;

bad_netcdf)
  printf 'CDF, it says' > broken.nc
  refuses 1 "broken.nc: NetCDF: Unknown file format" triangulate broken.nc -o mesh.nc
  "$PSTRIPACK" -q points random 50 -o nodes.nc
  refuses 1 "holds nodes without triangles" convert nodes.nc -o mesh.mpas.nc
  refuses 1 "gmsh cannot hold polygons" voronoi nodes.nc -o cells.msh
  refuses 1 "mpas cannot hold polygons" voronoi nodes.nc -o cells.mpas.nc
  "$PSTRIPACK" -q voronoi nodes.nc -o cells.nc
  refuses 1 "expected faces of three corners" convert cells.nc -o cells.off
  "$PSTRIPACK" -q points random 50 -o - --to nodes | "$PSTRIPACK" -q triangulate - -o piped.nc
  ;;

bad_command_lines)
  octahedron > nodes.txt
  refuses 2 "required" triangulate nodes.txt
  refuses 2 "mesh.xxx: no format has this suffix: give --to" triangulate nodes.txt -o mesh.xxx
  refuses 2 "a.b.gpkg: write GeoJSON and convert it: ogr2ogr a.b.gpkg a.b.geojson" voronoi nodes.txt -o a.b.gpkg
  printf 'SQLite format 3' > a.gpkg
  refuses 1 "a.gpkg: a GeoPackage: convert it first, by" voronoi nodes.txt --clip-to a.gpkg -o failed.off
  refuses 2 "--radius: only MPAS meshes have a radius" triangulate nodes.txt --radius 6371229 -o mesh.off
  refuses 2 "--radius: '-1' is not a number of metres above 0" triangulate nodes.txt --radius=-1 -o mesh.mpas.nc
  refuses 2 "--edges: only UGRID meshes have edges" convert nodes.txt --edges -o mesh.off
  refuses 2 "--to: 'potato' is none of ugrid, mpas" triangulate nodes.txt -o mesh.off --to potato
  refuses 2 "--to: 'ugird' is none of ugrid, mpas, scrip, esmf, vtu, off, gmsh, fesom, lists, gmt, geojson, csv, xyz, lonlat, nodes, raw; did you mean ugrid?" \
    triangulate nodes.txt -o mesh.off --to ugird
  refuses 2 "--duplicates: 'frist' is none of error, first, mean; did you mean first?" triangulate nodes.txt -o mesh.off --duplicates frist
  refuses 2 "earthquakes; did you mean random?" points rndom 10
  refuses 2 "unknown point set 'potato'" points potato 10
  refuses 2 "points are nodes, not a mesh" points random 10 -o mesh.off
  refuses 2 "degrees" triangulate nodes.txt -o mesh.off --units gradians
  refuses 2 "there is no subcommand 'polygons': expected triangulate, voronoi, info" polygons
  refuses 2 "there is no subcommand 'triangluate'; did you mean triangulate?" triangluate nodes.txt -o mesh.off
  refuses 2 "there is no option --outptu; did you mean --output?" triangulate nodes.txt --outptu mesh.off
  refuses 2 "there is no option --unit; did you mean --units?" triangulate nodes.txt --unit=degrees -o mesh.off
  refuses 2 "there is no option --qiet; did you mean --quiet?" --qiet info nodes.txt
  refuses 2 "there is no option --potato" info nodes.txt --potato
  ! grep -q "did you mean" err || fail "$(cat err)"
  refuses 2 "expected" info nodes.txt more.txt
  refuses 2 "'1.5' is not a whole number" points random 1.5
  refuses 2 "'1e400' is not a whole number" points random 1e400
  [ "$("$PSTRIPACK" points random 1e3 | wc -l)" = 1000 ] || fail "1e3 is a number"
  "$PSTRIPACK" --version > version
  grep -qE '^pstripack [0-9]+\.[0-9]+\.[0-9]+(-rc[0-9]+)?$' version || fail "$(cat version)"
  printf '1 0 0\n0 1 0\n0 0 1\n' | "$PSTRIPACK" triangulate - -o - --to lists > out 2> err
  grep -q '^pstripack: 3 nodes (text, x y z), 1 triangle; ' err || fail "$(cat err)"
  [ ! -e mesh.off ] || fail "mesh.off was written"
  ;;

no_partial_output)
  octahedron > nodes.txt
  echo old > mesh.off
  printf '1 0 0\n0 1 0\n0 0 1\n1 0 0\n' > twice.txt
  refuses 1 "are in the same place" triangulate twice.txt -o mesh.off
  refuses 1 "no/such/folder/mesh.off: cannot be written: No such file" triangulate nodes.txt -o no/such/folder/mesh.off
  refuses 1 "/dev/full: cannot be written: No space left" triangulate nodes.txt -o /dev/full --to off
  # A limit on file size, in blocks of 512 bytes, acts as a full disk.
  "$PSTRIPACK" -q points random 20000 -o many.txt
  code=0
  (trap '' XFSZ; ulimit -f 100; exec "$PSTRIPACK" -q triangulate many.txt -o mesh.off 2> err_of_full) || code=$?
  [ $code = 1 ] || fail "exit code $code where the disk is full"
  grep -q "mesh.off: cannot be written: File too large" err_of_full || fail "$(cat err_of_full)"
  [ "$(cat mesh.off)" = old ] || fail "mesh.off has changed"
  rm -f out err err_of_full
  [ "$(ls -A)" = "$(printf 'many.txt\nmesh.off\nnodes.txt\ntwice.txt')" ] || fail "files are left: $(ls -A)"
  ;;

duplicates)
  { octahedron; octahedron; } > twice.txt
  refuses 1 "twice.txt: node 1 (line 1) and node 7 (line 7) are in the same place: remove one, or say --duplicates first" \
    triangulate twice.txt -o twice.off
  octahedron > once.txt
  "$PSTRIPACK" triangulate twice.txt --duplicates first -o dropped.off 2> err
  grep -q "6 nodes dropped" err || fail "$(cat err)"
  "$PSTRIPACK" -q triangulate once.txt -o once.off
  cmp once.off dropped.off
  "$PSTRIPACK" -q info twice.txt > info.txt
  grep -q "^duplicates *6, the first is node 7 (line 7); left out below" info.txt || fail "$(cat info.txt)"
  grep -q "^triangles *8$" info.txt || fail "$(cat info.txt)"
  { octahedron; echo "1 1e-7 0"; } > near.txt
  "$PSTRIPACK" -q info near.txt > info.txt
  grep -q "^tightest pair *1e-07 rad, .*: node 1 (line 1) and node 7 (line 7)$" info.txt || fail "$(cat info.txt)"
  grep -q "^near duplicates *1 pair closer" info.txt || fail "$(cat info.txt)"
  # A longitude-latitude grid in radians has one node at each pole.
  grid=$(dirname "$DOCUMENT")/../tests/data/radian_grid.csv
  refuses 1 "node 1 (line 2) and node 2 (line 3) are in the same place" voronoi "$grid" -o failed.csv
  "$PSTRIPACK" -q voronoi "$grid" --duplicates first -o cells.csv
  [ "$(cut -d , -f 2-5 cells.csv | tail -n +2 | tr '\n' ' ')" = "-90,1,2,3 0,4,5,4 0,5,6,4 0,6,7,4 90,7,8,3 " ] || fail "$(cat cells.csv)"
  refuses 1 "are in the same place" scvt --start "$grid" -o failed.off
  "$PSTRIPACK" -q convert "$grid" --duplicates first -o once.csv
  [ "$(wc -l < once.csv)" = 6 ] || fail "$(cat once.csv)"
  ;;

tiny_nodes)
  # Copies of a pole up to rounding, whose cells are a 24th of the sphere each, and a garden of 2 m.
  data=$(dirname "$DOCUMENT")/../tests/data
  "$PSTRIPACK" -q voronoi "$data/nine_nodes.csv" -o cells.csv
  [ "$(cut -d , -f 6 cells.csv | tail -n +7 | cut -c 1-16 | sort -u)" = 0.52359877559829 ] || fail "$(cat cells.csv)"
  "$PSTRIPACK" -q info "$data/garden.csv" > info.txt
  if ! grep -q "^triangles *15$" info.txt || ! grep -q "^smallest angle *3.78752 degrees" info.txt; then fail "$(cat info.txt)"; fi
  "$PSTRIPACK" -q plot "$data/garden.csv" --what cells -o garden.svg
  ;;

near_nodes)
  # 0.1 mm, 1 m and 1 km from node 1.
  { echo "lon,lat,value"; printf '%s\n' 0,0,1 90,0,1 180,0,1 -90,0,1 0,90,1 0,-90,1 9e-10,0,3 9e-6,0,5 0.009,0,7; } > near.csv
  line="2 nodes are less than 1 mm apart on the Earth, but not in the same place: node 1 (line 2) and node 7 (line 8); --duplicates first --duplicates-within 1mm keeps one"
  for command in "triangulate near.csv" "voronoi near.csv" "interpolate near.csv --to-grid 2x2" "scvt --start near.csv"; do
    # shellcheck disable=SC2086
    "$PSTRIPACK" $command --units degrees -o out.nc 2> err
    [ "$(grep -c " apart on the Earth" err)" = 1 ] && grep -qF "near.csv: $line" err || fail "$command: $(cat err)"
    # shellcheck disable=SC2086
    "$PSTRIPACK" -q $command --units degrees -o out.nc 2> err
    [ ! -s err ] || fail "$command: $(cat err)"
    # shellcheck disable=SC2086
    "$PSTRIPACK" $command --units degrees --duplicates first --duplicates-within 1mm -o out.nc 2> err
    grep -q "near.csv: 1 node dropped that is within 1mm of earlier ones$" err || fail "$command: $(cat err)"
    if grep -q " apart on the Earth" err; then fail "$command: $(cat err)"; fi
  done
  while read -r within count; do
    "$PSTRIPACK" convert near.csv --units degrees --duplicates first --duplicates-within "$within" -o out.csv 2> err
    [ "$(wc -l < out.csv)" = "$count" ] || fail "$within: $(wc -l < out.csv)"
  done <<END
0mm 10
0.09mm 10
0.11mm 9
1.2m 8
0.0011km 8
110cm 8
1e-8deg 9
1e-5deg 8
1e-11rad 10
0.00016rad 7
89deg 7
END
  "$PSTRIPACK" convert near.csv --units degrees --duplicates mean --duplicates-within 2km -o out.csv 2> err
  [ "$(sed -n 2p out.csv)" = 0,0,4 ] || fail "$(cat out.csv)"
  refuses 1 "near.csv: node 1 (line 2) and node 7 (line 8) are within 1mm of each other: remove one, or say --duplicates first" \
    triangulate near.csv --units degrees --duplicates-within 1mm -o failed.off
  for within in 1 1foot mm 1e-9 -1mm 90deg 10008km nanm; do
    refuses 2 "--duplicates-within: '$within': expected" triangulate near.csv "--duplicates-within=$within" -o failed.off
  done
  ;;

pictures)
  "$PSTRIPACK" -q points random 300 -o nodes.txt
  "$PSTRIPACK" -q plot nodes.txt -o a.svg
  grep -q '>nodes.txt: 300 nodes, 596 triangles<' a.svg || fail "no title"
  "$PSTRIPACK" -q plot - -o - --to svg --title "nodes.txt: 300 nodes, 596 triangles" < nodes.txt > b.svg
  cmp a.svg b.svg
  for threads in 1 2; do
    "$PSTRIPACK" -q --threads $threads plot nodes.txt --what cells --colour owner:5:stripes -o owner$threads.svg
  done
  cmp owner1.svg owner2.svg
  "$PSTRIPACK" -q plot nodes.txt --what cells --colour owner:5 -o boxes.svg
  if cmp -s owner1.svg boxes.svg; then fail "stripes are boxes"; fi
  # The triangles of a mesh are drawn as they are: the other diagonal of a square on the equator.
  square='0.9 0.3 0.3\n0.9 -0.3 0.3\n0.9 -0.3 -0.3\n0.9 0.3 -0.31\n'
  printf "OFF\n4 2 0\n${square}3 0 1 2\n3 0 2 3\n" > one.off
  printf "OFF\n4 2 0\n${square}3 0 1 3\n3 1 2 3\n" > other.off
  "$PSTRIPACK" -q plot one.off --title "" -o one.svg
  "$PSTRIPACK" -q plot other.off --title "" -o other.svg
  if cmp -s one.svg other.svg; then fail "the triangles of a file are not drawn"; fi
  if command -v rsvg-convert > /dev/null; then
    "$PSTRIPACK" -q plot nodes.txt --view lonlat --width 1000 -o a.png
    # The signature and, in the header, 1000 (0x3e8) by 549 (0x225) pixels.
    [ "$(od -A n -t x1 -N 24 a.png | tr -d ' \n')" = 89504e470d0a1a0a0000000d49484452000003e800000225 ] ||
      fail "a.png is no PNG of 1000 x 549 pixels: $(od -A n -t x1 -N 24 a.png)"
  fi
  # PNG without the program that makes it.
  code=0
  PATH=/no/such/folder "$PSTRIPACK" plot nodes.txt -o b.png 2> err || code=$?
  [ $code = 1 ] && grep -q "PNG needs rsvg-convert (Debian: librsvg2-bin)" err || fail "$code: $(cat err)"
  refuses 2 "picture.gif: expected FILE.svg, FILE.png or FILE.html" plot nodes.txt -o picture.gif
  refuses 2 "--view: mercator: expected orthographic, lonlat" plot nodes.txt -o c.svg --view mercator
  refuses 2 "--view: lonlat:10: expected" plot nodes.txt -o c.svg --view lonlat:10
  refuses 2 "--view: orthographic:0,91: expected" plot nodes.txt -o c.svg --view orthographic:0,91
  refuses 2 "--colour: owner:0: expected owner:P or owner:P:stripes for 1 to 4096 ranks" plot nodes.txt -o c.svg --colour owner:0
  refuses 2 "--colour: owner:4:boxes: expected" plot nodes.txt -o c.svg --colour owner:4:boxes
  refuses 1 "nodes.txt: --colour aera: no column has this name; did you mean area? (here are none, area, degree, owner:P, node, line)" \
    plot nodes.txt -o c.svg --colour aera
  refuses 1 "no.shp: cannot be opened: No such file" plot nodes.txt -o c.svg --coast-file no.shp
  refuses 1 "nodes.txt: not a shapefile (.shp) of lines or polygons" plot nodes.txt -o c.svg --coast-file nodes.txt
  refuses 2 "--box: it is a map of longitude and latitude: leave out --zoom" plot nodes.txt -o c.svg --box 0,10,20,30 --zoom 5
  refuses 2 "--box: it is a map of longitude and latitude: leave out" plot nodes.txt -o c.svg --box 0,10,20,30 --view orthographic
  refuses 2 "--box: '0,10,30,20': expected WEST,EAST,SOUTH,NORTH" plot nodes.txt -o c.svg --box 0,10,30,20
  refuses 2 "--zoom: 'nan' is not a number from 1e-06 to 180" plot nodes.txt -o c.svg --zoom nan
  refuses 2 "--width: 'nan' is not a number from 100 to 20000" plot nodes.txt -o c.svg --width nan
  refuses 2 "--range: '5,2': expected LOW,HIGH, the lower first" plot nodes.txt -o c.svg --colour area --range 5,2
  refuses 2 "--range: a colour bar is needed: --colour area or a column of numbers" plot nodes.txt -o c.svg --range 2,5
  refuses 2 "'virdis' is none of viridis, magma, cividis, coolwarm, grey; did you mean viridis?" plot nodes.txt -o c.svg --palette virdis
  "$PSTRIPACK" -q plot nodes.txt --what cells --colour area --range 1e5,1e6 --palette magma --dots --box 170,-170,-30,-10 -o part.svg
  grep -q '>nodes.txt: 300 cells<' part.svg && grep -q 'fcfdbf' part.svg || fail "no title or palette"
  # Cells that voronoi has written, and their columns; of another command's, or another program's, not.
  "$PSTRIPACK" -q voronoi nodes.txt -o cells.geojson
  "$PSTRIPACK" plot cells.geojson --what cells --colour area_km2 --title "" -o cells.svg 2> err
  grep -q "cells.geojson: whole cells of its nodes are drawn" err && grep -q '>area_km2<\|area_km2' cells.svg || fail "$(cat err)"
  "$PSTRIPACK" -q plot nodes.txt --what cells --colour degree --title "" -o a.svg
  "$PSTRIPACK" -q plot cells.geojson --what cells --colour degree --title "" -o b.svg
  [ "$(grep -c '<path' a.svg)" = "$(grep -c '<path' b.svg)" ] || fail "other cells"
  "$PSTRIPACK" -q triangulate nodes.txt -o mesh.geojson
  refuses 1 "meshes are read from UGRID, MPAS and OFF, \`plot\` also takes the cells of \`pstripack voronoi\`" plot mesh.geojson -o c.svg
  printf 'lon,lat,mag,place\n0,0,1,a\n90,0,2,b\n180,0,3,a\n270,0,4,b\n0,90,5,a\n0,-90,,\n' > quakes.csv
  "$PSTRIPACK" -q plot quakes.csv --what cells --colour mag -o mag.svg
  grep -q '>mag<' mag.svg && grep -q '>no value: 1 cell<' mag.svg || fail "no legend of mag"
  "$PSTRIPACK" -q plot quakes.csv --what cells --colour place -o place.svg
  grep -q '>a (3)<' place.svg && grep -q '>b (2)<' place.svg || fail "no legend of place"
  refuses 1 "place is a column of words: say --what cells" plot quakes.csv -o c.svg --colour place
  refuses 2 "degree is a property of nodes: say --what cells" plot nodes.txt -o c.svg --colour degree
  refuses 1 "no/such/folder/c.svg: cannot be written: No such file" plot nodes.txt -o no/such/folder/c.svg
  refuses 1 "/dev/full: cannot be written: No space left" plot nodes.txt -o /dev/full --to svg
  "$PSTRIPACK" -q points fibonacci 410000 -o many.raw
  refuses 1 "nodes are in view, at most 200,000 can be drawn: zoom in, for example by --view orthographic:0,30 --zoom" \
    plot many.raw --from raw --coordinates xyz -q -o c.svg
  echo 'export { WebGLRenderer };' > module.js
  for option in "--view lonlat" "--width 500"; do
    # shellcheck disable=SC2086
    refuses 2 "a globe has no --view lonlat, --box, --dots or --width" plot nodes.txt -o c.html $option
  done
  refuses 2 "only a globe, FILE.html, needs three.js" plot nodes.txt -o c.svg --three-file module.js
  refuses 1 "no.js: cannot be opened: No such file or directory: globes need three.js (Debian: libjs-three" \
    plot nodes.txt -o c.html --three-file no.js
  refuses 1 "module.js: not three.js as one script" plot nodes.txt -o c.html --three-file module.js
  PSTRIPACK_THREE=module.js refuses 1 "module.js: not three.js as one script" plot nodes.txt -o c.html
  printf '1 0 0\n0 1 0\n0 0 1\n' > three.txt
  "$PSTRIPACK" -q plot three.txt --what cells -o lunes.svg
  [ ! -e c.svg ] && [ ! -e c.html ] && [ ! -e b.png ] || fail "a picture of a failed run"
  ;;

scvt)
  "$PSTRIPACK" scvt 300 --density bump --evaluations 30 --tolerance 1e-6 -o direct.nodes.nc 2> err
  grep -q '^pstripack: 300 generators, 3[0-9] evaluations, NOT converged to 1e-06: gradient .*, energy .*; iterating .* s; .*writing .* s$' err ||
    fail "$(cat err)"
  grep -q '^pstripack: cells by sides: .*; angles .* to .* degrees; neighbouring areas up to .* : 1; .* triangles .* hold their circumcentre$' err ||
    fail "$(cat err)"
  # A run that is cut short and continued from its checkpoint gives the same bytes: cut within the first steps, with some
  # and with all pairs of the quasi-Newton method, and from two formats.
  for run in 2:checkpoint.nc 5:checkpoint.ugrid.nc 11:checkpoint.nc; do
    checkpoint=${run#*:}
    "$PSTRIPACK" -q scvt 300 --density bump --evaluations 14 --tolerance 1e-6 --checkpoint $checkpoint --every ${run%:*} -o short.mpas.nc
    "$PSTRIPACK" scvt --start $checkpoint --evaluations 30 --tolerance 1e-6 -o resumed.nodes.nc 2> err
    grep -q " 3[0-9] evaluations, " err || fail "$(cat err)"
    same direct.nodes.nc resumed.nodes.nc
    [ "$("$PSTRIPACK" -q convert $checkpoint -o - --to xyz | wc -l)" = 300 ] || fail "$checkpoint is not whole"
  done
  # Without the pairs the run starts new ones; evaluations are counted from where the other run ended.
  "$PSTRIPACK" scvt --start short.mpas.nc --evaluations 200 --tolerance 1e-4 -o resumed.nodes.nc 2> err
  grep -q " evaluations, converged to 0.0001: " err || fail "$(cat err)"
  "$PSTRIPACK" scvt --start direct.nodes.nc --evaluations 12 --tolerance 1e-6 -o again.nodes.nc 2> err
  grep -q "none was left to do" err || fail "$(cat err)"
  same direct.nodes.nc again.nodes.nc
  # With another density the pairs are useless; the run still converges.
  "$PSTRIPACK" scvt --start checkpoint.nc --density bump:0,0,30,10,2 --evaluations 1e3 -o other.off 2> err
  grep -q " evaluations, converged to 0.0001: " err || fail "$(cat err)"
  # Lloyd's method has no memory: it also continues from its output.
  "$PSTRIPACK" -q scvt 300 --method lloyd --first random --evaluations 12 -o lloyd.nodes.nc
  "$PSTRIPACK" -q scvt 300 --method lloyd --first random --evaluations 9 --checkpoint checkpoint.nc --every 4 -o short.ugrid.nc
  for start in checkpoint.nc short.ugrid.nc; do
    "$PSTRIPACK" scvt --start $start --method lloyd --evaluations 12 -o resumed.nodes.nc 2> err
    grep -q " 12 evaluations, " err || fail "$(cat err)"
    same lloyd.nodes.nc resumed.nodes.nc
  done
  # Each file has the command, and before it the history of the start.
  if command -v ncdump > /dev/null; then
    for file in checkpoint.nc short.ugrid.nc short.mpas.nc resumed.nodes.nc; do
      ncdump -h $file | grep -q ':history = "pstripack scvt ' || fail "$file: no command"
    done
    ncdump -h resumed.nodes.nc | tr -d '\n' | grep -q 'scvt --start short.ugrid.nc .*scvt 300 --method lloyd' || fail "history of the start"
  fi
  # TERM ends the iterations, also after a checkpoint; so does a limit of time. The mesh is written.
  "$PSTRIPACK" scvt 3000 --density bump --tolerance 1e-12 --checkpoint term.nc --every 1 -o term.mpas.nc 2> err &
  job=$! status=0
  for _ in $(seq 3000); do [ -e term.nc ] && break; sleep 0.02; done
  kill -TERM $job
  wait $job || status=$?
  [ $status = 143 ] || fail "status $status after TERM: $(cat err)"
  grep -q "^pstripack: 3000 generators, .* evaluations, ended by TERM, NOT converged to 1e-12, then .*: gradient " err || fail "$(cat err)"
  grep -qE "^pstripack: cells by sides: .* (all triangles hold their|triangles do not hold their|1 triangle does not hold its) circumcentre$" err || fail "$(cat err)"
  "$PSTRIPACK" -q info term.mpas.nc > info
  "$PSTRIPACK" scvt 3000 --density bump --tolerance 1e-12 --time-limit 0.1 -o limit.off 2> err
  grep -q " ended by --time-limit, NOT converged to 1e-12: gradient " err || fail "$(cat err)"
  # Formats without density, other threads, a tolerance that is reached.
  "$PSTRIPACK" -q --threads 3 scvt 300 --density bump --evaluations 30 --tolerance 1e-6 -o threads.txt
  "$PSTRIPACK" -q convert direct.nodes.nc -o direct.txt
  cmp direct.txt threads.txt
  "$PSTRIPACK" scvt 50 --tolerance 0.1 -o loose.off 2> err
  grep -q " evaluations, converged to 0.1: " err || fail "$(cat err)"
  # First generators, by option and by number.
  for first in front levels random; do "$PSTRIPACK" -q scvt 3e3 --first $first --evaluations 1 --tolerance 0.01 -o $first.txt; done
  "$PSTRIPACK" -q scvt 3000 --evaluations 1 --tolerance 0.01 -o by_number.txt
  cmp by_number.txt front.txt
  "$PSTRIPACK" scvt 10242 --evaluations 0 -o ten.nodes.nc 2> err
  grep -q "^pstripack: N = 10 4^5 + 2: with --first levels all cells but 12 pentagons are hexagons$" err || fail "$(cat err)"
  "$PSTRIPACK" scvt 10242 --first levels -o ten.off 2> err
  grep -q "cells by sides: 5: 12, 6: 10230; " err || fail "$(cat err)"
  for other in 10241 "10242 --first front" "10242 --density bump"; do
    # shellcheck disable=SC2086
    "$PSTRIPACK" scvt $other --evaluations 0 -o ten.nodes.nc 2> err
    if grep -q levels err; then fail "$other: $(cat err)"; fi
  done
  if cmp -s front.txt levels.txt || cmp -s levels.txt random.txt; then fail "--first has no effect"; fi
  # A density in a file, here constant; the output stores the file's name.
  "$PSTRIPACK" -q points latlon 100 | sed 's/$/ 2/' > two.txt
  "$PSTRIPACK" -q points random 300 -o start.txt
  "$PSTRIPACK" -q scvt --start start.txt --density-file two.txt --evaluations 5 -o file.nodes.nc
  "$PSTRIPACK" -q scvt --start start.txt --evaluations 5 -o constant.nodes.nc
  for run in file constant; do "$PSTRIPACK" -q convert $run.nodes.nc -o - --to lonlat | cut -c 1-9 > $run.txt; done
  cmp file.txt constant.txt
  "$PSTRIPACK" -q scvt 300 --density-file two.txt --first random --evaluations 6 --checkpoint checkpoint.nc --every 1 -o six.nodes.nc
  "$PSTRIPACK" -q scvt --start checkpoint.nc --evaluations 8 -o more.nodes.nc
  "$PSTRIPACK" -q scvt 300 --density-file two.txt --first random --evaluations 8 -o eight.nodes.nc
  same more.nodes.nc eight.nodes.nc
  # Of any size (issue 39: "converged", gradient nan). Generators that are copies of poles up to rounding.
  for value in 1e-200 1e308; do
    sed "s/2$/$value/" two.txt > size.txt
    "$PSTRIPACK" scvt 100 --density-file size.txt --tolerance 1e-2 -o size.nodes.nc 2> err
    grep -q "converged to 0.01: gradient 0.00[0-9]*, energy [0-9]" err || fail "density $value: $(cat err)"
  done
  { octahedron; echo 6.1e-17 0 1; echo 0 6.1e-17 1; echo -6.1e-17 0 1; echo 0 -6.1e-17 1; } > copies.txt
  "$PSTRIPACK" scvt --start copies.txt --tolerance 1e-2 -o copies.nodes.nc 2> err
  grep -q "10 generators, .* converged to 0.01: gradient 0.00[0-9]*, energy 2" err || fail "copies: $(cat err)"
  rm two.txt
  refuses 1 "two.txt: cannot be opened" scvt --start file.nodes.nc --evaluations 7 -o failed.nc
  # Meshes for MPAS are well centred, others on request.
  bump="scvt 1000 --density bump:0,30,30,10,4 --tolerance 1e-3"
  # shellcheck disable=SC2086
  "$PSTRIPACK" $bump -o plain.nodes.nc 2> err
  grep -q ", converged to 0.001: gradient" err || fail "$(cat err)"
  grep -q "; [1-9] triangles do not hold their circumcentre$" err || fail "$(cat err)"
  # shellcheck disable=SC2086
  "$PSTRIPACK" $bump -o centred.mpas.nc 2> err
  grep -q ", converged to 0.001, then [0-9]* generators moved for their triangles' circumcentres: gradient" err || fail "$(cat err)"
  grep -q " to 8[34].[0-9] degrees; .* : 1; all triangles hold their circumcentre$" err || fail "$(cat err)"
  # shellcheck disable=SC2086
  "$PSTRIPACK" -q $bump --well-centred --strict -o centred.nodes.nc
  for run in centred.mpas centred.nodes; do "$PSTRIPACK" -q convert $run.nc -o $run.txt; done
  cmp centred.mpas.txt centred.nodes.txt
  "$PSTRIPACK" scvt 500 --first random --evaluations 1 --well-centred -o failed.off 2> err
  left="[0-9]* triangles do not hold their circumcentre, the first at lon [-.0-9]* lat [-.0-9]*, also after [0-9]* generators were moved: try"
  grep -q "^pstripack: $left" err || fail "$(cat err)"
  rm failed.off
  refuses 1 "triangles do not hold their circumcentre, the first at lon" -q scvt 500 --first random --evaluations 1 --well-centred --strict -o written.off
  refuses 1 "not converged to 0.0001" -q scvt 500 --evaluations 1 --strict -o written.off
  rm written.off
  # Widths in km give N: 4 pi R^2 / (sqrt(3)/2 width^2). A given N scales them.
  "$PSTRIPACK" scvt --width 1000km --tolerance 0.1 -o width.nodes.nc 2> err
  grep -q "^pstripack: the widths give 589 cells$" err || fail "$(cat err)"
  "$PSTRIPACK" -q scvt 589 --tolerance 0.1 -o n.nodes.nc
  same width.nodes.nc n.nodes.nc
  "$PSTRIPACK" scvt --width 500000m --radius 3185610 --tolerance 0.1 -o half.nodes.nc 2> err
  grep -q "^pstripack: the widths give 589 cells$" err || fail "$(cat err)"
  "$PSTRIPACK" scvt 147 --width 1000 --tolerance 0.1 -o coarse.nodes.nc 2> err
  grep -q "the widths give 589 cells; 147 are asked for: widths times 2.002$" err || fail "$(cat err)"
  # Discs and bands.
  disc="disc:500,2000,3000,1000,20,40"
  "$PSTRIPACK" scvt --width $disc --evaluations 6 --checkpoint checkpoint.nc --every 1 -o six.nodes.nc 2> err
  grep -q "^pstripack: transition made 11250 km long, so that widths change by at most 0.2 km per km$" err || fail "$(cat err)"
  grep -q "^pstripack: the widths give 618 cells$" err || fail "$(cat err)"
  "$PSTRIPACK" -q scvt --width $disc --evaluations 8 -o eight.nodes.nc
  "$PSTRIPACK" -q scvt --start checkpoint.nc --evaluations 8 -o more.nodes.nc
  same more.nodes.nc eight.nodes.nc
  # Polygons with a width each.
  region='{"type": "Feature", "properties": {"width": 400, "transition": "2000"}, "geometry": {"type": "Polygon", "coordinates": [[[0, 20], [60, 20], [60, 50], [0, 50], [0, 20]]]}}'
  echo "{\"type\": \"FeatureCollection\", \"features\": [$region]}" > region.json
  "$PSTRIPACK" scvt --width 1000km --width-region region.json --evaluations 3 --checkpoint region.nc --every 1 -o region.nodes.nc 2> err
  grep -q "^pstripack: widths limited to a change of 0.2 km per km: .* values lowered" err || fail "$(cat err)"
  grep -q "^pstripack: the widths give 808 cells$" err || fail "$(cat err)"
  echo "$region" > region.json
  "$PSTRIPACK" -q scvt --start region.nc --evaluations 5 -o more.nodes.nc
  "$PSTRIPACK" -q scvt --width 1000km --width-region region.json --evaluations 5 -o region.nodes.nc
  same more.nodes.nc region.nodes.nc
  if command -v ncgen > /dev/null; then  # Debian: netcdf-bin
    # cellWidth(lat, lon) as mpas_tools writes it: no units, the first meridian repeated. Here 1000 km everywhere.
    widths_file() { # NAME UNITS VALUES: on 7 rows and 9 columns
      { echo "netcdf w { dimensions: lat = 7; lon = 9; variables: double lat(lat), lon(lon), cellWidth(lat, lon); $2"
        echo "data: lat = -90,-60,-30,0,30,60,90; lon = -180,-135,-90,-45,0,45,90,135,180; cellWidth = $3; }"; } |
        ncgen -o "$1" -
    }
    all() { for i in $(seq 63); do printf '%s%s' "$(test $i = 1 || echo ,)" "$1"; done; }
    widths_file same.nc "" "$(all 1000)"
    "$PSTRIPACK" scvt --width-file same.nc --tolerance 0.01 -o same.mpas.nc 2> err
    grep -q "^pstripack: the widths give 589 cells$" err || fail "$(cat err)"
    widths_file metres.nc 'cellWidth:units = "m";' "$(all 1e6)"
    "$PSTRIPACK" -q scvt --width-file metres.nc --tolerance 0.01 -o metres.mpas.nc
    "$PSTRIPACK" -q convert same.mpas.nc -o same.txt
    "$PSTRIPACK" -q convert metres.mpas.nc -o metres.txt
    cmp same.txt metres.txt
    # A run continues with the widths of its file.
    "$PSTRIPACK" scvt --start same.mpas.nc --tolerance 1e-3 -o more.nodes.nc 2> err
    grep -q "converged to 0.001" err || fail "$(cat err)"
    # A step is limited to --grade, also in a run that continues.
    step() { for i in $(seq 63); do printf '%s%s' "$(test $i = 1 || echo ,)" $((i > 27 ? 1000 : 4000)); done; }
    widths_file step.nc "" "$(step)"
    "$PSTRIPACK" scvt --width-file step.nc --tolerance 0.1 -o step.nodes.nc 2> err
    limited="^pstripack: widths limited to a change of"
    grep -q "$limited 0.2 km per km: 17 of 42 values lowered, by up to 2333 km (lon -180 lat -30)$" err || fail "$(cat err)"
    "$PSTRIPACK" -q scvt --width-file step.nc --grade 0.1 --radius 5e6 --evaluations 6 --checkpoint checkpoint.nc --every 1 -o six.nodes.nc
    "$PSTRIPACK" scvt --start checkpoint.nc --evaluations 8 -o more.nodes.nc 2> err
    grep -q "$limited 0.1 km per km: 17 of 42 values lowered, by up to 2738 km" err || fail "$(cat err)"
    "$PSTRIPACK" -q scvt --width-file step.nc --grade 0.1 --radius 5e6 --evaluations 8 -o eight.nodes.nc
    same more.nodes.nc eight.nodes.nc
  fi
  # A density on a grid.
  "$PSTRIPACK" -q points latlon 3000 -o - --to lonlat | awk '{ print $0, 2 + sin($2 / 57.29577951308232) }' > values.txt
  "$PSTRIPACK" -q interpolate values.txt --to-grid 36x72 -o grid.nc
  "$PSTRIPACK" scvt 300 --density-file grid.nc --variable value -o grid.mpas.nc 2> err
  grep -q " converged to 0.0001: " err || fail "$(cat err)"
  # A limited area: the same bytes in pieces; checkpoints have all generators.
  "$PSTRIPACK" scvt --width 300km --region 10,50,10,50 --evaluations 3 --checkpoint area.nc --every 1 -o area.nodes.nc 2> err
  grep -q "the widths give about 21[0-9] cells in the region" err || fail "no number of cells: $(cat err)"
  "$PSTRIPACK" -q scvt --start area.nc --evaluations 5 -o more.nodes.nc
  "$PSTRIPACK" -q scvt --width 300km --region 10,50,10,50 --evaluations 5 -o area.nodes.nc
  same more.nodes.nc area.nodes.nc
  ;;

bad_scvt)
  refuses 2 "give either N or widths, for new generators, or --start FILE" scvt -o failed.off
  octahedron > start.txt
  refuses 2 "give either N" scvt 10 --start start.txt -o failed.off
  refuses 2 "density 'potato': expected constant, bump or bump:LON,LAT" scvt 10 --density potato -o failed.off
  refuses 2 "excludes" scvt 10 --density bump --density-file start.txt -o failed.off
  refuses 2 "no format has this suffix" scvt 10 -o failed.xxx
  refuses 2 "--first: 'middle' is none of front, levels, random" scvt 10 --first middle -o failed.off
  refuses 2 "--method: 'steepest' is none of lloyd, newton" scvt 10 --method steepest -o failed.off
  refuses 2 "'1.5' is not a whole number" scvt 1.5 -o failed.off
  refuses 1 "no/folder/failed.off: cannot be written" scvt 10 -o no/folder/failed.off
  refuses 1 "no/checkpoint.nc: cannot be written" scvt 10 --checkpoint no/checkpoint.nc -o failed.off
  "$PSTRIPACK" -q points hemisphere 30 -o half.txt
  refuses 1 "half.txt: the generators lie in one hemisphere" scvt --start half.txt -o failed.off
  sed 's/$/ 1/' half.txt > half_density.txt
  refuses 1 "half_density.txt: the density is not known on the whole sphere: the nodes leave out lon " scvt 10 --density-file half_density.txt -o failed.off
  { octahedron; octahedron; } > twice.txt
  refuses 1 "twice.txt: node 1 (line 1) and node 7 (line 7) are in the same place" scvt --start twice.txt -o failed.off
  "$PSTRIPACK" -q scvt --start twice.txt --duplicates first -o once.off
  octahedron | sed '4s/$/ 0/; 4!s/$/ 1/' > zero.txt
  refuses 1 "zero.txt: node 4 (line 4): density 0: must be positive" scvt 10 --density-file zero.txt -o failed.off
  octahedron | sed '/-/s/$/ 1e-290/; /-/!s/$/ 1e290/' > ratio.txt
  refuses 1 " elsewhere: the ratio is too large" scvt 10 --density-file ratio.txt -o failed.off
  octahedron | sed 's/$/ 1.7e308/' > huge.txt
  refuses 1 "the energy is beyond the largest double" scvt 4 --density-file huge.txt -o failed.off
  refuses 2 "--tolerance: 'nan' is not a number of at least 0" scvt 10 --tolerance nan -o failed.off
  octahedron | sed 's/$/ 1/' > one.txt
  "$PSTRIPACK" -q interpolate one.txt --to-grid 9x9 --box 0,90,0,90 -o regional.nc
  refuses 1 "regional.nc: the grid leaves out 280 degrees of longitude: a density must cover the sphere" \
    scvt 10 --density-file regional.nc --variable value -o failed.off
  printf '100 80 60\n190 0 60\n10 -80 60\n' > width.txt
  refuses 2 "excludes" scvt --width 60km --width-file start.txt -o failed.off
  refuses 1 "width.txt: expected widths on a grid, say cellWidth(lat, lon) in NetCDF" scvt --width-file width.txt -o failed.off
  if command -v ncgen > /dev/null; then
    of_widths() { # NAME ATTRIBUTE VALUES
      { echo "netcdf w { dimensions: lat = 3; lon = 4; variables: double lat(lat), lon(lon), cellWidth(lat, lon); $2"
        echo "data: lat = -90, 0, 90; lon = 0, 90, 180, 270; cellWidth = $3; }"; } | ncgen -o "$1" -
    }
    of_widths metres.nc "" "1e6,1e6,1e6,1e6,1e6,1e6,1e6,1e6,1e6,1e6,1e6,1e6"
    of_widths hole.nc "" "NaN,9,9,NaN,9,9,9,9,9,9,9,9"
    of_widths missing.nc "cellWidth:_FillValue = -999.;" "9,9,-999,9,9,9,9,9,9,9,9,9"
    of_widths negative.nc "" "9,9,9,9,9,-3,0,9,9,9,9,9"
    of_widths miles.nc 'cellWidth:units = "miles";' "9,9,9,9,9,9,9,9,9,9,9,9"
    refuses 1 "metres.nc: the median width is 1e+06 km: if these are not km, say so: ncatted -a units,cellWidth,c,c,m metres.nc" \
      scvt --width-file metres.nc -o failed.off
    refuses 1 "hole.nc: node 1, lon 0 lat -90: there is no width, at 2 of 12 places: fill the holes of the map" \
      scvt --width-file hole.nc -o failed.off
    refuses 1 "missing.nc: node 3, lon 180 lat -90: there is no width, at 1 of 12 places" scvt --width-file missing.nc -o failed.off
    refuses 1 "negative.nc: node 6, lon 90 lat 0: width -3, one of 2 of 12 that are not positive and finite" \
      scvt --width-file negative.nc -o failed.off
    refuses 1 "miles.nc: variable cellWidth: units 'miles'; expected km or m" scvt --width-file miles.nc -o failed.off
  fi
  if [ "$(awk '/MemTotal/ { print $2 }' /proc/meminfo)" -lt 300000000 ]; then
    refuses 1 "353404399 generators need about 265 GB, this machine has " -q scvt --width 1.291km -o failed.off
  fi
  for width in 0 -60km nankm 60miles km; do
    refuses 2 "'$width' is no width: expected, say, 60km" scvt "--width=$width" -o failed.off
  done
  refuses 2 "width 'band:1,2,3,4': expected five numbers: INNER,OUTER,RADIUS,TRANSITION,LAT" scvt --width band:1,2,3,4 -o failed.off
  polygon() { echo "{\"type\": \"Feature\", \"properties\": {$1}, \"geometry\": {\"type\": \"Polygon\", \"coordinates\": [$2]}}" > region.json; }
  box="[[0, 0], [9, 0], [9, 9], [0, 9], [0, 0]]"
  regions="scvt --width 900km --width-region region.json -o failed.off"
  for bad in '' '"width": 0' '"width": "wide"' '"width": null'; do
    polygon "$bad" "$box"
    # shellcheck disable=SC2086
    refuses 1 "region.json: feature 1: it needs the property width, in km and above 0" $regions
  done
  polygon '"width": 30, "transition": -1' "$box"
  # shellcheck disable=SC2086
  refuses 1 "region.json: feature 1: its property transition must be in km, and not negative" $regions
  polygon '"width": 3000' "$box"
  # shellcheck disable=SC2086
  refuses 1 "region.json: feature 1: it is smaller than a cell of 3000 km: enlarge it, make its width smaller, or use a disc" $regions
  polygon '"width": 30' "[[170, 0], [-170, 0], [-170, 9], [170, 0]]"
  # shellcheck disable=SC2086
  refuses 1 "feature 1: its side from longitude 170 to -170 goes around the globe: cut the polygon at 180, or continue beyond" $regions
  polygon '"width": 30' "[[0, 0], [9, 0], [9, 91], [0, 0]]"
  # shellcheck disable=SC2086
  refuses 1 "feature 1: latitude 91 is beyond the pole" $regions
  echo '{"type": "Point", "coordinates": [0, 0]}' > region.json
  # shellcheck disable=SC2086
  refuses 1 "region.json: not GeoJSON of polygons: the type is 'Point', expected FeatureCollection, Feature, Polygon or MultiPolygon" $regions
  refuses 2 "--width-region: say also --width, that of the cells elsewhere" scvt --width-region region.json 9 -o failed.off
  refuses 2 "excludes" scvt --width 60km --density bump -o failed.off
  refuses 2 "'0' is not a finite number above 0" scvt --width 60km --grade 0 -o failed.off
  refuses 2 "'nan' is not a number of metres above 0" scvt --width 60km --radius nan -o failed.off
  refuses 1 "the widths give 0.000589 cells, not 4 to 357913943: widths are in km, --radius in metres" \
    scvt --width 1e6 -o failed.off
  # Widths are no density, whatever the file says of itself.
  for name in cellWidth width resolution; do
    { echo "lon lat $name"; printf '0 90 60\n0 0 60\n90 0 60\n180 0 60\n-90 0 60\n0 -90 60\n'; } > $name.txt
    refuses 1 "$name.txt: $name is a width, not a density (width^-4): say --width-file in place of --density-file" \
      scvt 10 --density-file $name.txt --variable $name -o failed.off
  done
  [ ! -e failed.off ] || fail "failed.off was written"
  # Limited areas.
  polygon() { printf '{"type":"Polygon","coordinates":%s}' "$1" > area.json; }
  "$PSTRIPACK" -q points fibonacci 600 -o - --to xyz | "$PSTRIPACK" -q triangulate - -o sphere.nc
  "$PSTRIPACK" -q convert sphere.nc --region circle:500,0,0 -o cells.mpas.nc
  "$PSTRIPACK" -q points hemisphere 300 -o - | "$PSTRIPACK" -q triangulate - -o half.nc
  polygon '[[[0,0],[40,0],[40,40],[0,40],[0,0]],[[10,10],[20,10],[20,20],[10,10]]]'
  refuses 1 "area.json: feature 1: a hole, at lon 10 lat 10: a limited area has one boundary: leave out all rings but the first" \
    scvt --width 300km --region area.json -o failed.nc
  polygon '[[[0,0],[40,40],[40,0],[0,40],[0,0]]]'
  refuses 1 "area.json: feature 1: side 1 from 0,0 to 40,40 crosses or lies on side 3 from 40,0 to 0,40: mend the polygon" \
    convert sphere.nc --region area.json -o failed.nc
  polygon '[[[0,0],[0.7,0],[0.7,0.7],[0,0]]]'
  refuses 1 "within pi/2: GeoJSON is in degrees; if these are degrees, say --units degrees" scvt --width 10km --region area.json -o failed.nc
  refuses 1 "area.json: no cell has its centre in the region; those at lon " convert sphere.nc --units degrees --region area.json -o failed.nc
  refuses 2 "'0,0.7,0,0.7': these may be radians" scvt --width 10km --region 0,0.7,0,0.7 -o failed.nc
  refuses 1 "circle:3,0,0: the region is smaller than a cell of 10 km: enlarge it" scvt --width 10km --region circle:3,0,0 -o failed.nc
  refuses 2 "expected circle:KM,LON,LAT: a radius from 0 to 20015 km" convert sphere.nc --radius 6371000 --to mpas --region circle:20020,0,0 -o failed.nc
  refuses 2 "there is no file 'potato': expected WEST,EAST,SOUTH,NORTH, circle:KM,LON,LAT, or a file" convert sphere.nc --region potato -o failed.nc
  polygon '[[[0,0],[20,0],[20,20],[0,0]]]'
  sed 's/Polygon/MultiPolygon/; s/:\[\[/:[[[/; s/\]\]}/]],[[[90,0],[110,0],[100,20],[90,0]]]]}/' area.json > two.json
  refuses 1 "two.json: two parts that do not touch, at lon " convert sphere.nc --region two.json -o failed.nc
  refuses 1 " the mesh ends within 7 layers of cells around the region: make the region smaller" convert half.nc --region circle:2000,0,90 -o failed.nc
  refuses 1 "cells.mpas.nc: cellsOnVertex has a boundary already" convert cells.mpas.nc --region circle:500,0,0 -o failed.nc
  refuses 2 "--region: say also the widths there" scvt 100 --region circle:500,0,0 -o failed.nc
  ;;

interpolate)
  octahedron | sed '1,3s/$/ 1/; 4,6s/$/ 3/' > values.txt
  printf '0 0\n45 0\n90 90\n225 0\n' > places.txt
  for method in linear natural; do
    "$PSTRIPACK" interpolate values.txt --to-points places.txt --method $method -o out.txt 2> err
    grep -q '^pstripack: 6 nodes (text, x y z), 4 places, 0 outside the nodes; ' err || fail "$(cat err)"
    awk '!/#/ { printf "%.6g ", $3 }' out.txt > got
    expected="1 1 1 3 "
    [ $method = linear ] || expected="1 1.08915 1 2.91085 "  # the nodes across the arc have a share
    [ "$(cat got)" = "$expected" ] || fail "$method: $(cat out.txt)"
  done
  # The nodes themselves, to the last bit; through a pipe; lon lat and a column; threads.
  "$PSTRIPACK" -q points random 300 -o nodes.txt
  awk '{ printf "%s %.17g\n", $0, $1 * $2 + $3 }' nodes.txt > values.txt
  awk '{ printf "%.17g\n", $4 }' values.txt > expected
  "$PSTRIPACK" -q interpolate - --to-points nodes.txt --method natural -o - < values.txt | awk '!/#/ { printf "%.17g\n", $3 }' > got
  cmp expected got
  "$PSTRIPACK" -q --threads 1 interpolate values.txt --grid-step 5 --method natural -o one.txt
  "$PSTRIPACK" -q --threads 3 interpolate values.txt --to-grid 36x72 --method natural -o three.txt
  cmp one.txt three.txt
  [ "$(sed -n 2p one.txt | cut -d' ' -f1,2)" = "-177.5 -87.5" ] || fail "the first cell: $(sed -n 2p one.txt)"
  "$PSTRIPACK" -q convert nodes.txt -o - --to lonlat | awk '{ print $0, "7", NR }' > columns.txt
  "$PSTRIPACK" -q interpolate columns.txt --coordinates lonlat --variable 4 --to-points nodes.txt -o out.txt
  awk '!/#/ && ($3 - NR + 1) ^ 2 > 1e-16' out.txt > wrong
  [ ! -s wrong ] || fail "$(cat wrong)"
  awk '{ print $1, $2, NR, 7 }' columns.txt > third.txt  # the value is in column 3, so the first two are lon lat
  "$PSTRIPACK" -q interpolate third.txt --variable 3 --to-points nodes.txt -o - | cmp - out.txt
  # Outside of a region.
  "$PSTRIPACK" -q points cap:0.3 100 | awk '{ print $0, NR }' > region.txt
  "$PSTRIPACK" interpolate region.txt --grid-step 10 -o missing.txt 2> err
  outside=$(sed -n 's/.* places, \([0-9]*\) outside the nodes.*/\1/p' err)
  [ "$outside" -gt 600 ] && [ "$(grep -c ' nan$' missing.txt)" = "$outside" ] || fail "$(cat err)"
  "$PSTRIPACK" -q interpolate region.txt --grid-step 10 --outside nearest -o nearest.txt
  ! grep nan nearest.txt || fail "a value is missing"
  "$PSTRIPACK" -q interpolate region.txt --to-grid 2x3 --box 10,40,-20,0 -o grid.txt --outside nearest
  [ "$(awk '!/#/ { print $1, $2 }' grid.txt | tr '\n' ',')" = "15 -15,25 -15,35 -15,15 -5,25 -5,35 -5," ] || fail "$(cat grid.txt)"
  # The nearest node, also beyond the region: its value, number and distance.
  { echo "lon,lat,v"; printf '%s\n' 10,0,1 ,0,9 12,0,2 10,2,3 12,0,2; } > few.csv
  printf 'lon,lat,nearest_km\n10,-1,a\n100,0,b\n' > two.csv
  "$PSTRIPACK" -q interpolate few.csv --units degrees --skip-missing --duplicates first --method nearest --nearest-node --to-points two.csv -o out.csv
  cut -d , -f 1-4,6 out.csv | tail -n +2 | tr '\n' ' ' > got
  [ "$(cat got)" = "10,-1,1,1,a 100,0,2,3,b " ] || fail "$(cat out.csv)"
  awk -F , 'NR == 2 && ($5 - 111.19492664455873) ^ 2 > 1e-20 || NR == 3 && ($5 - 88 * 111.19492664455873) ^ 2 > 1e-18' out.csv > wrong
  [ ! -s wrong ] || fail "$(cat wrong)"
  "$PSTRIPACK" -q interpolate few.csv --units degrees --skip-missing --duplicates first --grid-step 90 --nearest-node -o out.txt
  [ "$(head -n 1 out.txt)" = "# lon lat v nearest_node nearest_km [km]" ] || fail "$(head -n 1 out.txt)"
  # Missing values and duplicates.
  { sed -n 1p region.txt; sed '5s/[^ ]*$/nan/' region.txt; } > odd.txt
  "$PSTRIPACK" -q points cap:0.3 100 -o places.txt
  "$PSTRIPACK" interpolate odd.txt --skip-missing --duplicates first --to-points places.txt -o out.txt 2> err
  grep -q "odd.txt: 1 node without value left out" err || fail "$(cat err)"
  grep -q "odd.txt: 1 node dropped that coincides with earlier ones" err || fail "$(cat err)"
  awk '!/#/ && NR != 6 && $3 != NR - 1' out.txt > wrong  # all but the fifth, which had none
  [ ! -s wrong ] || fail "$(cat wrong)"
  ;;

bad_values)
  octahedron | sed '2s/$/ nan/; 2!s/$/ 1/' > values.txt
  refuses 1 "values.txt: node 2 (line 2) has no value: remove it, or say --skip-missing" interpolate values.txt --grid-step 30 -o failed.txt
  refuses 2 "give one of --to-points, --to-grid, --grid-step" interpolate values.txt -o failed.txt
  refuses 2 "give one of --to-points, --to-grid, --grid-step" interpolate values.txt --grid-step 30 --to-grid 2x2 -o failed.txt
  refuses 2 "--grid-step: '1km' is not a number of degrees above 0" interpolate values.txt --grid-step 1km -o failed.txt
  refuses 2 "--output or --weights is required" interpolate values.txt --grid-step 30
  refuses 2 "--weights: are of one node for each place" interpolate values.txt --grid-step 30 --duplicates mean --weights failed.nc
  printf '10 20 1\n30 40 1\n' > three.txt
  refuses 1 "three.txt: has 3 columns: say --coordinates lonlat or xyz" interpolate three.txt --grid-step 30 --weights failed.nc
  refuses 2 "--nearest-node: is for columns of the output" interpolate values.txt --grid-step 30 --nearest-node --weights failed.nc
  refuses 2 "180 degrees are not a multiple of 7" interpolate values.txt --grid-step 7 -o failed.txt
  refuses 2 "--grid-step: '-1' is not a number of degrees above 0" interpolate values.txt --grid-step -1 -o failed.txt
  refuses 2 "'180' is not 2 numbers" interpolate values.txt --to-grid 180 -o failed.txt
  refuses 2 "expected NLATxNLON" interpolate values.txt --to-grid 0x10 -o failed.txt
  refuses 2 "expected WEST,EAST,SOUTH,NORTH" interpolate values.txt --grid-step 1 --box 0,10,20,10 -o failed.txt
  refuses 2 "neither .nc nor .txt nor .csv: give --to" interpolate values.txt --grid-step 30 -o failed.xxx
  octahedron > bare.txt
  refuses 1 "may be degrees or radians" interpolate bare.txt --grid-step 30 -o failed.txt
  printf '10 20\n30 40\n' > two.txt
  refuses 1 "two.txt: has 2 columns; expected 'lon lat value' or 'x y z value'" interpolate two.txt --grid-step 30 -o failed.txt
  { octahedron; octahedron; } | sed 's/$/ 1/' > twice.txt
  refuses 1 "are in the same place: remove one, or say --duplicates first" interpolate twice.txt --grid-step 30 -o failed.txt
  "$PSTRIPACK" -q points cap:0.3 100 | sed 's/$/ 1/' > region.txt
  refuses 1 "places lie outside the nodes of region.txt, the first is place 1, lon -165 lat -75: --outside missing or nearest" \
    interpolate region.txt --grid-step 30 --outside error -o failed.txt
  refuses 1 "no.txt: cannot be opened" interpolate region.txt --to-points no.txt -o failed.txt
  [ ! -e failed.txt ] || fail "failed.txt was written"
  ;;

netcdf_values)
  values_of() { awk '!/#/ { print $3 }' "$1"; }
  "$PSTRIPACK" -q points random 200 | awk '{ printf "%s %.17g\n", $0, 280 + $3 }' > values.txt
  # To a grid, and from the grid in NetCDF to points and nodes.
  "$PSTRIPACK" -q interpolate values.txt --grid-step 2 -o grid.nc
  "$PSTRIPACK" -q interpolate values.txt --grid-step 2 -o grid.txt
  awk '!/#/ { print $1, $2 }' grid.txt > places.txt
  values_of grid.txt > expected
  "$PSTRIPACK" -q interpolate grid.nc --variable value --to-points places.txt -o back.txt
  values_of back.txt | cmp expected -
  "$PSTRIPACK" -q interpolate values.txt --to-points places.txt -o points.nc
  "$PSTRIPACK" -q interpolate points.nc --variable value --to-points places.txt -o back.txt
  paste grid.txt back.txt | awk '!/#/ && ($3 - $6) ^ 2 > 1e-24' > wrong  # the places have been rounded
  [ ! -s wrong ] || fail "$(cat wrong)"
  # Values missing in the input are missing in the output.
  "$PSTRIPACK" -q points cap:0.5 100 | sed 's/$/ 1/' > region.txt
  "$PSTRIPACK" -q interpolate region.txt --grid-step 10 -o region.nc
  refuses 1 "node 1 has no value: remove it, or say --skip-missing" interpolate region.nc --variable value --grid-step 30 -o failed.nc
  "$PSTRIPACK" -q interpolate region.nc --variable value --skip-missing --grid-step 30 --outside nearest -o out.txt
  awk '!/#/ && $3 != 1' out.txt > wrong
  [ ! -s wrong ] || fail "$(cat wrong)"
  "$PSTRIPACK" -q interpolate region.nc --skip-missing --grid-step 30 --outside nearest -o only.txt  # the only variable
  cmp only.txt out.txt
  refuses 1 "there is no variable depth; say" interpolate region.nc --variable depth --grid-step 30 -o failed.nc
  refuses 1 "variable lon(lon=36): expected lon(lat=18, lon=36)" interpolate region.nc --variable lon --grid-step 30 -o failed.nc
  [ ! -e failed.nc ] || fail "failed.nc was written"
  ;;

as_given)
  # Longitudes and latitudes without exact vectors, beyond 180 degrees or in unusual notation are written as given.
  awk 'BEGIN { srand(7); for (i = 0; i < 200; ++i) printf "%.14g %.14g\n", 360 * rand(), 180 * rand() - 90 }' > nodes.lonlat
  printf '30 40\n-179.99999999999997 1e-300\n' >> nodes.lonlat
  "$PSTRIPACK" -q convert nodes.lonlat -o back.lonlat
  "$PSTRIPACK" -q convert back.lonlat -o again.lonlat
  cmp back.lonlat again.lonlat
  [ "$(tail -n 2 back.lonlat)" = "$(tail -n 2 nodes.lonlat)" ] || fail "$(tail -n 2 back.lonlat)"
  paste -d ' ' nodes.lonlat back.lonlat | awk '$1 + 0 != $3 + 0 || $2 + 0 != $4 + 0' > wrong
  [ ! -s wrong ] || fail "$(cat wrong)"
  # Also as places of interpolate, as x y z, and with the places' own columns.
  "$PSTRIPACK" -q points random 50 | sed 's/$/ 1/' > values.txt
  "$PSTRIPACK" -q interpolate values.txt --to-points back.lonlat -o places.txt
  sed 1d places.txt | cut -d ' ' -f 1,2 | cmp back.lonlat -
  { echo "x y z name"; "$PSTRIPACK" -q points random 20 --seed 3 | sed 's/$/ "a b"/'; } > places.xyz
  "$PSTRIPACK" -q interpolate values.txt --to-points places.xyz -o places.txt
  [ "$(head -n 1 places.txt)" = "# lon lat value name x y z" ] || fail "$(head -n 1 places.txt)"
  sed 1d places.txt | awk '{ print $6, $7, $8, $4, $5 }' > got
  sed 1d places.xyz | cmp got -
  # Given radians are written as degrees.
  sed 's/.*/1.1 -0.3/; 2s/.*/3 1.5/; 3s/.*/6.2 0.1/; 4,$d' nodes.lonlat > radians.txt
  "$PSTRIPACK" -q convert radians.txt --units radians -o - --to lonlat > degrees.txt
  [ "$(head -n 1 degrees.txt | cut -c 1-8)" = 63.02535 ] || fail "$(cat degrees.txt)"
  # Values through VTU and gmsh.
  printf 'lon,lat,depth,place\n30,40,7.25,a\n100,40,,b\n70,-20,-1,c\n' > table.csv
  "$PSTRIPACK" -q triangulate table.csv -o mesh.vtu
  for array in lon lat node line depth degree area area_km2 circumradius_km; do
    grep -q "<DataArray type=\"[A-Za-z0-9]*\" Name=\"$array\" format=\"ascii\">" mesh.vtu || fail "mesh.vtu has no $array"
  done
  tr '\n' ' ' < mesh.vtu | grep -q 'Name="lon" format="ascii"> 30 100 70 <' || fail "lon: $(cat mesh.vtu)"
  tr '\n' ' ' < mesh.vtu | grep -q 'Name="depth" format="ascii"> 7.25 nan -1 <' || fail "depth: $(cat mesh.vtu)"
  "$PSTRIPACK" -q triangulate table.csv -o mesh.msh
  tr '\n' ' ' < mesh.msh | grep -q '$NodeData 1 "lat" 1 0 3 0 1 3 1 40 2 40 3 -20 $EndNodeData' || fail "$(cat mesh.msh)"
  tr '\n' ' ' < mesh.msh | grep -q '$ElementData 1 "area" ' || fail "$(cat mesh.msh)"
  ;;

tables)
  # A catalogue with a byte order mark, quotes, missing values, latitude first and a duplicate.
  printf '\357\273\277time,latitude,longitude,mag,place\r\n' > quakes.csv
  printf '2020-01-01,61.2,-150.1,4.5,"10 km S of ""A"", #2"\r\n2020-01-02,40,30,3,\r\n,-10.3,170.7,,Fiji\r\n' >> quakes.csv
  printf '2020-01-04,40,30,5,"again"\r\n2020-01-05,50.1,20.3,1,e\r\n' >> quakes.csv
  refuses 1 "node 2 (line 3) and node 4 (line 5) are in the same place: remove one, or say --duplicates first" triangulate quakes.csv -o mesh.vtu
  refuses 1 "are in the same place" triangulate quakes.csv --duplicates error -o mesh.vtu
  values_of() { tr '\n' ' ' < mesh.vtu | sed "s/.*Name=\"$1\" format=\"ascii\"> \([^<]*\) <.*/\1/"; }
  for rule in first mean; do
    "$PSTRIPACK" triangulate quakes.csv --duplicates $rule -o mesh.vtu 2> err
    grep -q "quakes.csv: 1 node dropped that coincides with earlier ones" err || fail "$(cat err)"
    [ "$(values_of node)" = "1 2 3 5" ] || fail "node: $(values_of node)"
    [ "$(values_of line)" = "2 3 4 6" ] || fail "line: $(values_of line)"
    [ "$(values_of lon)" = "-150.1 30 170.7 20.3" ] || fail "lon: $(values_of lon)"
    expected="4.5 3 nan 1"
    [ $rule = first ] || expected="4.5 4 nan 1"
    [ "$(values_of mag)" = "$expected" ] || fail "mag: $(values_of mag)"
  done
  "$PSTRIPACK" -q triangulate quakes.csv --duplicates first --list-duplicates dropped.csv -o mesh.vtu
  [ "$(cat dropped.csv)" = "$(printf 'lon,lat,node,kept,line,time,mag,place\n30,40,4,2,5,2020-01-04,5,again')" ] || fail "$(cat dropped.csv)"
  "$PSTRIPACK" -q interpolate quakes.csv --variable mag --skip-missing --duplicates mean --list-duplicates dropped.geojson --to-points quakes.csv -o out.txt
  grep -q '"node":4,"kept":2,"line":5,"mag":5}.*"coordinates":\[30,40\]' dropped.geojson || fail "$(cat dropped.geojson)"
  printf '10 20\n100 40\n20 -50\n' | "$PSTRIPACK" -q triangulate - --duplicates first --list-duplicates none.csv -o mesh.off
  [ "$(wc -l < none.csv)" = 1 ] || fail "$(cat none.csv)"
  refuses 2 "--list-duplicates: lists what --duplicates first or mean drops" triangulate quakes.csv --list-duplicates none.csv -o failed.vtu
  "$PSTRIPACK" -q info quakes.csv > info.txt
  [ "$(tail -n 1 info.txt)" = "duplicate        node 2 (line 3) and node 4 (line 5)" ] || fail "$(cat info.txt)"
  "$PSTRIPACK" -q info quakes.csv --json | tr -d ' \n' > info.json
  grep -qF '"duplicate_pairs":[[2,4]]' info.json || fail "$(cat info.json)"
  # Columns by name and number; the value of interpolate.
  for columns in longitude,latitude,mag 3,2,4; do
    "$PSTRIPACK" -q interpolate quakes.csv --columns $columns --skip-missing --duplicates mean --to-points quakes.csv -o out.txt
    [ "$(head -n 1 out.txt)" = "# lon lat mag time mag_given place" ] || fail "$(head -n 1 out.txt)"
    [ "$(sed -n 3p out.txt)" = '30 40 4 "2020-01-02" 3 ""' ] || fail "$(sed -n 3p out.txt)"
  done
  "$PSTRIPACK" -q interpolate quakes.csv --variable mag --skip-missing --duplicates first --to-points quakes.csv -o named.txt
  [ "$(sed -n 3p named.txt | cut -d ' ' -f 3)" = 3 ] || fail "$(cat named.txt)"
  # What interpolate writes is read again.
  "$PSTRIPACK" -q interpolate out.txt --variable mag --skip-missing --duplicates first --to-points quakes.csv -o again.txt
  cut -d ' ' -f 1-3 out.txt > a
  cut -d ' ' -f 1-3 again.txt | cmp a -
  # Stations without a place or a value are left out on request; numbers are those in the input.
  printf 'name,lon,lat,t\na,10,20,1\nb,,30,2\nc,100,40,3\nd,20,-50,\ne,NA,5,5\nf,100,40,7\ng,170,5,7\nh,80,7,7\n' > gaps.csv
  refuses 1 "gaps.csv:3: nothing in column 'lon': remove the row, say --skip-missing" triangulate gaps.csv -o failed.vtu
  refuses 1 "gaps.csv: node 3 (line 4) and node 6 (line 7) are in the same place" -q triangulate gaps.csv --skip-missing -o failed.vtu
  "$PSTRIPACK" triangulate gaps.csv --skip-missing --duplicates first -o mesh.vtu 2> err
  grep -q "gaps.csv: 2 nodes without place left out" err || fail "$(cat err)"
  [ "$(values_of node)" = "1 3 4 7 8" ] || fail "node: $(values_of node)"
  "$PSTRIPACK" interpolate gaps.csv --variable t --skip-missing --duplicates first --to-points gaps.csv -o out.txt 2> err
  grep -q "gaps.csv: 1 node without value left out" err && [ "$(grep -c "gaps.csv: 2 nodes without place left out" err)" = 2 ] ||
    fail "$(cat err)"
  [ "$(awk '!/#/ { print $3 }' out.txt | tr '\n' ' ')" = "1 3 nan 3 7 7 " ] || fail "$(cat out.txt)"
  "$PSTRIPACK" -q info gaps.csv --skip-missing --json | tr -d ' \n' | grep -qF '"duplicate_pairs":[[3,6]]' || fail "numbers of info"
  # Segments of GMT.
  printf '> -Z1\n100\t0\n110\t5\n> -Z2\n100\t50\n' > lines.gmt
  "$PSTRIPACK" -q triangulate lines.gmt -o mesh.vtu
  [ "$(values_of segment)" = "1 1 2" ] || fail "segment: $(values_of segment)"
  ;;

bad_tables)
  # What would take any memory.
  awk 'BEGIN { print "lon,lat,note"; for (k = 0; k < 4000; ++k) printf "%d,%d,a%d\n", k % 360, k / 50, k
    printf "7.5,80.5,"; for (k = 0; k < 20000; ++k) printf "x"; print "" }' > notes.csv
  refuses 1 "notes.nc: column 'note' has a text of 20000 bytes, as long as which all in a NetCDF file are, 80 MB: leave the column out by --columns" convert notes.csv -o notes.nc
  awk 'BEGIN { printf "{\"type\":\"FeatureCollection\",\"features\":["
    for (k = 0; k < 4000; ++k) printf "%s{\"type\":\"Feature\",\"properties\":{\"p%d\":1},\"geometry\":{\"type\":\"Point\",\"coordinates\":[%d,%d]}}", k ? "," : "", k, k % 360, k / 50
    print "]}" }' > own.geojson
  refuses 1 "own.geojson: feature 2" info own.geojson
  grep -q "the properties have .* different names, the last .p2.*: give all features the same" err || fail "$(cat err)"
  ;;

maps)
  printf 'lon,lat,depth (km),place\n170,-10,7.25,"a, ""b"""\n-170,-10,,c\n180,10,-1,"d # e"\n' > table.csv
  # A row for each triangle, cell or node, with the given values.
  "$PSTRIPACK" -q triangulate table.csv -o mesh.csv
  [ "$(cut -d , -f 1-3 mesh.csv | tr '\n' ' ')" = "node1,node2,node3 1,2,3 " ] || fail "$(cat mesh.csv)"
  "$PSTRIPACK" -q voronoi table.csv --clip-to-hull -o cells.csv
  [ "$(head -n 1 cells.csv)" = "lon,lat,node,line,depth [km],place,degree,area [sr],area_km2,centroid_lon,centroid_lat" ] || fail "$(cat cells.csv)"
  grep -q '^170,-10,1,2,7.25,"a, ""b""",2,0.0' cells.csv || fail "$(cat cells.csv)"
  grep -q '^-170,-10,2,3,,c,2,0.0' cells.csv || fail "$(cat cells.csv)"
  "$PSTRIPACK" -q convert table.csv -o nodes.csv
  sed 's/depth (km)/depth [km]/' table.csv | cmp nodes.csv -
  "$PSTRIPACK" -q points random 20 -o nodes.txt
  "$PSTRIPACK" -q points random 20 -o nodes.csv
  "$PSTRIPACK" -q convert nodes.csv --coordinates xyz -o back.txt
  cmp nodes.txt back.txt
  # The triangle crosses the dateline: two polygons, with the nodes to the last bit.
  "$PSTRIPACK" -q triangulate table.csv -o mesh.geojson
  grep -q '"MultiPolygon"' mesh.geojson || fail "$(cat mesh.geojson)"
  for corner in 170,-10 180,10 -180,10 -170,-10; do
    grep -qF "[$corner]" mesh.geojson || fail "no $corner: $(cat mesh.geojson)"
  done
  # Polygons with a hole, and two of them.
  ring() { printf '[[%s,%s],[%s,%s],[%s,%s],[%s,%s],[%s,%s]]' "$1" "$3" "$2" "$3" "$2" "$4" "$1" "$4" "$1" "$3"; }
  printf '{"type":"MultiPolygon","coordinates":[[%s,%s],[%s]]}' "$(ring 10 30 -10 10)" "$(ring 15 20 -5 5)" "$(ring 40 41 3 4)" > two.json
  "$PSTRIPACK" -q voronoi nodes.csv --coordinates xyz --clip-to two.json -o parts.geojson
  awk -F '"area_km2":' '/Feature"/ { sum += $2 } END { exit (sum / 4315587 - 1) ^ 2 > 1e-10 }' parts.geojson || fail "$(cat parts.geojson)"
  printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"NAME":"east\\nbank"},"geometry":{"type":"Polygon","coordinates":[%s]}},{"type":"Feature","id":7,"geometry":{"type":"Polygon","coordinates":[%s]}}]}' "$(ring 10 30 -10 10)" "$(ring 5 10 -10 10)" > named.json
  "$PSTRIPACK" -q voronoi nodes.csv --coordinates xyz --clip-to named.json -o parts.csv
  [ "$(awk -F, 'NR > 1 { print $(NF - 5) "," $(NF - 4) }' parts.csv | sort -u | tr '\n' ' ')" = "1,east bank 2,7 " ] || fail "$(cat parts.csv)"
  "$PSTRIPACK" -q convert parts.csv -o again.csv
  printf '{"type":"Polygon","coordinates":[[[0,10],[10,40],[20,10],[-5,30],[25,30],[0,10]]]}' > star.json
  refuses 1 "star.json: feature 1: side 1 from 0,10 to 10,40 crosses or lies on side 4 from -5,30 to 25,30: mend the polygon" voronoi nodes.txt --clip-to star.json -o failed.csv
  refuses 2 "--clip-to: polygons cut whole cells: leave out --clip-to-hull" voronoi nodes.txt --clip-to two.json --clip-to-hull -o failed.csv
  refuses 1 "missing.json: cannot be opened" voronoi nodes.txt --clip-to missing.json -o failed.csv
  # Links with their lengths, the hull, and triangles without long sides.
  "$PSTRIPACK" -q triangulate table.csv --what links -o links.geojson
  [ "$(grep -c '"LineString"' links.geojson)" = 2 ] && [ "$(grep -c '"MultiLineString"' links.geojson)" = 1 ] || fail "$(cat links.geojson)"
  "$PSTRIPACK" triangulate table.csv --what links --longest 2400km -o links.csv 2> err
  [ "$(cut -c 1-8 links.csv | tr '\n' ' ')" = "node1,no 1,2,2189 " ] && grep -q ", 1 link; " err || fail "$(cat links.csv err)"
  "$PSTRIPACK" -q triangulate table.csv --what hull -o hull.geojson
  "$PSTRIPACK" -q triangulate table.csv --what hull -o hull.csv
  [ "$(sed -n 2p hull.geojson | grep -o '"coordinates.*')" = "$(sed -n 2p mesh.geojson | grep -o '"coordinates.*')" ] || fail "$(cat hull.geojson)"
  [ "$(cut -d , -f 3 hull.csv | tr '\n' ' ')" = "node 1 2 3 " ] || fail "$(cat hull.csv)"
  refuses 1 "nodes.txt: the nodes surround the sphere: they have no hull" triangulate nodes.txt --what hull -o failed.csv
  refuses 2 "the hull is that of all nodes: leave out --longest" triangulate table.csv --what hull --longest 1km -o failed.csv
  refuses 1 "off cannot hold links: --to geojson or csv can" triangulate table.csv --what links -o failed.off
  refuses 1 "each triangle has a side longer than 1000km" triangulate table.csv --longest 1000km -o failed.off
  refuses 1 "holds whole triangulations: leave out --longest" -q triangulate nodes.txt --longest 5000km -o failed.lists
  refuses 2 "--longest: '0km' leaves out everything" triangulate table.csv --longest 0km -o failed.off
  refuses 2 "--longest: '5': expected a number and its unit" triangulate table.csv --longest 5 -o failed.off
  "$PSTRIPACK" triangulate nodes.txt --longest 60deg -o some.csv 2> err
  left=$(sed -n 's/^pstripack: nodes.txt: \([0-9]*\) triangles with a side longer than 60deg left out$/\1/p' err)
  [ "$(wc -l < some.csv)" = $((37 - left)) ] || fail "$left $(wc -l < some.csv)"
  # A region within one cell.
  "$PSTRIPACK" -q voronoi table.csv --clip-to 0,0.1,10,10.1 -o one.geojson
  [ "$(grep -c '"Feature"' one.geojson)" = 1 ] || fail "$(cat one.geojson)"
  for corner in 0,10 0.1,10 0.1,10.1 0,10.1; do grep -qF "[$corner]" one.geojson || fail "no $corner: $(cat one.geojson)"; done
  # Other formats also get the cut cells. If the nodes surround the sphere, the hull cuts nothing.
  for suffix in vtu off gmt; do "$PSTRIPACK" -q voronoi table.csv --clip-to 170,-170,-20,20 -o part.$suffix; done
  [ "$(head -n 2 part.off | tail -n 1 | cut -d ' ' -f 2)" = 3 ] || fail "$(head -n 2 part.off)"
  "$PSTRIPACK" -q voronoi nodes.txt -o whole.off
  "$PSTRIPACK" voronoi nodes.txt --clip-to-hull -o hull.off 2> err
  grep -q "^pstripack: nodes.txt: the nodes surround the sphere: --clip-to-hull cuts nothing$" err || fail "$(cat err)"
  cmp whole.off hull.off
  "$PSTRIPACK" -q --threads 1 voronoi nodes.txt -o one.geojson
  "$PSTRIPACK" -q --threads 3 voronoi nodes.txt -o three.geojson
  sed 1d one.geojson > a
  sed 1d three.geojson | cmp a -
  ;;

huge_cells)
  # Stations of a region, whose outer cells reach around the sphere. On a whole sphere no cell is huge.
  awk 'BEGIN { srand(1); for (i = 0; i < 60; ++i) print 129 + 16 * rand(), 31 + 14 * rand() }' > stations.lonlat
  for cut in "" --clip-to-hull "--clip-to 129,145,31,45" -q; do
    # shellcheck disable=SC2086
    "$PSTRIPACK" voronoi stations.lonlat $cut -o cells.geojson 2> err
    case $cut in "") expected=1 ;; *) expected=0 ;; esac
    [ "$(grep -c 'pstripack: stations.lonlat: the cell of node [0-9]* has [0-9]* km2, [0-9]* times the median: .* --clip-to or --clip-to-hull$' err)" = $expected ] ||
      fail "$cut: $(cat err)"
  done
  "$PSTRIPACK" -q points random 5000 -o nodes.txt
  "$PSTRIPACK" voronoi nodes.txt -o cells.off 2> err
  [ "$(wc -l < err)" = 1 ] || fail "$(cat err)"
  ;;

geojson)
  # Reading a written file gives the same longitudes beyond 180 degrees, missing values, texts, history and vectors.
  printf 'lon,lat,depth,place\n300.1,40,7.25,a\n100,40,,"b ""c"""\n-70,-20.7,-1,\n180,89.99,3,d\n' > table.csv
  "$PSTRIPACK" -q convert table.csv -o nodes.geojson
  "$PSTRIPACK" -q convert nodes.geojson -o back.csv
  cmp table.csv back.csv
  "$PSTRIPACK" -q convert nodes.geojson -o again.geojson
  sed 1d nodes.geojson > features
  sed 1d again.geojson | cmp features -
  head -n 1 again.geojson | grep -q 'nodes.geojson -o again.geojson .*\\npstripack .*table.csv' || fail "$(head -n 1 again.geojson)"
  "$PSTRIPACK" -q points random 50 -o nodes.txt
  "$PSTRIPACK" -q convert nodes.txt -o nodes.json
  "$PSTRIPACK" -q convert - --coordinates xyz -o back.txt < nodes.json
  cmp nodes.txt back.txt
  # A value by name or as the first column after the coordinates; also as places.
  for option in "--variable depth" "--columns lon,lat,depth"; do
    # shellcheck disable=SC2086
    "$PSTRIPACK" -q interpolate nodes.geojson $option --skip-missing --to-points nodes.geojson -o values.txt
    [ "$(sed -n 1,2p values.txt | tr '\n' ' ')" = '# lon lat depth depth_given place 300.1 40 7.25 7.25 "a" ' ] || fail "$(cat values.txt)"
  done
  # Files of other programs: a byte order mark, several points per feature, altitudes, nested properties.
  printf '\357\273\277{"type": "FeatureCollection", "name": "x", "features": [\n' > other.geojson
  printf '{"geometry": {"coordinates": [[0, 0, 5], [10, 50]], "type": "MultiPoint"}, "type": "Feature", "properties": {"mag": 1, "features": {"a": [1]}}},\n' >> other.geojson
  printf '{"type": "Feature", "properties": null, "geometry": {"type": "Point", "coordinates": [-1e1, 3]}}], "title": "T"}\n' >> other.geojson
  "$PSTRIPACK" -q convert other.geojson -o other.csv
  printf 'lon,lat,altitude,mag,features\n0,0,5,1,"{""a"":[1]}"\n10,50,,1,"{""a"":[1]}"\n-10,3,,,\n' | cmp other.csv -
  "$PSTRIPACK" -q voronoi other.geojson -o cells.csv
  [ "$(cut -d , -f 1-4 cells.csv | tr '\n' ' ')" = "lon,lat,node,feature 0,0,1,1 10,50,2,1 -10,3,3,2 " ] || fail "$(cat cells.csv)"
  # Refused, with the feature or the line.
  features='{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"mag": 1}, "geometry": {"type": "Point", "coordinates": [10, 20]}},'
  refused() {
    words=$1
    cat > bad.geojson
    shift
    refuses 1 "bad.geojson:$words" triangulate bad.geojson -o failed.off "$@"
  }
  point() { printf '%s\n{"type": "Feature", "geometry": {"type": "%s", "coordinates": %s}}]}' "$features" "$1" "$2"; }
  point Point '[1, NaN]' | refused "3: not valid JSON: "
  point Point '[1, 2' | refused "3: not valid JSON: "
  printf '{"type": ' | refused "1: not valid JSON: "
  point Point '[1, 1e400]' | refused " feature 2: a number is larger than 1e308"
  point Point '[1, "2"]' | refused " feature 2: expected coordinates [longitude, latitude]"
  point Point '[1]' | refused " feature 2: expected coordinates"
  point Point '[30, 95]' | refused " node 2 (feature 2): latitude 95 is beyond the pole: GeoJSON has [longitude, latitude] in degrees; are they exchanged?"
  point MultiPoint '[[10, 20], [30, 40], [50, 10]]' | refused " node 1 (feature 1) and node 2 (feature 2) are in the same place" --columns lon,lat
  point Polygon '[[[1, 2]]]' | refused " feature 2: 'Polygon' is not a Point or MultiPoint: nodes are points; meshes are read from UGRID"
  printf '%s null]}' "$features" | refused ' "features" must be an array of features'
  printf '%s {"type": "Feature", "geometry": null}]}' "$features" | refused " feature 2: has no geometry: remove it"
  printf '{"type": "FeatureCollection", "features": []}' | refused " no points"
  printf '{"type": "Topology"}' | refused " not GeoJSON of points: the type is 'Topology', expected FeatureCollection"
  point Point '[1, 2]' | sed 's/"features"/"crs": {"type": "name", "properties": {"name": "EPSG:3857"}}, &/' |
    refused " coordinates are in EPSG:3857: write the file in longitudes and latitudes, EPSG:4326"
  point Point '[1, 2]' | refused " there is no property 'mga'; did you mean mag?; the features have mag" --columns lon,lat,mga
  point Point '[1, 2]' | refused " the coordinates are those of the geometry: give --columns lon,lat,NAME" --columns mag
  point Point '[1, 2]' | refused " --coordinates xyz needs the property 'x'" --coordinates xyz
  printf '1 2\n' | refused "1: not valid JSON" --from geojson
  printf '{"type": "%0100d\\n"}' 0 |
    refused " not GeoJSON of points: the type is '$(printf %060d 0)...', expected FeatureCollection"
  refuses 1 "no property 'place' is a number; properties that are numbers: depth" interpolate nodes.geojson --variable place --to-grid 2x2 -o failed.txt
  [ -z "$(find . -name 'failed*')" ] || fail "files of failed runs: $(echo ./failed*)"
  ;;

bad_maps)
  octahedron > nodes.txt
  printf '0 0\n10 0\n0 10\n3 3\n' > cap.lonlat
  for region in 1,2,3 10,10,0,1 0,10,20,20 0,10,5,-5 0,10,-91,0 0,10,0,91 0,361,0,1 -200,170,0,1 0,1,0,1,2; do
    refuses 2 "--clip-to: '$region'" voronoi nodes.txt --clip-to=$region -o failed.geojson
  done
  grep -q "is not 4 numbers" err || fail "$(cat err)"
  refuses 2 "170,-170 crosses the dateline" voronoi nodes.txt --clip-to 0,10,5,-5 -o failed.geojson
  refuses 2 "there is no option --region" triangulate nodes.txt --region 0,10,0,10 -o failed.geojson
  refuses 1 "cap.lonlat: no part of the hull of the nodes lies in the box" \
    voronoi cap.lonlat --units degrees --clip-to-hull --clip-to 100,110,0,10 -o failed.geojson
  refuses 1 "nodes.txt: the box is smaller than 1e-10 degrees: make it larger" \
    voronoi nodes.txt --clip-to 0,1e-13,0,1e-13 -o failed.geojson
  printf '85 45\n-95 0\n-95 -45\n0 90\n' > circle.lonlat
  refuses 1 "circle.lonlat: the cell of node 1 reaches halfway around the sphere" \
    voronoi circle.lonlat --units degrees -o failed.geojson
  # One pair of nodes is opposite: a quarter and an eighth of a turn on both sides of each node make its lune.
  "$PSTRIPACK" -q voronoi circle.lonlat --units degrees -o lunes.csv
  awk -F, 'NR > 1 { half = 3.141592653589793 * (NR % 2 ? 0.75 : 1.25)
    if ($6 / half - 1 > 1e-15 || 1 - $6 / half > 1e-15) bad = 1 } END { exit bad || NR != 5 }' lunes.csv || fail "$(cat lunes.csv)"
  # Nodes on a circle, half a circle or less: rounding decides whether their hull contains the centre. The cells are
  # lunes all the same.
  awk 'BEGIN { for (part = 1; part <= 3; ++part) for (k = 0; k < 12; ++k) { a = 6.283185307179586 / part * (k + 0.1) / 12
    printf "%.17g %.17g %.17g\n", cos(a), sin(a) * 0.6, sin(a) * 0.8 > "circle" part ".txt" } }'
  for part in 1 2 3; do
    "$PSTRIPACK" -q voronoi circle$part.txt -o lunes.csv
    awk -F, -v part=$part 'NR > 1 { sum += $6 } NR == 3 { inner = $6 * part / 1.0471975511965976 }
      END { exit !(sum > 12.56637061435916 && sum < 12.56637061435918 && inner > 1 - 1e-14 && inner < 1 + 1e-14) }' lunes.csv ||
      fail "circle$part: $(cat lunes.csv)"
    [ $part = 1 ] || refuses 1 "circle$part.txt: the hull of the nodes is so narrow that rounded corners" \
      voronoi circle$part.txt --clip-to-hull -o failed.geojson
  done
  "$PSTRIPACK" -q points strip:1e-12 50 | "$PSTRIPACK" -q voronoi - -o strip.off
  refuses 1 "/dev/full: cannot be written: No space left" voronoi nodes.txt -o /dev/full --to geojson
  refuses 1 "holds nodes without triangles" convert nodes.txt -o failed.gmt
  refuses 2 "points are nodes, not a mesh: give --to xyz, lonlat, nodes, csv, geojson or raw" points random 10 -o failed.gmt
  [ -z "$(find . -name 'failed*')" ] || fail "files of failed runs: $(echo ./failed*)"
  ;;

grids)
  # Grids of nodes include the region's edges, but no meridian twice; grids of cells lie between the edges.
  "$PSTRIPACK" -q points random 300 | awk '{ printf "%s %.17g\n", $0, 1 + $1 + 2 * $3 }' > values.txt
  columns_of() { sed 1d "$2" | cut -d ' ' -f "$1" | sort -n | uniq | tr '\n' ' '; }
  "$PSTRIPACK" -q interpolate values.txt --registration node --box 170,-170,-30,-10 --grid-step 10 -o part.txt
  [ "$(columns_of 1 part.txt)|$(columns_of 2 part.txt)" = "170 180 190 |-30 -20 -10 " ] || fail "$(cat part.txt)"
  "$PSTRIPACK" -q interpolate values.txt --box 170,-170,-30,-10 --grid-step 10 -o cells.txt
  [ "$(columns_of 1 cells.txt)|$(columns_of 2 cells.txt)" = "175 185 |-25 -15 " ] || fail "$(cat cells.txt)"
  "$PSTRIPACK" -q interpolate values.txt --registration node --to-grid 3x3 --box 170,-170,-30,-10 -o same.txt
  cmp part.txt same.txt
  # The same values for equal meridians with other numbers.
  "$PSTRIPACK" -q interpolate values.txt --registration node --box=-190,-170,-30,-10 --grid-step 10 -o west.txt
  cut -d ' ' -f 3 part.txt > a
  cut -d ' ' -f 3 west.txt | cmp a -
  for method in linear natural cubic; do
    "$PSTRIPACK" -q interpolate values.txt --method $method --registration node --box 0,360,-90,90 --grid-step 30 -o all.txt
    [ "$(columns_of 1 all.txt)" = "0 30 60 90 120 150 180 210 240 270 300 330 " ] || fail "$(columns_of 1 all.txt)"
    [ "$(columns_of 2 all.txt)" = "-90 -60 -30 0 30 60 90 " ] || fail "$(columns_of 2 all.txt)"
    for pole in -90 90; do  # one place, one value
      [ "$(awk -v pole=$pole '$2 == pole { print $3 }' all.txt | uniq | wc -l)" = 1 ] || fail "$method: $(cat all.txt)"
    done
  done
  "$PSTRIPACK" -q interpolate values.txt --method cubic --registration node --box 0,360,-90,90 --to-grid 7x12 -o same.txt
  cmp all.txt same.txt
  # CSV: a header, and nothing where a value is missing.
  "$PSTRIPACK" -q points cap:0.3 50 | sed 's/$/ 7/' > region.txt
  "$PSTRIPACK" -q interpolate region.txt --grid-step 30 -o region.csv
  [ "$(head -n 2 region.csv | tr '\n' ' ')" = "lon,lat,value -165,-75, " ] || fail "$(cat region.csv)"
  refuses 2 "--registration: is of a grid" interpolate values.txt --to-points values.txt --registration node -o failed.txt
  refuses 2 "expected NLATxNLON" interpolate values.txt --to-grid 1x5 --registration node -o failed.txt
  refuses 2 "--box: '5,5,0,1': expected WEST,EAST,SOUTH,NORTH" interpolate values.txt --grid-step 1 --box 5,5,0,1 -o failed.txt
  refuses 2 "neither .nc nor .txt nor .csv" interpolate values.txt --grid-step 30 -o failed.xxx
  ;;

netcdf_columns)
  # Numbers, texts, attributes and longitudes beyond 180 degrees are the same after writing and reading.
  printf 'lon,lat,depth (km),place\n300.1,40,7.25,a\n100,40,,b c\n70,-20.7,-1,\n300.1,40,9,d\n' > table.csv
  "$PSTRIPACK" -q convert table.csv -o nodes.nc
  "$PSTRIPACK" -q convert nodes.nc -o - --to lonlat > got
  printf '300.1 40\n100 40\n70 -20.7\n300.1 40\n' | cmp got -
  "$PSTRIPACK" -q triangulate nodes.nc --duplicates first -o mesh.nc
  "$PSTRIPACK" -q convert mesh.nc -o again.nc
  "$PSTRIPACK" -q convert again.nc -o - --to lonlat > got
  printf '300.1 40\n100 40\n70 -20.7\n' | cmp got -
  "$PSTRIPACK" -q convert again.nc -o mesh.vtu
  values_of() { tr '\n' ' ' < mesh.vtu | sed "s/.*Name=\"$1\" format=\"ascii\"> \([^<]*\) <.*/\1/"; }
  [ "$(values_of depth)" = "7.25 nan -1" ] || fail "depth: $(values_of depth)"
  [ "$(values_of lon)" = "300.1 100 70" ] || fail "lon: $(values_of lon)"
  [ "$(grep -c 'Name="degree' mesh.vtu)" = 1 ] || fail "degree is there twice"
  printf 'lon,lat,depth (km),place\n300,40,7,a\n100,40,8,b\n70,-20.7,-1,\n' > table.csv
  "$PSTRIPACK" -q interpolate table.csv --variable depth --to-points table.csv -o points.nc
  "$PSTRIPACK" -q interpolate points.nc --variable depth --to-points points.nc -o out.txt
  [ "$(sed -n 1,2p out.txt | tr '\n' ' ')" = '# lon lat depth [km] depth_given [km] depth_given_given [km] place 300 40 7 7 7 "a" ' ] || fail "$(cat out.txt)"
  ;;

ranks)
  # shellcheck disable=SC2086  # lists of words on purpose
  run() { ranks=$1; shift; $MPIRUN -n "$ranks" "$PSTRIPACK-mpi" "$@"; }
  "$PSTRIPACK" -q points random 3000 -o nodes.txt
  head -n 1000 nodes.txt > few.txt  # Hydra buffers at most 64 KB of stdin
  "$PSTRIPACK" -q triangulate nodes.txt -o serial.lists
  "$PSTRIPACK" -q triangulate few.txt -o few.lists
  "$PSTRIPACK" -q voronoi nodes.txt -o serial.off
  "$PSTRIPACK" -q scvt 500 --density bump --evaluations 5 --checkpoint checkpoint.off --every 2 -o serial.txt
  for n in 1 2 3; do
    run $n triangulate nodes.txt -o ranks.lists 2> err
    [ "$(grep -c ^pstripack: err)" = 1 ] || fail "$n ranks: $(cat err)"
    [ $n = 1 ] || grep -q "; on $n ranks$" err || fail "$n ranks: $(cat err)"
    cmp serial.lists ranks.lists
    run $n -q voronoi nodes.txt -o ranks.off
    cmp serial.off ranks.off
    run $n -q scvt 500 --density bump --evaluations 5 --checkpoint ranks.off --every 2 -o ranks.txt
    cmp serial.txt ranks.txt
    cmp checkpoint.off ranks.off
    [ "$(run $n -q points random 10 | wc -l)" = 10 ] || fail "points, by $n ranks"
    # mpirun of Open MPI 4.1 sometimes crashes in mca_iof_hnp while it forwards stdin: repeat.
    for _ in 1 2 3 4 5 6; do
      code=0
      run $n -q triangulate - -o read.lists < few.txt 2> err || code=$?
      grep -q mca_iof_hnp err || break
    done
    [ $code = 0 ] || fail "$n ranks, -: exit code $code: $(cat err)"
    cmp few.lists read.lists
    # Errors: one message, exit code 1 or 2, no output file.
    { cat nodes.txt; head -n 1 nodes.txt; } > twice.txt
    for case in "1 twice.txt" "1 missing.txt" "2 nodes.txt --potato"; do
      code=0
      # shellcheck disable=SC2086
      run $n triangulate ${case#* } -o failed.lists > out 2> err || code=$?
      [ "$code" = "${case%% *}" ] || fail "$n ranks, $case: exit code $code: $(cat err)"
      [ "$(grep -c ^pstripack: err)" = 1 ] || fail "$n ranks, $case: $(cat err)"
      [ ! -e failed.lists ] || fail "failed.lists was written"
    done
  done
  code=0
  $MPIRUN -n 1 "$PSTRIPACK-mpi" -q triangulate nodes.txt -o a.lists : -n 1 "$PSTRIPACK-mpi" -q triangulate nodes.txt -o b.lists 2> err || code=$?
  [ $code = 2 ] && grep -q "the ranks have different command lines" err || fail "exit code $code: $(cat err)"
  [ ! -e a.lists ] && [ ! -e b.lists ] || fail "two command lines, and one was obeyed"
  # pstripack itself has no ranks: in a job of several it must be told that it is meant alone.
  # shellcheck disable=SC2016
  alone='if [ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 0 ]; then exec "$@"; fi'
  code=0
  timeout 60 $MPIRUN -n 2 sh -c "$alone" sh "$PSTRIPACK" -q triangulate nodes.txt -o alone.lists 2> err || code=$?
  [ $code = 2 ] && grep -qxF "pstripack: this job has 2 ranks: pstripack-mpi uses them; say --serial, or set PSTRIPACK_SERIAL=1, if each process is meant to work alone" err ||
    fail "exit code $code: $(cat err)"
  [ ! -e alone.lists ] || fail "alone.lists was written"
  timeout 60 $MPIRUN -n 2 sh -c "$alone" sh "$PSTRIPACK" -q --serial triangulate nodes.txt -o alone.lists
  cmp serial.lists alone.lists
  rm alone.lists
  timeout 60 $MPIRUN -n 2 sh -c "PSTRIPACK_SERIAL=1; export PSTRIPACK_SERIAL; $alone" sh "$PSTRIPACK" -q triangulate nodes.txt -o alone.lists
  cmp serial.lists alone.lists
  ;;

scvt_ranks)
  # shellcheck disable=SC2086  # lists of words on purpose
  run() { ranks=$1; shift; $MPIRUN -n "$ranks" "$PSTRIPACK-mpi" -q "$@"; }
  fourteen="--density bump --tolerance 1e-9 --evaluations 14 --every 4 --checkpoint"
  thirty="--density bump --tolerance 1e-9 --evaluations 30"
  # The same bytes for any number of ranks and threads, output and checkpoint, in each kind of file.
  for run in 2:1:nc 3:2:mpas.nc; do
    suffix=${run##*:} threads=${run%:*}
    # shellcheck disable=SC2086
    "$PSTRIPACK" -q scvt 300 $fourteen one.nc -o one.$suffix
    mkdir -p ranks  # files hold the command: the same in both folders
    # shellcheck disable=SC2086
    (cd ranks && run ${run%%:*} --threads ${threads#*:} scvt 300 $fourteen one.nc -o one.$suffix)
    cmp one.$suffix ranks/one.$suffix
    cmp one.nc ranks/one.nc
  done
  cmp one.graph.info ranks/one.graph.info
  mv ranks/one.nc ranks.nc
  # More ranks than generators. Ranks begin with levels where a single process would begin with a front.
  "$PSTRIPACK" -q scvt 4 -o one.nodes.nc
  run 5 scvt 4 -o ranks.nodes.nc
  same one.nodes.nc ranks.nodes.nc
  "$PSTRIPACK" scvt 3000 --first levels --evaluations 1 --tolerance 0.01 -o one.off 2> one.err
  $MPIRUN -n 2 "$PSTRIPACK-mpi" scvt 3000 --evaluations 1 --tolerance 0.01 -o ranks.off 2> err
  cmp one.off ranks.off
  grep -q "^pstripack: 3000 generators, 1 evaluations, .*; on 2 ranks$" err || fail "$(cat err)"
  [ "$(grep "cells by sides" err)" = "$(grep "cells by sides" one.err)" ] || fail "another quality: $(cat err)"
  # Ranks can start from a front that one process has made.
  "$PSTRIPACK" -q scvt 3000 --first front --evaluations 0 -o front.nodes.nc
  "$PSTRIPACK" -q scvt 3000 --first front --evaluations 6 --tolerance 1e-9 -o one.nodes.nc
  run 2 scvt --start front.nodes.nc --evaluations 6 --tolerance 1e-9 -o ranks.nodes.nc
  same one.nodes.nc ranks.nodes.nc
  # Limited areas begin with a front on any number of ranks.
  "$PSTRIPACK" scvt --width 300km --region 10,50,10,50 -o one.csv 2> one.err
  $MPIRUN -n 2 "$PSTRIPACK-mpi" scvt --width 300km --region 10,50,10,50 -o ranks.csv 2> err
  cmp one.csv ranks.csv
  [ "$(grep "cells by sides" err)" = "$(grep "cells by sides" one.err)" ] || fail "another quality: $(cat err)"
  # A checkpoint of three ranks continues to the same bytes on two ranks and on one.
  # shellcheck disable=SC2086
  "$PSTRIPACK" -q scvt 300 $thirty -o direct.nodes.nc
  # shellcheck disable=SC2086
  run 2 scvt --start ranks.nc $thirty -o resumed.nodes.nc
  same direct.nodes.nc resumed.nodes.nc
  # shellcheck disable=SC2086
  "$PSTRIPACK" -q scvt --start ranks.nc $thirty -o resumed.nodes.nc
  same direct.nodes.nc resumed.nodes.nc
  # So does that of a run that ended because one rank got TERM; it writes its mesh, too.
  rm ranks.nc
  # shellcheck disable=SC2016
  $MPIRUN -n 3 sh -c 'echo $$ > rank.pid; exec "$@"' sh "$PSTRIPACK-mpi" scvt --start front.nodes.nc --density bump --tolerance 1e-12 --evaluations 1e5 --every 1 --checkpoint ranks.nc -o ended.nc 2> err &
  job=$!
  for _ in $(seq 3000); do [ -e ranks.nc ] && break; sleep 0.02; done
  kill -TERM "$(cat rank.pid)"
  if wait $job; then fail "status 0 after TERM"; fi
  grep -q "^pstripack: 3000 generators, .* ended by TERM, NOT converged to 1e-12: gradient .*; on 3 ranks$" err || fail "$(cat err)"
  "$PSTRIPACK" -q info ended.nc > /dev/null
  "$PSTRIPACK" -q scvt --start front.nodes.nc --density bump --tolerance 1e-12 --evaluations 1000 -o direct.nodes.nc
  run 2 scvt --start ranks.nc --tolerance 1e-12 --evaluations 1000 -o resumed.nodes.nc
  same direct.nodes.nc resumed.nodes.nc
  # What several ranks cannot do: one message, exit code 1, no output file.
  octahedron > start.txt
  "$PSTRIPACK" -q points hemisphere 30 -o half.nodes.nc
  while IFS='|' read -r arguments words; do
    code=0
    # shellcheck disable=SC2086
    run 2 scvt $arguments > out 2> err < /dev/null || code=$?
    [ $code = 1 ] || fail "$arguments: exit code $code: $(cat err)"
    [ "$(grep -c ^pstripack: err)" = 1 ] && grep -qF -- "$words" err || fail "$arguments: $(cat err)"
    [ ! -e failed.nc ] && [ ! -e failed.vtu ] || fail "$arguments: wrote a file"
  done <<END
10 --first front -o failed.nc|--first front: a front is made by one process: \`pstripack scvt 10 --first front
--start start.txt --duplicates first -o failed.nc|several ranks cannot: \`pstripack convert start.txt --duplicates first
10 -o failed.vtu|failed.vtu: several ranks write ugrid, mpas,
10 -o no/failed.nc|no/failed.nc: cannot be written: No such file
--start start.txt -o failed.nc|start.txt: several ranks read NetCDF, each its part: \`pstripack convert start.txt
--start half.nodes.nc -o failed.nc|half.nodes.nc: the generators lie in one hemisphere
10 --density-file start.txt -o failed.nc|start.txt
END
  ;;

*)
  fail "unknown case $1"
  ;;
esac
