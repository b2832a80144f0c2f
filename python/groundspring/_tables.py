"""Results as pandas tables."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas

    from ._native import History, Simulation


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
    columns = {"t": of.t[:n], "u_housner": housner.u[:n], "v_housner": housner.v[:n], "theta_housner": housner.theta[:n]}
    columns |= {"u": of.u[:n], "v": of.v[:n], "theta": of.theta[:n]}
    columns |= {name: getattr(of, name)[:n] for name in names}
    columns |= {name: values[:n] for name, values in of.demands.items()}
    return _frame(columns, "t")


def rows(of: list[dict[str, Any]]) -> pandas.DataFrame:
    """A row a record."""
    return _frame(of)
