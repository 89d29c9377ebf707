#!/bin/sh
# Runs pstripack and checks output, files, messages and exit codes. Usage: program.sh CASE; environment:
# PSTRIPACK, COMPARE (programs), DOCUMENT (docs/pstripack.md), WORK (folder for files).
set -eu
mkdir -p "$WORK/$1"
cd "$WORK/$1"
rm -rf ./* .[!.]*

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# refuses CODE "words" arguments...: the program ends with CODE and one line on stderr that has the words
refuses() {
  expected=$1 words=$2
  shift 2
  code=0
  "$PSTRIPACK" "$@" > out 2> err || code=$?
  [ "$code" = "$expected" ] || fail "$*: exit code $code, expected $expected: $(cat err)"
  [ "$(wc -l < err)" = 1 ] || fail "$*: not one line on stderr: $(cat err)"
  grep -qF -- "$words" err || fail "$*: expected '$words' in: $(cat err)"
}

octahedron() { printf '1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n'; }

case $1 in
documented_help)
  for command in "" triangulate voronoi info points convert plot; do
    # shellcheck disable=SC2086  # nothing, or one word
    "$PSTRIPACK" $command --help > help
    awk -v line="\$ pstripack ${command:+$command }--help" \
      '$0 == line { on = 1; next } on && /^```/ { exit } on' "$DOCUMENT" > documented
    diff help documented || fail "docs/pstripack.md has another --help of 'pstripack $command'"
  done
  ;;

pipes)
  octahedron | "$PSTRIPACK" -q triangulate - -o - --to off > mesh.off
  [ "$(head -n 2 mesh.off | tail -n 1)" = "6 8 0" ] || fail "an octahedron has 6 corners and 8 faces"
  "$PSTRIPACK" -q points fibonacci 100 | "$PSTRIPACK" -q info - --json > info.json
  grep -q '"triangles": 196,' info.json || fail "$(cat info.json)"
  octahedron | "$PSTRIPACK" triangulate - -o mesh.vtu 2> err
  grep -q '^pstripack: 6 nodes (text, x y z), 8 triangles; reading .* s; triangulating .* s; writing .* s$' err || fail "$(cat err)"
  ;;

lists)
  "$PSTRIPACK" -q points random 500 -o nodes.txt
  "$PSTRIPACK" -q triangulate nodes.txt -o a.lists
  "$PSTRIPACK" -q triangulate nodes.txt -o a.off
  "$PSTRIPACK" -q convert a.off -o b.lists
  "$COMPARE" lists a.lists b.lists > compared || fail "$(cat compared)"
  cmp a.lists b.lists
  [ "$(head -n 1 a.lists)" = "500 2989" ] || fail "N and LNEW: $(head -n 1 a.lists)"
  ;;

same_bytes_through_formats)
  for family in random hemisphere; do
    "$PSTRIPACK" -q points $family 500 -o nodes.txt
    "$PSTRIPACK" -q triangulate nodes.txt -o direct.lists
    for suffix in nc mpas.nc off; do
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
  printf '10 20 300\n30 40 -5\n50 60 70\n' > depth.txt
  refuses 1 "are not on one sphere; say --coordinates lonlat" triangulate depth.txt -o depth.off
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
  refuses 1 "holds nodes, no triangles" convert two.txt -o two.off
  [ "$(echo ./*.off)" = ./mesh.off ] || fail "files of failed runs: $(echo ./*.off)"
  ;;

bad_netcdf)
  printf 'CDF, it says' > broken.nc
  refuses 1 "broken.nc: NetCDF" triangulate broken.nc -o mesh.nc
  "$PSTRIPACK" -q points random 50 -o nodes.nc
  refuses 1 "holds nodes, no triangles" convert nodes.nc -o mesh.mpas.nc
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
  refuses 2 "--to: potato not in" triangulate nodes.txt -o mesh.off --to potato
  refuses 2 "unknown point set 'potato'" points potato 10
  refuses 2 "points are nodes, not a mesh" points random 10 -o mesh.off
  refuses 2 "degrees" triangulate nodes.txt -o mesh.off --units gradians
  refuses 2 "subcommand" polygons
  [ ! -e mesh.off ] || fail "mesh.off was written"
  ;;

no_partial_output)
  octahedron > nodes.txt
  echo old > mesh.off
  printf '1 0 0\n0 1 0\n0 0 1\n1 0 0\n' > twice.txt
  refuses 1 "are in the same place" triangulate twice.txt -o mesh.off
  refuses 1 "no/such/folder/mesh.off: cannot be written: No such file" triangulate nodes.txt -o no/such/folder/mesh.off
  refuses 1 "/dev/full: cannot be written: No space left" triangulate nodes.txt -o /dev/full --to off
  # A limit of the size of files, in blocks of 512 bytes, is a disk that is full.
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
  refuses 1 "twice.txt: node 1 (line 1) and node 7 (line 7) are in the same place: remove one, or say --drop-duplicates" \
    triangulate twice.txt -o twice.off
  octahedron > once.txt
  "$PSTRIPACK" triangulate twice.txt --drop-duplicates -o dropped.off 2> err
  grep -q "6 nodes dropped" err || fail "$(cat err)"
  "$PSTRIPACK" -q triangulate once.txt -o once.off
  cmp once.off dropped.off
  "$PSTRIPACK" -q info twice.txt > info.txt
  grep -q "^duplicates *6, the first is node 7 (line 7); left out below" info.txt || fail "$(cat info.txt)"
  grep -q "^triangles *8$" info.txt || fail "$(cat info.txt)"
  { octahedron; echo "1 1e-7 0"; } > near.txt
  "$PSTRIPACK" -q info near.txt > info.txt
  grep -q "^tightest pair *1e-07 rad, .*: node 1 (line 1) and node 7 (line 7)$" info.txt || fail "$(cat info.txt)"
  grep -q "^near duplicates *1 pairs" info.txt || fail "$(cat info.txt)"
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
    # The signature and, in the header, 1000 (0x3e8) by 548 (0x224) pixels.
    [ "$(od -A n -t x1 -N 24 a.png | tr -d ' \n')" = 89504e470d0a1a0a0000000d49484452000003e800000224 ] ||
      fail "a.png is no PNG of 1000 x 548 pixels: $(od -A n -t x1 -N 24 a.png)"
  fi
  # PNG without the program that makes it.
  code=0
  PATH=/no/such/folder "$PSTRIPACK" plot nodes.txt -o b.png 2> err || code=$?
  [ $code = 1 ] && grep -q "PNG needs rsvg-convert (Debian: librsvg2-bin)" err || fail "$code: $(cat err)"
  refuses 2 "picture.gif: expected FILE.svg or FILE.png" plot nodes.txt -o picture.gif
  refuses 2 "--view: mercator: expected orthographic, lonlat" plot nodes.txt -o c.svg --view mercator
  refuses 2 "--view: lonlat:10: expected" plot nodes.txt -o c.svg --view lonlat:10
  refuses 2 "--view: orthographic:0,91: expected" plot nodes.txt -o c.svg --view orthographic:0,91
  refuses 2 "--colour: owner:0: expected none, size, degree" plot nodes.txt -o c.svg --colour owner:0
  refuses 2 "--colour: owner:4:boxes: expected" plot nodes.txt -o c.svg --colour owner:4:boxes
  refuses 2 "degree is a property of nodes: say --what cells" plot nodes.txt -o c.svg --colour degree
  refuses 2 "histograms have no --view" plot nodes.txt -o c.svg --what histograms --view lonlat
  refuses 1 "no/such/folder/c.svg: cannot be written: No such file" plot nodes.txt -o no/such/folder/c.svg
  refuses 1 "/dev/full: cannot be written: No space left" plot nodes.txt -o /dev/full --to svg
  "$PSTRIPACK" -q points fibonacci 410000 -o many.raw
  refuses 1 "nodes are in view, at most 200,000 can be drawn: zoom in, for example by --view orthographic:0,30 --radius" \
    plot many.raw --from raw --coordinates xyz -q -o c.svg
  printf '1 0 0\n0 1 0\n0 0 1\n' > three.txt
  refuses 1 "three.txt: around some nodes, which lie on one circle, cells reach" plot three.txt --what cells -o c.svg
  [ ! -e c.svg ] && [ ! -e b.png ] || fail "a picture of a failed run"
  ;;

*)
  fail "unknown case $1"
  ;;
esac
