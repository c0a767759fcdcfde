# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs without a scene: a tyre on snow, and one wheel on two grounds, in minutes on two cores."""

from collections.abc import Callable
from pathlib import Path

from ..errors import ResultsError
from ..programs import inputs_folder
from ..run.case import Case
from .catalogue import Variables, quick_variables, script_of
from .one import SceneRun, run_scenes, show, words_of

Post = Callable[..., int]  # a command of furrow-post with its words; the exit status
# Snow by the oedometer alone predicts; the tyre scene's own was identified on wheels
OEDOMETER_SNOW = [("material", "../materials/fresh_snow_cam_clay.yaml")]
# folder -> scene, its variables, and those that stay with --quick; the longest run is the first
RUNS: dict[str, tuple[str, Variables, Variables]] = {
    "grains": ("wheel_on_sintered_snow", [("diameter", "0.04"), ("window", "1"), ("travel", "4.5")], []),
    "tyre": ("tyre_on_snow", [("distance", "3")], []),
    "tyre_predicted": ("tyre_on_snow", [("distance", "3")], OEDOMETER_SNOW),
    "continuum": ("wheel_on_snow", [("cell", "0.04"), ("distance", "3.5")], []),
}
# [Pa] for NRMM: from 173 kPa on its packed snow is ice, so a larger pressure changes nothing
LARGEST_PRESSURE = "179e3"


def run_two_grounds(folder: Path, quick: bool, post: Post) -> None:
    """Grains on one core; on the other the tyre and the wheel on continuum. post: runs a command of furrow-post

    @raises ResultsError, Interrupted, Failed
    """
    inputs = inputs_folder()
    if inputs is None:
        raise ResultsError("name a script: Furrow's scenes are not installed with the Python package")
    print(
        "The tyre of Shoop (2001) on 20 cm of snow, and its rigid wheel on continuum and on grains; two "
        f"cores; results in {folder}",
        flush=True,
    )

    def draw(case: Case) -> None:
        show(folder / case.name, quick, shown=False)

    run_scenes(folder, [_scene(name, folder, quick) for name in RUNS], jobs=2, ended=draw)
    print(
        "\nThe tyre against measurements; fitted: on snow whose soft beginning was identified on such "
        "wheels;\npredicted: on snow known by the oedometer alone"
    )
    measured = inputs / "validation" / "snow_wheel" / "reference.csv"
    beside = ["--measured", measured] if measured.is_file() else []
    _compare(
        post,
        folder / "measured",
        inputs / "costs" / "tyre_on_snow.csv",
        *(f"fitted={folder / 'tyre'}", f"predicted={folder / 'tyre_predicted'}"),
        *("--formula", f"nrmm:{LARGEST_PRESSURE}", *beside),
    )
    print("\nThe rigid wheel on both grounds")
    grounds = (f"{name}={folder / name}" for name in ("continuum", "grains"))
    _compare(post, folder, inputs / "costs" / "two_grounds.csv", *grounds)


def _scene(name: str, folder: Path, quick: bool) -> SceneRun:
    scene, variables, always = RUNS[name]
    script = script_of(scene)
    given = [*(quick_variables(script) if quick else variables), *always]
    return SceneRun(script, folder / name, given, words=words_of(scene, given))


def _compare(post: Post, folder: Path, errors: Path, *words: object) -> None:
    """Table, picture and report. errors: table of runs of other sizes."""
    given = [*words, *(("--errors", errors) if errors.is_file() else ())]
    post("compare", *given, "-o", folder)
    post("report", *given, "-o", folder / "report.html")
