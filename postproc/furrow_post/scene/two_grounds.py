# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run without a scene: a tyre on snow, and one wheel on two grounds, in minutes on two cores."""

import threading
from pathlib import Path

from ..errors import ResultsError
from ..programs import inputs_folder
from .catalogue import Variables, quick_variables, script_of
from .one import SceneRun, post, run_scene, show, words_of
from .process import Runs, Stopped

# Snow by the oedometer alone predicts; the tyre scene's own was identified on wheels
OEDOMETER_SNOW = [("material", "../materials/fresh_snow_cam_clay.yaml")]
# folder -> scene, its variables, and those that stay with --quick
RUNS: dict[str, tuple[str, Variables, Variables]] = {
    "tyre": ("tyre_on_snow", [("distance", "3")], []),
    "tyre_predicted": ("tyre_on_snow", [("distance", "3")], OEDOMETER_SNOW),
    "continuum": ("wheel_on_snow", [("cell", "0.04"), ("distance", "3.5")], []),
    "grains": ("wheel_on_sintered_snow", [("diameter", "0.04"), ("window", "1"), ("travel", "4.5")], []),
}
LABELS = {"tyre_predicted": "prediction"}  # of lines on the screen
# [Pa] for NRMM: from 173 kPa on its packed snow is ice, so a larger pressure changes nothing
LARGEST_PRESSURE = "179e3"


def run_two_grounds(folder: Path, quick: bool, runs: Runs) -> None:
    """Grains on one core; on the other the tyre, the wheel on continuum, and their pictures.

    @raises ResultsError, Stopped, Failed
    """
    inputs = inputs_folder()
    if inputs is None:
        raise ResultsError("name a script: Furrow's scenes are not installed beside the Python package")
    print(
        "The tyre of Shoop (2001) on 20 cm of snow, and its rigid wheel on continuum and on grains; two "
        f"cores; results in {folder}",
        flush=True,
    )
    troubles: list[Exception] = []

    def on_continuum() -> None:
        try:
            names = ("tyre", "tyre_predicted", "continuum")
            for name in names:
                _run(name, folder, quick, runs)
            for name in names:
                show(folder / name, quick, shown=False)
        except (ResultsError, Stopped, OSError) as error:
            troubles.append(error)

    other = threading.Thread(target=on_continuum)
    other.start()
    try:
        _run("grains", folder, quick, runs)
    except (ResultsError, Stopped, OSError) as error:
        troubles.append(error)
    other.join()
    for trouble in troubles:
        raise trouble
    show(folder / "grains", quick, shown=False)
    print(
        "\nThe tyre against measurements; fitted: on snow whose soft beginning was identified on such "
        "wheels;\npredicted: on snow known by the oedometer alone"
    )
    measured = inputs / "validation" / "snow_wheel" / "reference.csv"
    beside = ["--measured", measured] if measured.is_file() else []
    _compare(
        folder / "measured",
        inputs / "costs" / "tyre_on_snow.csv",
        *(f"fitted={folder / 'tyre'}", f"predicted={folder / 'tyre_predicted'}"),
        *("--formula", f"nrmm:{LARGEST_PRESSURE}", *beside),
    )
    print("\nThe rigid wheel on both grounds")
    grounds = (f"{name}={folder / name}" for name in ("continuum", "grains"))
    _compare(folder, inputs / "costs" / "two_grounds.csv", *grounds)


def _run(name: str, folder: Path, quick: bool, runs: Runs) -> None:
    scene, variables, always = RUNS[name]
    script = script_of(scene)
    given = [*(quick_variables(script) if quick else variables), *always]
    label = f"{LABELS.get(name, name):10} "
    run_scene(SceneRun(script, folder / name, given, words=words_of(scene, given)), runs, label)


def _compare(folder: Path, errors: Path, *words: object) -> None:
    """Table, picture and report. errors: table of runs of other sizes."""
    given = [*words, *(("--errors", errors) if errors.is_file() else ())]
    post(("compare", *given, "-o", folder), ("report", *given, "-o", folder / "report.html"))
