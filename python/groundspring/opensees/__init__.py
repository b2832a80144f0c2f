"""Feet that land as Housner's body does, under a model of your own in openseespy.

    import openseespy.opensees as ops
    import groundspring as gs
    from groundspring.opensees import Stepper, add_feet

    ...                                         # your nodes, masses, elements: ndm 2, ndf 3; nodes 1 and 2 stand on the ground
    springs = gs.tune(gs.Structure.aframe(height, width, mass)).springs
    feet = add_feet(ops, [1, 2], springs)
    stepper = Stepper(ops, feet)
    stepper.gravity()
    history = stepper.run(gs.el_centro())

Nothing of the model is changed but what is added; tags do not collide with yours. The stepping is that of the decks which
`tune run` writes, from the same source.
"""

from ._account import Account
from ._feet import Feet, add_feet
from ._history import FeetHistory
from ._stepper import StepError, Stepper

__all__ = ["Account", "Feet", "FeetHistory", "StepError", "Stepper", "add_feet"]
