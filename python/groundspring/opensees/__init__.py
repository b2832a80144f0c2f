"""Feet that land as Housner's body does, under a model of your own in openseespy.

    import openseespy.opensees as ops
    import groundspring as gs
    from groundspring.opensees import Stepper, add_feet, springs_for

    ...                                 # your nodes, masses, elements: ndm 2, ndf 3; nodes 1 and 2 stand on the ground
    springs = springs_for(ops, [1, 2])  # for what lands there, by the model's own mass and stiffness
    feet = add_feet(ops, [1, 2], springs)
    stepper = Stepper(ops, feet)
    stepper.gravity()
    history = stepper.run(gs.el_centro())

Springs of `gs.tune` are for rigid bodies: under columns that give they throw the foot back, again and again,
in a million steps.

Nothing of the model is changed but what is added; tags do not collide with yours. The stepping is that of the decks
which `tune run` writes, from the same source.
"""

from ._account import Account
from ._converged import Convergence
from ._feet import Feet, add_feet
from ._history import FeetHistory
from ._springs_for import FeetSprings, UntiedFeetWarning, springs_for
from ._staging import StepError
from ._stepper import Stepper

__all__ = [
    "Account",
    "Convergence",
    "Feet",
    "FeetHistory",
    "FeetSprings",
    "StepError",
    "Stepper",
    "UntiedFeetWarning",
    "add_feet",
    "springs_for",
]
