# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong command lines of furrow: one line that says what is allowed, status 2.

    command_line.py <furrow> [<mpirun -n>]
"""

import sys

from faults import Table, run

SCRIPT = """variable length index 1
variable speed index 2
variable twice equal 2*v_length
print "length ${length}"
if "${speed} > 3" then "variable angle index 4" "print ${angle}"
include part.lig
"""
PART = 'variable width index 5\nprint "$x ${width}"\n'

# words, status, what is said
CASES = [
    ("-in nofile.lig", 2, ["script 'nofile.lig' cannot be read: No such file"]),
    ("-in .", 2, ["script '.' is a folder"]),
    ("-in empty.lig", 2, ["script 'empty.lig' is empty"]),
    ("-in", 2, ["option -in without its value"]),
    ("-in script.lig -in part.lig", 2, ["two scripts"]),
    ("script.lig", 2, ["'script.lig', which is no option", "write '-in script.lig'"]),
    ("--unknown", 2, ["no option '--unknown'", "--help"]),
    ("-version", 2, ["did you mean '--version'?"]),
    ("-in script.lig -var", 2, ["-var without a variable"]),
    ("-in script.lig -var length", 2, ["variable 'length' without a value"]),
    ("-var length -in script.lig", 2, ["variable 'length' without a value"]),
    ("-in script.lig -var length=3 1", 2, ["name 'length=3'"]),
    ("-in script.lig -var length EMPTY", 2, ["'length' with an empty value"]),
    ("-in script.lig -var x 1 -var lenght 3", 2,
     ["'lenght' that no line of 'script.lig' reads", "length, speed, angle, width", "did you mean 'length'?"]),
    ("-in script.lig -var x 1 -var print 3", 2, ["'print' that no line"]),
    ("-in script.lig -log nowhere/log", 2, ["'nowhere/log' of -log or -screen cannot be written: No such file"]),
    ("-in script.lig -log .", 2, ["Is a directory"]),
    ("-in script.lig -screen nowhere/screen", 2, ["'nowhere/screen'"]),
    ("-in script.lig -echo loudly", 2, ["-echo with 'loudly'", "none, screen, log, both"]),
    ("--version", 0, ["furrow", "LIGGGHTS 3.8.0"]),
    ("--help", 0, ["Usage: furrow -in <script>", "--version"]),
    # what must not be refused: a branch that is not taken, an included file, a negative number
    ("-in script.lig -log none -var x 1 -var angle 7", 0, ["length 1"]),
    ("-in script.lig -log none -var x 1 -var width -6", 0, ["1 -6"]),
    ("-i script.lig -l none -v length 3 4 5 -v x 1", 0, ["length 3"]),
    # nothing is known of what a script with an unknown include reads
    ("-in computed.lig -log none -var other 1", 0, ["part 5"]),
]


def main(furrow, *mpirun):
    table = Table()
    files = {"script.lig": SCRIPT, "part.lig": PART, "empty.lig": "",
             "computed.lig": 'variable n string part\nvariable file equal 1\nvariable x index part\n'
                             'variable part getenv HOME\nif "1 > 2" then "include ${part}"\ninclude part.lig\n'}
    for name, text in files.items():
        (table.folder / name).write_text(text)
    for words, status, texts in CASES:
        said = run([furrow, *("" if word == "EMPTY" else word for word in words.split())], table.folder)
        table.check(words, said, status, *texts)
        if status == 2:
            table.expect(f"{words}: one line", len(said.text.splitlines()) == 1, said.text)
    for words in ("-in nofile.lig", "-in script.lig -var lenght 3"):
        table.check(f"{words}, two ranks", run([*mpirun, 2, furrow, *words.split()], table.folder), 2)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
