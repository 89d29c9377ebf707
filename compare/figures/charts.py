"""Charts drawn by gnuplot, as SVG and PNG."""
import math
import subprocess
from dataclasses import dataclass, field

# The colours of Okabe and Ito, which colour-blind readers can distinguish.
BLACK, GREY, ORANGE, SKY, GREEN, YELLOW, BLUE, VERMILION, PURPLE = (
    "#000000", "#999999", "#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7")
KEY_ROW, TITLE_ROW = 14, 20  # pixels: the height of a line
PALETTE = [BLUE, ORANGE, GREEN, VERMILION, SKY, PURPLE, YELLOW]


@dataclass
class Curve:
    label: str
    points: list  # of (x, y)
    colour: str
    dash: int = 1  # gnuplot's: 1 solid, 2 dashed, 3 dotted
    symbol: int = 7  # gnuplot's point type


@dataclass
class Panel:
    title: str
    curves: list
    x: str
    y: str
    ticks: list = field(default_factory=list)  # of x; none: powers of ten
    log_y: bool = True


def _quoted(text):
    return "'" + text.replace("'", "''") + "'"


def _ranges(panels):
    """Ranges that fit all these panels; the range of y ends at ticks."""
    xs, ys = zip(*(point for panel in panels for curve in panel.curves for point in curve.points))
    x_range = f"set xrange [{min(xs) / 1.15:g}:{max(xs) * 1.15:g}]"
    if not panels[0].log_y:
        return [x_range, f"set yrange [0:{math.ceil(2 * max(ys)) / 2:g}]"]
    low, high = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
    return [x_range, f"set yrange [1e{low}:1e{max(high, low + 1)}]"]


def _commands(panel, number):
    curves = [curve for curve in panel.curves if curve.points]
    if not curves:
        return ["set multiplot next"]
    lines = [f"set title {_quoted(panel.title)} offset 0,{len(curves) * KEY_ROW / TITLE_ROW:.2f}",
             f"set xlabel {_quoted(panel.x)}", f"set ylabel {_quoted(panel.y)}",
             "unset logscale", "set logscale x", "set xtics auto", "set format x '10^{%L}'", "set format y '%g'"]
    if panel.ticks:
        lines += ["set format x '%g'", "set xtics (" + ", ".join(f"'{t}' {t}" for t in panel.ticks) + ")"]
    if panel.log_y:
        lines += ["set logscale y", "set format y '10^{%L}'"]
    for i, curve in enumerate(curves):
        lines += [f"$c{number}_{i} << END", *(f"{x:g} {y:g}" for x, y in curve.points), "END"]
    plots = [f"$c{number}_{i} using 1:2 with linespoints title {_quoted(c.label)} linecolor rgb '{c.colour}' "
             f"dashtype {c.dash} pointtype {c.symbol} linewidth 1.6 pointsize 0.5" for i, c in enumerate(curves)]
    return lines + ["plot " + ", ".join(plots)]


def draw(path, title, rows, note, own_ranges=False):
    """Writes path.svg and path.png: rows of panels, the title above, the note below. With own_ranges each panel
    has its own ranges, else all have the same."""
    panels = [panel for row in rows for panel in row]
    columns = max(map(len, rows))
    keys = KEY_ROW * max(len(panel.curves) for panel in panels)  # between a title and its panel
    width, height = max(460 * columns, 820) + 40, (300 + keys) * len(rows) + 70
    margins = f"{80 / width:.4f},{1 - 20 / width:.4f},{80 / height:.4f},{1 - (75 + keys) / height:.4f}"
    gaps = f"{85 / width:.4f},{(100 + keys) / height:.4f}"
    commands = []
    for terminal, suffix in (("svg", "svg"), ("pngcairo", "png")):
        commands += ["reset session",
                     f"set terminal {terminal} size {width},{height} font 'DejaVu Sans,11' background '#ffffff'",
                     f"set output {_quoted(f'{path}.{suffix}')}",
                     f"set multiplot layout {len(rows)},{columns} title {_quoted(title)} "
                     f"margins screen {margins} spacing screen {gaps}",
                     f"set label 1 {_quoted(note)} at screen 0.5,{14 / height:.4f} center font ',8.5'",
                     "set key at graph 0,graph 1.02 bottom left vertical maxcols 1 Left reverse samplen 2.5 font ',9'",
                     "set grid xtics ytics linetype 1 linecolor rgb '#dddddd'", "set border linecolor rgb '#666666'",
                     *_ranges(panels)]
        for number, panel in enumerate(panels):
            commands += (_ranges([panel]) if own_ranges else []) + _commands(panel, number) + ["unset label 1"]
        commands += ["unset multiplot", "set output"]
    subprocess.run(["gnuplot"], input="\n".join(commands), text=True, check=True)
