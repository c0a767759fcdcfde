# SPDX-License-Identifier: GPL-2.0-or-later
"""Faults on the command line of furrow-post, and in the tables that it names."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from furrow_post.uncertainty.cost_table import write_table
from furrow_post.cli.main import main
from support.command import FURROW_POST, SOURCE
from support.faults import FaultsTest, outcome
from support.laboratory import write_plate
from support.runs import write_run
from support.tables import made_runs

SCENE = "wheel_on_snow"
NOT_MEASURED = str(SOURCE / "inputs" / "costs" / "runs.csv")
BEKKER = "bekker --load 6000 --diameter 0.74 --width 0.272 --terrain"
WONG = "wong_reece --load 6000 --diameter 1.2 --width 0.3 --terrain"

# (words of empirical, terrain or None, error)
EMPIRICAL = (
    *(
        (f"nrmm --load 6e3 --diameter 0.74 --width 0.272 --depth 0.2 --density 200 {pressure}", None, said)
        for pressure, said in (
            ("--pressure 179", "a contact pressure of 179 Pa; allowed: 5000 to 2e+06 Pa. Give it in Pa"),
            ("--pressure 179e6 --extrapolate", "a contact pressure of 1.79e+08 Pa; allowed"),
        )
    ),
    (BEKKER, "no such sand", "there is no terrain 'no such sand'; name a soil card, or one of LLL"),
    ("bekker", None, "needs --load, --diameter, --width"),
    (f"--slip 0.2 {BEKKER}", "LETE sand", "does not read --slip; leave it out"),
    (f"--depth 0.2 {BEKKER}", "LETE sand", "does not read --depth; leave it out"),
    (f"--extrapolate {BEKKER.replace('6000', '1e300')}", "LETE sand", "1e+300 N on a wheel of 0.74 m x 0.272 m are 4.97e+300 Pa over"),
    (BEKKER.replace("0.74", "740").replace("0.272", "272"), "LETE sand", "0.0298 Pa over diameter and width; allowed: 20 to"),
    (f"--slip 0.2 {WONG}", "LETE sand", "are not known; a terrain that has them"),
)

# (words after two runs "a b", error)
COMPARE = (
    (["--formula", "nrmm:179e3"], "a: the density of its ground is not known"),
    (["--formula", "nrmm:179"], "a contact pressure of 179 Pa; allowed: 5000 to 2e+06 Pa"),
    (["--formula", "nrmm:"], "write nrmm:PRESSURE with the largest contact pressure"),
    (["--formula", "bekker:no sand"], "there is no terrain 'no sand'"),
    (["--formula", "guess:1"], "there is no formula 'guess'"),
    (["--formula", ""], "there is no formula ''"),
    (["--measured", "none.csv"], "a: has no terrain; --measured needs its depth"),
    (["--errors", "none.csv"], "none.csv: cannot be read"),
    (["-o", "a/history.h5"], "a/history.h5: file exists"),
    (["-o", "/proc/x"], "/proc/x: no such file or directory; check path and rights"),
    (["a"], "a: is given twice; name each results folder once"),
    (["c="], "results: 'c=' has no folder; write LABEL=FOLDER, or FOLDER"),
    (["=c"], "results: '=c' has no label; write LABEL=FOLDER, or FOLDER"),
    (["none"], "none: no such file; name the results folder of a run"),
)

# (words, error)
OTHERS: tuple[tuple[list[str], str], ...] = (
    (["fit-tyre", "235/75R15", "--pressure", "241000", "-o", "x"], "241000 kPa is no pressure of a tyre"),
    (["fit-tyre", "235/75R15", "--pressure", "2.41", "-o", "x"], "give kPa: bar times 100"),
    (["compare", "a"], "needs two results folders"),
    (["compare", "x=a", "x=b"], "/x'; write LABEL=FOLDER"),
    (["compare", "one/plate", "two/plate"], "two curves are called 'plate'; write LABEL=FOLDER"),
    (["plot", "a", "-o", "a"], "a: is a folder; name a file in it"),
    (["plot", "a", "-o", "none/x.png"], "there is no folder none; make it first"),
    (["plot", "a", "-o", "x.gif"], "x.gif: its name must end in .png or .svg or .pdf"),
    (["plot", "a", "-o", "x.svg", "--format", "pdf"], "-o x.svg: is no pdf"),
    (["report", "a", "-o", "x.pdf"], "x.pdf: its name must end in .html"),
    (["report", "a", "-o", "/proc/x.html"], "/proc/x.html: no such file or directory"),
    (["resistance", "a", "a", "--together"], "a: is given twice; name each results folder once"),
    (["resistance", "a", "--csv", "b", "a/."], "a: is given twice"),
    (["export", "none"], "none: no such file; name the results folder of a run"),
    (["export", "a", "a"], "a: is given twice"),
    (["export", "a", "x=b", "x=a/history.h5"], "two runs are called 'x'; write LABEL=FOLDER"),
    (["export", "a", "-o", "a"], "a: is a folder; name a file in it"),
    (["export", "a", "-o", "none/x.csv"], "none/x.csv: there is no folder none; make it first"),
    (["export", "a", "--channels", "hub_dorp"], "did you mean 'hub_drop'?"),
    (["export", "a", "--channels", ","], "no run has the channel ''; allowed: time, stage"),
    (["view", "a"], "a: has nothing to look at; repeat the run with 'vtk N'"),
    (["view", "a", "a"], "a: is given twice"),
    (["view", "a", "b", "one"], "3 results folders are given; a view shows one or two"),
    (["view", "none"], "none: has no results; name the results folder of a run"),
    (["cost", "a", "-o", "/proc"], "/proc: is a folder"),
    (["cost", "a", "a"], "a: is given twice"),
    (["cost", "a", "--write", "/proc/x.csv"], "/proc/x.csv: no such file or directory"),
    (["cost", "none.csv"], "none.csv: cannot be read"),
    (["point", "none"], "none: has neither point.h5 nor fit.h5"),
    (["point", "a"], "a: has neither point.h5 nor fit.h5"),
    (["sidewall", "a"], "a/sidewall.h5: No such file"),
    (["sidewall", "text"], "sidewall.h5: is not a results file of Furrow, or damaged"),
    (["point", "text"], "point.h5: is not a results file of Furrow, or damaged"),
    (["laboratory", "a"], "has no facts.txt; name the results folder of a laboratory test"),
    (["laboratory", "one/plate", "one/plate"], "one/plate: is given twice"),
    (["variables", "none.lig"], "furrow: script 'none.lig' cannot be read: No such file or directory"),
)

# (arguments of inputs/run, message)
RUN: tuple[tuple[list[str], str], ...] = (
    (["no_such_scene"], "no scene 'no_such_scene'"),
    (["wheel_on_snwo"], "no scene 'wheel_on_snwo'. Did you mean wheel_on_snow"),
    (["scenes/tyre_on_sno.lig"], "Did you mean tyre_on_snow"),
    (["tyre_on_snow\n"], "'tyre_on_snow\\n' has a line break or another control character"),
    ([SCENE, "-o", "a\ntouch pwned #"], "'a\\ntouch pwned #' has a line break"),
    ([""], "an argument is empty"),
    ([SCENE, "wheel_on_sand"], "are two scenes; name one"),
    ([SCENE, "-n", "1", "-n", "2"], "-n: is given twice"),
    ([SCENE, "-n", str(4 * len(os.sched_getaffinity(0)) + 1)], "would crawl"),
    ([SCENE, "-o", "a", "-o", "b"], "-o/--output: is given twice"),
    ([SCENE, "-o", __file__], "there is a file of this name"),
    ([SCENE, "-o", "/proc/x"], "no right to write"),
    (["-v", "speed", "1"], "name one"),
    (["-n", "1"], "name one"),
    ([SCENE, "-v", "cell", ""], "-v cell has an empty value"),
    ([SCENE, "-v", "", "1"], "-v has an empty name; it takes a name and a value"),
    ([SCENE, "-v", "widht", "3"], "no line reads 'widht'; did you mean width?"),
    ([SCENE, "--quick", "-v", "sell", "3"], "no line reads 'sell'; did you mean cell?"),
    ([SCENE, "-v", "steps", "3"], "computes 'steps' itself"),
    ([SCENE, "-v", "results", "x"], "-v results: use -o"),
    ([SCENE, "-v", "cell", "0.1", "-v", "cell", "0.2"], "-v cell is given 2 times"),
    (["wheel_on_sand", "-v", "bed_level", "0.1"], "no line reads 'bed_level'"),
    ([SCENE, "--error", "10%", "-v", "widht", "3"], "no line reads 'widht'"),
    ([SCENE, "--quick", "--error", "10%"], "give one of them"),
    ([SCENE, "--quick", "--time", "10min"], "give one of them"),
    ([SCENE, "--dry-run"], "--dry-run prints the plan for --error or --time; give one of them"),
    (["--time", "1h"], "--time belongs to a scene; name one"),
    ([SCENE, "--continue", "-o", "/proc/x"], "/proc/x: has no run to continue"),
    ([SCENE, "--continue", "-n", "1"], "leave out -n"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--continue"], "the same command resumes it"),
    (["--checkpoint", "1h"], "--checkpoint belongs to a scene"),
    (["--sweep", "slip=0,1"], "--sweep belongs to a scene; name one"),
    (["--until-steady", "3%"], "--until-steady belongs to a scene; name one"),
    ([SCENE, "--sweep", "slip"], "'slip' has no ="),
    ([SCENE, "--sweep", "slip=0:1:0.1"], "not the step"),
    ([SCENE, "--sweep", "slip=a:b:3"], "'a:b:3' is no range FIRST:LAST:COUNT"),
    ([SCENE, "--sweep", "slip=nan"], "nan is no finite number"),
    ([SCENE, "--sweep", "slip=0,-inf"], "-inf is no finite number"),
    ([SCENE, "--sweep", "material=../materials/fresh_snow_cam_clay.yaml,x.yaml"], "material: there is no file x.yaml"),
    ([SCENE, "-v", "material", "../materials/snwo.yaml"], "-v material: there is no file ../materials/snwo.yaml"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--measured", __file__], "arguments_test.py: "),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--measured", NOT_MEASURED], "is no table of measured points"),
    ([SCENE, "--sweep", "sell=0.1,0.2"], "no line reads 'sell'; did you mean cell?"),
    ([SCENE, "--sweep", "results=a,b"], "--sweep results: use -o"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "-v", "cell", "0.1"], "given both by -v and by --sweep"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--packings", "2"], "no line of"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--error", "10%"], "--error chooses one run"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--formula", "x"], "there is no formula 'x'"),
    ([SCENE, "--sweep", "cell=0.1,0.2", "--measured", "x.csv"], "x.csv: no such file"),
    ([SCENE, "--jobs", "2"], "--jobs belongs to --sweep"),
    ([SCENE, "--again"], "--again belongs to --sweep"),
    ([SCENE, "--until-steady", "3%", "--until-steady", "4%"], "--until-steady: is given twice"),
    ([SCENE, "--time-limit", "2h"], "--time-limit belongs to --until-steady or --sweep"),
)


class ArgumentsFaultsTest(FaultsTest):
    folder: Path
    home: str

    @classmethod
    def setUpClass(cls) -> None:
        cls.home = os.getcwd()
        cls.folder = Path(tempfile.mkdtemp())
        os.chdir(cls.folder)
        write_run(Path("a"))
        write_run(Path("b"), sinkage=0.051)
        for name in ("one", "two"):
            write_plate(Path(name) / "plate", 1e6)
        Path("text").mkdir()
        for name in ("point", "sidewall"):
            Path("text", f"{name}.h5").write_text("hello")
        write_table(Path("table.csv"), made_runs())

    @classmethod
    def tearDownClass(cls) -> None:
        os.chdir(cls.home)
        shutil.rmtree(cls.folder)

    def post(self, words: list[str], message: str) -> None:
        self.expect(" ".join(map(repr, words)), outcome(lambda: main(words)), message)

    def test_faulty_arguments_of_formulas_are_refused(self) -> None:
        for words, terrain, message in EMPIRICAL:
            last = [] if terrain is None else [terrain]
            self.post(["empirical", *words.split(), *last], message)

    def test_faulty_arguments_of_comparisons_are_refused(self) -> None:
        for words, message in COMPARE:
            output = [] if "-o" in words else ["-o", "out"]
            self.post(["compare", "a", "b", *words, *output], message)
        self.assertFalse(Path("out").exists())

    def test_faulty_arguments_of_other_commands_are_refused(self) -> None:
        for words, message in OTHERS:
            self.post(words, message)

    def test_faulty_arguments_of_runs_are_refused(self) -> None:
        for words, message in RUN:
            with self.subTest(words=words):
                found = outcome(lambda: main(["run", *words]))
                self.assertEqual(found.status, 2)
                self.assertIn(message, found.said)
                self.assertLessEqual(len(found.said.splitlines()), 2)

    def test_folder_name_with_an_equals_sign_is_read(self) -> None:
        name = "slip=0.1"
        shutil.copytree("a", name)
        for words in (["report", name, "-o", "=.html"], ["compare", name, "b", "-o", "out="]):
            with self.subTest(words=words):
                self.assertEqual(outcome(lambda: main(words)), (0, ""))
        self.assertIn(f"  {name} ", Path("out=", "compare.txt").read_text())

    def test_table_with_a_byte_order_mark_is_read(self) -> None:
        for encoding in ("utf-8", "utf-8-sig"):
            Path("marked.csv").write_text(Path("table.csv").read_text(), encoding=encoding)
            words = ["cost", "marked.csv", "-o", "cost.png"]
            with self.subTest(encoding=encoding):
                self.assertEqual(outcome(lambda: main(words)), (0, ""))

    def test_faulty_tables_of_runs_are_refused(self) -> None:
        good = Path("table.csv").read_text()
        head, *rows = good.splitlines(keepends=True)
        size = "half,rigid wheel,"  # stands before the size
        for fault, text, message in (
            ("empty", "", "has no rows"),
            ("no rows", head, "has no rows"),
            ("another head", "a,b\n1,2\n", "has no column run"),
            ("a column less", good.replace("sinkage_error", "error"), "no column sinkage_error"),
            ("a column twice", head[:-1] + ",size\n" + rows[0][:-1] + ",1\n", "two columns 'size'"),
            ("a short row", good + "x,y\n", "has fewer cells than the head"),
            ("a long row", good + rows[0][:-1] + ",1,2\n", "has more cells than the head"),
            ("a word", good.replace(f"{size}0.04", f"{size}x", 1), "to float: 'x'"),
            ("size 0", good.replace(f"{size}0.04", f"{size}0", 1), "size is 0"),
            ("size -1", good.replace(f"{size}0.04", f"{size}-1", 1), "size is -1"),
        ):
            Path("bad.csv").write_text(text)
            with self.subTest(fault=fault):
                self.post(["cost", "bad.csv"], "bad.csv: ")
                self.post(["cost", "bad.csv"], message)
        Path("bad.csv").write_bytes(good.encode() + b"\xe9\xff")
        self.post(["cost", "bad.csv"], "bad.csv: is not text in UTF-8")

    def test_ascii_locale_prints_every_text(self) -> None:
        """Text is UTF-8 in any locale; the error gives a name that is not."""
        plain = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
        environment = {**os.environ, **plain}
        write_run(Path("Spur ä ö"))
        shutil.copytree("a", os.fsdecode(b"l\xe4uf"))

        def post(*words: str) -> "subprocess.CompletedProcess[bytes]":
            command = [sys.executable, str(FURROW_POST), *words]
            return subprocess.run(command, env=environment, capture_output=True)

        done = post("report", "Spur ä ö", "-o", "Größe.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Spur ä ö", Path("Größe.html").read_text(encoding="utf-8"))
        done = post("report", os.fsdecode(b"l\xe4uf"), "-o", "x.html")
        self.assertEqual(done.returncode, 1)
        self.assertIn(b"is a name that is not UTF-8; rename", done.stderr.splitlines()[-1])

    def test_missing_packages_are_reported(self) -> None:
        """The last line names the missing packages and what to install; furrow-post has no other."""
        programs = [
            file
            for file in SOURCE.glob("inputs/**/*.py")
            if '__name__ == "__main__"' in (text := file.read_text(encoding="utf-8"))
            and "furrow_post" in text
        ]
        self.assertGreaterEqual(len(programs), 10)
        for program in (*programs, FURROW_POST):
            with self.subTest(program=program):
                # -S leaves out the folders of packages
                command = [sys.executable, "-S", str(program), "--help"]
                done = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(done.returncode, 1)
                lines = done.stderr.splitlines()
                self.assertIn("has no numpy", lines[-1])
                self.assertIn("write 'apt install python3-numpy", lines[-1])
                if program == FURROW_POST:
                    self.assertEqual(len(lines), 1, done.stderr)

    def test_import_without_packages_raises(self) -> None:
        """A program that can do without furrow_post goes on."""
        text = "try:\n import furrow_post\nexcept ImportError as error:\n print('without:', error)"
        environment = {**os.environ, "PYTHONPATH": str(SOURCE / "postproc")}
        command = [sys.executable, "-S", "-c", text]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("without: furrow_post: ", done.stdout)


if __name__ == "__main__":
    unittest.main()
