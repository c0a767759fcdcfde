# SPDX-License-Identifier: GPL-2.0-or-later
"""What is run: the lists of runs and the laws they use."""
import csv, math, pathlib

here = pathlib.Path(__file__).resolve().parent
materials = here.parents[1] / "materials"

LOAD_MASS = 636.0  # kg, TR p. 27
WIDTH = 0.272      # m
CELLS = 5          # in 0.20 m: cells of 4 cm
# Numerical choices; the stage 'error' changes one at a time. Damping of the rig: the wheel comes to rest in height after 0.6 m.
BASE = dict(wheel_width=WIDTH, shoulder=0.051, mass=LOAD_MASS, speed=2.235, settle=0.25, accelerate=0.15, distance=1.2, damping=10000,
            width=0.7, fine_width=0.4, particles=2, friction=0.3, enforcement="penalty", cycle=16)
WINDOW = 0.5       # m of travel at the end that is averaged
DEEP_DISTANCE = 2.4  # m of rolling on more than 0.3 m of snow

CALIBRATION = dict(density=220, depth=(0.18, 0.22))  # the rows that the identification may see

# ---- laws of density alone: p_b = p_510 (rho/510 kg/m3)^s, not below what carries the layer's own weight -----------------------------

OWN_WEIGHT = 1e3  # Pa: half a metre of 220 kg/m3


def power_law(density, slope, d, beta, E, p_510):
    """Sections of a material file. d [Pa], beta [degrees], E [Pa], p_510 [Pa]."""
    def strength(rho):
        return p_510 * (rho / 510.0) ** slope
    knee = 510.0 * (OWN_WEIGHT / p_510) ** (1.0 / slope)  # kg/m3, where the power begins
    rows = [(density, OWN_WEIGHT), (knee, 1.001 * OWN_WEIGHT)] if knee > 1.001 * density else [(density, strength(density))]
    rows.append((900.0, strength(900.0)))
    return dict(law=dict(type="drucker_prager_cap", density=density, d=d, beta=beta, R=1.1e-4, alpha=0, K=1, eps_vol_pl_0=0.001),
                elasticity=dict(type="linear", E=E, nu=0.3),
                hardening=dict(type="table", p=[float(f"{p:.6g}") for _, p in rows],
                               eps_vol_pl=[round(math.log(rho / density), 6) for rho, _ in rows], interpolation="log", beyond="extrapolate"))


# The identified laws, rounded from what identify.py found; inputs/materials/field_snow_identified[_towed].yaml are these at 220 kg/m3.
# zero_slip: as TR compares; towed: free spin, as the wheel was measured.
LAWS = {
    "zero_slip": dict(slope=26, d=7e3, beta=22.53, E=13.79e6, p_510=130e3),
    "towed": dict(slope=30, d=1e3, beta=57, E=0.35e6, p_510=70e3),
}


def material_text(sections, title):
    def words(section):
        return "\n".join(f"  {k}: [{', '.join(f'{x:.6g}' for x in v)}]" if isinstance(v, list) else
                         f"  {k}: {v:.6g}" if isinstance(v, (int, float)) else f"  {k}: {v}" for k, v in section.items())
    return f"title: {title}\n" + "\n".join(f"{name}:\n{words(section)}" for name, section in sections.items()) + "\n"


# ---- runs -----------------------------------------------------------------------------------------------------------------------------


def job(material, depth, mode="towed", diameter=0.76, cells=None, soften=1.0, stiffness=0.4, length=1.2, sections=None, **changes):
    """Cells of about 4 cm that divide the depth."""
    cell = depth / (cells or round(depth * CELLS / 0.20))
    values = dict(BASE, depth=depth, diameter=diameter, cell=round(cell, 6), fine_depth=depth, headroom=0.4, soften=soften,
                  stiffness=stiffness, length=length, mode="slip slip 0" if mode == "zero_slip" else mode)
    values.update(changes)
    return dict(variables=values, material=material, sections=sections)


def preset(name, depth=0.20, mode="towed", **changes):
    """TR's wheel on snow of a file of inputs/materials. The modulus is softened (README: what that does)."""
    return job(name, depth, mode, diameter=0.74, **{"soften": 0.25, **changes})


def on_law(density, depth, mode, law, **changes):
    """Table 11's wheel. A modulus like TR's is softened; springs of the contact follow the modulus, so that a soft one needs stiffer springs."""
    E = law["E"]
    values = dict(soften=min(1.0, 0.25 * 13.79e6 / E), stiffness=max(0.4, min(4.0, 1e6 / E)))
    return job(None, depth, mode, sections=power_law(density, **law), **{**values, **changes})


def on_field_snow(density, depth, law, mode=None, **changes):
    return on_law(density, depth, mode or law, LAWS[law], **changes)


