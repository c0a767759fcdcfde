# SPDX-License-Identifier: GPL-2.0-or-later
"""furrow-post picture: the rut in grains or continuum."""


from ..read.results import Results
from ..scene.pictures import draw_rut
from .parameters import Given, command, output_options, pixels_option, results_argument, target


@command(
    results_argument(),
    *output_options(),
    pixels_option(),
)
def picture(given: Given) -> None:
    results = Results(given.results)
    file = target(given, results.folder, "rut")
    draw_rut(results, file, given.pixels)
    print(file)
