"""Completions for bash and zsh, of what the program says of itself."""
import re
import shlex


def kind(argument):
    """What completes an argument: "keys", "folders", "files SUFFIX...", "word WORD..." or "nothing"."""
    if argument == "KEY=VALUE":
        return "keys"
    if argument == "DIR":
        return "folders"
    suffixes = re.findall(r"\.([a-z]+)", argument)
    if suffixes:
        return " ".join(["files", *suffixes, *["nc"] * (suffixes == ["csv"])])  # a table may be netCDF wherever it may be CSV
    return f"word {argument.replace('|', ' ')}" if argument.islower() else "nothing"


BASH = r"""# bash completion for raytube, made at build time of the program's own help.
_raytube_kind() {  # COMMAND OPTION-OR-POSITION: what completes it
  case "$1 $2" in
@KINDS@
  esac
}

_raytube_options() {  # COMMAND: its options
  case "$1" in
@OPTIONS@
  esac
}

_raytube_files() {  # SUFFIXES WORD: folders, and files with one of the suffixes
  local suffix
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "$2"; for suffix in $1; do compgen -f -X "!*.$suffix" -- "$2"; done)
}

_raytube_reply() {  # KIND WORD
  case "$1" in
    keys) compopt -o nospace 2>/dev/null
      mapfile -t COMPREPLY < <(compgen -S = -W "@KEYS@" -- "$2") ;;
    folders) _raytube_files "" "$2" ;;
    "files "*) _raytube_files "${1#files }" "$2" ;;
    "word "*) mapfile -t COMPREPLY < <(compgen -W "${1#word }" -- "$2") ;;
  esac
}

# Number of the word under the cursor among those that are neither options nor their arguments.
_raytube_position() {  # COMMAND
  local i position=1 option
  for ((i = 2; i < COMP_CWORD; i++)); do
    option=${COMP_WORDS[i]}
    if [[ $option == -* ]]; then
      [[ -n $(_raytube_kind "$1" "$option") ]] && ((i++))
    elif [[ $option != [=:] && ${COMP_WORDS[i - 1]} != [=:] ]]; then
      ((position++))
    fi
  done
  echo "$position"
}

_raytube() {
  local command=${COMP_WORDS[1]-} word=${COMP_WORDS[COMP_CWORD]-} previous=${COMP_WORDS[COMP_CWORD - 1]} kind
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    mapfile -t COMPREPLY < <(compgen -W "@COMMANDS@ $(_raytube_options "")" -- "$word")
    return
  fi
  [[ $word == [=:] || $previous == [=:] ]] && return  # bash splits words there: within a value
  kind=$([[ $previous == -* ]] && _raytube_kind "$command" "$previous")
  if [ -n "$kind" ]; then
    _raytube_reply "$kind" "$word"
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(_raytube_options "$command")" -- "$word")
  else
    _raytube_reply "$(_raytube_kind "$command" "$(_raytube_position "$command")")" "$word"
  fi
}
complete -F _raytube raytube
"""


def bash_kinds(page):
    for position, entry in enumerate(page.positionals, 1):
        number = '"[0-9]*' if entry.repeated else f'{position}"'
        yield f'    "{page.command} {number}) echo "{kind(entry.argument)}" ;;'
    for entry in page.options:
        if entry.argument:
            patterns = " | ".join(f'"{page.command} {name}"' for name in entry.names)
            yield f'    {patterns}) echo "{kind(entry.argument)}" ;;'


def bash(whole, commands, keys):
    options = [f'    "{page.command}") echo "{" ".join(n for e in page.options for n in e.names)}" ;;' for page in [whole, *commands]]
    kinds = [line for page in commands for line in bash_kinds(page)]
    names = " ".join(page.command for page in commands)
    parts = {"@KINDS@": "\n".join(kinds), "@OPTIONS@": "\n".join(options), "@KEYS@": " ".join(keys), "@COMMANDS@": names}
    text = BASH
    for name, part in parts.items():
        text = text.replace(name, part)
    return text


ZSH = r"""#compdef raytube
# zsh completion for raytube, made at build time of the program's own help.
_raytube_keys() {
  local -a keys=(@KEYS@)
  compadd -S = -- $keys
}

_raytube() {
  local context state state_descr line
  typeset -A opt_args
  _arguments -C @OPTIONS@ '1:command:->command' '*::argument:->argument'
  if [[ $state == command ]]; then
    local -a commands=(@COMMANDS@)
    _describe command commands
    return
  fi
  case $words[1] in
@CASES@
  esac
}

_raytube "$@"
"""


def zsh_action(argument):
    what, _, words = kind(argument).partition(" ")
    suffixes = words.replace(" ", "|")  # a pattern all in brackets would be qualifiers
    pattern = f"*.({suffixes})" if "|" in suffixes else f"*.{suffixes}"
    return {"keys": "_raytube_keys", "folders": "_files -/", "files": f'_files -g "{pattern}"', "word": f"({words})",
            "nothing": " "}[what]


def zsh_plain(text):
    """`text` without what means something to _arguments and _describe."""
    return text.translate(str.maketrans({"[": "(", "]": ")", ":": ",", "\\": ""}))


def zsh_option(entry):
    """Specifications of _arguments for an option, one for each of its names."""
    repeats = "*" if "may be repeated" in entry.description else ""
    excluded = "" if repeats else f"({' '.join(entry.names)})"
    argument = f":{zsh_plain(entry.argument)}:{zsh_action(entry.argument)}" if entry.argument else ""
    for name in entry.names:
        yield shlex.quote(f"{excluded}{repeats}{name}[{zsh_plain(entry.description)}]{argument}")


def zsh_options(page):
    return [specification for entry in page.options for specification in zsh_option(entry)]


def zsh_case(page):
    numbers = ["*" if entry.repeated else str(i) for i, entry in enumerate(page.positionals, 1)]
    positionals = [shlex.quote(f"{n}:{zsh_plain(e.description)}:{zsh_action(e.argument)}") for n, e in zip(numbers, page.positionals)]
    lines = " \\\n        ".join([*zsh_options(page), *positionals])
    return f"    {page.command})\n      _arguments \\\n        {lines} ;;"


def zsh(whole, commands, keys):
    described = " ".join(shlex.quote(f"{page.command}:{zsh_plain(page.summary)}") for page in commands)
    parts = {"@KEYS@": " ".join(keys), "@OPTIONS@": " ".join(zsh_options(whole)), "@COMMANDS@": described,
             "@CASES@": "\n".join(zsh_case(page) for page in commands)}
    text = ZSH
    for name, part in parts.items():
        text = text.replace(name, part)
    return text
