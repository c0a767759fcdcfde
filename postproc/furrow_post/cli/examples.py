# SPDX-License-Identifier: GPL-2.0-or-later
"""Examples of every subcommand, for its --help."""

EXAMPLES: dict[str, tuple[str, ...]] = {
    "run": ("wheel_on_snow --quick", "tyre_on_plane --sweep slip=0:0.2:3 -o results/pull"),
    "resistance": ("results/a", "--csv results/a results/b", "--distance 0.5 1.2 results/a"),
    "export": ("results/a", "results/a results/b --channels hub_drop,force_x -o both.csv"),
    "plot": ("results/a", "results/a --against x -o forces.svg"),
    "picture": ("results/a",),
    "terrain": ("results/a --format pdf",),
    "laboratory": ("results/laboratory/oedometer_sand_dry",),
    "point": ("results/snow_oedometer",),
    "sidewall": ("results/p235_75r15",),
    "modes": ("results/at_rest",),
    "fit-law": ("inputs/points/fit_abele_gow.yaml -o results/oedometer",),
    "fit-tyre": ("235/75R15 --rim 6.5 --pressure 241 --point 241 6227 3.1 -o my_tyre.yaml",),
    "empirical": ("nrmm --help",),
    "compare": ("continuum=results/a grains=results/b -o results/both",),
    "flow": ("results/a results/b",),
    "compaction": ("results/a", "soft=results/a hard=results/b -o results/both"),
    "cost": ("coarse=results/a fine=results/b", "inputs/costs/wheel_on_snow.csv"),
    "plan": ("inputs/costs/wheel_on_snow.csv --sinkage 3% --coefficient 0.01",),
    "study": ("", "snow_oedometer", "snow_plate fresh_fine --results results/plate", "--pages --check"),
    "choose": ("inputs/costs/wheel_on_snow.csv --error 10%",),
    "variables": ("inputs/scenes/wheel_on_snow.lig",),
    "fmu": ("inputs/guide/howto/vehicle/wheel.lig -o results/wheel.fmu",),
    "sweep": ("results/sweep", "continuum=results/a grains=results/b -o results/both"),
    "surrogate": ("results/a -o wheel.json", "wheel.json --at slip=0.2 load=600"),
    "map": ("wheel.json dem.tif --classes soil.tif soils.csv --load 600 -o results/map",),
    "identify": ("wheel.json tests.csv --set c=250 -o results/soil",),
    "view": ("results/a", "results/a results/b -o both.html"),
    "film": ("results/a film.mp4", "results/a --colour displacement --cut 0 --seconds 5"),
    "report": ("results/a", "continuum=results/a grains=results/b -o both.html"),
}


def epilog(name: str) -> str:
    """What --help of a subcommand ends with."""
    lines = "".join(f"\n  furrow-post {name} {words}" for words in EXAMPLES[name])
    return f"examples:{lines}"
