# SPDX-License-Identifier: GPL-2.0-or-later
"""The pages of the guide work as printed: guide.py <source> <build> <scratch> <page>...

Each page is a session. Its files are saved, its commands run one after the other in a scratch tree
that looks like the source tree, and its script fragments run in the place of the same lines of a
complete script. A scene runs small, with the variables of its line "# Quick:" or of COARSE. A sweep is
checked. Commands that several pages show run once, and equal runs of a scene share their results.
"""

import re
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[k] / name) for k, name in ((1, "support"), (2, "postproc"))]
from copied import is_python, run_command

SECONDS = 900  # of one command
PROGRAM = re.compile(
    r"([A-Z_]+=\S+ )*(bash (inputs|results)/|cd |cp |mkdir |mpirun |ctest |cmake |ffmpeg |furrow(-\w+)? "
    r"|build/|postproc/|inputs/|/usr/bin/python3 |paraview |pvpython )"
)
SAVE = re.compile(r"\b[Ss]ave\b[^`.]*\bas\s+`([^`]+)`[^`]*:$")
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.M | re.S)
BASE = "README.md"  # its script completes fragments
# Not run here: what each needs, and the test that has it
ELSEWHERE = (
    (r"cmake --build build --target site", "the job 'site' of .ci/run"),
    (r"(\w+=\S+ )?paraview ", "ParaView"),
    (r"inputs/laboratory/(run|calibrate|identify)\.py (?!--list)", "scenes.laboratory.*"),
    (r"bash inputs/run$", "scenes.two_grounds"),
    (r"bash tests/run( --all)?$", "this run of tests"),
    (r"(cmake|ctest) ", "this build"),
)
# Smaller than the quick versions, whose values tests/scenes checks
COARSE = {
    "two_axles": {"cell": "0.1", "distance": "0.4"},
    "tyre_on_snow": {"cell": "0.1", "distance": "0.25"},
    "wheel_on_sintered_snow": {"diameter": "0.08", "travel": "0.3"},
    "wheel_on_snow": {"cell": "0.1", "distance": "0.3", "vtk": "1200"},
}


