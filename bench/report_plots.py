"""The pictures of the report, through gnuplot."""
import math
import pathlib
import subprocess
import sys

from report_numbers import ADAPTIVE, LEVEL_DB, METHODS, RAYS, TIME, curve

PALETTE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "figures" / "palette.py"
LEAST_DB = 1e-5  # errors below are drawn here: a logarithmic axis has no zero
STYLES = """
set style line 1 lc rgb '#888888' lw 2 pt 5 ps 0.9
set style line 2 lc rgb '#1f5fbf' lw 2 pt 6 ps 1.3
set style line 3 lc rgb '#2e8b3d' lw 2 pt 9 ps 1.2
set style line 4 lc rgb '#8a1fbf' lw 2 pt 11 ps 1.2
set style line 5 lc rgb '#d9480f' lw 2 pt 7 ps 0.9
set grid lt 1 lw 1 lc rgb '#dddddd'
set logscale xy
set format '10^{%T}'
"""


def block(name, rows):
    return f"${name} << EOD\n" + "".join(" ".join(f"{v:.8g}" for v in row) + "\n" for row in rows) + "EOD\n"


def decades(values):
    """Whole decades round all values."""
    return f"[1e{math.floor(math.log10(min(values)))}:1e{math.ceil(math.log10(max(values)))}]"


def error_panels(data, what, scale, label):
    """Six panels: rms error against rays or time. The dotted line is the level that tables speak of."""
    script = (f"set key at screen 0.5,0.97 center maxcols 5 maxrows 1 width 2\nset yrange [{LEAST_DB / 2}:60]\n"
              f"set ytics add ('≤10^{{-5}}' {LEAST_DB})\nset multiplot layout 2,3 margins 0.065,0.985,0.085,0.885 spacing 0.05,0.13\n")
    for i, body in enumerate(data["error"]):
        curves = {m: [(scale * p[what], max(p["rms_db"], LEAST_DB)) for p in points] for m, points in body["methods"].items()}
        plots = []
        for style, method in enumerate(METHODS, 1):
            if method in curves:
                script += block(f"b{i}m{style}", curves[method])
            plots.append(f"{f'$b{i}m{style}' if method in curves else 'NaN'} with linespoints ls {style} title '{method}'")
        script += (f"set title '{body['body']}' offset 0,-0.6\nset xlabel '{label}'\nset ylabel '{'' if i % 3 else 'rms error (dB)'}'\n"
                   f"set xrange {decades([x for rows in curves.values() for x, _ in rows])}\n"
                   f"plot {LEVEL_DB} with lines lc rgb '#444444' dt 3 notitle, {', '.join(plots)}\nunset key\n")
    return script + "unset multiplot\n"


def growth_panels(data):
    """Four panels: time against frequency, triangles, looks, number of frequencies."""
    shown = [g for g in data["growth"] if g["variable"] != "threads"][:4]
    script = "set key left top\nset multiplot layout 2,2\nset ylabel 'time (s)'\n"
    for i, growth in enumerate(shown):
        plots = []
        for style, mode in ((1, "uniform"), (3, ADAPTIVE)):
            script += block(f"g{i}m{style}", curve(growth, mode))
            plots.append(f"$g{i}m{style} with linespoints ls {style} title '{mode}'")
        script += f"set title '{growth['body']}'\nset xlabel '{growth['variable']}'\nplot {', '.join(plots)}\n"
    return script + "unset multiplot\n"


def draw(data, folder):
    """Draws every picture; returns the names drawn, none if gnuplot is missing."""
    pictures = {"error_rays": ("1200,760", error_panels(data, RAYS, 1, "rays per look")),
                "error_time": ("1200,760", error_panels(data, TIME, 1e3, "time per look (ms)")),
                "growth": ("1000,720", growth_panels(data))}
    for name, (size, commands) in pictures.items():
        file = folder / f"{name}.png"
        head = (f"set encoding utf8\nset terminal pngcairo size {size} font 'DejaVu Sans,10' background rgb 'white'\n"
                f"set output '{file}'\n")
        try:
            subprocess.run(["gnuplot", "-d"], input=head + STYLES + commands, text=True, check=True)
        except FileNotFoundError:
            print("no plots: gnuplot is not installed", file=sys.stderr)
            return []
        subprocess.run([sys.executable, PALETTE, file], check=True)
    return list(pictures)
