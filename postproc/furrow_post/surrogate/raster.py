# SPDX-License-Identifier: GPL-2.0-or-later
"""Rasters of terrain by GDAL: slope of an elevation model, soil, and the GeoTIFF of a map."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import __version__
from ..arrays import Floats
from ..errors import ResultsError
from ..programs import optional_module

NOTHING = -9999.0  # of cells without a value
# [m] of the names that GDAL has for the unit of heights, EPSG 9001, 9002 and 9003; no name: metres
HEIGHTS = {
    **dict.fromkeys(("", "m", "metre", "meter"), 1.0),
    **dict.fromkeys(("ft", "foot"), 0.3048),
    **dict.fromkeys(("us-ft", "us survey foot"), 1200 / 3937),
}


@dataclass(frozen=True)
class Raster:
    """Values with row 0 in the north; NaN: no data."""

    values: Floats
    transform: tuple[float, ...]  # of GDAL: x0, dx, 0, y0, 0, -dy
    projection: str = ""

    def require_same(self, other: "Raster", name: str) -> None:
        """Requires the size and the place of another raster. @raises ResultsError"""
        if self.values.shape != other.values.shape or not np.allclose(
            self.transform, other.transform
        ):
            raise ResultsError(
                f"{name}: has {other.values.shape[1]} x {other.values.shape[0]} cells or an origin that differ "
                f"from the elevation model with {self.values.shape[1]} x {self.values.shape[0]}; bring it onto "
                "the same grid by gdalwarp -te ... -ts ..."
            )


def _gdal() -> Any:
    gdal = optional_module("osgeo.gdal", "python3-gdal")
    gdal.UseExceptions()
    return gdal


def _open(gdal: Any, file: Path) -> Any:
    if not file.is_file():
        raise ResultsError(f"{file}: no such file; give a raster that GDAL reads, e.g. a GeoTIFF")
    try:
        return gdal.Open(str(file))
    except RuntimeError as error:
        raise ResultsError(
            f"{file}: GDAL cannot read it ({error}); give a raster, e.g. a GeoTIFF"
        ) from None


def _read(data: Any) -> Raster:
    band = data.GetRasterBand(1)
    values: Floats = band.ReadAsArray().astype(np.float64)
    nothing = band.GetNoDataValue()
    if nothing is not None:
        values[values == nothing] = np.nan
    return Raster(values, tuple(data.GetGeoTransform()), data.GetProjection())


def read_raster(file: Path) -> Raster:
    """Reads the first band of a raster file. @raises ResultsError"""
    return _read(_open(_gdal(), file))


def read_slope(file: Path) -> Raster:
    """Steepest slope [degrees] of an elevation model by Horn's differences. Lengths and heights have the units that
    the file states, else metres.

    @raises ResultsError
    """
    gdal = _gdal()
    data = _open(gdal, file)
    projection = data.GetProjection()
    system = optional_module("osgeo.osr", "python3-gdal").SpatialReference(projection) if projection else None
    if system and system.IsGeographic():
        raise ResultsError(
            f"{file}: has degrees of longitude and latitude; reproject it to metres by gdalwarp -t_srs EPSG:..."
        )
    unit, length = data.GetRasterBand(1).GetUnitType(), system.GetLinearUnits() if system else 1.0  # [m]
    if unit.lower() not in HEIGHTS or (not unit and length != 1.0):
        raise ResultsError(
            f"{file}: has heights in '{unit}', and lengths in {length:.6g} m; allowed: heights in m, ft or us-ft, and for "
            "lengths in m also no unit; write the unit of the heights by gdal_edit.py -units UNIT"
        )
    options = {"format": "MEM", "slopeFormat": "degree", "computeEdges": True, "scale": length / HEIGHTS[unit.lower()]}
    return _read(gdal.DEMProcessing("", data, "slope", **options))


def write_geotiff(
    file: Path, like: Raster, bands: Mapping[str, tuple[Floats, str]], notes: Sequence[str]
) -> None:
    """bands: name -> values and unit; NaN becomes no data"""
    gdal = _gdal()
    rows, columns = like.values.shape
    options = ["COMPRESS=DEFLATE", "ZLEVEL=1", "TILED=YES", "NUM_THREADS=ALL_CPUS"]
    data = gdal.GetDriverByName("GTiff").Create(
        str(file), columns, rows, len(bands), gdal.GDT_Float32, options
    )
    data.SetGeoTransform(like.transform)
    data.SetProjection(like.projection)
    data.SetMetadata({"program": f"furrow-post {__version__} map", "notes": "\n".join(notes)})
    for number, (name, (values, unit)) in enumerate(bands.items(), 1):
        band = data.GetRasterBand(number)
        band.SetNoDataValue(NOTHING)
        band.SetDescription(name)
        band.SetUnitType(unit)
        band.WriteArray(np.where(np.isnan(values), NOTHING, values).astype(np.float32))
    data.FlushCache()
