"""One page of HTML: sections of text, tables and embedded pictures."""
import base64
import html

STYLE = """body{font:15px/1.5 system-ui,sans-serif;color:#222;max-width:1120px;margin:2em auto;padding:0 1em}
table{border-collapse:collapse;margin:1em 0}caption{text-align:left;font-weight:600;padding:.3em 0}
th,td{padding:.15em .8em;border-bottom:1px solid #ddd;text-align:right;font-variant-numeric:tabular-nums}
th:first-child,td:first-child{text-align:left}thead th{border-bottom:2px solid #888}
figure{margin:1.2em 0}figure img{max-width:100%;height:auto}figcaption{color:#555}.note{color:#555}
@media print{figure,table{break-inside:avoid}}"""


def text(words):
    return f"<p>{html.escape(words)}</p>\n"


def note(words):
    return f'<p class="note">{html.escape(words)}</p>\n'


def cells(kind, values):
    return "<tr>" + "".join(f"<{kind}>{html.escape(str(v))}</{kind}>" for v in values) + "</tr>\n"


def table(name, caption, head, rows):
    return (f'<table id="{name}"><caption>{html.escape(caption)}</caption><thead>\n{cells("th", head)}</thead><tbody>\n'
            + "".join(cells("td", row) for row in rows) + "</tbody></table>\n")


def picture(file, caption):
    """The picture itself is in the page; without gnuplot there is none."""
    if not file.exists():
        return note(f"No picture (gnuplot is not installed): {caption}")
    data = base64.b64encode(file.read_bytes()).decode()
    return (f'<figure><img alt="{html.escape(caption)}" src="data:image/png;base64,{data}">'
            f"<figcaption>{html.escape(caption)}</figcaption></figure>\n")


def section(name, heading, *parts):
    return f'<section id="{name}"><h2>{html.escape(heading)}</h2>\n{"".join(parts)}</section>\n'


def whole(title, parts):
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title>\n'
            f'<meta name="viewport" content="width=device-width"><style>{STYLE}</style></head><body>\n'
            f"<h1>{html.escape(title)}</h1>\n{''.join(parts)}</body></html>\n")


def ratio(ours, theirs):
    """Three digits; a dash where there is nothing to divide by."""
    return f"{ours / theirs:.3g}" if theirs else "–"
