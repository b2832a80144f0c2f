"""Figures with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from ._native import Simulation


def histories(of: Simulation, axes: Axes | None = None) -> Axes:
    """Horizontal displacement of the centre of mass in both models, Housner's impacts marked."""
    if axes is None:
        try:
            from matplotlib import pyplot
        except ImportError as error:
            raise ImportError("plot needs matplotlib: pip install matplotlib") from error
        axes = pyplot.subplots(figsize=(9.0, 3.5), layout="constrained")[1]
    housner = of.housner
    axes.plot(housner.t, 1e3 * housner.u, color="black", linewidth=1.0, label="Housner")
    axes.plot(of.t, 1e3 * of.u, color="tab:red", linewidth=1.0, linestyle="--", label="finite elements on ground springs")
    axes.plot(housner.impacts, 0.0 * housner.impacts, ".", color="black", markersize=4.0, label="impacts")
    axes.set_xlabel("time [s]")
    axes.set_ylabel("displacement u [mm]")
    axes.grid(alpha=0.3)
    axes.legend(loc="upper right", fontsize="small")
    return axes
