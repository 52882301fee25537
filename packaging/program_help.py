"""What the program says of itself: its commands and options from --help, its case keys from the sentence about an unknown one.

Manual pages and completions are made of this and of nothing else, so that they cannot say anything but what the program does."""
import re
import subprocess
from dataclasses import dataclass, field

COLUMN = 30  # at which CLI11 begins descriptions
NO_KEY = "such_a_key_there_is_not"


@dataclass
class Entry:
    """One line of a list of the help: an option, a positional or a command."""

    names: list  # ["-o", "--output"], ["case"], ["run"]
    argument: str  # "DIR"; empty for a flag
    required: bool
    repeated: bool  # a positional of which there may be several
    needs: str  # the option without which this one means nothing; empty if there is none
    limits: str  # "1 - 4096"; empty if there are none
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
    """`term` is, for example, "--threads N:INT in [1 - 4096]" or "--seed S Needs: --launch"."""
    term, _, needs = term.partition(" Needs: ")
    required = term.endswith(" REQUIRED")
    term = term.removesuffix(" REQUIRED")
    repeated = term.endswith(" ...")
    if repeated:
        term = term.removesuffix(" ...").rstrip(".")
    limits = re.search(r":\w+ in \[(.*)\]$", term)
    if limits:
        term = term[: limits.start()]
    names, _, argument = term.partition(" ")
    return Entry(names.split(","), argument, required, repeated, needs, limits[1] if limits else "", description)


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
    """Help text in paragraphs: summary and usage, lists under their headings, then the footer."""
    lists = {"Positionals:": "positionals", "Options:": "options", "Subcommands:": "commands"}
    first, *paragraphs = text.rstrip("\n").split("\n\n")
    page = Help(command, first.splitlines()[0])
    while paragraphs and paragraphs[0].splitlines()[0] in lists:
        heading, *lines = paragraphs.pop(0).splitlines()
        setattr(page, lists[heading], entries(lines))
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
