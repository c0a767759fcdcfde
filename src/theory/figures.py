#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Draws the figures of the theory manual into the folder figures next to this file.

    python3 src/theory/figures.py [CHAPTER...]

Curves are computed from the numbered equations of the chapters. tests/pages/theory_test.py compares
the yield surfaces with those of furrow-point.
"""

import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch, Polygon, Rectangle

FOLDER = Path(__file__).resolve().parent / "figures"
BLUE, ORANGE, GREEN, VIOLET, GREY = "#1f5a8a", "#c8672b", "#4d8a4a", "#7a4b8c", "#6b6b6b"
SAND, WHEEL = "#e6d8b4", "#39424e"
STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "figure.facecolor": "white",
}


def save(name: str) -> None:
    plt.savefig(FOLDER / f"{name}.png", dpi=110, bbox_inches="tight")
    plt.close()


def arrow(axes: Axes, start, end, text="", colour="black", at=None, style="-|>", **more) -> None:
    """An arrow in data coordinates, with a text at a point or at its end."""
    axes.add_patch(
        FancyArrowPatch(start, end, arrowstyle=style, mutation_scale=10, color=colour,
                        shrinkA=0, shrinkB=0, lw=1.2, **more)
    )  # fmt: skip
    if text:
        place = end if at is None else at
        axes.text(*place, text, color=colour, ha="center", va="center")


def drawing(axes: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    axes.set(xlim=x, ylim=y, aspect="equal")
    axes.axis("off")


# ---- laws: equations of laws.md ----------------------------------------------------------------


def cap_surface(p, p_b, d, beta, R, alpha):
    """t on the surface at pressures p [Pa] (equations 6 to 9), NaN outside. beta in degrees."""
    angle = np.radians(beta)
    p_a = (p_b - R * d) / (1 + R * np.tan(angle))
    Q, B = d + p_a * np.tan(angle), 1 - alpha / np.cos(angle)
    A = B + alpha
    with np.errstate(invalid="ignore"):
        cap = A / R * np.sqrt((R * Q) ** 2 - (p - p_a) ** 2)
        transition = B * Q + np.sqrt((alpha * Q) ** 2 - (p - p_a) ** 2)
    line = d + p * np.tan(angle)
    on_transition = p_a - p < alpha * Q * np.sin(angle)
    t = np.where(p >= p_a, cap, np.where(on_transition, transition, line))
    return np.where(t >= 0, t, np.nan)


def cap_confined(p_b, d, beta, R, alpha):
    """p and q in confined compression (equation 13)."""
    angle = np.radians(beta)
    p_a = (p_b - R * d) / (1 + R * np.tan(angle))
    A = 1 + alpha - alpha / np.cos(angle)
    q = A * (d + p_a * np.tan(angle)) / np.sqrt(1 + 2.25 * (R / A) ** 2)
    return p_a + 1.5 * (R / A) ** 2 * q, q


def foam_slope(p_t, p_c0, sigma_0):
    """M of equation 14."""
    square = p_t * p_c0 + sigma_0 * (p_c0 - p_t) / 3 - sigma_0**2 / 9
    return sigma_0 / np.sqrt(square)


def foam_surface(p, p_t, p_c, M):
    with np.errstate(invalid="ignore"):
        return M * np.sqrt(((p_c + p_t) / 2) ** 2 - (p - (p_c - p_t) / 2) ** 2)


def clay_surface(p, p_0, M, b):
    """q of equation 16."""
    with np.errstate(invalid="ignore"):
        return M * np.sqrt((p + b * p_0) * (p_0 - p) / (1 + 2 * b))


def clay_confined(p_0, M, b):
    B = M / np.sqrt(1 + 2 * b)
    S, a = np.sqrt(9 + 4 * B**2), (1 + b) * p_0 / 2
    return (1 - b) * p_0 / 2 + 3 * a / S, 2 * B**2 * a / S


def lode_section(c, K, kind):
    """g of equation 11."""
    if kind == "abaqus":
        return 0.5 * (1 + 1 / K - (1 - 1 / K) * c)
    w = (1 - K**2) / (1 + K**3)
    return np.array([max(np.roots([1 - w, 0, -1, -w * x]).real) for x in c])


def laws() -> None:
    figure, panels = plt.subplots(2, 2, figsize=(8.4, 7.0))
    cap_panel(panels[0, 0])
    foam_panel(panels[0, 1])
    clay_panel(panels[1, 0])
    section_panel(panels[1, 1])
    for axes in panels.flat[:3]:
        axes.axhline(0, color="black", lw=0.8)
        axes.axvline(0, color="black", lw=0.8)
        axes.set(xlabel="pressure p", ylabel="Mises stress q")
    figure.tight_layout()
    save("laws")


def cap_panel(axes: Axes) -> None:
    d, beta, R, alpha, p_b = 0.12, 28.0, 0.45, 0.06, 1.0
    shape = (d, beta, R, alpha)
    tan = np.tan(np.radians(beta))
    p_a = (p_b - R * d) / (1 + R * tan)
    Q = d + p_a * tan
    p = np.concatenate([np.linspace(-d / tan, p_a, 400), np.linspace(p_a, p_b, 2000)])
    axes.plot(p, cap_surface(p, p_b, *shape), color=BLUE)
    axes.plot([-d / tan, 1.0 * p_a], [0, d + 1.0 * p_a * tan], ":", color=GREY, lw=1)
    axes.plot([p_a, p_a], [0, Q], ":", color=GREY, lw=1)
    axes.plot(*cap_confined(p_b, *shape), "o", color=ORANGE)
    axes.text(p_a, -0.045, "$p_a$", ha="center")
    axes.text(p_b, -0.045, "$p_b$", ha="center")
    axes.text(-0.04, d, "$d$", ha="right", va="center")
    axes.text(0.24, d + 0.24 * tan + 0.04, "shear line, slope tan β", rotation=26, ha="center",
              rotation_mode="anchor", color=BLUE)  # fmt: skip
    axes.text(p_b + 0.005, 0.30, "cap", color=BLUE)
    axes.text(p_a + 0.03, Q + 0.02, "transition", color=BLUE)
    x, y = 0.60, d + 0.60 * tan  # flow on the line, by the potential (equation 10)
    step = np.array([(x - p_a) * tan**2, y])
    arrow(axes, (x, y), tuple(np.array([x, y]) + 0.16 * step / np.hypot(*step)), "flow", ORANGE,
          (x - 0.05, y + 0.20))  # fmt: skip
    axes.set(title="a  Drucker–Prager cap", xlim=(-0.3, 1.15), ylim=(-0.08, 0.75))


def foam_panel(axes: Axes) -> None:
    p_t, p_c0, sigma_0 = 0.1, 1.0, 2.424  # the ratios of [Shoop2001], Table 1
    M = foam_slope(p_t, p_c0, sigma_0)
    for p_c, colour in ((1.0, BLUE), (1.6, GREEN)):
        p = np.linspace(-p_t, p_c, 1001)
        axes.plot(p, foam_surface(p, p_t, p_c, M), color=colour)
        axes.text(p_c, -0.25, "$p_{c0}$" if p_c == 1.0 else "$p_c$", ha="center")
    axes.plot(sigma_0 / 3, sigma_0, "o", color=BLUE, mfc="white")
    axes.text(sigma_0 / 3 + 0.16, sigma_0 + 0.1, "$\\sigma_0$", color=BLUE)
    axes.text(-p_t - 0.03, -0.25, "$-p_t$", ha="center")
    axes.text(1.42, 3.6, "compacted", color=GREEN, ha="center")
    axes.set(title="b  Crushable foam", xlim=(-0.35, 1.8), ylim=(-0.5, 5.4))


def clay_panel(axes: Axes) -> None:
    M, b = 3.3, 0.1  # inputs/materials/fresh_snow_cam_clay.yaml
    for p_0, colour in ((0.6, BLUE), (1.0, GREEN)):
        p = np.linspace(-b * p_0, p_0, 1001)
        axes.plot(p, clay_surface(p, p_0, M, b), color=colour)
        axes.plot((1 - b) * p_0 / 2, clay_surface((1 - b) * p_0 / 2, p_0, M, b), "s", ms=4,
                  color=colour)  # fmt: skip
        axes.plot(*clay_confined(p_0, M, b), "o", color=ORANGE)
    end = clay_confined(1.0, M, b)
    axes.plot([0, 1.1 * end[0]], [0, 1.1 * end[1]], ":", color=ORANGE, lw=1)
    axes.text(1.11 * end[0], 1.1 * end[1] + 0.02, "confined", color=ORANGE)
    axes.text(0.40, 1.72, "critical state", color=GREEN, ha="center")
    axes.text(1.0, -0.12, "$p_0$", ha="center")
    axes.text(-b - 0.03, -0.12, "$-b\\,p_0$", ha="center")
    axes.set(title="c  Cohesive Cam clay", xlim=(-0.25, 1.2), ylim=(-0.2, 1.95))


def snow_surface(p, p_c, d, beta, A):
    """q of equation 1 of the chapter snow."""
    cap = A * np.sqrt(np.clip(p_c**2 - np.maximum(p, 0) ** 2, 0, None))
    return np.minimum(cap, d + p * np.tan(np.radians(beta)))


def snow_confined(p_c, d, beta, A, nu_p):
    """p and q in confined compression: equations 5 and 6 of the chapter snow, for p_c."""
    slope, tan = 3 * (1 - 2 * nu_p) / (1 + nu_p), np.tan(np.radians(beta))
    p = p_c / np.sqrt(1 + (slope / A) ** 2)
    if slope * p > d + p * tan:  # p^2 + ((d + p tan)/A)^2 = p_c^2
        a, b, c = A**2 + tan**2, d * tan, d**2 - (A * p_c) ** 2
        p = (-b + np.sqrt(b**2 - a * c)) / a
        return p, d + p * tan
    return p, slope * p


def snow() -> None:
    nu_p, beta, r, m = 0.1, 31.5, 0.2, 5  # inputs/materials/snow.yaml
    A = np.sqrt(4.5 * (1 - 2 * nu_p) / (1 + nu_p))
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 3.6))
    states = ((32.2, 379.3), (130.0, 466.2)), ((130.0, 466.2), (665.0, 591.0))
    for axes, pair in zip(panels, states):
        for (p_c, rho), colour in zip(pair, (BLUE, GREEN)):
            d = 1.5 * (rho / 200) ** m
            p = np.linspace(-r * d, p_c, 2001)
            axes.plot(p, snow_surface(p, p_c, d, beta, A), color=colour, label=f"{rho:.0f} kg/m³")
            axes.plot([-r * d, -r * d], [0, snow_surface(-r * d, p_c, d, beta, A)], color=colour)
        path = [(0.0, 0.0)]
        for p_c in np.geomspace(1.0, pair[1][0], 60):
            rho = np.interp(np.log(p_c), np.log([0.829, 31.9, 64.2, 128.6, 328.7, 664.6]),
                            [200, 379.3, 408.4, 466.2, 527.7, 591.0])  # fmt: skip
            path.append(snow_confined(p_c, 1.5 * (rho / 200) ** m, beta, A, nu_p))
        axes.plot(*zip(*path), ":", color=ORANGE, label="confined")
        axes.axhline(0, color="black", lw=0.8)
        axes.axvline(0, color="black", lw=0.8)
        axes.set(xlabel="pressure p, kPa", ylabel="Mises stress q, kPa")
        axes.legend(frameon=False)
    figure.tight_layout()
    save("snow")


def sand_ratio(D, M, N):
    """P over the image pressure: equation 2 of the chapter sand."""
    return (1 + N * D / M) ** ((1 - N) / N)


def sand_drained(void, M=1.25, N=0.5, chi=4.0, gamma=0.82, slope=0.02, H=100.0, G_r=40e6, nu=0.2):
    """Axial strain, stress ratio and volumetric strain of compression at 50 kPa, with steps of 1e-4
    that solve equations 2 to 6 for the stress ratio of a surface that grows by equation 5."""
    lateral, step = 5e4, 1e-4
    chi_i = chi / (1 - (1 - N) * slope * chi / M)
    P, q, image, volume = lateral, 0.0, 0.8 * lateral, 0.0
    rows = [(0.0, 0.0, 0.0)]
    for count in range(1, 2001):
        G = G_r * np.sqrt(P / 1e5)
        K = 2 * (1 + nu) / (3 * (1 - 2 * nu)) * G
        limit = chi_i * (void - gamma + slope * np.log(image / 1e3))
        image = min(image, P / sand_ratio(limit, M, N))  # a short way along the cone
        D = M / N * ((P / image) ** (N / (1 - N)) - 1)
        dv, flow = step * 3 * G / (3 * K + G), 0.0  # elastic, at constant lateral stress
        trial = q + 3 * G * (step - dv / 3)
        if trial > (M - (1 - N) * D) * (lateral + trial / 3):
            x = P / image
            growth = H * (image / 1e5) ** -0.5 * (x**2 / sand_ratio(limit, M, N) - x) if D > limit else 0.0
            # q = eta(P/image) P with P = lateral + q/3; d(eta) = -(1 - N) dD
            slope_x = (1 - N) * M / N * N / (1 - N) * x ** (N / (1 - N))
            dq_flow = slope_x * P * growth / (1 - (M - (1 - N) * D) / 3 + slope_x / 3)
            # axial strain = dq/(3 G) + flow + volume/3 with volume = dq/(3 K) + D flow
            flow = step / (dq_flow * (1 / (3 * G) + 1 / (9 * K)) + 1 + D / 3)
            dq = dq_flow * flow
            dv = dq / (3 * K) + D * flow
            image *= 1 + growth * flow
            P = P + dq / 3
            D = M / N * ((P / image) ** (N / (1 - N)) - 1)
            q = (M - (1 - N) * max(D, limit)) * P
        else:
            q, P = trial, lateral + trial / 3
        P = lateral + q / 3
        volume += dv
        void -= (1 + void) * dv
        rows.append((count * step, q / P, volume))
    return np.array(rows).T


def sand() -> None:
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(9.6, 3.2))
    M = 1.25
    for N, colour in zip((0.2, 0.5, 0.7), (BLUE, ORANGE, GREEN)):
        D = np.linspace(-0.6, M / (1 - N), 400)
        x = sand_ratio(D, M, N)
        left.plot(x, (M - (1 - N) * D) * x, color=colour, label=f"N = {N}")
    left.plot([0, 1.6], [0, 1.6 * M], ":", color=GREY)
    left.set(title="a  Yield surface", xlabel="$P/P_i$", ylabel="$t/P_i$", xlim=(0, 2.8), ylim=(0, 1.9))
    left.legend(frameon=False)
    for void, colour in zip((0.60, 0.68, 0.78), (BLUE, ORANGE, GREEN)):
        strain, ratio, volume = sand_drained(void)
        middle.plot(100 * strain, ratio, color=colour, label=f"e = {void:.2f}")
        right.plot(100 * strain, 100 * volume, color=colour)
    middle.axhline(M, ls=":", color=GREY)
    middle.set(title="b  Stress ratio q/p", xlabel="axial strain, %")
    middle.legend(frameon=False)
    right.axhline(0, color="black", lw=0.8)
    right.set(title="c  Compaction, %", xlabel="axial strain, %")
    figure.tight_layout()
    save("sand")


def section_panel(axes: Axes) -> None:
    sine = 0.5  # friction angle 30 degrees
    K = (3 - sine) / (3 + sine)
    turn = np.linspace(0, 2 * np.pi, 721)
    c = -np.cos(3 * turn)  # turn = 0 is triaxial compression
    for values, text, colour, line in (
        (np.ones_like(turn), "round, K = 1", GREY, "--"),
        (1 / lode_section(c, 0.8, "abaqus"), "K = 0.8", BLUE, "-"),
        (1 / lode_section(c, K, "matsuoka_nakai"), f"matsuoka_nakai, K = {K:.2f}", GREEN, "-"),
    ):
        axes.plot(values * np.sin(turn), values * np.cos(turn), line, color=colour, label=text)
    corners = [(radius * np.sin(a), radius * np.cos(a))
               for a, radius in zip(np.arange(7) * np.pi / 3, [1, K] * 3 + [1])]  # fmt: skip
    axes.plot(*zip(*corners), ":", color=ORANGE, label="Mohr–Coulomb, φ = 30°")
    for a, name in ((0, "$\\sigma_1$"), (2 * np.pi / 3, "$\\sigma_2$"), (4 * np.pi / 3, "$\\sigma_3$")):
        axes.plot([0, 1.15 * np.sin(a)], [0, 1.15 * np.cos(a)], color="black", lw=0.7)
        axes.text(1.25 * np.sin(a), 1.25 * np.cos(a), name, ha="center", va="center")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.02), ncol=2, fontsize=8)
    axes.set(title="d  Deviatoric section", aspect="equal", xlim=(-1.35, 1.35), ylim=(-1.1, 1.4))
    axes.axis("off")


# ---- symbols -------------------------------------------------------------------------------------


def symbols() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.9), width_ratios=(1.15, 1.15, 1))
    depths_panel(panels[0])
    side_panel(panels[1])
    slip_angle_panel(panels[2])
    figure.tight_layout()
    save("symbols")


def depths_panel(axes: Axes) -> None:
    drawing(axes, (-1.45, 1.95), (-1.55, 1.65))
    axes.set_title("a  three depths")
    drop, deflection, radius = 0.5, 0.22, 1.0
    ground = 0.0
    centre = ground - drop + radius
    contact = ground - drop + deflection
    half = np.sqrt(radius**2 - (centre - contact) ** 2)
    axes.fill([-1.45, -half, half, 1.45, 1.45, -1.45],
              [contact, contact, contact, ground, -1.5, -1.5], color=SAND, zorder=0)  # fmt: skip
    axes.fill([half, 1.45, 1.45, half], [contact, contact, ground, ground], color=SAND, zorder=0)
    angle = np.linspace(0, 2 * np.pi, 721)
    x, z = radius * np.cos(angle), centre + radius * np.sin(angle)
    axes.plot(x, z, "--", color=GREY, lw=1)
    axes.plot(x, np.maximum(z, contact), color=WHEEL, lw=2.2)
    axes.add_patch(Circle((0, centre), 0.06, color=WHEEL))
    axes.text(0.1, centre + 0.08, "axle, $z_a$")
    arrow(axes, (0, centre), (-0.71, centre + 0.70), "$r_0$", GREY, (-0.5, centre + 0.28))
    for x, low, high, text in (
        (1.05, ground - drop, ground, "$z_h$  hub_drop"),
        (0.2, ground - drop, contact, "$z_t$"),
        (0.72, contact, ground, "$z_r$"),
    ):
        arrow(axes, (x, low), (x, high), style="<|-|>", colour=ORANGE)
        axes.text(x + 0.07, (low + high) / 2, text, color=ORANGE, va="center")
    axes.plot([-0.15, 1.2], [ground - drop] * 2, ":", color=ORANGE, lw=0.8)
    axes.text(-1.4, ground + 0.06, "ground level $z_0$", fontsize=8)
    axes.text(-1.4, -1.35, "$z_t$ tyre_deflection,  $z_r$ rut_depth", color=ORANGE, fontsize=8)
    axes.plot([-1.45, -half], [ground, ground], color="black", lw=0.8)


def side_panel(axes: Axes) -> None:
    drawing(axes, (-1.6, 1.8), (-1.4, 1.4))
    axes.set_title("b  forces and speeds from the side")
    ground, centre = -0.72, 0.1
    axes.fill([-1.6, -0.3, 0.57, 1.8, 1.8, -1.6],
              [-0.86, -0.86, ground, ground, -1.4, -1.4], color=SAND, zorder=0)  # fmt: skip
    axes.add_patch(Circle((0, centre), 1.0, fill=False, color=WHEEL, lw=2.2))
    axes.add_patch(Circle((0, centre), 0.06, color=WHEEL))
    arrow(axes, (0, centre), (1.25, centre), "$v$", BLUE, (1.33, centre))
    arrow(axes, (0.05, -0.9), (0.05, -0.15), "$F_z$", ORANGE, (0.24, -0.2))
    arrow(axes, (0.05, -0.9), (-0.75, -0.9), "$F_x<0$", ORANGE, (-0.62, -1.08))
    arrow(axes, (-0.55, centre + 0.5), (0.55, centre + 0.5), "$\\omega_y$, $T$", GREEN,
          (0, centre + 0.62), connectionstyle="arc3,rad=-0.45")  # fmt: skip
    arrow(axes, (0, centre), (0, centre - 0.55), "load", GREY, (-0.25, centre - 0.45))
    arrow(axes, (-1.45, 0.75), (-1.0, 0.75), "$x$", at=(-0.9, 0.75))
    arrow(axes, (-1.45, 0.75), (-1.45, 1.2), "$z$", at=(-1.45, 1.3))


def slip_angle_panel(axes: Axes) -> None:
    drawing(axes, (-1.1, 1.7), (-1.2, 1.5))
    axes.set_title("c  slip angle from above")
    psi = np.radians(25)
    forward, left = np.array([np.cos(psi), np.sin(psi)]), np.array([-np.sin(psi), np.cos(psi)])
    corners = [a * 0.75 * forward + b * 0.22 * left for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    axes.add_patch(Polygon(corners, closed=True, facecolor="#c9ced6", edgecolor=WHEEL, lw=1.5))
    arrow(axes, (0, 0), (1.45, 0), "$v_t$", BLUE, (1.58, 0))
    arrow(axes, (0, 0), tuple(1.3 * forward), "$F_T$", ORANGE, tuple(1.45 * forward))
    arrow(axes, (0, 0), tuple(0.95 * left), "$F_S$", ORANGE, tuple(1.1 * left))
    turn = np.linspace(0, psi, 40)
    axes.plot(1.05 * np.cos(turn), 1.05 * np.sin(turn), color="black", lw=1)
    axes.text(1.13, 0.22, "$\\psi>0$")
    axes.text(-1.1, -0.95, "heading to the left: the\nground pushes to the left", fontsize=8)
    arrow(axes, (0.8, -0.95), (1.25, -0.95), "$x$", at=(1.35, -0.95))
    arrow(axes, (0.8, -0.95), (0.8, -0.5), "$y$", at=(0.8, -0.4))


# ---- the coupled step ----------------------------------------------------------------------------


def step() -> None:
    figure, panels = plt.subplots(3, 1, figsize=(8.6, 6.6), height_ratios=(1, 1.3, 1.1))
    phases_panel(panels[0])
    leapfrog_panel(panels[1])
    multirate_panel(panels[2])
    figure.tight_layout()
    save("step")


def phases_panel(axes: Axes) -> None:
    axes.set(xlim=(0, 10), ylim=(-0.35, 1.25))
    axes.axis("off")
    axes.set_title("a  one LIGGGHTS step")
    names = ("controllers", "bodies:\nN sub-steps", "grains move,\nmeshes follow",
             "forces of grains\nand walls", "sum over ranks,\naudit", "histories")  # fmt: skip
    colours = (GREY, BLUE, GREEN, GREEN, VIOLET, GREY)
    for k, (name, colour) in enumerate(zip(names, colours)):
        left = 0.1 + 1.66 * k
        axes.add_patch(Rectangle((left, 0.2), 1.4, 0.75, facecolor=colour, alpha=0.18, ec=colour))
        axes.text(left + 0.7, 0.575, name, ha="center", va="center", fontsize=8)
        if k:
            arrow(axes, (left - 0.26, 0.575), (left, 0.575))
    arrow(axes, (5.8, 0.2), (2.5, 0.2), connectionstyle="arc3,rad=-0.16", colour=ORANGE)
    axes.text(4.15, -0.27, "forces of grains act in the next step", color=ORANGE, ha="center",
              fontsize=8)  # fmt: skip


def leapfrog_panel(axes: Axes) -> None:
    axes.set(xlim=(-0.3, 3.9), ylim=(-0.3, 3.1))
    axes.axis("off")
    axes.set_title("b  leapfrog, with N = 4 sub-steps")
    axes.axhline(2.3, color="black", lw=0.8, xmax=0.97)
    axes.axhline(0.8, color="black", lw=0.8, xmax=0.97)
    axes.text(-0.28, 2.62, "grains", color=GREEN)
    axes.text(-0.28, 1.12, "bodies", color=BLUE)
    for n in range(4):
        axes.plot(n, 2.3, "o", color=GREEN)
        axes.text(n, 1.93, f"$x_{n},\\,F_{n}$", ha="center", color=GREEN, fontsize=8)
        if n < 3:
            axes.plot(n + 0.5, 2.3, "|", color=GREEN, ms=12)
            axes.text(n + 0.5, 2.6, f"$v_{{{2 * n + 1}/2}}$", ha="center", color=GREEN, fontsize=8)
            arrow(axes, (n, 1.8), (n, 0.95), colour=ORANGE)
            for k in range(4):
                axes.plot(n + k / 4, 0.8, "o", color=BLUE, ms=4)
    axes.plot(3, 0.8, "o", color=BLUE, ms=4)
    axes.text(0.04, 1.4, "$N\\,F$ in the first sub-step", color=ORANGE, fontsize=8)
    for k in range(4):
        axes.text(1 + k / 4, 0.42, "contact", ha="center", fontsize=6.5, color=BLUE, rotation=30)
    arrow(axes, (2, -0.05), (2.25, -0.05), style="<|-|>")
    axes.text(2.125, -0.32, "$\\Delta t$", ha="center")
    arrow(axes, (0, -0.05), (1, -0.05), style="<|-|>")
    axes.text(0.5, -0.32, "$\\Delta T$", ha="center")


def multirate_panel(axes: Axes) -> None:
    axes.set(xlim=(-0.3, 6.9), ylim=(-0.5, 2.4))
    axes.axis("off")
    axes.set_title("c  multiple time stepping: three grain steps in one terrain step")
    axes.axhline(1.5, color="black", lw=0.8)
    axes.axhline(0.4, color="black", lw=0.8)
    axes.text(-0.28, 1.85, "grains", color=GREEN)
    axes.text(-0.28, 0.75, "terrain", color=BLUE)
    for n in range(7):
        axes.plot(n, 1.5, "o", color=GREEN, ms=5)
    for n, t in enumerate((1, 4)):
        axes.plot(t, 0.4, "o", color=BLUE)
        axes.text(t, 0.0, f"$t_{n}$", ha="center", color=BLUE)
        axes.plot([t - 1, t + 1], [1.72, 1.72], color=ORANGE, lw=3, alpha=0.6)
        axes.text(t, 1.95, "mesh at constant velocity", color=ORANGE, ha="center", fontsize=8)
        arrow(axes, (t, 1.4), (t, 0.55), "mean force", ORANGE, (t + 0.5, 0.98))
    arrow(axes, (1, -0.2), (4, -0.2), style="<|-|>")
    axes.text(2.5, -0.5, "$T_t=3\\,\\Delta T$", ha="center")


# ---- the continuum -------------------------------------------------------------------------------


def splines(knots, x):
    """Quadratic B-splines on knots with triple ends (Cox-de Boor), a row for each."""
    t = np.concatenate([[knots[0]] * 2, knots, [knots[-1]] * 2])
    last = np.searchsorted(t, knots[-1]) - 1
    N = [((t[i] <= x) & ((x < t[i + 1]) | (i == last))).astype(float) for i in range(len(t) - 1)]
    for degree in (1, 2):
        N = [
            sum(
                (np.where(width > 0, rise / max(width, 1e-300), 0) * each)
                for width, rise, each in (
                    (t[i + degree] - t[i], x - t[i], N[i]),
                    (t[i + degree + 1] - t[i + 1], t[i + degree + 1] - x, N[i + 1]),
                )
            )
            for i in range(len(N) - 1)
        ]
    return np.array(N)


def continuum() -> None:
    figure = plt.figure(figsize=(9.4, 6.4))
    grid = figure.add_gridspec(2, 2, height_ratios=(1, 1.15), width_ratios=(1, 1))
    splines_panel(figure.add_subplot(grid[0, :]))
    interval_panel(figure.add_subplot(grid[1, 0]))
    faces_panel(figure.add_subplot(grid[1, 1]))
    figure.tight_layout()
    save("continuum")


def splines_panel(axes: Axes) -> None:
    lengths = [1.0] * 5 + [1.15**k for k in range(1, 5)]
    knots = np.concatenate([[0], np.cumsum(lengths)])
    x = np.linspace(knots[0], knots[-1], 2001)
    for k, N in enumerate(splines(knots, x)):
        axes.plot(x, N, color=(BLUE, GREEN, ORANGE, VIOLET)[k % 4], lw=1.2)
    for knot in knots:
        axes.axvline(knot, color="0.8", lw=0.8, zorder=0)
    for low, high in zip(knots[:-1], knots[1:]):
        for share in (0.25, 0.75):
            axes.plot(low + share * (high - low), -0.08, "o", color="#b0893c", ms=4)
    axes.set(title="a  splines $N_i$, graded cells and particles", ylim=(-0.16, 1.08),
             xlim=(-0.1, knots[-1] + 0.1), xlabel="position in fine cells", ylabel="$N_i$")  # fmt: skip


def interval_panel(axes: Axes) -> None:
    axes.set(xlim=(0, 10), ylim=(0, 10))
    axes.axis("off")
    axes.set_title("b  between two grid resets")
    boxes = (
        (8.3, "particles to grid: $m_i$, $v_i$; weights at $x_s$", BLUE),
        (6.6, "forces of stress and contact", GREEN),
        (5.2, "$v_i$, slide surface, faces, $u_i$", GREEN),
        (3.8, "strain $H$, law, new stress", GREEN),
        (1.6, "grid to particles: $x_p$, $v_p$, $C_p$", BLUE),
    )
    for y, text, colour in boxes:
        axes.add_patch(Rectangle((0.4, y), 7.4, 1.05, facecolor=colour, alpha=0.18, ec=colour))
        axes.text(4.1, y + 0.52, text, ha="center", va="center", fontsize=8.5)
    arrow(axes, (4.1, 8.3), (4.1, 7.65))
    arrow(axes, (4.1, 3.8), (4.1, 2.65))
    arrow(axes, (7.8, 4.3), (7.8, 7.1), colour=GREEN, connectionstyle="arc3,rad=0.9")
    axes.text(9.3, 5.7, "$n_s$ steps", color=GREEN, rotation=90, va="center", ha="center")
    arrow(axes, (0.4, 2.1), (0.4, 8.8), colour=BLUE, connectionstyle="arc3,rad=-0.12")


def faces_panel(axes: Axes) -> None:
    drawing(axes, (-0.9, 10.9), (-2.2, 7.6))
    axes.set_title("c  faces and moving ground")
    axes.add_patch(Rectangle((1, 0), 8, 4, facecolor=SAND, edgecolor="none"))
    for x in np.linspace(1, 9, 17):
        axes.plot([x, x], [0, 4], color="0.75", lw=0.5)
    for y in np.linspace(0, 4, 9):
        axes.plot([1, 9], [y, y], color="0.75", lw=0.5)
    for x in np.linspace(1, 9, 21):  # the rough base
        axes.plot([x, x - 0.3], [0, -0.4], color="black", lw=0.8)
    axes.plot([1, 9], [0, 0], color="black", lw=1.5)
    axes.text(5, -1.1, "rough: $v=0$", ha="center", fontsize=8.5)
    for y in (0.7, 2.0, 3.3):  # dashpots and springs of the far field
        axes.plot([9, 9.4], [y, y], color=BLUE)
        axes.add_patch(Rectangle((9.4, y - 0.22), 0.5, 0.44, fill=False, ec=BLUE))
        axes.plot([9.9, 10.3], [y, y], color=BLUE)
    axes.plot([10.3, 10.3], [0.2, 3.8], color=BLUE)
    axes.text(9.9, 4.2, "absorbing", color=BLUE, ha="center", fontsize=8.5)
    for y in (0.6, 1.6, 2.6, 3.6):  # rollers of a smooth face
        axes.add_patch(Circle((0.78, y), 0.2, fill=False, ec=GREEN))
    axes.plot([0.56, 0.56], [0, 4], color=GREEN)
    axes.text(0.5, 4.2, "smooth", color=GREEN, ha="center", fontsize=8.5)
    axes.add_patch(Circle((5, 5.1), 1.6, fill=False, color=WHEEL, lw=2))
    arrow(axes, (5, 5.1), (7.4, 5.1), "$v$", at=(7.7, 5.1))
    axes.add_patch(Rectangle((9, 0), 0.5, 4, fill=False, ls=":", ec=ORANGE))
    axes.add_patch(Rectangle((1, 0), 0.5, 4, fill=False, ls=":", ec=ORANGE))
    axes.text(5, -2.0, "moving ground: a layer is removed behind and added ahead", color=ORANGE,
              ha="center", fontsize=8)  # fmt: skip


# ---- contact: equations of contact.md ------------------------------------------------------------


def largest_stiffness(cfl, poisson, particles, damping):
    """The largest s that equation 8 allows."""
    ratio = (1 + poisson) / (3 * (1 - poisson))  # K/M
    a = 12 * cfl**2 * ratio
    low, high = 0.0, 100.0
    for _ in range(60):
        s = 0.5 * (low + high)
        root = particles * cfl * np.sqrt(s)
        b = root * (root + 4 * damping)
        stable = a < 4 and b < 4 and (4 - a) * (4 - b) > 4 * b / particles**2
        low, high = (s, high) if stable else (low, s)
    return low


def contact() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.5), width_ratios=(1.15, 1, 1))
    gap_panel(panels[0])
    j = np.linspace(0, 40, 400)
    for kappa, colour in ((0, GREY), (5, BLUE), (15, GREEN)):
        share = np.ones_like(j) if kappa == 0 else 1 - np.exp(-j / kappa)
        panels[1].plot(j, share, color=colour, label=f"κ = {kappa} mm")
    panels[1].set(xlabel="slip j [mm]", ylabel="$T/(\\mu F_n)$", ylim=(0, 1.1),
                  title="b  mobilised friction")  # fmt: skip
    panels[1].legend(loc="lower right")
    cfl = np.linspace(0.2, 0.74, 160)
    for damping, line in ((0.1, "-"), (0.5, "--")):
        limits = [largest_stiffness(c, 0.3, 2, damping) for c in cfl]
        panels[2].plot(cfl, limits, line, color=BLUE, label=f"ζ = {damping}")
    panels[2].plot(0.4, 0.4, "o", color=ORANGE)
    panels[2].text(0.41, 0.36, "default", color=ORANGE, va="top")
    panels[2].set(xlabel="cfl", ylabel="largest stiffness s", yscale="log", ylim=(0.05, 30),
                  title="c  stability, ν = 0.3, n = 2")  # fmt: skip
    panels[2].legend()
    figure.tight_layout()
    save("contact")


def gap_panel(axes: Axes) -> None:
    drawing(axes, (-1.5, 2.1), (-1.3, 1.9))
    axes.set_title("a  gap of a particle")
    nodes = np.array([[-1.4, 1.35], [-0.2, 0.75], [1.3, 0.85], [2.0, 1.3]])
    axes.fill(*np.vstack([nodes, [2.0, 1.9], [-1.4, 1.9]]).T, color="#c9ced6")
    axes.plot(*nodes.T, "o-", color=WHEEL, lw=2, ms=4)
    axes.text(0.4, 1.4, "body", color=WHEEL)
    for x in np.arange(-1.1, 2.0, 0.9):
        for y in (-0.05, -0.95):
            axes.add_patch(Rectangle((x - 0.45, y - 0.45), 0.9, 0.9, facecolor=SAND, ec="white"))
            axes.plot(x, y, "o", color="#b0893c", ms=4)
    particle = np.array([0.7, -0.05])
    edge = nodes[2] - nodes[1]
    closest = nodes[1] + edge * np.dot(particle - nodes[1], edge) / np.dot(edge, edge)
    normal = (particle - closest) / np.hypot(*(particle - closest))
    arrow(axes, tuple(closest), tuple(closest + 0.42 * normal), "$n$", ORANGE,
          tuple(closest + 0.2 * normal + np.array([0.14, 0])))  # fmt: skip
    axes.plot(*zip(particle, closest), ":", color="black", lw=1)
    arrow(axes, (1.62, -0.05), (1.62, closest[1]), "$\\delta$", at=(1.75, 0.38), style="<|-|>")
    arrow(axes, (0.38, -0.05), (0.38, 0.4), "$\\ell$", at=(0.25, 0.2), style="<|-|>")
    arrow(axes, (0.38, 0.4), (0.38, closest[1]), "$g$", at=(0.25, 0.6), style="<|-|>")


# ---- grains: equations of grains.md --------------------------------------------------------------


def grains() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.5), width_ratios=(1, 1.1, 1))
    F_b, chi, zeta, mu, F_y = 0.6, 0.7, 1.0, 0.3, 1.0
    F = np.array([-zeta * F_b, -zeta * F_b, 0, F_y, F_y])
    T = chi * F_b + mu * np.maximum(F, 0)
    T[0] = 0
    T[-1] = 0
    panels[0].fill(F, T, color=BLUE, alpha=0.15)
    panels[0].plot(F, T, color=BLUE)
    panels[0].axvline(0, color="black", lw=0.8)
    panels[0].text(-zeta * F_b, -0.09, "$-\\zeta F_b$", ha="center")
    panels[0].text(F_y, -0.09, "$F_y$", ha="center")
    panels[0].text(-0.03, chi * F_b + 0.05, "$\\chi F_b$", ha="right")
    panels[0].text(0.72, 0.66, "slope μ", color=BLUE, ha="right")
    arrow(panels[0], (1.3, 0.52), (1.0, 0.4), "crush", ORANGE, (1.35, 0.6))
    arrow(panels[0], (0.25, 0.85), (0.2, 0.49), "shear", ORANGE, (0.25, 0.92))
    arrow(panels[0], (-0.62, 0.18), (-0.9, 0.18), "break", ORANGE, (-0.85, 0.27))
    panels[0].set(xlim=(-1.05, 1.6), ylim=(-0.14, 1.1), xlabel="normal force $F_n/F_y$",
                  ylabel="shear force $|F_t|/F_y$", title="a  admissible forces")  # fmt: skip
    X = np.linspace(0, 0.5, 300)
    Y_0, p, Y_1, q, p_c = 1150.0, 3.0, 5.6, 27.0, 13.0  # grains/snow_bond_parameters.h
    crush = Y_0 * np.exp(p * X) + Y_1 * (np.exp(q * X) - 1)
    panels[1].semilogy(X, 1e-3 * crush, color=BLUE, label="crush strength $F_y/d^2$")
    panels[1].semilogy(X, 1e-3 * np.minimum(crush, Y_0 * np.exp(p_c * X)), "--", color=ORANGE,
                       label="bond strength $F_b/d^2$")  # fmt: skip
    panels[1].set(xlabel="crushing X", ylabel="kPa", title="b  strength")
    panels[1].legend()
    axes = panels[2]
    drawing(axes, (-1.5, 1.5), (-1.3, 1.3))
    axes.set_title("c  two clusters and their bond")
    for x in (-0.62, 0.62):
        axes.add_patch(Circle((x, 0), 0.75, facecolor="#dde7f0", edgecolor=BLUE, alpha=0.8))
        axes.plot(x, 0, "k.")
    axes.add_patch(Rectangle((-0.1, -0.33), 0.2, 0.66, color=ORANGE, alpha=0.7))
    axes.text(0.0, 0.52, "$A$", ha="center", color=ORANGE)
    arrow(axes, (-0.13, -0.95), (0.13, -0.95), style="<|-|>")
    axes.text(0, -1.2, "$u$", ha="center")
    arrow(axes, (-0.62, 0), (-1.15, 0.53), "$R_i$", at=(-0.75, 0.42))
    arrow(axes, (0.62, 0), (1.15, 0.53), "$R_j$", at=(0.75, 0.42))
    figure.tight_layout()
    save("grains")


# ---- tyres ---------------------------------------------------------------------------------------


def tyres() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(10.0, 4.2), width_ratios=(1, 1, 1))
    chain_panel(panels[0])
    section_of_tyre(panels[1], bricks=False)
    section_of_tyre(panels[2], bricks=True)
    figure.tight_layout()
    save("tyres")


def arc(start, end, length, count):
    """Points of the circular arc of a length over a chord, bulging to the right of start to end."""
    chord = np.asarray(end) - np.asarray(start)
    c = np.hypot(*chord)
    low, high = 1e-6, np.pi
    for _ in range(80):  # sin(h)/h = c/length, h half of the opening angle
        half = 0.5 * (low + high)
        low, high = (half, high) if np.sin(half) / half > c / length else (low, half)
    radius = length / (2 * half)
    along, out = chord / c, np.array([chord[1], -chord[0]]) / c
    turn = np.linspace(-half, half, count)
    return (np.asarray(start) + along * c / 2)[:, None] + np.outer(along, radius * np.sin(turn)) + (
        np.outer(out, radius * (np.cos(turn) - np.cos(half)))
    )


def chain_panel(axes: Axes) -> None:
    drawing(axes, (-0.45, 1.55), (-0.35, 1.65))
    axes.set_title("a  sidewall chain")
    points = arc((0, 0), (0.35, 1.25), 1.65, 9)
    axes.plot(*points, "o-", color=BLUE, ms=4)
    axes.plot([0, 0.35], [0, 1.25], ":", color=GREY)
    for k in range(8):
        middle = (points[:, k] + points[:, k + 1]) / 2
        direction = points[:, k + 1] - points[:, k]
        out = np.array([direction[1], -direction[0]]) / np.hypot(*direction)
        arrow(axes, tuple(middle - 0.2 * out), tuple(middle - 0.02 * out), colour=ORANGE)
    axes.text(0.3, 0.55, "p", color=ORANGE)
    axes.plot([-0.35, 0], [0, 0], color=WHEEL, lw=3)
    axes.text(-0.33, -0.14, "rim, $k_r$, $\\theta_r$")
    axes.plot([-0.3, 0.35], [1.3, 1.25], color=WHEEL, lw=3)
    axes.text(-0.3, 1.42, "tread, $k_t$, $\\theta_t$, $\\phi$")
    axes.text(*(points[:, 4] + np.array([0.1, 0.0])), "hinge\n$EI_i$, $\\kappa_i$", color=BLUE)
    arrow(axes, (1.05, 0.0), (1.4, 0.0), "$a$", at=(1.5, 0.0))
    arrow(axes, (1.05, 0.0), (1.05, 0.35), "$r$", at=(1.05, 0.45))


def section_of_tyre(axes: Axes, bricks: bool) -> None:
    drawing(axes, (-0.15, 1.65), (-0.35, 1.75))
    axes.set_title("c  brick tyre" if bricks else "b  shell tyre")
    axes.plot([0, 0], [-0.3, 1.7], "-.", color=GREY, lw=0.8)
    axes.text(0.03, -0.3, "mid-plane", fontsize=8, color=GREY)
    axes.plot([0, 0.8, 0.8], [-0.1, -0.1, 0.0], color=WHEEL, lw=3)
    axes.text(0.25, -0.02, "rim", color=WHEEL)
    bead, edge = (0.8, 0.0), (0.78, 1.3)
    side = arc(bead, edge, 1.62, 9)
    tread_x = np.linspace(0, edge[0], 5)
    tread_z = 1.38 - 0.08 * (tread_x / edge[0]) ** 2
    if not bricks:
        axes.plot(tread_x, tread_z, "s-", color=GREEN, ms=5)
        axes.plot(*side, "--", color=BLUE)
        axes.plot(*side[:, ::2][:, 1:-1], "o", color=BLUE, ms=4, mfc="white")
        axes.text(0.1, 1.5, "shells", color=GREEN)
        axes.text(0.1, 0.7, "sidewall: looked up;\ncircles: contact", color=BLUE, fontsize=8)
        return
    carcass = np.hstack([np.vstack([tread_x, tread_z]), side[:, ::-1][:, 1:]])
    axes.plot(*carcass, "s-", color=BLUE, ms=4)
    for k in range(4):
        if k == 2:
            continue  # a groove
        for layer in range(2):
            low, high = 0.11 * layer, 0.11 * (layer + 1)
            corner = [(tread_x[k], tread_z[k] + low), (tread_x[k + 1], tread_z[k + 1] + low),
                      (tread_x[k + 1], tread_z[k + 1] + high), (tread_x[k], tread_z[k] + high)]  # fmt: skip
            axes.add_patch(Polygon(corner, facecolor="#cfcfcf", edgecolor="black", lw=0.7))
    axes.text(0.05, 1.66, "rubber bricks, groove", fontsize=8)
    axes.text(0.1, 0.7, "carcass of shells,\nbead to bead", color=BLUE, fontsize=8)


# ---- where the resistance comes from -------------------------------------------------------------


def resistance() -> None:
    figure, axes = plt.subplots(figsize=(8.6, 4.2))
    axes.set(xlim=(0, 12), ylim=(0, 8.4))
    axes.axis("off")

    def box(x, y, text, colour, width=2.6, height=0.72):
        axes.add_patch(
            Rectangle((x, y - height / 2), width, height, facecolor=colour, alpha=0.18, ec=colour)
        )
        axes.text(x + width / 2, y, text, ha="center", va="center", fontsize=8.5)

    box(0.1, 4.0, "axle and load\n$W_{drive}+W_{load}$", ORANGE, height=1.1)
    groups = (
        ("continuum", BLUE, 6.5, ("compaction $W_c$", "bulldozing $W_b$", "inertia $E_k$",
                                  "radiation $E_r$", "grid $E_n$")),
        ("grains", GREEN, 3.55, ("below the track", "ahead and aside", "walls", "their motion")),
        ("contact and wheel", VIOLET, 1.0, ("friction", "springs and damping",
                                            "wheel, tyre, rig")),
    )  # fmt: skip
    for name, colour, y, parts in groups:
        box(4.4, y, name, colour)
        arrow(axes, (2.7, 4.0), (4.4, y), colour=colour)
        for k, part in enumerate(parts):
            place = y + 0.66 * ((len(parts) - 1) / 2 - k)
            box(8.7, place, part, colour, 3.1, 0.55)
            arrow(axes, (7.0, y), (8.7, place), colour=colour)
    save("resistance")


# ---- errors: equations of errors.md --------------------------------------------------------------


def block_errors(values):
    """Length of blocks and standard error of the mean (equation 2) for each."""
    lengths, errors = [], []
    length = 1
    while len(values) // length >= 2:
        count = len(values) // length
        means = values[len(values) - count * length :].reshape(count, length).mean(axis=1)
        lengths.append(length)
        errors.append(means.std(ddof=1) / np.sqrt(count))
        length = max(length + 1, length * 5 // 4)
    return np.array(lengths), np.array(errors)


def errors() -> None:
    random = np.random.default_rng(7)
    count, memory, noise = 4000, 0.98, 0.15
    shocks = random.normal(size=count) * noise * np.sqrt(1 - memory**2)
    series = np.zeros(count)
    for k in range(1, count):
        series[k] = memory * series[k - 1] + shocks[k]
    time = np.linspace(0, 4, count)
    history = 1 + series - 0.9 * np.exp(-time / 0.18)
    start = 800
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.4))
    panels[0].plot(time, history, color=BLUE, lw=0.6)
    panels[0].axvspan(time[start], time[-1], color=GREEN, alpha=0.12)
    panels[0].axhline(history[start:].mean(), color=ORANGE)
    panels[0].text(2.4, 0.25, "window", color=GREEN, ha="center")
    panels[0].text(0.35, 0.25, "transient", color=GREY, fontsize=8)
    panels[0].set(xlabel="time of the cruise [s]", ylabel="value", title="a  steady part")
    lengths, found = block_errors(history[start:])
    n = count - start
    enough = lengths**3 > 2 * n * (np.maximum.accumulate(found) / found[0]) ** 4
    true = noise * np.sqrt((1 + memory) / (1 - memory) / n)
    several = n // lengths >= 4
    panels[1].loglog(lengths[several], found[several], color=BLUE)
    panels[1].axhline(true, color=GREY, ls="--", label="exact for this noise")
    chosen = int(np.argmax(enough))
    panels[1].plot(lengths[chosen], np.maximum.accumulate(found)[chosen], "o", color=ORANGE,
                   label="chosen by equation 3")  # fmt: skip
    panels[1].set(xlabel="block length l [rows]", ylabel="standard error $u_t$", title="b  blocks")
    panels[1].legend(loc="lower right")
    f_0, a, order = 1.0, 0.35, 1.4
    sizes = np.array([0.25, 0.5, 1.0])
    values = f_0 + a * sizes**order
    ratio = np.log((values[2] - values[1]) / (values[1] - values[0])) / np.log(2)  # equation 7
    index = 1.25 * (values[1] - values[0]) / (2**ratio - 1)  # equation 8
    h = np.linspace(0, 1.05, 200)
    panels[2].plot(h, f_0 + a * h**order, color=BLUE, lw=1)
    panels[2].plot(sizes, values, "o", color=BLUE)
    zero = values[0] - (values[1] - values[0]) / (2**ratio - 1)
    panels[2].errorbar([0], [zero], yerr=[index], fmt="s", color=ORANGE, capsize=4,
                       label=f"$f_0\\pm U_h$, p = {ratio:.1f}")  # fmt: skip
    panels[2].set(xlabel="size h over the coarsest", ylabel="value", xlim=(-0.06, 1.1),
                  title="c  grid convergence")  # fmt: skip
    panels[2].legend(loc="upper left")
    figure.tight_layout()
    save("errors")


# ---- hybrid --------------------------------------------------------------------------------------


def hybrid() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(10.5, 3.4), width_ratios=(1, 1, 1.25))
    random = np.random.default_rng(3)
    for axes, trough in ((panels[0], False), (panels[1], True)):
        drawing(axes, (-0.3, 6.3), (-0.4, 5.9))
        axes.set_title("b  trough, seen along the travel" if trough else "a  layer of grains")
        for x in np.arange(0.25, 6, 0.5):
            for y in np.arange(0.25, 3.4 if trough else 2, 0.5):
                if trough and 1.5 < x < 4.5 and y > 1.5:
                    continue
                axes.add_patch(Rectangle((x - 0.25, y - 0.25), 0.5, 0.5, fc=SAND, ec="white"))
        low, left, right = (1.5, 1.5, 4.5) if trough else (2.0, 0.0, 6.0)
        mesh = ([0, 1.5, 1.5, 4.5, 4.5, 6], [3.5, 3.5, 1.5, 1.5, 3.5, 3.5])
        axes.plot(*(mesh if trough else ([0, 6], [2, 2])), color=ORANGE, lw=2)
        for y in np.arange(low + 0.17, 3.45, 0.3):
            shift = 0.17 * (int(round((y - low) / 0.3)) % 2)
            for x in np.arange(left + 0.18 + shift, right - 0.1, 0.35):
                axes.add_patch(Circle((x, y), 0.16 + 0.01 * random.normal(), fc="#d9b36a", ec="0.4",
                                      lw=0.4))  # fmt: skip
        if trough:
            axes.add_patch(Rectangle((2.2, 3.3), 1.6, 2.4, fc="#c9ced6", ec=WHEEL))
        else:
            axes.add_patch(Circle((3, 4.9), 1.6, fc="#c9ced6", ec=WHEEL))
        axes.set_ylim(-0.4, 6.6)
        axes.text(5.95, 0.1, "continuum", ha="right", fontsize=8)
        axes.text(0.05, (3.6 if trough else 1.65), "mesh", color=ORANGE, fontsize=8)
    axes = panels[2]
    drawing(axes, (-1.6, 9.6), (-1.6, 5.6))
    axes.set_title("c  moving hybrid")
    for k in range(8):
        colour = {0: "#e3b7a0", 7: "#b9d3ae"}.get(k, SAND)
        axes.add_patch(Rectangle((k, 0), 1, 1.4, fc=colour, ec="white"))
        axes.add_patch(Rectangle((k, 1.4), 1, 0.8, fc=colour, ec="white", hatch="oo", alpha=0.6))
    axes.plot([0, 8], [1.4, 1.4], color=ORANGE, lw=2)
    axes.add_patch(Circle((4.3, 3.3), 1.3, fc="#c9ced6", ec=WHEEL))
    arrow(axes, (4.3, 3.3), (6.3, 3.3), "$v$", at=(6.6, 3.3))
    axes.text(0.5, -0.4, "dropped", ha="center", fontsize=8)
    axes.text(7.5, -0.4, "added", ha="center", fontsize=8)
    arrow(axes, (0.5, -0.7), (7.5, -0.7), colour=ORANGE, connectionstyle="arc3,rad=0.12")
    axes.text(4.0, -1.55, "same patch of the mesh, one period $L$ ahead", ha="center", fontsize=8,
              color=ORANGE)  # fmt: skip
    figure.tight_layout()
    save("hybrid")


# ---- soil contact model: equations of scm.md ----------------------------------------------------


def plate_curve(depths, modulus, n, stiffness):
    """Pressures [Pa] of a cell at successive depths of a plate [m] (equation 1)."""
    surface, pressures = 0.0, []
    for depth in depths:
        pressure = max(0.0, stiffness * (depth - surface))
        limit = modulus * depth**n
        if pressure > limit:
            pressure, surface = limit, depth - limit / stiffness
        pressures.append(pressure)
    return np.array(pressures)


def mobilised(slides, K):
    """m after successive slides [m] in one direction or the other (equation 4)."""
    m, values = 0.0, [0.0]
    for slide in slides:
        limit = np.sign(slide)
        m = limit + (m - limit) * np.exp(-abs(slide) / K)
        values.append(m)
    return np.array(values)


def scm() -> None:
    figure, panels = plt.subplots(1, 3, figsize=(9.2, 2.9))
    depths = np.concatenate(
        [np.linspace(0, 0.03, 120), np.linspace(0.03, 0.024, 60), np.linspace(0.024, 0.05, 150)]
    )
    pressures = plate_curve(depths, 1.2e6, 0.8, 1.5e7)
    panels[0].plot(1e3 * depths, 1e-3 * pressures, color=BLUE)
    panels[0].plot(1e3 * depths, 1.2e3 * depths**0.8, color=GREY, lw=0.8, ls="--")
    panels[0].set(xlabel="sinkage z [mm]", ylabel="pressure p [kPa]", title="a  a plate")
    K = 0.01
    slides = np.concatenate([np.full(80, 5e-4), np.full(100, -5e-4)])
    places = np.concatenate([[0.0], np.cumsum(slides)])
    panels[1].plot(1e3 * places, mobilised(slides, K), color=ORANGE)
    panels[1].set(xlabel="place [mm]", ylabel="mobilised share m", title="b  sliding, K = 10 mm")
    radius, entry = 0.25, np.arccos(1 - 0.03 / 0.25)
    angle = np.linspace(0, entry, 100)
    for slip, colour in ((0.1, BLUE), (0.4, GREEN)):
        j = radius * (entry - angle - (1 - slip) * (np.sin(entry) - np.sin(angle)))
        panels[2].plot(np.degrees(angle), 1 - np.exp(-j / K), color=colour, label=f"slip {slip:g}")
    panels[2].legend()
    panels[2].set(xlabel="angle from the lowest point [°]", ylabel="mobilised share m",
                  title="c  along a driven wheel")  # fmt: skip
    figure.tight_layout()
    save("scm")


# ---- resistive force theory: equations of rft.md ------------------------------------------------

# Coefficients of [Agarwal2023] by the powers of x1, x2, x3
RFT = {
    (0, 0, 0): (0.00212, -0.06796, -0.02634), (1, 0, 0): (-0.02320, -0.10941, -0.03436),
    (0, 1, 0): (-0.20890, 0.04725, 0.45256), (0, 0, 1): (-0.43083, -0.06914, 0.00835),
    (2, 0, 0): (-0.00259, -0.05835, 0.02553), (0, 2, 0): (0.48872, -0.65880, -1.31290),
    (0, 0, 2): (-0.00415, -0.11985, -0.05532), (1, 1, 0): (0.07204, -0.25739, 0.06790),
    (0, 1, 1): (-0.02750, -0.26834, -0.16404), (1, 0, 1): (-0.08772, 0.02692, 0.02287),
    (3, 0, 0): (0.01992, -0.00736, 0.02927), (0, 3, 0): (-0.45961, 0.63758, 0.95406),
    (0, 0, 3): (0.40799, 0.08997, -0.00131), (1, 2, 0): (-0.10107, 0.21069, -0.11028),
    (2, 1, 0): (-0.06576, 0.04748, 0.01487), (0, 1, 2): (0.05664, 0.20406, -0.02730),
    (0, 2, 1): (-0.09269, 0.18589, 0.10911), (2, 0, 1): (0.01892, 0.04934, -0.04097),
    (1, 0, 2): (0.01033, 0.13527, 0.07881), (1, 1, 1): (0.15120, -0.33207, -0.27519),
}  # fmt: skip


def rft_stress(n, d, friction):
    """Stress per strength and depth on a face of outward normal n that moves along d (equation 2)."""
    n, d = np.asarray(n, float), np.asarray(d, float)
    if n @ d < -1e-9:
        return np.zeros(3)
    m = n if n[2] <= 1e-9 else -n
    x = (-d[2], -m[2], m @ d)
    f = sum(np.prod(np.power(x, powers)) * np.array(c) for powers, c in RFT.items())
    alpha = f[0] * m + f[1] * d - f[2] * np.array((0.0, 0.0, 1.0))
    pressure = -alpha @ n
    if pressure <= 0.0:
        return np.zeros(3)
    along = alpha + pressure * n
    share = min(1.0, friction * pressure / max(np.linalg.norm(along), 1e-12))
    return -pressure * n + (-share if along @ d > 0 else share) * along


def rft() -> None:
    figure, panels = plt.subplots(1, 2, figsize=(7.4, 2.9))
    angles = np.radians(np.linspace(0, 90, 91))
    for axes, normal, title in (
        (panels[0], (0, 0, -1), "a  level plate"),
        (panels[1], (1, 0, 0), "b  upright plate"),
    ):
        stress = np.array([rft_stress(normal, (np.cos(a), 0, -np.sin(a)), 0.5) for a in angles])
        axes.plot(np.degrees(angles), stress[:, 2], color=BLUE, label="upward")
        axes.plot(np.degrees(angles), -stress[:, 0], color=ORANGE, label="against the travel")
        axes.set(xlabel="motion below the horizontal [°]", title=title)
    panels[0].set(ylabel="stress over \u03be z")
    panels[0].legend()
    figure.tight_layout()
    save("rft")


CHAPTERS: dict[str, Callable[[], None]] = {
    "symbols": symbols,
    "step": step,
    "continuum": continuum,
    "laws": laws,
    "snow": snow,
    "sand": sand,
    "contact": contact,
    "grains": grains,
    "tyres": tyres,
    "resistance": resistance,
    "errors": errors,
    "hybrid": hybrid,
    "scm": scm,
    "rft": rft,
}


def draw(names: Iterable[str] = tuple(CHAPTERS)) -> None:
    plt.rcParams.update(STYLE)
    FOLDER.mkdir(exist_ok=True)
    for name in names:
        CHAPTERS[name]()


if __name__ == "__main__":
    draw(sys.argv[1:] or tuple(CHAPTERS))
