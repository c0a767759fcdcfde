# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post completion: what a shell needs to complete commands, options and scenes."""

from .parameters import Given, argument, command

LINES = {
    "bash": 'eval "$(_FURROW_POST_COMPLETE=bash_source furrow-post)"',
    "zsh": 'eval "$(_FURROW_POST_COMPLETE=zsh_source furrow-post)"',
    "fish": "_FURROW_POST_COMPLETE=fish_source furrow-post | source",
}


@command(argument("shell", ", ".join(LINES), choices=LINES))
def completion(given: Given) -> None:
    print(f"# Add this line to the start file of {given.shell}; furrow-post must be on the PATH")
    print(LINES[given.shell])
