# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post converge: a scene in three sizes; all its later runs take the error of their cells or grains from it."""

from pathlib import Path

from ..arguments import at_least, between, path
from ..programs import results_folder
from ..scene.converging import converge, convergence_table, material_table, vary_material
from .parameters import Given, argument, command, flag, option


@command(
    argument("scene", "a scene, or the path of a LIGGGHTS script", str),
    option("-v", "given", nargs=2, parse=str, multiple=True, metavar="NAME VALUE", help="sets a variable of the script; cell and diameter: the finest"),
    option("--ratio", parse=between(1.1, 2.0), default=1.26, help="of one size to the next finer (default 1.26)"),
    option("--sizes", parse=at_least(2), default=3, help="their number (default 3)"),
    flag("--material", help="varies the parameters of the card or material by their standard errors instead, in coarser cells"),
    option("--jobs", parse=at_least(1), default=1, help="runs at a time (default 1)"),
    option("-o", "--output", parse=path, help="folder of the runs (default: results/SCENE_convergence)"),
)
def converge_(given: Given) -> None:
    folder: Path = given.output or results_folder(f"{Path(given.scene).stem}_convergence")
    if given.material:
        made = vary_material(given.scene, list(given.given), folder, given.jobs)
        print(material_table(made))
        print(f"\n{made.path}: later runs of this script with {made.file} take the error of their soil from it")
        return
    found = converge(given.scene, list(given.given), given.ratio, given.sizes, folder, given.jobs)
    print(convergence_table(found))
    print(f"\n{found.path}: later runs of this script take the error of their size from it")
