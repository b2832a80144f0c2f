"""What several tests share."""

import importlib.util
import math
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import groundspring as gs


@pytest.fixture
def ops() -> Iterator[Any]:
    import openseespy.opensees as ops

    ops.wipe()
    yield ops
    ops.wipe()


def load(path: Path) -> ModuleType:
    """A Python file as a module, not run as a program."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


CASES = {
    "61 m frame": (gs.Structure.aframe(61.0, 12.2, 680.1e3), 1.0, 0.002),
    "12 m pier": (gs.Structure.aframe(12.0, 2.4, 350e3), 1.0, 0.002),
    # at scale 1 no block of 2 m from 0.25 to 0.6 m width is well conditioned over 20 s; two programs differ by 0.0001
    # (0.36 m), 0.0005 (0.46 m), 0.0007 (0.48 m), 0.0010 (0.44 m), 0.0013 (0.4 m, whose history 0.1 % of restitution
    # moves by 0.1)
    "2 m block": (gs.Structure.block(2.0, 0.46, 1000.0), 1.0, 0.002),
    "2 m block, 0.7 m wide": (gs.Structure.block(2.0, 0.7, 1000.0), 1.5, 0.002),
}
"""Structure, scale of El Centro, accuracy asked for."""


LEG = 4.0
"""Stiffness of the decks' legs over the stiffest k1."""


def rigid_body(ops: Any, structure: gs.Structure, springs: gs.Springs) -> float:
    """The body of the decks: legs that stand for a rigid body, from node 3 to the feet 1 and 2; what they give, m/N."""
    leg = LEG * max(springs.vertical.k1, springs.horizontal.k1)
    b, h = structure.width / 2.0, structure.height
    length = math.sqrt(b * b + h * h)
    # the products in the deck's order: both are equal to the last bit
    ea, ei = leg * length, leg * (length * (length * length)) / 3.0
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(3, 0.0, h)
    ops.mass(3, structure.mass, structure.mass, structure.inertia)
    ops.geomTransf("Corotational", 1)
    for foot, x in ((1, -b), (2, b)):
        ops.node(foot, x, 0.0)
        ops.element("elasticBeamColumn", foot, foot, 3, ea, 1.0, ei, 1)
    return 1.0 / leg
