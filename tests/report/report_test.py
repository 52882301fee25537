#!/usr/bin/env python3
"""Reports in headless Chromium: nothing on the console, no request, every switch and every view answers to the mouse.

    report_test.py PROGRAM CASES CASE,... [PICTURES]    CASE: trihedral, which has every view; haul_truck, which has many facets.
                                                        PICTURES: a folder for a picture of every section, to be looked at

The package raytube must be on PYTHONPATH.
"""
import os
import subprocess
import sys
import tempfile

from browser import Browser, chromium

MOST_BYTES = 10_000_000
# Sweeps that have every view between them, quick to solve.
SWEEPS = {
    "trihedral": ["--parts", "--set", "frequency.ghz={start=2.5,stop=3.5,count=21}", "--set", "look.phi_deg={start=0,stop=90,step=1}",
                  "--set", "output.image_look=4"],
    "haul_truck": ["--parts", "--set", "frequency.ghz={start=93,stop=95,count=9}", "--set", "look.phi_deg={start=29,stop=31,step=0.25}",
                   "--set", "output.image_look=4", "--set", "output.image_per_wavelength=2"],
}
SECTIONS = {"words", "curves", "map", "profile", "waterfall", "isar", "centres", "uncertainty", "settings", "mesh", "run"}
# Of a picture on the page, the dots as one number, so that a change is seen.
DOTS = """(selector => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => {
  let sum = 0; const text = document.querySelector(selector).toDataURL();
  for (let i = 0; i < text.length; ++i) sum = (31 * sum + text.charCodeAt(i)) | 0; done(sum); }))))"""


def fail(text):
    sys.exit("report_test: " + text)


def check(condition, text):
    if not condition:
        fail(text)


def dots(browser, section):
    return browser.evaluate(f"{DOTS}('#{section} .plot canvas')")


def sections_of(browser):
    return set(browser.evaluate("[...document.querySelectorAll('section')].filter(section => !section.hidden).map(section => section.id)"))


def tip(browser):
    return browser.evaluate("document.getElementById('tip').hidden ? '' : document.getElementById('tip').textContent")


def middle(browser, section, across=0.5, up=0.5):
    left, top, width, height = browser.box(f"#{section} .plot canvas")
    return left + across * width, top + up * height


def try_switches(browser, section):
    """Each changes the picture, and back again brings the first one."""
    count = browser.evaluate(f"document.querySelectorAll('#{section} input[type=checkbox]').length")
    # Lines in space that lie upon one another may change their order once, when they are made anew: a few dots.
    browser.evaluate(f"document.querySelectorAll('#{section} input[type=checkbox]').forEach(box => {{ box.click(); box.click(); }})")
    before = dots(browser, section)
    for i in range(count):
        click = f"(() => {{ const box = document.querySelectorAll('#{section} input[type=checkbox]')[{i}]; box.click(); return box.parentElement.textContent; }})()"
        name = browser.evaluate(click)
        changed = dots(browser, section)
        browser.evaluate(click)
        check(before == dots(browser, section), f"{section}: {name} on and off again is another picture")
        if (section, name) not in MAY_SHOW_NOTHING:
            check(changed != before, f"{section}: {name} changes nothing")


# A target without the mechanism, an error too small to be seen, or edges that send nothing back.
MAY_SHOW_NOTHING = {("curves", name) for name in ("VH", "HV", "numerical error", "bounce 1", "bounce 2", "bounce 3", "bounce 4", "bounce 5", "edges, order 1",
                                                  "edges, orders 2 and 3", "edge\u2013face interaction", "waves over curved surfaces")}
MAY_SHOW_NOTHING |= {("profile", "VH"), ("profile", "HV"), ("space", "return of edges")}


def try_choices(browser, section):
    """Every entry of every list, every end of every slider; then as it was."""
    browser.evaluate(f"""(() => {{ for (const list of document.querySelectorAll('#{section} select')) {{ const chosen = list.selectedIndex;
        for (let i = 0; i < list.options.length; ++i) {{ list.selectedIndex = i; list.dispatchEvent(new Event('change')); }}
        list.selectedIndex = chosen; list.dispatchEvent(new Event('change')); }} }})()""")
    browser.evaluate(f"""(() => {{ for (const bar of document.querySelectorAll('#{section} input[type=range]')) {{ const at = bar.value;
        for (const value of [bar.min, bar.max, at]) {{ bar.value = value; bar.dispatchEvent(new Event('input')); }} }} }})()""")


def try_mouse(browser, section, words):
    browser.mouse("mouseMoved", *middle(browser, section))
    check(words in tip(browser), f"{section}: the mouse in the middle shows {tip(browser)!r}, without {words!r}")
    before = dots(browser, section)
    browser.drag(middle(browser, section, 0.4, 0.4), middle(browser, section, 0.7, 0.7))
    browser.mouse("mouseMoved", 2, 2)
    check(dots(browser, section) != before, f"{section}: a dragged rectangle zooms nothing")
    at = middle(browser, section)
    for clicks in (1, 2):
        browser.mouse("mousePressed", *at, button="left", clickCount=clicks)
        browser.mouse("mouseReleased", *at, button="left", clickCount=clicks)
    browser.mouse("mouseMoved", 2, 2)
    near = dots(browser, section)
    browser.mouse("mouseWheel", *at, deltaX=0, deltaY=-200)
    browser.mouse("mouseMoved", 2, 2)
    check(dots(browser, section) != near, f"{section}: the wheel zooms nothing")


