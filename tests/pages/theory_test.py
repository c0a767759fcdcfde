# SPDX-License-Identifier: GPL-2.0-or-later
"""The theory manual and the code agree: theory_test.py <source> <build> <scratch>.

- Links of the chapters lead to files that exist.
- Equations are numbered from 1 on in each chapter.
- Headers cite chapters and equations that exist ("theory: continuum, eq. 4"); chapters list those
  headers.
- The yield surfaces of the figures, computed from the equations, are those of furrow-point.
- Every chapter shows a figure that figures.py draws.
"""

import importlib.util
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import h5py
import numpy as np

CITATION = re.compile(r"theory:\s+(\w+)(?:,\s+eqs?\.\s+(\d+)(?:\s*(?:to|and|,)\s*(\d+))?)?")
LINK = re.compile(r"\]\(([^)#]+)(#[^)]*)?\)")
TAG = re.compile(r"\\tag\{(\d+)\}")


def chapters(source: Path) -> dict[str, str]:
    folder = source / "src" / "theory"
    return {
        page.stem: page.read_text(encoding="utf-8") for page in sorted(folder.glob("*.md")) if page.stem != "README"
    }


def check_links(source: Path) -> list[str]:
    errors = []
    for page in sorted((source / "src" / "theory").glob("*.md")):
        for target, _ in LINK.findall(page.read_text(encoding="utf-8")):
            if not target.startswith("http") and not (page.parent / target).exists():
                errors.append(f"{page.name}: links to {target}, which does not exist")
    return errors


def check_numbers(manual: dict[str, str]) -> list[str]:
    errors = []
    for name, text in manual.items():
        tags = [int(tag) for tag in TAG.findall(text)]
        if tags != list(range(1, len(tags) + 1)):
            errors.append(f"{name}.md: equations are numbered {tags}")
        if len(tags) != len(re.findall(r"^\$\$ .* \$\$$", text, re.M)):
            errors.append(f"{name}.md: has an equation without a number")
        for heading in ("## Options", "## In the code"):
            if heading not in text:
                errors.append(f"{name}.md: has no section '{heading[3:]}'")
    return errors


def check_citations(source: Path, manual: dict[str, str]) -> list[str]:
    errors, cited = [], set()
    for folder in ("src", "coupling"):
        for header in sorted((source / folder).rglob("*.h")):
            text = re.sub(r"\n\s*///? ?", " ", header.read_text(encoding="utf-8"))
            for chapter, first, last in CITATION.findall(text):
                where = header.relative_to(source)
                if chapter not in manual:
                    errors.append(f"{where}: cites the chapter '{chapter}', which does not exist")
                    continue
                cited.add(chapter)
                count = len(TAG.findall(manual[chapter]))
                for number in filter(None, (first, last)):
                    if int(number) > count:
                        errors.append(f"{where}: cites {chapter}, eq. {number} of {count}")
                if f"{header.name}](" not in manual[chapter]:
                    errors.append(f"{where}: cites {chapter}.md, which does not link to it")
    for chapter in manual.keys() - cited:
        errors.append(f"{chapter}.md: no header cites it")
    return errors


# Laws with the numbers that the functions of figures.py take, and stiff: equations 13 and 17 of
# laws.md neglect elastic strain.
CAP = {"d": 5e3, "beta": 22.53, "R": 0.3, "alpha": 0.05}
FOAM_TENSION, FOAM_UNIAXIAL = 2e3, 1.5e4
CLAY = {"M": 3.3, "tension_ratio": 0.1}
SNOW = {"d": 2e3, "beta": 31.5, "nu_p": 0.1}
STRENGTH = 1e4  # [Pa] at the start
LAWS = {
    "drucker_prager_cap": CAP,
    "crushable_foam": {"pt": FOAM_TENSION, "sigma0": FOAM_UNIAXIAL},
    "cohesive_cam_clay": CLAY,
    "cohesive_cap": {**SNOW, "d_density": 200, "d_exponent": 0, "tension_ratio": 0.2},
}
MATERIAL = """title: {law}
law: {{type: {law}, density: 200, {keys}}}
elasticity: {{type: linear, E: 1e10, nu: 0.2}}
hardening:
  type: table
  p: [{strength}, 1e6]
  eps_vol_pl: [0, 0.5]
  interpolation: linear
  beyond: extrapolate
"""
POINT = """title: confined compression
material: {law}.yaml
path: {{type: confined, strain: [0.1, 0.3], steps: 2000}}
"""


