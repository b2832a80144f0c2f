"""Ground springs that let a finite element program follow Housner's theory of rocking.

    import groundspring as gs

    frame = gs.Structure.aframe(height=61.0, width=12.2, mass=680.1e3)
    tuned = gs.tune(frame, gs.el_centro().truncated(20.0))
    print(tuned)                # springs, accuracy, what the body does in both models
    tuned.plot()
    tuned.save("out")           # what `tune run` writes, decks for OpenSees and SAP2000 among it

`groundspring.opensees` puts the springs under a model of your own in openseespy.

SI units throughout: m, kg, s, N; angles in radians. theta > 0 leans to the right, u > 0 is to the right, v > 0 up.
Errors are ValueError, warnings are GroundspringWarning, in words of Python. Arrays of results cannot be written to.
"""

from ._many import rocking
from ._native import __VERSION as _version
from ._native import (
    GRAVITY,
    Chain,
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
    design,
    earthquake_records,
    el_centro,
    fit_response,
    frequency_response,
    read_parameters,
    read_record,
    rigid_rocking,
    rigid_rocking_many,
    simulate,
    synthetic_records,
    tune,
    validate,
)

__version__: str = _version
"""Of the package, which is that of the program."""

__all__ = [
    "__version__",
    "GRAVITY",
    "Chain",
    "Design",
    "GroundspringWarning",
    "Histories",
    "History",
    "Record",
    "RockingTable",
    "Simulation",
    "Springs",
    "Structure",
    "Tuned",
    "UnitDesign",
    "Validation",
    "design",
    "earthquake_records",
    "el_centro",
    "fit_response",
    "frequency_response",
    "read_parameters",
    "read_record",
    "rigid_rocking",
    "rigid_rocking_many",
    "rocking",
    "simulate",
    "synthetic_records",
    "tune",
    "validate",
]