def check_page(browser, name, page, pictures):
    size = os.path.getsize(page)
    check(size < MOST_BYTES, f"{name}: the page has {size} bytes")
    browser.open(page)
    print(f"{name}: {size / 1e6:.1f} MB")
    sections = sections_of(browser)
    check(sections >= SECTIONS, f"{name}: lacks {SECTIONS - sections}")
    in_space = browser.evaluate("typeof THREE !== 'undefined'")
    if pictures:
        for section in sections:
            browser.picture("#" + section, os.path.join(pictures, f"{name}_{section}.png"))
    plots = sorted(sections & {"curves", "polar", "map", "profile", "waterfall", "doppler", "isar"}) + [s for s in sections if s.startswith("image")]
    for section in plots + (["space"] if in_space else []):
        try_switches(browser, section)
        try_choices(browser, section)
    for section in plots:
        try_mouse(browser, section, "dBsm")
    if in_space:
        try_space(browser)
    try_to_save(browser, name)
    check_narrow(browser, name)
    check(not browser.complaints(), f"{name}: {browser.complaints()}")
    return sections


def try_to_save(browser, name):
    """Every button makes a file; the curves' table has the numbers of the plot."""
    browser.evaluate("window.saved = []; saveAs = (file, blob) => { saved.push([file, blob.type, blob.size]); }; 0")
    browser.evaluate("""window.buttons = [...document.querySelectorAll("button")].filter(
      button => button.textContent.startsWith("save") && !button.closest("section").hidden); 0""")
    buttons = browser.evaluate("buttons.length")
    for i in range(buttons):  # one after the other: the outline of a large target takes its time
        browser.evaluate(f"buttons[{i}].click()")
    saved = browser.evaluate("new Promise(done => { const wait = () => saved.length >= %d ? done(saved) : requestAnimationFrame(wait); wait(); })" % buttons)
    check(buttons > 5 and all(size > 200 for _, _, size in saved), f"{name}: saved {saved}")
    check({kind for _, kind, _ in saved} == {"image/png", "text/csv"}, f"{name}: saved {saved}")
    levels = browser.evaluate("frames[0].table().trim().split('\\n').slice(1).map(line => Number(line.split(',')[1]))")
    shown = browser.evaluate("[...frames[0].series[0].ys]")
    check(len(levels) == len(shown) and all(abs(a - b) < 0.006 for a, b in zip(levels, shown)), f"{name}: the table has {levels[:3]}, the plot {shown[:3]}")


def check_narrow(browser, name):
    """On the screen of a telephone nothing is wider than the page."""
    browser.call("Emulation.setDeviceMetricsOverride", width=420, height=900, deviceScaleFactor=1, mobile=False)
    width = browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(document.documentElement.scrollWidth))))")
    browser.call("Emulation.clearDeviceMetricsOverride")
    check(width <= 420, f"{name}: a window of 420 dots scrolls sideways to {width}")


def try_space(browser):
    before = dots(browser, "space")
    browser.evaluate("document.querySelector('#space button').click()")
    check(dots(browser, "space") != before, "space: the view from the radar is the same")
    browser.mouse("mouseMoved", *middle(browser, "space"))
    check(" m" in tip(browser), f"space: the mouse on the target shows {tip(browser)!r}")
    before = dots(browser, "space")
    browser.drag(middle(browser, "space", 0.4, 0.4), middle(browser, "space", 0.6, 0.5))
    check(dots(browser, "space") != before, "space: a drag does not turn the target")


def main():
    if not chromium():
        print("report_test: skipped, there is no chromium (Debian package chromium, or RAYTUBE_CHROMIUM)")
        sys.exit(77)
    program, cases, names = sys.argv[1:4]
    pictures = sys.argv[4] if len(sys.argv) > 4 else None
    found = set()
    with tempfile.TemporaryDirectory() as folder:
        browser = Browser(*(() if pictures else (800, 700)))  # fewer dots to draw; wider than what a telephone is shown
        try:
            for name, sweep in ((name, SWEEPS[name]) for name in names.split(",")):
                out = os.path.join(folder, name)
                subprocess.run([program, "run", f"{cases}/{name}/case.toml", "-o", out, "--quiet", "--set", "output.plots=false", *sweep], check=True,
                               stderr=subprocess.DEVNULL)
                settings = [word for word in sweep if word != "--parts"]
                subprocess.run([program, "centres", f"{cases}/{name}/case.toml", "-o", out, "--look", "4", "--quiet", *settings], check=True,
                               stderr=subprocess.DEVNULL)
                subprocess.run([program, "report", out, "--quiet"], check=True)
                found |= check_page(browser, name, os.path.join(out, "report.html"), pictures)
        finally:
            browser.close()
    check("trihedral" not in names or "polar" in found and any(section.startswith("image") for section in found), f"no report has every view: {sorted(found)}")


main()
