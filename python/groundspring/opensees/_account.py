"""Energies of a model with feet, summed over the steps.

    input = kinetic + structure + feet + residual

The input is the work of the ground and of the weight, relative to the ground; the structure's is the work done on its
elements: elastic, plastic and of Rayleigh damping; the feet's is the work done on them. What the steps lose is the
residual.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._native import GRAVITY, Record
from ._feet import Array, Feet


@dataclass
class Account:
    """Energies at the samples, J, from zero at the start: `kinetic` of the nodal masses but the absorbers'."""

    input: Array
    kinetic: Array
    structure: Array
    feet: Array

    @property
    def residual(self) -> Array:
        """What does not add up: lost by the steps if positive."""
        left: Array = self.input - self.kinetic - self.structure - self.feet
        return left


class Books:
    """Keeps the account. Masses of elements, mass-proportional damping and loads but the weight are not in it."""

    def __init__(self, ops: Any, groups: list[Feet], record: Record, start: float, weight: bool) -> None:
        self.ops, self.record, self.start, self.weight = ops, record, start, weight
        up = record.vertical
        self.accel = (record.accel, np.zeros(len(record)) if up is None else up.accel)
        own = {node for group in groups for node in (*group.absorbers, *group.grounds)}
        masses = [
            (node, dof, ops.nodeMass(node, dof)) for node in ops.getNodeTags() if node not in own for dof in (1, 2, 3)
        ]
        self.masses = [entry for entry in masses if entry[2] > 0.0]
        feet = {element for group in groups for element in (*group.units, *group.bearings)}
        self.elements = [(element, ops.eleNodes(element)) for element in ops.getEleTags() if element not in feet]
        self.sums = np.zeros(2)  # input, structure
        self.rows: list[tuple[float, float, float]] = []
        self.before = self._now()
        self.kinetic = self._kinetic()

    def _now(self) -> tuple[Array, Array, list[Array], list[Array]]:
        ops = self.ops
        since = ops.getTime() - self.start
        ground = np.array([np.interp(since, self.record.t, accel, right=0.0) for accel in self.accel])
        places = np.array([ops.nodeDisp(node, dof) for node, dof, _ in self.masses])
        forces = [np.array(ops.eleDynamicalForce(element)) for element, _ in self.elements]
        ends = [np.array([x for node in nodes for x in ops.nodeDisp(node)]) for _, nodes in self.elements]
        return ground, places, forces, ends

    def _kinetic(self) -> float:
        return 0.5 * sum(float(mass * self.ops.nodeVel(node, dof) ** 2) for node, dof, mass in self.masses)

    def step(self) -> None:
        now = self._now()
        ground = 0.5 * (self.before[0] + now[0])
        for (_, dof, mass), moved in zip(self.masses, now[1] - self.before[1], strict=True):
            force = -mass * (ground[dof - 1] + (GRAVITY if dof == 2 and self.weight else 0.0)) if dof < 3 else 0.0
            self.sums[0] += force * moved
        for old, new, start, end in zip(self.before[2], now[2], self.before[3], now[3], strict=True):
            self.sums[1] += 0.5 * (old + new) @ (end - start)
        self.before = now

    def sample(self) -> None:
        self.rows.append((self.sums[0], self._kinetic() - self.kinetic, self.sums[1]))

    def account(self, feet: Array) -> Account:
        received, kinetic, structure = np.array(self.rows).T
        return Account(received, kinetic, structure, feet)
