#!/usr/bin/env python3
"""Doxygen's input filter: the comments that headers of this project carry anyway become documentation.

    comments.py HEADER      writes the header to standard output, as many lines as it has

- the comment at the head of the file, before `#pragma once`, is that of the file; lines in it that are indented keep their breaks;
- a comment behind a declaration is that of the declaration, with the lines that continue it;
- a comment behind several names, `dvec3 begin, end;  // ...`, is that of each.
"""
import re
import sys

TRAILING = re.compile(r"(?P<code>.*[;,})\w]) *(?<![:/])//(?![/])(?P<text> .*)")
NAME = r"\w+(?:\{[^{}]*\}| = [^,;]+)?"
SEVERAL = re.compile(rf"(?P<type> +(?:mutable )?[\w:]+(?:<.*>)?) (?P<names>{NAME}(?:, {NAME})+);")
CONTINUED = re.compile(r" +//(?![/])(?P<text> .*)")


def formulas_kept(lines):
    """Lines that are indented further keep their breaks."""
    def indented(line):
        return line.startswith("//   ")

    for before, line, after in zip(["", *lines], lines, [*lines[1:], ""]):
        opening = " @verbatim" if indented(line) and not indented(before) else ""
        closing = " @endverbatim" if indented(line) and not indented(after) else ""
        yield f"{opening}{line[2:]}{closing}"


def head_documented(lines):
    """The comment takes the place of `#pragma once`, too: line numbers stay."""
    end = next((i for i, line in enumerate(lines) if not line.startswith("//")), len(lines))
    if end == 0 or lines[end:end + 1] != ["#pragma once"]:
        return lines
    *head, last = formulas_kept(lines[:end])
    return ["/** @file", *head, f"{last} */", *lines[end + 1:]]


def documented(code, gap, text):
    several = SEVERAL.fullmatch(code)
    if not several:
        return f"{code}{gap}///<{text}"
    *names, last = re.findall(NAME, several["names"])
    first = " ".join(f"{several['type']} {name}; /**<{text} */" for name in names)
    return f"{first} {several['type']} {last};{gap}///<{text}"


def trailing_documented(lines):
    column = None  # of the comment that the next line may continue
    for line in lines:
        continued = CONTINUED.fullmatch(line)
        trailing = TRAILING.fullmatch(line)
        if continued and column is not None and line.index("//") == column:
            yield f"{line[:column]}///<{continued['text']}"
        elif trailing and not trailing["code"].lstrip().startswith(("#", "//", "}")):
            code, text = trailing["code"], trailing["text"]
            column = line.index("//", len(code))
            yield documented(code, line[len(code):column], text)
        else:
            column = None
            yield line


def main():
    with open(sys.argv[1], encoding="utf-8") as header:
        lines = header.read().splitlines()
    print("\n".join(trailing_documented(head_documented(lines))))


if __name__ == "__main__":
    main()
