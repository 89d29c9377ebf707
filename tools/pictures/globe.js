// The script of globe.html.
'use strict';
(() => {

// ---- The mesh. tools/pictures/globe.cpp writes what is read here.

const get = id => document.getElementById(id);
const data = JSON.parse(get('data').textContent);
const {lon, lat, numbers = null, shades = null} = data;
const n = lon.length, degree = Math.PI / 180;

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const times = (a, f) => [a[0] * f, a[1] * f, a[2] * f];
const unit = a => times(a, 1 / Math.sqrt(dot(a, a)));
const middle = (a, b) => unit([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
const distance2 = (a, b) => (a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2 + (a[2] - b[2]) ** 2;
const angles = p => ({lon: Math.atan2(p[1], p[0]) / degree, lat: Math.atan2(p[2], Math.hypot(p[0], p[1])) / degree});
const place = (lon, lat) => [Math.cos(lat * degree) * Math.cos(lon * degree), Math.cos(lat * degree) * Math.sin(lon * degree),
                             Math.sin(lat * degree)];
// The directions to the east, to the north and upwards.
function axes(lon, lat) {
  const up = place(lon, lat), east = [-Math.sin(lon * degree), Math.cos(lon * degree), 0];
  return [east, cross(up, east), up];
}

const xyz = new Float64Array(3 * n);
for (let i = 0; i < n; ++i) xyz.set(place(lon[i], lat[i]), 3 * i);
const node = i => [xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]];

// The corners of the triangles, counterclockwise, the smallest first.
const corners = Int32Array.from(data.triangles), count = corners.length / 3;
for (let k = 0, first = 0; k < corners.length; k += 3) {
  corners[k] = first += corners[k];
  corners[k + 1] += first;
  corners[k + 2] += first;
}
// The triangles of node v are around[begin[v]] ... around[begin[v + 1] - 1].
const begin = new Int32Array(n + 1), around = new Int32Array(3 * count);
for (const v of corners) ++begin[v];
for (let v = 0, sum = 0; v <= n; ++v) sum = begin[v] += sum;
for (let k = corners.length; k-- > 0;) around[--begin[corners[k]]] = k / 3 | 0;
const triangle = t => [0, 1, 2].map(k => node(corners[3 * t + k]));
function circumcentre(t) {
  const [a, b, c] = triangle(t), u = minus(b, a), v = minus(c, a), w = cross(u, v), uu = dot(u, u), vv = dot(v, v);
  // The normal of nodes some cm apart is rounded by a metre. The way from a to the centre is as exact as they are.
  return unit(uu + vv > 1e-4 ? w : minus(a, times(cross(minus(times(u, vv), times(v, uu)), w), 0.5 / dot(w, w))));
}
function areaOf(a, b, c) {  // of a triangle, from differences of its corners
  return 2 * Math.atan2(dot(a, cross(minus(b, a), minus(c, a))), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

// The triangles of a node, its neighbours, and the corners of its cell, these two counterclockwise.
function star(v) {
  const triangles = [...around.subarray(begin[v], begin[v + 1])], p = node(v), [east, north] = axes(lon[v], lat[v]);
  const neighbours = new Set(triangles.flatMap(t => [...corners.subarray(3 * t, 3 * t + 3)]));
  neighbours.delete(v);
  const azimuth = q => Math.atan2(dot(north, minus(q, p)), dot(east, minus(q, p)));
  return {triangles, open: neighbours.size > triangles.length,
          neighbours: [...neighbours].sort((a, b) => azimuth(node(a)) - azimuth(node(b))),
          cell: triangles.map(circumcentre).sort((a, b) => azimuth(a) - azimuth(b))};
}

// ---- Drawing. What is drawn later lies on top. What is behind the sphere's middle is cut off.

const canvas = get('globe'), gl = canvas.getContext('webgl', {stencil: true});
if (gl === null) {
  get('node').textContent = 'The globe needs WebGL, which this browser lacks or has switched off.';
  return;
}
const program = gl.createProgram();
for (const [kind, text] of [[gl.VERTEX_SHADER, `
  attribute vec3 position;  // less the origin
  attribute vec4 colour;
  uniform mat3 turn;
  uniform vec3 origin;
  uniform vec2 scale, shift;
  uniform float size;
  varying vec4 paint;
  void main() {
    vec3 p = turn * position + origin;
    gl_Position = vec4(p.xy * scale + shift, 1.0 - 2.0 * p.z, 1.0);
    gl_PointSize = size;
    paint = colour;
  }`], [gl.FRAGMENT_SHADER, `
  precision mediump float;
  varying vec4 paint;
  void main() { gl_FragColor = paint; }`]]) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  gl.attachShader(program, shader);
}
['position', 'colour'].forEach((name, k) => gl.bindAttribLocation(program, k, name));
gl.linkProgram(program);
gl.useProgram(program);
const uniform = name => gl.getUniformLocation(program, name);
gl.enableVertexAttribArray(0);
gl.enable(gl.BLEND);
gl.blendFuncSeparate(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA, gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
gl.enable(gl.STENCIL_TEST);

// Positions are relative to this place, so that those of a small region keep their digits in single precision.
let origin = [0, 0, 0];
for (let i = 0; i < n; ++i) origin = minus(origin, times(node(i), -1 / n));
origin = Math.hypot(...origin) > 0.9 ? unit(origin) : [0, 0, 0];

// Longer arcs, in radians, are drawn as several pieces.
const longest2 = 0.03 * 0.03;

// Triangles, lines or points that grow until they are shown. Colours are four bytes.
class Shape {
  constructor() {
    this.size = 0;
    this.places = new Float32Array(3 << 12);
    this.colours = new Uint32Array(1 << 12);
  }
  point(p, colour = 0) {
    if (this.size === this.colours.length) {
      const larger = from => { const to = new from.constructor(2 * from.length); to.set(from); return to; };
      this.places = larger(this.places);
      this.colours = larger(this.colours);
    }
    for (let k = 0; k < 3; ++k) this.places[3 * this.size + k] = p[k] - origin[k];
    this.colours[this.size++] = colour;
  }
  arc(a, b) {
    if (distance2(a, b) > longest2) {
      const m = middle(a, b);
      this.arc(a, m);
      this.arc(m, b);
    } else {
      this.point(a);
      this.point(b);
    }
  }
  // Each long side is divided at its middle, so triangles on both sides of it fit.
  face(a, b, c, colour) {
    const ab = distance2(a, b), bc = distance2(b, c), ca = distance2(c, a);
    if (!(Math.max(ab, bc, ca) > longest2)) {  // also if a corner is NaN
      for (const p of [a, b, c]) this.point(p, colour);
    } else if (bc > ab && bc >= ca) {
      this.face(b, c, a, colour);
    } else if (ca > ab) {
      this.face(c, a, b, colour);
    } else {
      const m = middle(a, b);
      this.face(a, m, c, colour);
      this.face(m, b, c, colour);
    }
  }
}

const layers = [];
// Lines are one pixel wide. Wider ones are drawn several times, moved by a pixel or less.
const thick = [[0.5, 0], [-0.5, 0], [0, 0.5], [0, -0.5]];
function layer(mode, options) {
  layers.push({mode, size: 1, opacity: 1, moves: [[0, 0]], count: 0, visible: true, places: gl.createBuffer(), ...options});
  return layers[layers.length - 1];
}
function show(layer, shape) {
  const fill = (buffer, content) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, content, gl.STATIC_DRAW);
  };
  fill(layer.places, shape.places.subarray(0, 3 * shape.size));
  if (layer.colours) fill(layer.colours, shape.colours.subarray(0, shape.size));
  layer.count = shape.size;
}

const bytes = hex => [1, 3, 5].map(k => parseInt(hex.slice(k, k + 2), 16));
const palette = (shades === null ? ['#ffffff'] : data.colours).map(hex => new Uint32Array(Uint8Array.of(...bytes(hex), 255).buffer)[0]);
const colourOf = face => palette[shades === null ? 0 : shades[face]];
const lineColour = shades === null ? '#1f5f8b' : data.ticks ? '#ffffff' : '#555555';

const graticule = layer(gl.LINES, {colour: '#d5dce3'});
// Cells end at the boundary: they are drawn where triangles have set the stencil.
const mask = layer(gl.TRIANGLES, {colour: '#ffffff', opacity: 0});
const faces = layer(gl.TRIANGLES, {colours: gl.createBuffer(), masked: true});
const sides = layer(gl.LINES, {colour: lineColour, masked: true});
const arcs = layer(gl.LINES, {colour: lineColour});
const edge = layer(gl.LINES, {colour: '#d55e00', moves: thick});
const halo = layer(gl.LINES, {colour: '#ffffff', opacity: 0.45, moves: [[1, 0.5], [-1, -0.5]]});
const coasts = layer(gl.LINES, {colour: '#1c1c1c'});
const dots = layer(gl.POINTS, {colour: '#222222'});
const marked = layer(gl.LINES, {colour: '#d55e00', moves: thick}), markedPoint = layer(gl.POINTS, {colour: '#d55e00', size: 7});

const gap = new Float32Array(n);  // from each node to one of its neighbours
const boundary = [];  // its nodes
{
  const inside = new Shape(), fill = new Shape(), cellSides = new Shape(), triangleArcs = new Shape(), outline = new Shape();
  const points = new Shape();
  const centres = new Float64Array(3 * count);
  for (let t = 0; t < count; ++t) centres.set(circumcentre(t), 3 * t);
  const centre = t => [centres[3 * t], centres[3 * t + 1], centres[3 * t + 2]];
  for (let k = 0; k < corners.length; ++k) {
    const t = k / 3 | 0, v = corners[k], w = corners[k % 3 === 2 ? k - 2 : k + 1];
    let other = -1;  // the triangle on the other side of the arc
    for (let s = begin[v]; s < begin[v + 1]; ++s) {
      const u = around[s];
      if (u !== t && (corners[3 * u] === w || corners[3 * u + 1] === w || corners[3 * u + 2] === w)) other = u;
    }
    if (other >= 0 && v > w) continue;
    const a = node(v), b = node(w);
    if (other < 0) {
      boundary.push(v);
      outline.arc(a, b);
    }
    gap[v] = gap[w] = Math.sqrt(distance2(a, b));
    triangleArcs.arc(a, b);
    // The side between the cells of v and w. At the boundary it leads far beyond.
    const from = centre(t), to = other < 0 ? times(unit(cross(a, b)), -1) : centre(other);
    cellSides.arc(from, to);
    if (data.cells) fill.face(a, from, to, colourOf(v));
    if (data.cells) fill.face(b, from, to, colourOf(w));
  }
  for (let t = 0; t < count; ++t) {
    if (!data.cells) fill.face(...triangle(t), colourOf(t));
    if (boundary.length > 0) inside.face(...triangle(t));
  }
  for (let v = 0; v < n; ++v) points.point(node(v));
  for (const [to, shape] of [[mask, inside], [faces, fill], [sides, cellSides], [arcs, triangleArcs], [edge, outline], [dots, points]])
    show(to, shape);

  const lines = new Shape();
  for (let x = -180; x < 180; x += 10) {
    const end = x % 90 === 0 ? 90 : 80;  // few meridians reach the poles
    for (let y = -end; y < end; ++y) lines.arc(place(x, y), place(x, y + 1));
  }
  for (let y = -80; y < 90; y += 10)
    for (let x = 0; x < 360; ++x) lines.arc(place(x, y), place(x + 1, y));
  show(graticule, lines);

  const shore = new Shape();
  for (const steps of data.coasts || [])
    for (let k = 0, x = 0, y = 0, last = null; k < steps.length; k += 2) {
      const p = place((x += steps[k]) / 1e5, (y += steps[k + 1]) / 1e5);
      if (last !== null) shore.arc(last, p);
      last = p;
    }
  show(halo, shore);
  show(coasts, shore);
  if (!data.coasts) get('coasts').parentElement.remove();
}
const hasBoundary = boundary.length > 0;

// ---- The view: a centre, and half of the smaller side of the window as a multiple of the sphere's radius.

const home = {lon: 0, lat: 30, half: 1.04};
if (hasBoundary) {
  let sum = [0, 0, 0], least = 1;
  for (let i = 0; i < n; ++i) sum = minus(sum, times(node(i), -1));
  if (Math.hypot(...sum) > 1e-6) Object.assign(home, angles(sum));
  for (const v of boundary) least = Math.min(least, dot(place(home.lon, home.lat), node(v)));
  if (least > 0.35) home.half = 1.06 * Math.sqrt(1 - least * least);
}
if (data.centre) [home.lon, home.lat] = data.centre;
if (data.radius !== undefined) home.half = Math.min(1.04, Math.sin(Math.min(90, data.radius) * degree));
// A step of single precision is less than a pixel.
const nearest = Math.hypot(...origin) > 0 ? 1e-8 : 1e-4;

const view = {...home};
let scale = 1, east, north, up;  // pixels for a radius, and the directions of the view
const width = () => canvas.clientWidth, height = () => canvas.clientHeight;

function look() {
  view.lat = Math.max(-90, Math.min(90, view.lat));
  view.lon -= 360 * Math.round(view.lon / 360);
  view.half = Math.max(nearest, Math.min(1.3, view.half));
  [east, north, up] = axes(view.lon, view.lat);
  scale = Math.max(1, Math.min(width(), height()) / 2 / view.half);
}
// The place on the sphere at pixels right of and below the corner of the canvas; null: none.
function under(x, y) {
  const right = (x - width() / 2) / scale, above = (height() / 2 - y) / scale, rest = 1 - right * right - above * above;
  return rest < 0 ? null : unit([0, 1, 2].map(k => right * east[k] + above * north[k] + Math.sqrt(rest) * up[k]));
}
function turn(dx, dy) {
  view.lon -= dx / scale / degree / Math.max(0.1, Math.cos(view.lat * degree));
  view.lat += dy / scale / degree;
  redraw();
}
// Zooms, and keeps the place at x, y where it is.
function zoom(factor, x = width() / 2, y = height() / 2) {
  const held = under(x, y);
  view.half *= factor;
  look();
  const now = under(x, y);
  if (held && now) {
    const a = angles(held), b = angles(now);
    view.lon += a.lon - b.lon;
    view.lat += a.lat - b.lat;
  }
  redraw();
}

function draw() {
  look();
  const ratio = window.devicePixelRatio || 1, w = width(), h = height();
  canvas.style.background = `radial-gradient(circle ${Math.min(scale, 1e5)}px, #f4f6f8 100%, #fff 100%)`;
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
  gl.uniformMatrix3fv(uniform('turn'), false, [0, 1, 2].flatMap(k => [east[k], north[k], up[k]]));
  gl.uniform3f(uniform('origin'), dot(origin, east), dot(origin, north), dot(origin, up));
  gl.uniform2f(uniform('scale'), 2 * scale / w, 2 * scale / h);

  // Lines fade where neighbours in the middle of the view are close together.
  const apart = gap[nodeAt(up)] * scale, faint = Math.max(0, Math.min(1, (apart - 2) / 6)) * (shades === null ? 1 : 0.6);
  sides.opacity = arcs.opacity = faint;
  sides.visible = get('cells').checked && faint > 0;
  arcs.visible = get('triangles').checked && faint > 0;
  dots.visible = get('nodes').checked && apart > 4;
  dots.size = Math.max(1.5, Math.min(5, 0.15 * apart)) * ratio;
  coasts.visible = halo.visible = get('coasts') !== null && get('coasts').checked;
  for (const layer of layers.filter(({visible, count}) => visible && count > 0)) {
    gl.bindBuffer(gl.ARRAY_BUFFER, layer.places);
    gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
    if (layer.colours) {
      gl.bindBuffer(gl.ARRAY_BUFFER, layer.colours);
      gl.vertexAttribPointer(1, 4, gl.UNSIGNED_BYTE, true, 0, 0);
      gl.enableVertexAttribArray(1);
    } else {
      gl.disableVertexAttribArray(1);
      gl.vertexAttrib4f(1, ...bytes(layer.colour).map(byte => byte / 255), layer.opacity);
    }
    gl.stencilFunc(layer.masked && hasBoundary ? gl.EQUAL : gl.ALWAYS, 1, 1);
    gl.stencilOp(gl.KEEP, gl.KEEP, layer === mask ? gl.REPLACE : gl.KEEP);
    gl.uniform1f(uniform('size'), layer.size);
    for (const [x, y] of layer.moves) {
      gl.uniform2f(uniform('shift'), 2 * x / w, 2 * y / h);
      gl.drawArrays(layer.mode, 0, layer.count);
    }
  }
  const across = 2 * Math.asin(Math.min(1, w / 2 / scale)) * 6371;
  get('view').textContent = `above ${named(view.lon, view.lat, 2)}` +
      (w / 2 < scale ? `; ${across < 1 ? `${digits(1000 * across, 3)} m` : `${digits(across, 3)} km`} wide` : '');
}
let waiting = false;
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; draw(); });
}

// ---- What readers see.

// 12345.678 with six digits: "12,345.7"
const digits = (value, precision) => value.toLocaleString('en', {maximumSignificantDigits: precision});
function named(lon, lat, decimals) {
  lon -= 360 * Math.round(lon / 360);
  const one = (angle, letters) => `${Number(Math.abs(angle).toFixed(decimals))}° ${letters[angle < 0 ? 1 : 0]}`;
  return `${one(lat, 'NS')}, ${one(lon, 'EW')}`;
}
function areaText(area) {
  const km2 = area * 6371 * 6371;
  return km2 < 0.1 ? `${digits(km2 * 1e6, 6)} m²` : `${digits(km2, 6)} km²`;
}

// The node nearest to a place: the cell that contains it.
function nodeAt(p) {
  let best = 0, least = 5;
  for (let v = 0, k = 0; v < n; ++v, k += 3) {  // by differences, which keep the digits of small distances
    const x = xyz[k] - p[0], y = xyz[k + 1] - p[1], z = xyz[k + 2] - p[2], square = x * x + y * y + z * z;
    if (square < least) least = square, best = v;
  }
  return best;
}
function isIn(t, p) {
  const [a, b, c] = triangle(t), left = (a, b) => dot(cross(minus(b, a), minus(p, a)), a) >= 0;
  return left(a, b) && left(b, c) && left(c, a);
}

// Writes what is known of the node nearest to a place, or nothing if the place is null or beyond the boundary.
function showAt(p) {
  const outline = new Shape(), dot = new Shape(), parts = [];
  const v = p === null ? -1 : nodeAt(p), {triangles, neighbours, cell, open} = star(Math.max(v, 0));
  const t = v < 0 ? undefined : triangles.find(t => isIn(t, p));
  if (v >= 0 && !(open && t === undefined)) {
    parts.push(`node ${v + data.first}`, named(lon[v], lat[v], 6));
    if (numbers) parts.push(`${data.name}: ${numbers[v] === null ? 'none' : `${digits(numbers[v], 6)} ${data.unit}`.trim()}`);
    else if (data.words) parts.push(`${data.name}: ${data.words[v] || 'none'}`);
    if (open) parts.push('on the boundary');
    else if (data.cells) parts.push(`cell ${areaText(cell.reduce((sum, p, k) => sum + areaOf(node(v), cell.at(k - 1), p), 0))}`);
    if (!data.cells && t !== undefined) parts.push(`triangle ${t + data.first}: ${areaText(areaOf(...triangle(t)))}`);
    parts.push(`${neighbours.length} neighbours: ${neighbours.map(w => w + data.first).join(' ')}`);
    const ring = !data.cells && t !== undefined ? triangle(t) : open ? [] : cell;
    ring.forEach((p, k) => outline.arc(p, ring[(k + 1) % ring.length]));
    dot.point(node(v));
  }
  get('node').textContent = parts.join('; ');
  show(marked, outline);
  show(markedPoint, dot);
  redraw();
}

// Turns the globe to a node, and zooms so that its neighbours can be seen.
function goTo(v) {
  Object.assign(view, {lon: lon[v], lat: lat[v], half: Math.min(view.half, Math.max(nearest, 8 * gap[v]))});
  showAt(node(v));
}

// ---- Mouse, fingers, keys.

const fingers = new Map();  // the places of pointers that are down
const local = event => [event.offsetX, event.offsetY];
canvas.addEventListener('pointerdown', event => {
  canvas.setPointerCapture(event.pointerId);
  fingers.set(event.pointerId, local(event));
  showAt(under(...local(event)));
});
canvas.addEventListener('pointermove', event => {
  const now = local(event), last = fingers.get(event.pointerId);
  if (last === undefined) return showAt(under(...now));
  const other = [...fingers].find(([id]) => id !== event.pointerId);
  fingers.set(event.pointerId, now);
  if (other === undefined) return turn(now[0] - last[0], now[1] - last[1]);
  const [x, y] = other[1], from = Math.hypot(last[0] - x, last[1] - y), to = Math.hypot(now[0] - x, now[1] - y);
  if (to > 0) zoom(from / to, (now[0] + x) / 2, (now[1] + y) / 2);
  turn((now[0] - last[0]) / 2, (now[1] - last[1]) / 2);
});
for (const kind of ['pointerup', 'pointercancel']) canvas.addEventListener(kind, event => fingers.delete(event.pointerId));
canvas.addEventListener('wheel', event => {
  if (window !== window.parent && document.activeElement !== canvas) return;  // scrolls a notebook until the globe is clicked
  event.preventDefault();
  zoom(Math.exp(Math.max(-100, Math.min(100, event.deltaY)) * 0.002), ...local(event));
}, {passive: false});
const keys = {
  ArrowLeft: () => turn(40, 0), ArrowRight: () => turn(-40, 0), ArrowUp: () => turn(0, 40), ArrowDown: () => turn(0, -40),
  '+': () => zoom(0.7), '=': () => zoom(0.7), '-': () => zoom(1 / 0.7), Home: () => Object.assign(view, home),
};
document.addEventListener('keydown', event => {  // also before a click, while nothing has the focus
  const action = event.target === canvas || event.target === document.body ? keys[event.key] : null;
  if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
  event.preventDefault();
  action();
  look();
  showAt(up);
});
document.querySelectorAll('[type=checkbox]').forEach(box => box.onchange = redraw);
const number = get('number');
number.min = data.first;
number.max = n - 1 + data.first;
get('search').onsubmit = event => {
  event.preventDefault();
  goTo(number.value - data.first);
};

// ---- Begin. After # in the address: a node, or longitude, latitude and the radius of the view in degrees.

document.title = get('title').textContent = data.title;
get(data.cells ? 'cells' : 'triangles').checked = true;
const add = (parent, kind, text = '') => {
  parent.append(Object.assign(document.createElement('div'), {className: kind, textContent: text}));
  return parent.lastChild;
};
if (data.legend) add(get('legend'), '', data.legend);
if (data.ticks) {
  const bar = add(get('legend'), 'bar');
  bar.style.background = `linear-gradient(to right, ${data.colours.slice(0, -1)})`;
  for (const [part, label] of data.ticks) {
    const tick = bar.appendChild(document.createElement('span'));
    tick.textContent = label;
    tick.style.left = `${100 * part}%`;
  }
}
const shade = (label, count, colour) => add(get('legend'), 'shade', `${label} (${digits(count, 15)})`).style.setProperty('--colour', colour);
if (shades) data.labels.slice(0, 70).forEach((label, k) => data.counts[k] > 0 && shade(label, data.counts[k], data.colours[k]));
if (hasBoundary) shade('boundary nodes', boundary.length, '#d55e00');
new ResizeObserver(() => {
  canvas.width = width() * (window.devicePixelRatio || 1);
  canvas.height = height() * (window.devicePixelRatio || 1);
  draw();
}).observe(canvas);
if (location.hash.length > 1) {
  const [first, ...others] = location.hash.slice(1).split(',').map(Number);
  if (others.length > 0) {
    Object.assign(view, {lon: first, lat: others[0], half: others[1] ? Math.sin(others[1] * degree) : home.half});
    look();
    showAt(up);
  } else if (first >= data.first && first < n + data.first) {
    goTo(first - data.first);
  }
}
window.globe = {view, star, opened: performance.now()};
})();
