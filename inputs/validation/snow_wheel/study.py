"""What is run: the lists of runs and the laws they use."""
import csv, math, pathlib

here = pathlib.Path(__file__).resolve().parent
materials = here.parents[1] / "materials"

LOAD_MASS = 636.0  # kg, TR p. 27
WIDTH = 0.272      # m
CELLS = 5          # in 0.20 m: cells of 4 cm
# Numerical choices; the stage 'error' changes one at a time.
BASE = dict(wheel_width=WIDTH, shoulder=0.051, mass=LOAD_MASS, speed=2.235, settle=0.25, accelerate=0.15, distance=0.75, damping=6000,
            width=0.7, fine_width=0.4, particles=2, friction=0.3)
WINDOW = 0.4       # m of travel at the end that is averaged

IDENTIFIED = "field_snow_identified"
CALIBRATION = dict(density=220, depth=(0.18, 0.22))  # the rows that the identification may see

# ---- laws of density alone: p_b = p_510 (rho/510 kg/m3)^s ---------------------------------------------------------------------------


def power_law(density, slope, d, beta, E, p_510=115e3):
    """Sections of a material file."""
    p = [p_510 * (rho / 510.0) ** slope for rho in (density, 900.0)]
    return dict(law=dict(type="drucker_prager_cap", density=density, d=d, beta=beta, R=1.1e-4, alpha=0, K=1, eps_vol_pl_0=0.001),
                elasticity=dict(type="linear", E=E, nu=0.3),
                hardening=dict(type="table", p=[float(f"{v:.6g}") for v in p],
                               eps_vol_pl=[0, round(math.log(900.0 / density), 6)], interpolation="log", beyond="extrapolate"))


# What was tried on the calibration rows, in this order; the last is the identified law. Columns: slope s, d [Pa], beta [degrees], E [Pa],
# p_510 [Pa]. beta is one of the two readings of TR's angle or between them; p_510 = 115 kPa spends 1.9 kJ/m2 on the way to 510 kg/m3.
TRIALS = {
    "trial_1": (10, 500, 41.3, 13.79e6, 115e3),
    "trial_2": (30, 500, 41.3, 13.79e6, 115e3),
    "trial_3": (10, 500, 22.53, 1e6, 400e3),
    "trial_4": (10, 500, 22.53, 1e6, 115e3),
    "trial_5": (8, 500, 41.3, 1e6, 115e3),
    "trial_6": (12, 500, 41.3, 0.6e6, 115e3),
    "trial_7": (10, 5000, 41.3, 1e6, 115e3),
    "identified": (10, 500, 41.3, 1e6, 115e3),
}


def field_snow(density, trial="identified"):
    return power_law(density, *TRIALS[trial])


def material_text(sections, title):
    def words(section):
        return "\n".join(f"  {k}: [{', '.join(f'{x:.6g}' for x in v)}]" if isinstance(v, list) else
                         f"  {k}: {v:.6g}" if isinstance(v, (int, float)) else f"  {k}: {v}" for k, v in section.items())
    return f"title: {title}\n" + "\n".join(f"{name}:\n{words(section)}" for name, section in sections.items()) + "\n"


# ---- runs -----------------------------------------------------------------------------------------------------------------------------


def job(material, depth, mode="towed", diameter=0.76, cells=None, soften=1.0, stiffness=0.4, length=1.2, sections=None, **changes):
    """Cells of about 4 cm that divide the depth; three of them as headroom."""
    cell = depth / (cells or round(depth * CELLS / 0.20))
    values = dict(BASE, depth=depth, diameter=diameter, cell=round(cell, 6), headroom=round(3 * cell if cell > 0.035 else 0.11, 6), soften=soften,
                  stiffness=stiffness, length=length, mode="slip slip 0" if mode == "zero_slip" else mode, **{})
    values.update(changes)
    return dict(variables=values, material=material, sections=sections)


def preset(name, depth=0.20, mode="towed", **changes):
    """TR's wheel on snow of a file of inputs/materials. The modulus is softened (README: what that does)."""
    return job(name, depth, mode, diameter=0.74, **{"soften": 0.25, **changes})


def on_field_snow(density, depth, mode="towed", trial="identified", **changes):
    values = dict(soften=1.0, stiffness=1.0)
    if TRIALS[trial][3] > 5e6:
        values = dict(soften=0.25, stiffness=0.4)
    return job(None, depth, mode, sections=field_snow(density, trial), **{**values, **changes})


def prediction():
    """From the oedometer alone, with the variants that tell where the bias comes from."""
    runs = {"oedometer_towed": preset("fresh_snow"), "oedometer_zero_slip": preset("fresh_snow", mode="zero_slip")}
    for variant in ("log", "p_0413", "abele_gow", "exponential", "beta_41", "d_30", "foam"):
        runs[f"{variant}_towed"] = preset(f"fresh_snow_{variant}")
    runs["log_zero_slip"] = preset("fresh_snow_log", mode="zero_slip")
    runs["smooth_wheel"] = preset("fresh_snow", friction=0.0)
    runs["deep_towed"] = preset("fresh_snow", depth=0.50, width=0.9)
    runs["deep_zero_slip"] = preset("fresh_snow", depth=0.50, mode="zero_slip", width=0.9)
    return runs


def identification():
    return {name: on_field_snow(220, 0.20, trial=name) for name in TRIALS}


def row_name(density, depth):
    return f"row_{density:.0f}_{100 * depth:.0f}cm"


def rows():
    """One run for each depth and density of the shared rows; the calibration's too."""
    found = {(r["density_kgm3"], r["depth_m"]) for r in reference()}
    runs = {row_name(rho, h): on_field_snow(rho, h, **({"width": 0.9} if h > 0.3 else {})) for rho, h in sorted(found, reverse=True)}
    runs["identified_zero_slip"] = on_field_snow(220, 0.20, "zero_slip")
    return runs


ERROR_BASE = "row_220_20cm"
ERRORS = {
    "cell_5cm": ("cells of 5 cm", dict(cells=4)),
    "cell_3.3cm": ("cells of 3.33 cm", dict(cells=6)),
    "cell_2.5cm": ("cells of 2.5 cm", dict(cells=8)),
    "particles_3": ("27 particles in a cell", dict(particles=3)),
    "wide": ("ground 1.0 m wide", dict(width=1.0)),
    "long": ("ground 1.6 m long", dict(length=1.6)),
    "rolls_further": ("1.25 m of rolling", dict(distance=1.25)),
    "contact_2": ("contact springs twice as stiff", dict(stiffness=2.0)),
    "soft": ("modulus halved", dict(soften=0.5)),
    "slow": ("half the speed", dict(speed=1.1175)),
}


def errors():
    runs = {f"error_{name}": on_field_snow(220, 0.20, **changes) for name, (_, changes) in ERRORS.items()}
    runs["error_oedometer_soften_1"] = preset("fresh_snow", soften=1.0)
    return runs


STAGES = {"predict": prediction, "identify": identification, "rows": rows, "error": errors}


def reference():
    """Rows of reference.csv, as numbers."""
    with open(here / "reference.csv") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if not line.startswith("#"))]


def is_calibration(row):
    low, high = CALIBRATION["depth"]
    return row["density_kgm3"] == CALIBRATION["density"] and low <= row["depth_m"] <= high
