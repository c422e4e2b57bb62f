# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
"""The manual page, for scdoc, and completions of hapnet-study, from the table of its options."""

from __future__ import annotations

import re

import hapnet
from hapnet.study.options import (
    COMMANDS, COMMON, EXAMPLES, EXIT_CODES, NOTES, OPTIONS, PROGRAM, SUMMARY, options_of, usage_of,
)


def generated(what: str) -> str:
    """The text for man, bash, zsh or fish."""
    return {"man": _man, "bash": _bash, "zsh": _zsh, "fish": _fish}[what]()


def _plain(text: str) -> str:
    """Text without meaning for scdoc."""
    return re.sub(r"([^\w\s])", r"\\\1", text).replace("_", r"\_")


def _man() -> str:
    lines = [f'{PROGRAM}(1) "" "Hapnet {hapnet.__version__}"', "", "# NAME", "",
             f"{PROGRAM} - trials with people over an emulated network", "", "# SYNOPSIS", ""]
    lines += [f"*{_plain(usage_of(name))}*" + (r"++" if name != "check" else "")
              for name in COMMANDS]
    lines += ["", "# DESCRIPTION", "", _plain(SUMMARY), "", "# OPTIONS", ""]
    for short, name, value, text in COMMON:
        names = f"*{_plain(short)}*, *{_plain(name)}*" if short else f"*{_plain(name)}*"
        lines += [f"{names} {_plain(value)}".rstrip(), f"\t{_plain(text)}", ""]
    for option in OPTIONS:
        lines += [f"*{_plain(option.name)}* {_plain(option.value)}".rstrip(),
                  f"\t{_plain(option.help)} ({', '.join(option.commands)})", ""]
    lines += ["# COMMANDS", ""]
    for name, text in COMMANDS.items():
        lines += [f"## {name}", "", f"{_plain(text)}", ""]
    lines += ["# NOTES", "", *[_plain(line) for line in NOTES.splitlines()], "", "Examples:", "```",
              EXAMPLES, "```", "", "# EXIT STATUS", "", "```", EXIT_CODES, "```"]
    return "\n".join(lines) + "\n"


def _names(command: str) -> list[str]:
    return [option.name for option in options_of(command)] + ["-h", "--help"]


def _bash() -> str:
    cases = []
    for name in COMMANDS:
        values = ["        case $before in"]
        for option in options_of(name):
            if option.choices:
                words = " ".join(option.choices)
                values.append(f"        {option.name})"
                              f' COMPREPLY=($(compgen -W "{words}" -- "$word")); return ;;')
            elif option.value:
                values.append(f"        {option.name}) return ;;")
        cases += [f"    {name})", *values, "        esac",
                  f"        words='{' '.join(_names(name))}'", "        ;;"]
    top = " ".join([*COMMANDS, "-h", "--help", "-V", "--version", "--generate"])
    generate = COMMON[2][2].replace("|", " ")
    return "\n".join([
        "_hapnet_study() {",
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}",
        "    local command= words i",
        "    COMPREPLY=()",
        "    for ((i = 1; i < COMP_CWORD; ++i)); do",
        f"        case ${{COMP_WORDS[i]}} in {'|'.join(COMMANDS)}) command=${{COMP_WORDS[i]}}"
        " && break ;; esac",
        "    done",
        "    case $command in",
        *cases,
        "    *)",
        f'        if [[ $before == --generate ]]; then COMPREPLY=($(compgen -W "{generate}" --'
        ' "$word")); return; fi',
        f"        words='{top}'",
        "        ;;",
        "    esac",
        '    [[ $word == -* || -z $command ]] && COMPREPLY=($(compgen -W "$words" -- "$word"))',
        "}",
        f"complete -o default -F _hapnet_study {PROGRAM}", ""])


def _quoted(text: str) -> str:
    return text.replace("'", "'\\''")


def _zsh() -> str:
    lines = [f"#compdef {PROGRAM}", "_hapnet_study() {", "    local -a commands=("]
    lines += [f"        '{name}:{_quoted(text)}'" for name, text in COMMANDS.items()]
    lines += ["    )", "    local word command=", "    for word in ${words[2,CURRENT-1]}; do",
              "        (( ${commands[(I)$word:*]} )) && command=$word && break", "    done",
              "    case $command in"]
    for name in COMMANDS:
        lines += [f"    {name})", "        _arguments \\"]
        for option in options_of(name):
            text = _quoted(option.help).replace("[", r"\[").replace("]", r"\]").replace(":", r"\:")
            what = f"({' '.join(option.choices)})" if option.choices else "_files"
            value = f":{option.value}:{what}" if option.value else ""
            lines.append(f"            '{option.name}[{text}]{value}' \\")
        lines += ["            '--help[Print help and exit]' \\", "            '*:file:_files'",
                  "        ;;"]
    lines += ["    *)", "        (( $#commands )) && _describe command commands",
              "        _arguments '--help[Print help and exit]' \\",
              "            '--version[Print the version and exit]' \\",
              f"            '--generate[Print a page or completions]:what:({_generate_words()})'",
              "        ;;", "    esac", "}", '_hapnet_study "$@"', ""]
    return "\n".join(lines)


def _generate_words() -> str:
    return COMMON[2][2].replace("|", " ")


def _fish() -> str:
    lines = [f"complete -c {PROGRAM} -s h -l help -d 'Print help and exit'",
             f"complete -c {PROGRAM} -s V -l version -d 'Print the version and exit'",
             f"complete -c {PROGRAM} -l generate -x -a '{_generate_words()}'"]
    for name, text in COMMANDS.items():
        none = f"not __fish_seen_subcommand_from {' '.join(COMMANDS)}"
        lines.append(f"complete -c {PROGRAM} -n '{none}' -a {name} -d '{_quoted(text)}'")
        for option in options_of(name):
            takes = f" -x -a '{' '.join(option.choices)}'" if option.choices else (
                " -r" if option.value else "")
            lines.append(f"complete -c {PROGRAM} -n '__fish_seen_subcommand_from {name}'"
                         f" -l {option.name[2:]}{takes} -d '{_quoted(option.help)}'")
    return "\n".join(lines) + "\n"
