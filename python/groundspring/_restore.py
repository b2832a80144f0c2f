"""What pickles are opened by: each function makes again what it is named after."""

from __future__ import annotations

import warnings
from typing import Any

from ._native import (
    Design,
    GroundspringWarning,
    Histories,
    History,
    Record,
    RockingTable,
    Simulation,
    Springs,
    Structure,
    Tuned,
    UnitDesign,
    Validation,
    _design,
    _histories,
    _history,
    _table,
    _unit_design,
    simulate,
    tune,
    validate,
)


def record(dt: float, accel: Any, name: str, vertical: Record | None) -> Record:
    made = Record(dt, accel, name)
    return made if vertical is None else made.with_vertical(vertical)


def structure(kind: str, height: float, width: float, mass: float, inertia: float, restitution: float) -> Structure:
    with warnings.catch_warnings():
        # told when it was made
        warnings.simplefilter("ignore", GroundspringWarning)
        if kind == "block":
            # by its whole height
            return Structure.block(2.0 * height, width, mass, inertia, restitution)
        return Structure.aframe(height, width, mass, inertia, restitution)


def design(alpha: float, mass_share: float, stiffness: float) -> Design:
    return _design(alpha, mass_share, stiffness)


def unit_design(mu: float, f: float, xi: float, frequency_ratio: float) -> UnitDesign:
    return _unit_design(mu, f, xi, frequency_ratio)


def history(filed: Any) -> History:
    return _history(filed)


def histories(each: list[History]) -> Histories:
    return _histories(each)


def table(columns: Any) -> RockingTable:
    return _table(columns)


def simulation(of: Structure, springs: Springs, shaken: Record, restitution: float, friction: float) -> Simulation:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # they were given the first time
        return simulate(of, springs, shaken, restitution=restitution, friction=friction)


def tuned(
    of: Structure,
    shaken: Record | None,
    accuracy: float,
    method: Any,
    scale: float,
    duration: float | None,
    max_hz: float | None,
    max_settlement: float,
    friction: float,
    front: bool,
    vertical: Record | None,
    # not in pickles of earlier versions
    program: Any = None,
    step: float | None = None,
    integrator: str | None = None,
    substeps: int | None = None,
) -> Tuned:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return tune(
            of, shaken, accuracy, method, scale=scale, duration=duration, max_hz=max_hz, max_settlement=max_settlement,
            friction=friction, front=front, vertical=vertical, program=program, step=step, integrator=integrator,
            substeps=substeps,
        )  # fmt: skip


def tuned_histories(*inputs: Any) -> Simulation:
    return tuned(*inputs).histories


def validation(
    of: Structure,
    springs: Springs,
    records: list[Record],
    synthetic: int,
    earthquakes: int,
    seed: int,
    duration: float | None,
    restitution: float,
) -> Validation:
    return validate(
        of,
        springs,
        records,
        synthetic=synthetic,
        earthquakes=earthquakes,
        seed=seed,
        duration=duration,
        restitution=restitution,
    )
