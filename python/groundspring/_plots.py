"""Figures with matplotlib."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ._native import GRAVITY, frequency_response

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._native import History, Record, Simulation, Springs


def _axes(axes: Axes | None) -> Axes:
    if axes is not None:
        return axes
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot needs matplotlib: pip install matplotlib") from error
    return pyplot.subplots(figsize=(9.0, 3.5), layout="constrained")[1]


def record(of: Record, axes: Axes | None = None) -> Axes:
    """Ground acceleration over time, with the vertical one if there is one."""
    axes = _axes(axes)
    axes.plot(of.t, of.accel / GRAVITY, color="black", linewidth=0.7, label=of.name)
    if of.vertical is not None:
        axes.plot(of.t, of.vertical.accel / GRAVITY, color="tab:blue", linewidth=0.5, label="vertical")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("ground acceleration [g]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right", fontsize="small")
    return axes


def history(of: History, axes: Axes | None = None) -> Axes:
    """Rotation over time, impacts marked."""
    axes = _axes(axes)
    axes.plot(of.t, 1e3 * of.theta, color="black", linewidth=1.0, label=f"Housner: {of.outcome}")
    axes.plot(of.impacts, 0.0 * of.impacts, ".", color="black", markersize=4.0, label="impacts")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("rotation [mrad]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right", fontsize="small")
    return axes


def springs(of: Springs, axes: Axes | None = None) -> Axes:
    """Amplitude response ratio of the vertical and the horizontal unit over frequency (equation 7)."""
    axes = _axes(axes)
    ratio = np.logspace(-3.0, 1.5, 500)
    for name, unit, color in (("vertical", of.vertical, "black"), ("horizontal", of.horizontal, "tab:red")):
        omega, mu = math.sqrt(unit.k1 / of.mass), unit.m2 / of.mass
        f, xi = math.sqrt(unit.k2 / unit.m2) / omega, unit.c / (2.0 * unit.m2 * omega)
        axes.loglog(ratio * omega / (2.0 * math.pi), frequency_response(ratio, mu, f, xi), color=color, label=name)
    axes.set_xlabel("frequency [Hz]")
    axes.set_ylabel("amplitude response ratio")
    axes.grid(alpha=0.3, which="both")
    axes.legend(loc="lower left", fontsize="small")
    return axes


def histories(of: Simulation, axes: Axes | None = None) -> Axes:
    """Horizontal displacement of the centre of mass in both models, Housner's impacts marked."""
    axes = _axes(axes)
    housner = of.housner
    axes.plot(housner.t, 1e3 * housner.u, color="black", linewidth=1.0, label="Housner")
    axes.plot(
        of.t, 1e3 * of.u, color="tab:red", linewidth=1.0, linestyle="--", label="finite elements on ground springs"
    )
    axes.plot(housner.impacts, 0.0 * housner.impacts, ".", color="black", markersize=4.0, label="impacts")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("displacement u [mm]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right", fontsize="small")
    return axes
