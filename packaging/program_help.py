"""What the program says of itself: its commands and options from --help, its case keys from the sentence about an unknown one.

Manual pages and completions are made of this and of nothing else, so that they cannot say anything but what the program does."""
import re
import subprocess
from dataclasses import dataclass, field

COLUMN = 34  # at which descriptions begin
NO_KEY = "such_a_key_there_is_not"


@dataclass
class Entry:
    """One line of a list of the help: an option, a positional or a command."""

    names: list  # ["-o", "--output"], ["case"], ["run"]
    argument: str  # "DIR"; empty for a flag
    required: bool
    repeated: bool  # a positional of which there may be several
    description: str


@dataclass
class Help:
    command: str  # empty: the program
    summary: str
    positionals: list = field(default_factory=list)
    options: list = field(default_factory=list)
    commands: list = field(default_factory=list)
    footer: list = field(default_factory=list)  # lines


def said_by(program, *arguments):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=True).stdout


def entry(term, description):
    """`term` is, for example, "-j,--threads N", or of the Python package "-j, --threads N"."""
    required = term.endswith(" REQUIRED")
    names, _, argument = term.removesuffix(" REQUIRED").replace(", -", ",-").partition(" ")
    repeated = argument.endswith("...")
    return Entry(names.split(","), argument.removesuffix("...").strip(), required, repeated, description)


def entries(lines):
    """The entries of a list; a term that reaches into the column of descriptions has its own on the next line."""
    found, long_term = [], ""
    for number, line in enumerate(lines):
        following = lines[number + 1] if number + 1 < len(lines) else ""
        if long_term:
            found.append(entry(long_term, line.strip()))
            long_term = ""
        elif following.startswith(" " * COLUMN):
            long_term = line.strip()
        else:
            found.append(entry(line[:COLUMN].strip(), line[COLUMN:].strip()))
    return found


def parsed(command, text):
    """Help text in paragraphs: summary and usage, lists under their headings (of the program, groups of commands), then the footer."""
    lists = {"Positionals:": "positionals", "Options:": "options"}
    first, *paragraphs = text.rstrip("\n").split("\n\n")
    page = Help(command, first.splitlines()[0])
    while paragraphs:
        heading, *lines = paragraphs[0].splitlines()
        group = heading in lists or (not command and heading.endswith(":") and len(lines) > 0 and all(line.startswith("  ") for line in lines))
        if not group or heading in ("Exit codes:", "Examples:"):
            break
        kind = lists.get(heading, "commands")
        setattr(page, kind, getattr(page, kind) + entries(lines))
        paragraphs.pop(0)
    page.footer = "\n\n".join(paragraphs).splitlines()
    return page


def program_and_commands(program):
    """Help of the program and of each of its commands."""
    whole = parsed("", said_by(program, "--help"))
    return whole, [parsed(c.names[0], said_by(program, c.names[0], "--help")) for c in whole.commands]


def version(program):
    return said_by(program, "--version").split()[1]


def keys_offered(program, case, key):
    """What `raytube check` offers in place of an unknown key."""
    complaint = subprocess.run([program, "check", case, "--set", f"{key}=1"], capture_output=True, text=True).stderr
    found = re.search(r"choose among (.*)$", complaint.strip())
    if not found:
        raise SystemExit(f"the program does not say which keys there are beside {key}: {complaint}")
    return found[1].split(", ")


def case_keys(program, case):
    """Dotted names of all case keys but those of [materials], whose names users choose. `case` is any sound case file."""
    keys = []
    for name in keys_offered(program, case, NO_KEY):
        if name == "title":
            keys.append(name)
        elif name != "materials":
            keys += keys_offered(program, case, f"{name}.{NO_KEY}")
    return keys