class Session:
    def __init__(self, source: Path, build: Path, scratch: Path) -> None:
        self.source, self.root = source, scratch
        self.done: set[str] = set()
        self.results: dict[str, str] = {}  # folder of each run of a scene
        self.saved: set[str] = set()  # names of files that pages bring
        shutil.rmtree(scratch, ignore_errors=True)
        scratch.mkdir(parents=True)
        for entry in source.iterdir():
            if entry.name not in ("inputs", "build", "results", ".git"):
                (scratch / entry.name).symlink_to(entry)
        (scratch / "build").symlink_to(build)
        # Pages write into inputs; the folders of studies are only read.
        (scratch / "inputs").mkdir()
        for entry in (source / "inputs").iterdir():
            place = scratch / "inputs" / entry.name
            if entry.name in ("scenes", "tyres", "materials", "meshes", "points", "guide", "beds"):
                shutil.copytree(entry, place, ignore=shutil.ignore_patterns("*.png", "results"))
            else:
                place.symlink_to(entry)

    def run(self, command: str, folder: str = ".", fails: bool = False) -> str:
        print(f"+ {command}", flush=True)
        # the command behind inputs/run, when nothing is to be built
        direct = re.sub("^bash inputs/run (.*--no-build)", r"postproc/furrow-post run \1", command)
        chosen = direct if is_python(direct) else command
        status, said = run_command(chosen, self.root / folder, self.root / "build", SECONDS)
        assert bool(status) == fails, f"{said}\n'{command}' ended with status {status}"
        return said

    def command(self, command: str, later: str) -> None:
        """Runs a command of a page, small, once; later: the commands after it."""
        if any(re.match(start, command) for start, _ in ELSEWHERE):
            return
        small = self.small(command, later)
        if small in self.done:
            return
        self.done.add(small)
        scene = re.fullmatch(r"(bash inputs/run .*--no-build --no-pictures .*) -o (\S+)(.*)", small)
        folder = self.results.setdefault(scene[1] + scene[3], scene[2]) if scene else ""
        if scene and folder != scene[2]:
            print(f"= {small}: as {folder}", flush=True)
            shutil.copytree(self.root / folder, self.root / scene[2])
        else:
            self.run(small)

    def small(self, command: str, later: str) -> str:
        """Command that is run for it. A scene that the tests of scenes run has its variables checked, unless
        a later command reads its results, or the page brings the scene or a file."""
        words = shlex.split(command)
        if words[:2] == ["postproc/furrow-post", "sweep"]:  # the tests of sweeps draw
            return "postproc/furrow-post sweep --help"
        if words[:2] == ["furrow-post", "budget"]:  # a shortened run has no steady values
            return "furrow-post budget --help"
        if words[:2] == ["furrow-tyre", "fit"] and "--tests" in words:  # drivers.tyre_files fits them
            return f"{command} --check"
        if words[:2] != ["bash", "inputs/run"] or "--help" in words:
            return command
        scene = words[2]
        script = scene if scene.endswith(".lig") else f"inputs/scenes/{scene}.lig"  # of this tree
        if "--error" in words:  # scenes.error makes pilot and run
            return f"postproc/furrow-post variables -- {script}"
        if "--sweep" in words:
            return f"{command} --no-build --check"
        given = {words[k + 1]: words[k + 2] for k, word in enumerate(words) if word == "-v"}
        quick = "--quick" in words
        folder = f"results/{Path(scene).stem}{'_quick' if quick else ''}"
        if "-o" in words:
            folder = words[words.index("-o") + 1]
        own = [scene, *(Path(value).name for value in given.values())]
        if not re.search(rf"{folder}\b", later) and not self.saved & set(own):
            pairs = [word for pair in given.items() for word in pair]
            return f"postproc/furrow-post variables -- {shlex.join([script, *pairs])}"
        if "-o" not in words:  # into this tree, and not into that of the program
            words += ["-o", folder]
        for name, value in COARSE.get(scene, {}).items():
            if name not in given:
                words += ["-v", name, value]
        for name in {"cell", "diameter"} & given.keys():  # a coarser one is quick as well
            place = words.index(given[name], words.index(name))
            smallest = {**self.quick(script), **COARSE.get(scene, {})}[name]
            words[place] = max(smallest, given[name], key=float)
        # tests/scenes has the pictures of every scene
        words[2:3] = [script, "--no-build", "--no-pictures", *([] if quick else ["--quick"])]
        return shlex.join(words)

    def quick(self, script: str) -> dict[str, str]:
        line = re.search(r"^# Quick: *(.*)$", (self.root / script).read_text(encoding="utf-8"), re.M)
        if line is None:
            sys.exit(f"{script}: has no line '# Quick:' for the small version")
        words = shlex.split(line[1])
        return dict(zip(words[1::3], words[2::3]))

    def fragment(self, page: Path, text: str) -> None:
        """Lines of a script run in the place of the same lines of a complete one."""
        first_page = BLOCK.finditer((self.source / BASE).read_text(encoding="utf-8"))
        base = next(block for block in first_page if "create_box" in block[2])
        whole = re.search(r"^create_box ", text, re.M)
        lines = joined(text if whole else base[2])
        for line in () if whole else joined(text):
            start = " ".join(line.split()[:2])
            places = [k for k, other in enumerate(lines) if " ".join(other.split()[:2]) == start]
            assert places, f"{page}: '{line}' replaces no line of the script of {BASE}"
            lines[places[0]] = line
        lines = [line if not line.startswith("run") else "run 20" for line in lines]
        script = self.root / "inputs" / "scenes" / "fragment.lig"
        script.write_text("variable bed_level equal 0.12\n" + "\n".join(lines) + "\n", encoding="utf-8")
        said = self.run("furrow -in fragment.lig -log none", "inputs/scenes")
        assert "ERROR" not in said, f"{said}\n{page}: the lines\n{text}do not run"


def joined(text: str) -> list[str]:
    """Lines of a script, those that '&' continues as one, without comments."""
    lines = text.replace("&\n", " ").splitlines()
    return [line.strip() for line in lines if line.strip() and not line.startswith("#")]


def blocks(page: Path) -> Iterator[tuple[str, str, str]]:
    """Paragraph before, language and text of each code block."""
    text, end = page.read_text(encoding="utf-8"), 0
    for block in BLOCK.finditer(text):
        yield text[end : block.start()].strip().rpartition("\n\n")[2], block[1], block[2]
        end = block.end()


