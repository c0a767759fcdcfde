#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Integrates the rate equations of NorSand (norsand.h) with SciPy and prints norsand_reference.csv.

Nothing of Furrow is used. The plastic multiplier follows from the consistency condition with
numerical derivatives of the yield function. The paths start isotropically inside the surface. First
yield and the arrival at the limit of dilatancy, and the departure from it, are located as events.
"""

import sys

import numpy as np
from scipy.integrate import solve_ivp

M, GAMMA, LAMBDA, CHI, N, H, H_PSI = 1.25, 0.82, 0.02, 4.0, 0.35, 100.0, 300.0
G_REF, EXPONENT, NU, PT = 40e6, 0.5, 0.2, 10.0
BULK_RATIO = 2 * (1 + NU) / (3 * (1 - 2 * NU))
CHI_I = CHI / (1 - (1 - N) * LAMBDA * CHI / M)


def psi_i(void, image):
    """State parameter of the image; image: ln of the image pressure in Pa."""
    return void - GAMMA + LAMBDA * (image - np.log(1e3))


def dilatancy(x):
    """D on the surface at x = P over the image pressure."""
    return M / N * (x ** (N / (1 - N)) - 1)


def lowest_ratio(void, image):
    """x at the limit of dilatancy."""
    return (1 + N * CHI_I * psi_i(void, image) / M) ** ((1 - N) / N)


def excess(y, limited=False):
    """Yield function over P; y: P = p + pt, q, ln of the image pressure, void ratio."""
    P, q, image, void = y[:4]
    D = CHI_I * psi_i(void, image) if limited else dilatancy(P / np.exp(image))
    return q / P - M + (1 - N) * D


def gradient(y, limited):
    steps = np.array((1e-6 * y[0], 1e-6 * y[0], 1e-6, 1e-6))
    return np.array(
        [
            (excess(y + d, limited) - excess(y - d, limited)) / (2 * s)
            for s, d in ((s, s * np.eye(4)[k]) for k, s in enumerate(steps))
        ]
    )


def rates(y, path, phase):
    """d(y)/d(axial strain) and d(volume)/d(axial strain), compression positive.

    phase: elastic, surface or limit
    """
    P, q, image, void = y
    G = G_REF * (P / 1e5) ** EXPONENT
    K = BULK_RATIO * G
    plastic = phase != "elastic"
    hardening = 0.0
    if plastic:
        f = gradient(y, phase == "limit")
        psi = psi_i(void, image)
        x, lowest = P / np.exp(image), lowest_ratio(void, image)
        D = CHI_I * psi if phase == "limit" else dilatancy(x)
        modulus = max(H - H_PSI * psi, 0.1 * H) * (np.exp(image) / 1e5) ** (EXPONENT - 1)
        hardening = modulus * (x / lowest - 1 if phase == "limit" else x**2 / lowest - x)
        stiffness = f[0] * K * D + f[1] * 3 * G - f[2] * hardening

    def response(volume):
        shear = 1 - volume / 3  # of axial strain 1
        flow = 0.0
        if plastic:
            flow = (f[0] * K * volume + f[1] * 3 * G * shear - f[3] * (1 + void) * volume) / stiffness
        dP = K * (volume - (flow * D if plastic else 0.0))
        dq = 3 * G * (shear - flow)
        return np.array((dP, dq, flow * hardening, -(1 + void) * volume))

    if path == "undrained":
        volume = 0.0
    elif path == "confined":
        volume = 1.0
    else:  # drained: the lateral stress P - q/3 is constant
        at = [response(v)[0] - response(v)[1] / 3 for v in (0.0, 1.0)]
        volume = at[0] / (at[0] - at[1])
    return np.append(response(volume), volume)


def integrate(path, void, pressure, strains):
    """Rows at the strains, from the isotropic pressure with the image pressure at 0.8 P."""

    def yields(_, y):
        return excess(y)

    def arrives(_, y):
        return y[0] / np.exp(y[2]) - lowest_ratio(y[3], y[2])

    def departs(t, y):
        return arrives(t, y)

    for event, direction in ((yields, 1), (arrives, -1), (departs, 1)):
        event.terminal, event.direction = True, direction
    y = np.array((pressure + PT, 0.0, np.log(0.8 * (pressure + PT)), void, 0.0))
    following = {"elastic": "surface", "surface": "limit", "limit": "surface"}
    events = {"elastic": yields, "surface": arrives, "limit": departs}
    start, rows, phase = 0.0, [], "elastic"
    while len(rows) < len(strains):
        solution = solve_ivp(
            lambda t, y, phase=phase: rates(y[:4], path, phase),
            (start, strains[-1]),
            y,
            events=events[phase],
            t_eval=strains[strains > start],
            rtol=1e-9,
            atol=1e-10,
            method="DOP853",
        )
        assert solution.success
        rows.extend(np.array(solution.y).T)
        if len(solution.t_events[0]):
            start, y = float(solution.t_events[0][0]), solution.y_events[0][0]
            phase = following[phase]
    return rows


def main():
    print("path,void_ratio,pressure_Pa,axial_strain,p_Pa,q_Pa,volumetric_strain")
    for path, void, pressure, end in (
        ("drained", 0.62, 5e4, 0.20),
        ("drained", 0.78, 5e4, 0.20),
        ("drained", 0.66, 5e3, 0.20),
        ("undrained", 0.70, 1e5, 0.04),
        ("undrained", 0.76, 1e5, 0.04),
        ("confined", 0.62, 2e3, 0.008),
        ("confined", 0.74, 2e3, 0.012),
    ):
        strains = end * np.array((0.05, 0.1, 0.2, 0.3, 0.5, 0.75, 1.0))
        for strain, row in zip(strains, integrate(path, void, pressure, strains)):
            print(f"{path},{void},{pressure:g},{strain:g},{row[0] - PT:.8g},{row[1]:.8g},{row[4]:.8g}")


if __name__ == "__main__":
    sys.exit(main())
