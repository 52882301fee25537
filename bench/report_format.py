"""Numbers and tables as the report writes them."""

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value):
    """Three digits; powers of ten where there would be many zeros."""
    if value == 0:
        return "0"
    if 0.01 <= abs(value) < 9.995e4:
        return f"{float(f'{value:.3g}'):,.0f}" if abs(value) >= 1000 else f"{value:.3g}"
    mantissa, power = f"{value:.1e}".split("e")
    return f"{mantissa}·10" + str(int(power)).translate(SUPERSCRIPT)


def seconds(value):
    for scale, unit in ((1, "s"), (1e3, "ms")):
        if value * scale >= 1:
            return f"{number(value * scale)} {unit}"
    return f"{number(value * 1e6)} µs"


def signed(text, sign):
    """`sign` says whether the true value is what stands there (""), at most ("≤") or more than (">") that."""
    return f"{sign} {text}".strip()


def ratio(above, below):
    """The ratio of two values with signs, itself with the sign that follows; ≈ if neither bound is known."""
    up, down = above[1] == ">" or below[1] == "≤", above[1] == "≤" or below[1] == ">"
    return signed(number(above[0] / below[0]), "≈" if up and down else "≥" if up else "≤" if down else "")


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)