def prediction():
    """From the oedometer alone, with the variants that tell where the bias comes from."""
    runs = {"oedometer_towed": preset("fresh_snow"), "oedometer_zero_slip": preset("fresh_snow", mode="zero_slip")}
    for variant in ("log", "p_0413", "abele_gow", "exponential", "beta_41", "d_30"):
        runs[f"{variant}_towed"] = preset(f"fresh_snow_{variant}")
    runs["log_zero_slip"] = preset("fresh_snow_log", mode="zero_slip")
    runs["smooth_wheel"] = preset("fresh_snow", friction=0.0, headroom=1.0)  # does not turn: it pushes snow up before it
    deep = dict(depth=0.50, width=0.9, distance=DEEP_DISTANCE, headroom=1.0)
    runs["deep_towed"] = preset("fresh_snow", **deep)
    runs["deep_zero_slip"] = preset("fresh_snow", mode="zero_slip", **deep)
    runs["deep_field_towed"] = on_field_snow(220, law="towed", **deep)
    runs["foam_towed"] = preset("fresh_snow_foam", soften=1.0, cycle=1)  # porous elasticity: no E to soften
    return runs


def row_name(mode, density, depth):
    return f"{mode}_row_{density:.0f}_{100 * depth:.0f}cm"


def on_row(density, depth, mode, law, **changes):
    """A run of a shared row; a deep one has more width and rolls further until it is steady."""
    return on_law(density, depth, mode, law, **({"width": 0.9, "distance": DEEP_DISTANCE} if depth > 0.3 else {}), **changes)


def rows():
    """One run for each depth and density of the shared rows, with each of the two identified laws; the calibration's too."""
    found = sorted({(r["density_kgm3"], r["depth_m"]) for r in reference()}, reverse=True)
    runs = {row_name(mode, rho, h): on_row(rho, h, mode, law) for mode, law in LAWS.items() for rho, h in found}
    runs["towed_law_zero_slip"] = on_field_snow(220, 0.20, "towed", mode="zero_slip")
    runs["zero_slip_law_towed"] = on_field_snow(220, 0.20, "zero_slip", mode="towed")
    return runs


ERROR_BASE = "towed_row_220_20cm"
ERRORS = {
    "cell_5cm": ("cells of 5 cm", dict(cells=4)),
    "cell_3.3cm": ("cells of 3.33 cm", dict(cells=6)),
    "cell_2.5cm": ("cells of 2.5 cm", dict(cells=8)),
    "particles_3": ("27 particles in a cell, springs 2.5", dict(particles=3, stiffness=2.5)),
    "uniform": ("cells of 4 cm over the whole width", dict(fine_width=0.7)),
    "graded": ("cells grow under the wheel: below 8 cm and beside 20 cm", dict(fine_depth=0.08, fine_width=0.2)),
    "wide": ("ground 1.0 m wide", dict(width=1.0)),
    "long": ("ground 1.6 m long", dict(length=1.6)),
    "rolls_further": ("2.0 m of rolling", dict(distance=2.0)),
    "impulse": ("contact by impulses", dict(enforcement="impulse")),
    "cycle_1": ("mapping at each step", dict(cycle=1)),
    "soft": ("modulus halved", dict(soften=0.5)),
    "slow": ("5 km/h, as measured", dict(speed=1.39)),
}
SPRINGS = (0.5, 1.5)        # factors on the springs of the contact, the identified law
CONTACT = (0.2, 0.8, 1.6)   # springs of the contact, the oedometer's law, beside 0.4
SOFTEN = (0.5, 1.0)         # factors on its modulus, beside 0.25


def errors():
    """Of the identified law, and of the oedometer's, whose modulus is softened."""
    runs = {f"error_{name}": on_field_snow(220, 0.20, "towed", **changes) for name, (_, changes) in ERRORS.items()}
    springs = on_field_snow(220, 0.20, "towed")["variables"]["stiffness"]
    runs |= {f"error_contact_{factor:g}": on_field_snow(220, 0.20, "towed", stiffness=factor * springs) for factor in SPRINGS}
    runs |= {f"error_oedometer_{name}": job for name, (_, job) in oedometer_errors().items()}
    return runs


def oedometer_errors():
    """Name: what is changed, run."""
    runs = {"cell_5cm": ("cells of 5 cm", preset("fresh_snow", cells=4)), "cell_3.3cm": ("cells of 3.33 cm", preset("fresh_snow", cells=6)),
            "impulse": ("contact by impulses", preset("fresh_snow", enforcement="impulse"))}
    runs |= {f"soften_{factor:g}": (f"modulus softened by {factor:g}" if factor < 1 else "modulus not softened",
                                    preset("fresh_snow", soften=factor)) for factor in SOFTEN}
    runs |= {f"contact_{factor:g}": (f"contact springs {factor:g}", preset("fresh_snow", stiffness=factor)) for factor in CONTACT}
    return runs


STAGES = {"predict": prediction, "rows": rows, "error": errors}


def reference():
    """Rows of reference.csv, as numbers."""
    with open(here / "reference.csv") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def is_calibration(row):
    low, high = CALIBRATION["depth"]
    return row["density_kgm3"] == CALIBRATION["density"] and low <= row["depth_m"] <= high
