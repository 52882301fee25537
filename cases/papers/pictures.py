"""The pictures that raytube does not draw itself, through gnuplot."""
import pathlib
import subprocess
import sys

PALETTE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "figures" / "palette.py"
HEAD = """set encoding utf8
set terminal pngcairo size {size} font 'DejaVu Sans,11' background rgb 'white'
set output '{file}'
set grid lt 1 lw 1 lc rgb '#dddddd'
set style line 1 lc rgb '#1f5fbf' lw 1.6
set style line 2 lc rgb '#8a1fbf' lw 1.6
set style line 3 lc rgb '#b8b8b8' lw 6
set style line 4 lc rgb '#222222' lw 1.5 pt 7 ps 1.1 dt 2
set style line 5 lc rgb '#1f5fbf' lw 2 pt 6 ps 1.2
set style fill noborder
"""


def draw(file, size, script):
    """Nothing is drawn without gnuplot; the page says so."""
    commands = HEAD.format(size=size, file=file) + script
    try:
        subprocess.run(["gnuplot", "-d"], input=commands, text=True, check=True)
    except FileNotFoundError:
        return
    subprocess.run([sys.executable, PALETTE, file], check=True)


def block(name, *columns):
    return f"${name} << EOD\n" + "".join(" ".join(f"{v:.7g}" for v in row) + "\n" for row in zip(*columns)) + "EOD\n"


def curves(results):
    """phi, then σ and model uncertainty of VV, the same of HH, as blocks of these names."""
    def columns(r):
        yield r.phi
        for c in ("vv", "hh"):
            yield r.sigma[c]
            yield r.column("model", c)
    return "".join(block(name, *columns(r)) for name, r in results.items())


LEVEL_PANEL = ("set title '{title}' offset 0,-0.6\nplot {first}, $r using 1:($2-$3):($2+$3) with filledcurves lc rgb '#cfe0f7' "
               "title 'VV, model uncertainty', $r using 1:2 with lines ls 1 title 'VV', $r using 1:4 with lines ls 2 dt (8,4) title 'HH'\n")


def cut(file, closed, far, near, titles, axes):
    """Two panels: the far field over the closed form, and the chamber over the far field."""
    script = block("c", closed.phi, closed.sigma["vv"], closed.sigma["hh"]) + curves({"far": far, "near": near})
    script += (f"set xlabel 'φ (deg)'\nset ylabel 'σ (dBsm)'\nset key outside right top vertical Left reverse samplen 2.5 spacing 1.2\n"
               f"set rmargin 33\nset lmargin 9\nset xrange [{axes[0]}]\nset yrange [{axes[1]}]\nset multiplot layout 2,1\n")
    # VV alone as a broad line beneath: HH of the closed form differs by the sign of the double bounce, which shows in the minima only.
    panels = (("far", "$c using 1:2 with lines ls 3 title 'VV closed form (PO, far)'"),
              ("near", "$far using 1:2 with lines ls 3 title 'VV, far field'"))
    for (name, first), title in zip(panels, titles):
        script += LEVEL_PANEL.format(title=title, first=first).replace("$r", f"${name}")
    draw(file, "1000,760", script + "unset multiplot\n")


def estimates(file, result):
    """Numerical error and model uncertainty of every look of the truck, VV and HH."""
    script, plots = "", []
    for c, style in (("vv", 1), ("hh", 2)):
        script += block(c, result.phi, result.column("err", c), result.column("model", c))
        plots += [f"${c} using 1:3 with lines ls {style} lw 1 dt (3,3) title '{c.upper()} model'",
                  f"${c} using 1:2 with lines ls {style} lw 1.4 title '{c.upper()} numerical'"]
    script += ("set logscale y\nset yrange [0.01:30]\nset xrange [0:180]\nset xtics 15\nset xlabel 'φ (deg): 0 front, 90 side, 180 rear'\n"
               "set ylabel 'estimate (dB)'\nset key outside right top vertical Left reverse samplen 2.5 spacing 1.2\n")
    draw(file, "1000,380", script + f"plot {', '.join(plots)}\n")


def hits(file, panels):
    """Six panels: hits per hundred rays against rays, published and ours. panels: {title: (published, ours)}, both (rays, hits) pairs."""
    script = ("set logscale x\nset xrange [1500:150000]\nset format x '10^{%T}'\nset xtics 1000,10\nset mxtics 10\n"
              "set key at screen 0.5,0.985 center maxcols 2 maxrows 1\n"
              "set multiplot layout 2,3 margins 0.06,0.985,0.1,0.87 spacing 0.055,0.15\n")
    for i, (title, (theirs, ours)) in enumerate(panels.items()):
        top = 1.15 * max(h for _, h in (*theirs, *ours))
        script += block(f"p{i}", *zip(*theirs)) + block(f"o{i}", *zip(*ours))
        script += (f"set title '{title}' offset 0,-0.6\nset yrange [{-0.04 * top}:{top}]\nset xlabel '{'rays' if i > 2 else ''}'\n"
                   f"set ylabel '{'' if i % 3 else 'hits per hundred rays'}'\n"
                   f"plot $p{i} with linespoints ls 4 title 'published', $o{i} with linespoints ls 5 title 'raytube'\nunset key\n")
    draw(file, "1000,600", script + "unset multiplot\n")