def run_point(build: Path, scratch: Path, law: str) -> Path:
    """The results of confined compression."""
    keys = ", ".join(f"{key}: {value}" for key, value in LAWS[law].items())
    material = MATERIAL.format(law=law, keys=keys, strength=STRENGTH)
    (scratch / f"{law}.yaml").write_text(material, encoding="utf-8")
    point = scratch / f"{law}_point.yaml"
    point.write_text(POINT.format(law=law), encoding="utf-8")
    command = [build / "bin" / "furrow-point", "run", point, "-o", scratch / law, "--no-plot"]
    subprocess.run(command, check=True, stdout=subprocess.PIPE)
    return scratch / law / "point.h5"


def figures_of(source: Path) -> ModuleType:
    """The module that draws the figures."""
    path = source / "src" / "theory" / "figures.py"
    specification = importlib.util.spec_from_file_location("figures", path)
    assert specification and specification.loader
    figures = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(figures)
    return figures


def check_figures(figures: ModuleType, manual: dict[str, str], scratch: Path) -> list[str]:
    figures.FOLDER = scratch / "figures"
    figures.draw()
    drawn = {f"figures/{path.name}" for path in figures.FOLDER.glob("*.png")}
    errors = []
    for name, text in manual.items():
        shown = set(re.findall(r"!\[[^\]]+\]\(([^)]+)\)", text))
        if not shown or shown - drawn:
            errors.append(f"{name}.md: shows {sorted(shown)}; figures.py draws {sorted(drawn)}")
    return errors


def check_surfaces(figures: ModuleType, build: Path, scratch: Path) -> list[str]:
    slope = figures.foam_slope(FOAM_TENSION, STRENGTH, FOAM_UNIAXIAL)
    M, b = CLAY["M"], CLAY["tension_ratio"]
    d, beta, nu_p = SNOW.values()
    A = (4.5 * (1 - 2 * nu_p) / (1 + nu_p)) ** 0.5
    surface = {
        "drucker_prager_cap": lambda p, tip: figures.cap_surface(p, tip, **CAP),
        "crushable_foam": lambda p, tip: figures.foam_surface(p, FOAM_TENSION, tip, slope),
        "cohesive_cam_clay": lambda p, tip: figures.clay_surface(p, tip, M, b),
        "cohesive_cap": lambda p, tip: np.append(0, figures.snow_surface(p[1:], tip, d, beta, A)),
    }
    confined = {
        "drucker_prager_cap": lambda tip: figures.cap_confined(tip, **CAP),
        "cohesive_cam_clay": lambda tip: figures.clay_confined(tip, M, b),
        "cohesive_cap": lambda tip: figures.snow_confined(tip, d, beta, A, nu_p),
    }
    errors = []
    for law, equation in surface.items():
        with h5py.File(run_point(build, scratch, law)) as file:
            shapes = [(group["p"][:], group["q"][:]) for group in file["yield_surface"].values()]
            end = float(file["point/p"][-1]), float(file["point/q"][-1])
        if len(shapes) != 3:
            errors.append(f"{law}: furrow-point wrote {len(shapes)} yield surfaces, not 3")
        for p, q in shapes:
            off = np.abs(np.nan_to_num(equation(p, p[-1])) - q).max() / q.max()
            if off > 1e-6:
                errors.append(f"{law}: the equations of the manual are off by {off:.1e} of the largest q")
        if law in confined:
            expected = confined[law](shapes[-1][0][-1])
            off = max(abs(found / wanted - 1) for found, wanted in zip(end, expected))
            if off > 1e-3:
                errors.append(f"{law}: p, q in confined compression are {end}, not {expected}")
    return errors


def main(source: Path, build: Path, scratch: Path) -> None:
    scratch.mkdir(parents=True, exist_ok=True)
    manual = chapters(source)
    errors = check_links(source) + check_numbers(manual) + check_citations(source, manual)
    figures = figures_of(source)
    errors += check_figures(figures, manual, scratch) + check_surfaces(figures, build, scratch)
    if errors:
        sys.exit("\n".join(errors))


if __name__ == "__main__":
    main(*(Path(word).resolve() for word in sys.argv[1:4]))
