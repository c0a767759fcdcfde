# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command in a code block of a page works: commands.py <source> <build> <scratch> <run>.

The guide and the first page are tested by guide.py; run: results of the script OWN_SCRIPT that it made.

Commands that take seconds are run, in a scratch folder that looks like the source tree. Those that
take minutes are checked for what can be seen without running: RULES states how, for each kind of
command. A command that no rule knows fails.
"""

import re
import shlex
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[k] / name) for k, name in ((1, "support"), (2, "postproc"))]
from copied import run_command

PAGES_OF = ("src", "coupling", "inputs", "tests", "postproc")
PROGRAM = re.compile(
    r"([A-Z_]+=\S+ )*(bash |cd |mpirun |furrow(-\w+)? |build/|postproc/|inputs/|tests/|paraview |pvpython )"
)
PLACEHOLDER = re.compile(r"\[|\.\.\.|<|FILE|FOLDER|LABEL")  # of a line that shows the syntax
OWN_SCRIPT = "inputs/guide/tutorials/wheel_in_my_script"
OWN_RUN = f"{OWN_SCRIPT}/results/own_script"  # stands for any results/SCENE of a page
SECONDS = 300  # of one command


def commands(page: Path) -> Iterator[str]:
    """Commands of the code blocks without a language, comments and placeholders left out."""
    blocks = re.findall(r"^```\n(.*?)^```", page.read_text(encoding="utf-8"), re.M | re.S)
    for line in "".join(blocks).replace("\\\n", " ").splitlines():
        text = line.split(" #")[0].strip()
        if PROGRAM.match(text) and not PLACEHOLDER.search(text):
            yield text


class Tree:
    """A folder with links to what the commands of pages name; they write into it alone."""

    def __init__(self, source: Path, build: Path, scratch: Path) -> None:
        self.source, self.root = source, scratch
        shutil.rmtree(scratch, ignore_errors=True)
        (scratch / "inputs").mkdir(parents=True)
        for name in ("src", "coupling", "tests", "postproc"):
            (scratch / name).symlink_to(source / name)
        (scratch / "build").symlink_to(build)
        for entry in (source / "inputs").iterdir():
            if entry.name != "guide":
                (scratch / "inputs" / entry.name).symlink_to(entry)
        shutil.copytree(source / OWN_SCRIPT, scratch / OWN_SCRIPT)

    def run(self, command: str) -> str:
        """Output of a command; the test ends where its status is not 0."""
        print(f"+ {command}", flush=True)
        status, said = run_command(command, self.root, self.root / "build", SECONDS)
        assert not status, f"{said}\n'{command}' ended with status {status}"
        return said


def run(tree: Tree, command: str) -> None:
    """Really."""
    for name in re.findall(r"results/(\w+)", command):
        place = tree.root / "results" / name
        if (tree.source / "inputs" / "scenes" / f"{name}.lig").is_file() and not place.exists():
            place.parent.mkdir(exist_ok=True)
            place.symlink_to(tree.root / OWN_RUN)
    tree.run(command)


def scene(tree: Tree, command: str) -> None:
    """bash inputs/run SCENE -v NAME VALUE, or furrow -in SCRIPT ...: both are there."""
    words = shlex.split(command)
    named = words[words.index("-in") + 1] if "-in" in words else (words[2:] or [""])[0]
    if not named:
        return tree.run("bash inputs/run --help") and None
    script = named if named.endswith(".lig") else f"inputs/scenes/{named}.lig"
    given = [w for k, word in enumerate(words) if word == "-v" for w in words[k + 1 : k + 3]]
    tree.run(f"postproc/furrow-post variables -- {shlex.join([script, *given])}")
    return None


WITH_COMMANDS = ("furrow-post", "identify_snow.py")


def options(tree: Tree, command: str) -> None:
    """A long study or film: its help has every option of the command."""
    words = shlex.split(command)
    program = words[: 2 if words[0].endswith(WITH_COMMANDS) else 1]
    said = tree.run(f"{shlex.join(program)} --help")
    for word in words:
        assert not re.match(r"--?[a-z]", word) or word in said, f"'{command}': the help of {words[0]} has no {word}"


def benchmark(tree: Tree, command: str) -> None:
    """A benchmark, which is built only where its library is installed: its source."""
    found = re.search(r"benchmarks/([\w/]+)", command)
    if not found or not (tree.source / "tests" / "benchmarks" / f"{found[1]}.cpp").is_file():
        sys.exit(f"'{command}': there is no such benchmark")


def compiled(tree: Tree, command: str) -> None:
    """A script of ParaView, which the tests do not install."""
    found = re.search(r"\S+/(\w+\.py)", command)
    assert found
    script = next(word.split("=")[-1] for word in command.split() if word.endswith(found[1]))
    compile((tree.root / script).read_text(encoding="utf-8"), script, "exec")


def tests_run(tree: Tree, command: str) -> None:
    """bash tests/run: this test is part of it."""
    tree.run("bash -n tests/run")


RULES: tuple[tuple[str, Callable[[Tree, str], None]], ...] = (
    (r"(\w+=\S+ )?paraview |pvpython ", compiled),
    (r"bash tests/run", tests_run),
    (r"bash inputs/run|furrow -in ", scene),
    (r"(\w+=\S+ |mpirun -n \d+ )?build/tests/benchmarks/", benchmark),
    (r"tests/benchmarks/\w+\.py$", run),
    (r"tests/benchmarks/\w+\.py ", options),
    (r"(postproc/)?furrow-post (film|flow|laboratory|converge|cost|sweep|study) ", options),
    (r"inputs/\S+\.py --list$", run),
    (r"inputs/(costs|crosscheck|laboratory|validation)/\S+\.py", options),
    (r"furrow-resistance --together ", options),  # OWN_RUN has one wheel
    (r"(\w+=\S+ )?(build/bin/)?furrow-(point|sidewall|tyre|resistance) ", run),
    (r"postproc/furrow-post |postproc/examples/", run),
)


def check_help(tree: Tree, found: list[str]) -> None:
    """The help of each program ends with examples, which are commands of its page."""
    for program in ("point", "resistance", "sidewall", "tyre"):
        said = tree.run(f"furrow-{program} --help")
        examples = said.partition("Examples:\n")[2].strip().splitlines()
        missing = [example for example in map(str.strip, examples) if example not in found]
        assert examples and not missing, f"furrow-{program} --help: {missing or 'no examples'}; its page has {found}"


def main(source: Path, build: Path, scratch: Path, own_run: Path) -> None:
    found_in = [page for part in PAGES_OF for page in (source / part).rglob("*.md")]
    pages = [source / "CONTRIBUTING.md"]
    pages += sorted(page for page in found_in if source / "inputs" / "guide" not in page.parents)
    found = list(dict.fromkeys(command for page in pages for command in commands(page)))
    tree = Tree(source, build, scratch)
    shutil.copytree(own_run, tree.root / OWN_RUN)  # results that commands look at
    check_help(tree, found)
    for command in found:
        rule = next((rule for start, rule in RULES if re.match(start, command)), None)
        assert rule is not None, f"'{command}': no rule of {Path(__file__).name} says how it is checked"
        rule(tree, command)
    assert len(found) >= 40, f"only {len(found)} commands were found in {len(pages)} pages"
    print(f"{len(found)} commands")


if __name__ == "__main__":
    main(*(Path(word).resolve() for word in sys.argv[1:5]))
