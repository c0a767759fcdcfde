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

CALIBRATION = dict(density=220, depth=(0.18, 0.22))  # the rows that the identification may see

# ---- laws of density alone: p_b = p_510 (rho/510 kg/m3)^s ---------------------------------------------------------------------------


def power_law(density, slope, d, beta, E, p_510=115e3):
    """Sections of a material file."""
    p = [p_510 * (rho / 510.0) ** slope for rho in (density, 900.0)]
    return dict(law=dict(type="drucker_prager_cap", density=density, d=d, beta=beta, R=1.1e-4, alpha=0, K=1, eps_vol_pl_0=0.001),
                elasticity=dict(type="linear", E=E, nu=0.3),
                hardening=dict(type="table", p=[float(f"{v:.6g}") for v in p],
                               eps_vol_pl=[0, round(math.log(900.0 / density), 6)], interpolation="log", beyond="extrapolate"))


# Laws that were tried on the calibration rows: mode of the wheel, slope s, d [Pa], beta [degrees], E [Pa], p_510 [Pa].
# zero_slip: as TR compares; p_510, s and d are searched, all else is TR's. zero_slip_4 is shipped as field_snow_identified.yaml.
# towed: free spin, as the wheel was measured; s, d and E are searched, beta is the other reading of TR's angle, p_510 = 115 kPa spends
# 1.9 kJ/m2 on the way to 510 kg/m3.
TRIALS = {
    "zero_slip_1": ("zero_slip", 10, 500, 41.3, 13.79e6, 115e3),
    "zero_slip_2": ("zero_slip", 6, 5000, 22.53, 13.79e6, 150e3),
    "zero_slip_3": ("zero_slip", 8, 3000, 22.53, 13.79e6, 150e3),
    "zero_slip_4": ("zero_slip", 8, 2300, 22.53, 13.79e6, 180e3),
    "towed_1": ("towed", 10, 500, 41.3, 13.79e6, 115e3),
    "towed_2": ("towed", 10, 500, 22.53, 1e6, 400e3),
    "towed_3": ("towed", 10, 500, 41.3, 1e6, 115e3),
}
CHOSEN = {"zero_slip": "zero_slip_4", "towed": "towed_3"}


def field_snow(density, trial):
    return power_law(density, *TRIALS[trial][1:])


def material_text(sections, title):
    def words(section):
        return "\n".join(f"  {k}: [{', '.join(f'{x:.6g}' for x in v)}]" if isinstance(v, list) else
                         f"  {k}: {v:.6g}" if isinstance(v, (int, float)) else f"  {k}: {v}" for k, v in section.items())
    return f"title: {title}\n" + "\n".join(f"{name}:\n{words(section)}" for name, section in sections.items()) + "\n"


# ---- runs -----------------------------------------------------------------------------------------------------------------------------


def job(material, depth, mode="towed", diameter=0.76, cells=None, soften=1.0, stiffness=0.4, length=1.2, sections=None, **changes):
    """Cells of about 4 cm that divide the depth."""
    cell = depth / (cells or round(depth * CELLS / 0.20))
    values = dict(BASE, depth=depth, diameter=diameter, cell=round(cell, 6), headroom=0.4, soften=soften,
                  stiffness=stiffness, length=length, mode="slip slip 0" if mode == "zero_slip" else mode)
    values.update(changes)
    return dict(variables=values, material=material, sections=sections)


def preset(name, depth=0.20, mode="towed", **changes):
    """TR's wheel on snow of a file of inputs/materials. The modulus is softened (README: what that does)."""
    return job(name, depth, mode, diameter=0.74, **{"soften": 0.25, **changes})


def on_field_snow(density, depth, trial, **changes):
    """Table 11's wheel. TR's modulus is softened; springs of the contact follow the modulus, so that a soft one needs stiffer springs."""
    mode, E = TRIALS[trial][0], TRIALS[trial][4]
    values = dict(soften=0.25, stiffness=0.4) if E > 5e6 else dict(soften=1.0, stiffness=1.0)
    return job(None, depth, sections=field_snow(density, trial), **{"mode": mode, **values, **changes})


def prediction():
    """From the oedometer alone, with the variants that tell where the bias comes from."""
    runs = {"oedometer_towed": preset("fresh_snow"), "oedometer_zero_slip": preset("fresh_snow", mode="zero_slip")}
    for variant in ("log", "p_0413", "abele_gow", "exponential", "beta_41", "d_30", "foam"):
        runs[f"{variant}_towed"] = preset(f"fresh_snow_{variant}", **({"soften": 1.0} if variant == "foam" else {}))  # no E to soften
    runs["log_zero_slip"] = preset("fresh_snow_log", mode="zero_slip")
    runs["smooth_wheel"] = preset("fresh_snow", friction=0.0)
    runs["deep_towed"] = preset("fresh_snow", depth=0.50, width=0.9)
    runs["deep_zero_slip"] = preset("fresh_snow", depth=0.50, mode="zero_slip", width=0.9)
    return runs


def identification():
    return {name: on_field_snow(220, 0.20, name) for name in TRIALS}


def row_name(mode, density, depth):
    return f"{mode}_row_{density:.0f}_{100 * depth:.0f}cm"


def rows():
    """One run for each depth and density of the shared rows, with each of the two identified laws; the calibration's too."""
    found = sorted({(r["density_kgm3"], r["depth_m"]) for r in reference()}, reverse=True)
    runs = {row_name(mode, rho, h): on_field_snow(rho, h, trial, **({"width": 0.9} if h > 0.3 else {}))
            for mode, trial in CHOSEN.items() for rho, h in found}
    runs["towed_law_zero_slip"] = on_field_snow(220, 0.20, CHOSEN["towed"], mode="zero_slip")
    runs["zero_slip_law_towed"] = on_field_snow(220, 0.20, CHOSEN["zero_slip"], mode="towed")
    return runs


ERROR_BASE = "towed_row_220_20cm"
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
    runs = {f"error_{name}": on_field_snow(220, 0.20, CHOSEN["towed"], **changes) for name, (_, changes) in ERRORS.items()}
    runs["error_zero_slip_3.3cm"] = on_field_snow(220, 0.20, CHOSEN["zero_slip"], cells=6)
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
