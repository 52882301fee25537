"""Experiment two: six ways to launch rays. Double slit and open box."""
import math
import statistics

import page
import pictures
from solves import published, table

SOURCES = {"S1": "random", "S2": "angles", "S3": "octahedron", "S4": "box-grid", "S5": "plane-wave", "S6": "geometry"}
ASKED = ("2000", "10000", "25000", "100000")
MOST = ASKED[-1]
PASSES = 5  # the median of whose seconds counts


def counted(folder, part):
    """{(model, rays asked): rows of all positions} of the part whose hits are counted."""
    found = {}
    for row in table(folder / "sources.csv"):
        if row["part"] == part:
            found.setdefault((row["model"], row["rays_asked"]), []).append(row)
    return found


def order(hits):
    """S6 > S1 > ...: by hits per hundred rays, of most rays."""
    return " > ".join(sorted(SOURCES, key=lambda s: -float(hits[s, MOST])))


def hits_table(ours, theirs):
    rows = []
    for source, model in SOURCES.items():
        for asked in ASKED:
            row = ours[model, asked][0]
            a, b = float(row["hit_percent"]), float(theirs[source, asked])
            rows.append((f"{source} {model}", asked, row["rays"], f"{b:.2f}", f"{a:.2f}", page.ratio(a, b)))
    return page.table("slits-hits", "Hits on the screen per hundred rays", ("source", "about", "rays", "published", "raytube", "ratio"), rows)


def seconds_table(passes, theirs):
    rows = []
    for source, model in SOURCES.items():
        ours = statistics.median(float(p[model, MOST][0]["seconds"]) for p in passes)
        before = float(theirs[source, MOST])
        rows.append((f"{source} {model}", passes[0][model, MOST][0]["rays"], f"{before:.2f}", f"{ours:.3f}", page.ratio(ours, before)))
    caption = f"Seconds for about 100 000 rays; published: MATLAB on a Xeon E5-1620 v2; raytube: median of {PASSES} runs"
    return page.table("slits-seconds", caption, ("source", "rays", "published", "raytube", "ratio"), rows)


def error_table(ours):
    """Both estimates against what they tend to, with their bounds."""
    def triple(row, estimate, exact, bound):
        if not row[estimate]:
            return ("–",) * 4
        x, truth = float(row[estimate]), float(row[exact])
        return f"{x:.4f}", f"{truth:.4f}", f"{x - truth:+.4f}", f"{float(row[bound]):.4f}"

    rows = [(f"{source} {model}", *triple(row, "direct_percent", "limit_percent", "limit_bound_percent"),
             *triple(row, "estimate_percent", "exact_percent", "estimate_bound_percent"))
            for source, model in SOURCES.items() for row in ours[model, MOST]]
    head = ("source", "direct hits (%)", "exact limit", "off by", "bound", "weighted (%)", "exact share", "off by", "bound")
    return page.table("slits-errors", "How far about 100 000 rays are off: direct hits, and the share of the solid angle", head, rows)


def hits_picture(file, ours, theirs):
    panels = {f"{source} {model}": ([(float(n), float(theirs[source, n])) for n in ASKED],
                                    [(float(r["rays"]), float(r["hit_percent"])) for n in ASKED for r in ours[model, n]])
              for source, model in SOURCES.items()}
    pictures.hits(file, panels)


def slits(program):
    folders = [program("sources", "double_slit/case", f"slits_{i}", *(("--set", "output.plots=false") if i else ())) for i in range(PASSES)]
    passes = [counted(folder, "screen") for folder in folders]
    ours, theirs = passes[0], published("double_slit", "hits")
    hits_picture(program.work / "slits_published.png", ours, theirs)
    our_order = order({(s, MOST): ours[m, MOST][0]["hit_percent"] for s, m in SOURCES.items()})
    return page.section(
        "slits", "Double slit: six ways to launch rays",
        page.note("The numbers are those of our dimensions of the scene: the published ones are known in part only."),
        page.picture(program.work / "slits_published.png", "Hits on the screen per hundred rays, published and raytube"), hits_table(ours, theirs),
        page.table("slits-order", "Order by hits, about 100 000 rays", ("published", "raytube"), [(order(theirs), our_order)]),
        seconds_table(passes, published("double_slit", "seconds")), error_table(ours),
        page.picture(program.keep(folders[0] / "launch.png", "slits_launch"), "Points through which about 2000 rays go, or from which they start"),
        page.picture(program.keep(folders[0] / "hits.png", "slits_hits"), "Where about 100 000 rays met the screen"))


# ---------------------------------------------------------------- box
def direct_error(rows):
    """Root mean square of the relative error of the weighted direct share, over the positions that see the receiver."""
    seen = [(float(r["estimate_percent"]), float(r["exact_percent"])) for r in rows if float(r["exact_percent"]) > 0]
    return math.sqrt(sum((a / b - 1)**2 for a, b in seen) / len(seen))


def percent(share):
    return f"{100 * share:.0f} %" if share >= 0.1 else f"{100 * share:.2g} %"


def box_table(ours):
    rows = []
    for (model, asked), positions in ours.items():
        hits = statistics.mean(float(r["hit_percent"]) for r in positions)
        seconds = sum(float(r["seconds"]) for r in positions)
        rows.append((model, asked, positions[0]["rays"], "–", f"{hits:.3f}", percent(direct_error(positions)), f"{seconds:.3f}"))
    head = ("model", "about", "rays a position", "published", "raytube: hits per hundred rays", "direct share off by (rms)", "seconds")
    return page.table("box-hits", "Hits on the receiver, mean of 37 positions; seconds of all of them", head, rows)


def box(program):
    folder = program("sources", "open_box/case", "box", "--set", f"source.rays=[{','.join(ASKED)}]")
    return page.section(
        "box", "Open box: a source on a half circle",
        page.note("No published numbers are at hand, and all dimensions are ours."),
        page.picture(program.keep(folder / "sources.png", "box"), "Response against position, 5° each, about 100 000 rays"),
        box_table(counted(folder, "receiver")))
