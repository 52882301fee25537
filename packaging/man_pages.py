"""Manual pages in the language of man(7), of what the program says of itself."""
import re

SECTIONS = {"Examples:": "EXAMPLES", "Exit codes:": "EXIT STATUS"}


def escaped(text):
    text = text.replace("\\", "\\e").replace("-", "\\-").replace("'", "\\(aq")
    return "\\&" + text if text.startswith(".") else text


def bold(text):
    return f"\\fB{escaped(text)}\\fR"


def italic(text):
    return f"\\fI{escaped(text)}\\fR"


def term(entry):
    names = ", ".join(bold(name) for name in entry.names)
    return f"{names} {italic(entry.argument)}" if entry.argument else names


def listed(entries, label=term):
    for entry in entries:
        text = entry.description.rstrip(".") + "." + " Required." * entry.required
        yield from (".TP", label(entry), escaped(text))


def synopsis(page):
    options = [e for e in page.options if e.required]
    required = [f"{bold(e.names[-1])} {italic(e.argument)}" for e in options]
    positionals = [italic(e.argument) + "..." * e.repeated for e in page.positionals]
    return " ".join([bold(f"raytube {page.command}"), *positionals, *required, "[" + italic("OPTION") + "]..."])


def example(line):
    """An example of the help, and behind its command, if there is any, the remark in brackets."""
    command, _, remark = line.strip().partition("      (")
    return [escaped(command)] + ([f"    ({escaped(remark)}"] if remark else [])


def status(line):
    code, _, meaning = line.strip().partition("  ")
    return [".TP", bold(code), escaped(meaning[:1].upper() + meaning[1:] + ".")]


def footer(lines):
    """The text below the options: paragraphs, then sections of examples and of exit codes."""
    text, section = [], None
    for line in lines:
        if line in SECTIONS:
            if section == "EXAMPLES":
                text.append(".EE")
            section = SECTIONS[line]
            text += [f".SH {section}"] + ([".EX"] if section == "EXAMPLES" else [])
        elif not line:
            text += [".PP"] if section is None else []
        elif section is None:
            text.append(escaped(line))
        else:
            text += example(line) if section == "EXAMPLES" else status(line)
    return text + [".EE"] if section == "EXAMPLES" else text


def page_head(name, version, summary):
    return [f'.TH {escaped(name.upper())} 1 "" "raytube {version}" "raytube"', ".nh", ".ad l", ".SH NAME",
            f"{escaped(name)} \\- {escaped(summary[:1].lower() + summary[1:])}"]


def see_also(names):
    references = [f"{bold(name)}(1)" for name in names]
    pages = f"All of the documentation, with worked cases, is in {italic('share/doc/raytube')} of the folder raytube is installed in."
    return [".SH SEE ALSO", ",\n".join(references), ".PP", pages]


def command_page(page, version):
    lines = page_head(f"raytube-{page.command}", version, page.summary)
    lines += [".SH SYNOPSIS", synopsis(page), ".SH DESCRIPTION"]
    described = footer(page.footer)
    split = next((i for i, line in enumerate(described) if line.startswith(".SH")), len(described))
    lines += described[:split] + [".SH OPTIONS", *listed(page.positionals, lambda e: italic(e.argument)), *listed(page.options)]
    return lines + described[split:] + see_also(["raytube"])


def program_page(whole, commands, version):
    lines = page_head("raytube", version, whole.summary)
    lines += [".SH SYNOPSIS"]
    for page in commands:
        lines += [synopsis(page), ".br"]
    lines += [f"{bold('raytube')} {bold('--version')}", ".SH DESCRIPTION"]
    lines += [f"{escaped(whole.summary)}. Each command has a page of its own.", ".SH COMMANDS"]
    lines += listed(whole.commands, lambda e: f"\\fB{escaped('raytube-' + e.names[0])}\\fR(1)")
    lines += [".SH OPTIONS", *listed(whole.options)]
    codes = whole.footer[whole.footer.index("Exit codes:"):]
    return lines + footer(codes) + see_also([f"raytube-{page.command}" for page in commands])


def man_pages(whole, commands, version):
    """Text of each page by its file name."""
    pages = {"raytube.1": program_page(whole, commands, version)}
    pages.update({f"raytube-{page.command}.1": command_page(page, version) for page in commands})
    return {name: re.sub(r"\n{2,}", "\n", "\n".join(lines)) + "\n" for name, lines in pages.items()}
