"""The empirical model of wheels in shallow snow of NRMM, as S. A. Shoop (ERDC/CRREL TR-01-16, 2001, eq 29-33) gives it."""
import math


def sinkage(depth, density, pressure):
    """[m], of snow of this depth [m] and density [kg/m3] under the largest contact pressure [Pa]; packed to at most 917 kg/m3."""
    packed = min(0.519 + 0.0023 * pressure / 1e3, 0.917)  # Mg/m3
    return depth * (1.0 - density / 1e3 / packed)


def resistance(sinkage, density, width, radius):
    """[N] of one wheel. Beyond two thirds of the radius and beyond the radius deep snow of more than 150 kg/m3 resists more."""
    contact = radius * math.acos((radius - sinkage) / radius)
    shallow = 13.6041 * (density * width * contact) ** 1.26
    deep = 1.0 if density <= 150 or sinkage <= 2.0 * radius / 3.0 else 1.5 if sinkage < radius else 2.5
    return deep * shallow