def check(session: Session, page: Path) -> int:
    """Number of commands, files and fragments of a page."""
    count, said, shown = 0, "", page.read_text(encoding="utf-8")
    for before, language, text in blocks(page):
        saved = SAVE.search(before)
        if saved:
            file = session.root / saved[1]
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
            session.saved |= {saved[1], file.name}
            count += 1
            continue
        shipped = re.search(r"\[`?([\w./]+)`?\]\(([^)]+)\) (?:holds|adds|reads):?$", before)
        if shipped and text.strip() not in (page.parent / shipped[2]).read_text(encoding="utf-8"):
            sys.exit(f"{page}: the block is not a part of {shipped[2]}")
        if before.endswith("fails, as it should:"):
            said = " ".join(session.run(text.strip(), "inputs/scenes", fails=True).split())
            count += 1
        if before.startswith("The error") and " ".join(text.split()) not in said:
            sys.exit(f"{page}: shows\n{text}not what the command prints:\n{said}")
        if language:
            continue
        lines = text.replace("\\\n", " ").splitlines()
        commands = [line.split(" #")[0].strip() for line in lines if PROGRAM.match(line)]
        for command in commands:
            session.command(command, shown.partition(command)[2])
        script = re.search(r"^fix ", text, re.M) and "..." not in text  # no syntax
        if script and not commands and not shipped:
            session.fragment(page, text)
            count += 1
        count += len(commands)
    return count


def table_rows(text: str, column: str) -> Iterator[dict[str, str]]:
    """Rows of the tables that have a column of this name."""
    names: list[str] = []
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.startswith("|"):
            names = []
        elif not names:
            names = cells
        elif column in names and not set(line) <= set("|-: "):
            yield dict(zip(names, cells))


def declared(listing: str) -> list[tuple[str, str]]:
    """Keys with their units, of a program's list: name, range [unit], default, meaning."""
    columns = [re.split(r" {2,}", line[2:]) for line in listing.splitlines() if line[:2] == "  "]
    units = [re.findall(r"\[([^],]+)\]", column[1]) for column in columns]
    return [(column[0], unit[-1] if unit else "") for column, unit in zip(columns, units)]


def check_keys(session: Session) -> None:
    """The tables of keys have the keys and units of the programs, and no others."""
    brick = (session.source / "src/io/inputs/brick_tyre_file.cpp").read_text(encoding="utf-8")
    of_brick = re.findall(r"(?:number|numbers|flag|integer)\(\s*\"(\w+)\",(?: 0,)?(?: \"([^\"]*)\",)?", brick)
    for page, found in (
        ("soil_files", declared(session.run("furrow-point laws"))),
        ("tyre_files", declared(session.run("furrow-sidewall keys")) + of_brick),
    ):
        text = (session.source / f"inputs/guide/{page}.md").read_text(encoding="utf-8")
        shown = {(key, row["unit"]) for row in table_rows(text, "key") for key in re.findall(r"`(\w+)`", row["key"])}
        if set(found) != shown:
            sys.exit(
                f"{page}: the programs have {sorted(set(found) - shown)}, which the page lacks; "
                f"the page has {sorted(shown - set(found))}, which the programs lack"
            )


def check_messages(source: Path) -> None:
    """The messages of the page of troubleshooting are those of the program."""
    page = (source / "inputs/guide/howto/troubleshooting.md").read_text(encoding="utf-8")
    files = [
        file
        for folder in ("src", "coupling", "postproc/furrow_post", "tests/coupled/faults")
        for file in (source / folder).rglob("*")
        if file.suffix in (".cpp", ".h", ".py", ".faults")
    ]
    # Literals that C++ joins are one text.
    program = "".join(file.read_text(encoding="utf-8") for file in files)
    program = re.sub(r"\"\s*\"", "", program)
    messages = [row["message"].strip("`") for row in table_rows(page, "message")]
    missing = [message for message in messages if message not in program]
    if missing or len(messages) < 20:
        sys.exit(f"troubleshooting.md: {len(messages)} messages; no program prints {missing}")


def main(source: Path, build: Path, scratch: Path, pages: list[Path]) -> None:
    session = Session(source, build, scratch)
    for page in pages:
        print(f"== {page.relative_to(source)}", flush=True)
        count = check(session, page)
        print(f"{count} commands, files and fragments", flush=True)
        assert count or "tutorials" not in page.parts, f"{page}: shows nothing that runs"
        if page.stem == "soil_files":
            check_keys(session)
        if page.stem == "troubleshooting":
            check_messages(source)


if __name__ == "__main__":
    given = [Path(word).resolve() for word in sys.argv[1:]]
    main(given[0], given[1], given[2], given[3:])
