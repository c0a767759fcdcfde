# SPDX-License-Identifier: GPL-2.0-or-later
"""Wrong command lines of furrow: one line that states what is allowed, status 2. And scripts that
crash the parser of LIGGGHTS.

    command_line.py <furrow> [<mpirun -n>]
"""

import sys

from fault_table import Table, run, run_script

SCRIPT = """variable length index 1
variable speed index 2
variable twice equal 2*v_length
print "length ${length}"
if "${speed} > 3" then "variable angle index 4" "print ${angle}"
include part.lig
"""
PART = 'variable width index 5\nprint "$x ${width}"\n'

# words, status, output
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
     ["'lenght' that no line of 'script.lig' reads", "length, speed, width, angle", "did you mean 'length'?"]),
    ("-in script.lig -var x 1 -var length 3 -var length 4", 2, ["the variable 'length' twice, as '3' and '4'"]),
    ("-in script.lig -var x 1 -var print 3", 2, ["'print' that no line"]),
    ("-in bed_in_part.lig -var depht 3", 2, ["'depht'", "depth"]),
    ("-in script.lig -log nowhere/log", 2, ["'nowhere/log' of -log or -screen cannot be written: No such file"]),
    ("-in script.lig -log .", 2, ["Is a directory"]),
    ("-in script.lig -screen nowhere/screen", 2, ["'nowhere/screen'"]),
    ("-in script.lig -log script.lig", 2, ["file 'script.lig' of -log or -screen is the script"]),
    ("-in utf16.lig", 2, ["script 'utf16.lig' is written in UTF-16; allowed: a text in UTF-8"]),
    ("-in zeros.lig", 2, ["script 'zeros.lig' has bytes of value 0: it is no text"]),
    ("-in cr.lig", 2, ["script 'cr.lig' has lines that end with CR alone"]),
    ("-in script.lig -echo loudly", 2, ["-echo with 'loudly'", "none, screen, log, both"]),
    ("--variables", 2, ["option --variables without its value"]),
    ("--variables nofile.lig", 2, ["script 'nofile.lig' cannot be read: No such file"]),
    ("--variables utf16.lig", 2, ["written in UTF-16"]),
    ("--variables script.lig -in part.lig", 2, ["two scripts"]),
    ("--variables script.lig", 0, ['"length": "1"', '"angle": "4"', '"width": "5"', '"twice"', '/part.lig"', '"not_found": []']),
    ("--variables computed.lig", 0, ['"in_paths": [\n  "part"\n ]', '"not_found": [\n  "${part}"']),
    ("--keys", 0, ['"fix wheel/rigid": {', '"diameter": {', '"allowed": "a number > 0 [m]"']),
    ("--version", 0, ["furrow", "LIGGGHTS 3.8.0"]),
    ("--help", 0, ["Usage: furrow -in <script>", "--version"]),
    # lines that must not be refused: a branch that is not taken, an included file, a negative number
    ("-in script.lig -log none -var x 1 -var angle 7", 0, ["length 1"]),
    ("-in script.lig -log none -var x 1 -var width -6", 0, ["1 -6"]),
    ("-i script.lig -l none -v length 3 4 5 -v x 1", 0, ["length 3"]),
    # nothing is known of what a script with an unknown include reads
    ("-in computed.lig -log none -var other 1", 0, ["part 5"]),
]

BOX = "units si\natom_style granular\natom_modify sort 0 0\nregion box block -1 1 -1 1 -1 1 units box\ncreate_box 1 box\n"
DEEP = "is more than 200 brackets or variables deep; allowed: variables that are not made of themselves"
# name, script, status, text of the message
SCRIPTS = [
    ("variables of each other", 'variable a equal v_b\nvariable b equal v_a\nprint "${a}"\n', 1, [DEEP, "line 3: "]),
    ("brackets of a formula", f"variable f equal {'(' * 20000}1{')' * 20000}\nprint \"${{f}}\"\n", 1, [DEEP]),
    ("brackets of a condition", f"if \"{'(' * 20000}1{')' * 20000}\" then \"print x\"\n", 1, [DEEP]),
    ("fifty brackets", f"variable f equal {'(' * 50}1{')' * 50}\nprint \"value ${{f}}\"\n", 0, ["value 1"]),
    ("a long string", f"variable s string {'a' * 100000}\nprint after\n", 0, ["after"]),
    ("a script that includes itself", "include script.lig\n", 1,
     ["command include, file 'script.lig' stands within 50 files that include another"]),
    ("an included text in UTF-16", "include utf16.lig\n", 1, ["command include, file 'utf16.lig' is written in UTF-16"]),
    ("a missing file", "include nofile.lig\n", 1, ["Cannot open input script nofile.lig", "paths of include and jump"]),
    ("a checkpoint onto the script", BOX + "write_restart script.lig\n", 1,
     ["restart file 'script.lig' would replace a file of another kind"]),
    ("a checkpoint onto a checkpoint", BOX + "write_restart ck\nwrite_restart ck\n", 0, []),
    ("a seed", BOX + "fix p all particletemplate/sphere 10002 atom_type 1 density constant 2600 radius constant 0.01\n", 1,
     ["> 10000 and a prime number", "the number behind 'seed' in the line below", "particletemplate"]),
    ("restart without steps", BOX + "restart 0 ck\n", 1, ["write 'restart <steps> <file>' with steps above 0"]),
]


def main(furrow, *mpirun):
    table = Table()
    files = {"script.lig": SCRIPT, "part.lig": PART, "empty.lig": "",
             "computed.lig": 'variable n string part\nvariable file equal 1\nvariable x index part\n'
                             'variable part getenv HOME\nif "1 > 2" then "include ${part}"\ninclude part.lig\n'}
    # A bed is found from the folder of the file with its line
    files |= {"bed_in_part.lig": "variable depth index 1\ninclude parts/bed_line.lig\n",
              "parts/bed_line.lig": "bed ../beds/bed.lig depth ${depth}\n", "beds/bed.lig": "variable half equal 0.5*${bed_depth}\n"}
    for folder in ("parts", "beds"):
        (table.folder / folder).mkdir()
    for name, text in files.items():
        (table.folder / name).write_text(text)
    (table.folder / "utf16.lig").write_bytes(SCRIPT.encode("utf-16"))
    (table.folder / "zeros.lig").write_bytes(SCRIPT.encode("utf-16-le"))
    (table.folder / "cr.lig").write_bytes(SCRIPT.replace("\n", "\r").encode())
    for words, status, texts in CASES:
        said = run([furrow, *("" if word == "EMPTY" else word for word in words.split())], table.folder)
        table.check(words, said, status, *texts)
        if status == 2:
            table.expect(f"{words}: one line", len(said.text.splitlines()) == 1, said.text)
    for name, script, status, texts in SCRIPTS:
        table.check(name, run_script(furrow, table.folder, script), status, *texts)
    (table.folder / "script.lig").write_text(SCRIPT)
    for words in ("-in nofile.lig", "-in script.lig -var lenght 3"):
        table.check(f"{words}, two ranks", run([*mpirun, 2, furrow, *words.split()], table.folder), 2)
    table.end()


if __name__ == "__main__":
    main(*sys.argv[1:])
