"""Results as pandas tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas
    import polars as pl

    from ._native import Histories, History, RockingTable, Simulation


def _frame(columns: Any, index: Any = None) -> pandas.DataFrame:
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_pandas needs pandas: pip install pandas") from error
    table = pandas.DataFrame(columns)
    return table if index is None else table.set_index(index)


def motion(history: History) -> pandas.DataFrame:
    """Housner's motion over time, s."""
    return _frame({"t": history.t, "u": history.u, "v": history.v, "theta": history.theta, "rate": history.rate}, "t")


def simulation(of: Simulation) -> pandas.DataFrame:
    """Both models' motions over time, s, as far as both go; the feet's forces, N; the finite elements' energies, J."""
    housner = of.housner
    n = min(len(housner.t), len(of.t))
    names = (
        "vertical_left", "vertical_right", "horizontal_left", "horizontal_right",
        "energy_input", "energy_stored", "energy_dissipated", "energy_residual",
    )  # fmt: skip
    columns = {
        "t": of.t[:n],
        "u_housner": housner.u[:n],
        "v_housner": housner.v[:n],
        "theta_housner": housner.theta[:n],
    }
    columns |= {"u": of.u[:n], "v": of.v[:n], "theta": of.theta[:n]}
    columns |= {name: getattr(of, name)[:n] for name in names}
    columns |= {name: values[:n] for name, values in of.demands.items()}
    return _frame(columns, "t")


def rows(of: list[dict[str, Any]]) -> pandas.DataFrame:
    """A row a record."""
    return _frame(of)


def histories(of: Histories) -> pandas.DataFrame:
    """A row a history: how it ended, its largest |theta|/alpha, its impacts, when it overturned, s."""
    each = [of[i] for i in range(len(of))]
    columns = {
        "outcome": [one.outcome for one in each],
        "peak_ratio": of.peak_ratio,
        "impacts": [len(one.impacts) for one in each],
        "overturned": of.overturned,
        "overturned_time": [float("nan") if one.overturned is None else one.overturned for one in each],
        "samples": [len(one) for one in each],
    }
    return _frame(columns)


def rocking(of: RockingTable) -> pandas.DataFrame:
    """The table as it is."""
    return _frame({name: of[name] for name in of.columns})


def polars(of: RockingTable) -> pl.DataFrame:
    """The table as it is, without a copy."""
    try:
        import polars
    except ImportError as error:
        raise ImportError("to_polars needs polars: pip install polars") from error
    return polars.DataFrame(of)
