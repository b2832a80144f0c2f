class Steps:
    """Steps of one size, as a plain script takes them; a step that Newton's iteration gives up is halved.

    With TOUCHES above 1 a step within which a gap is about to open or close, told from the gap and
    its rate before it, is taken in so many parts, and so is the step after one in which a contact
    changed: OpenSees keeps what has converged, so that a step can be divided before it is taken,
    not after. Always give `analyze` the same number, to the last digit: TRBDF2 and BackwardEuler
    begin anew with every other one.

    feet      pairs of nodes with a vertical gap between them, closed where the foot is not above the absorber
    taken     steps so far
    refused   steps that Newton's iteration gave up
    smallest  step, s
    """

    def __init__(self, feet, landing, longest, rise, accuracy=0.002):
        self.feet = feet
        self.size = STEP
        self.allowed = self.smallest = self.size
        self.taken = self.refused = self.late = 0
        self.closed = None

    def touches(self):
        """Whether a contact changes in the step to come, or did in the last one."""
        gaps = [[of(foot, 2) - of(absorber, 2) for of in (ops.nodeDisp, ops.nodeVel)] for foot, absorber in self.feet]
        closed = [opening <= 0.0 for opening, _ in gaps]
        near = self.closed not in (None, closed)
        self.closed = closed
        return near or any((opening <= 0.0) != (opening + rate * self.size <= 0.0) for opening, rate in gaps)

    def step(self, h, least):
        """One step of h, or two halves of it."""
        if ops.analyze(1, h) == 0:
            self.taken += 1
            self.smallest = min(self.smallest, h)
            return True
        self.refused, self.allowed = self.refused + 1, h
        return h > 1.5 * least and self.step(0.5 * h, least) and self.step(0.5 * h, least)

    def advance(self, _):
        """One step, wherever the next sample is. False if Newton's iteration gives up in the shortest part of it."""
        parts = TOUCHES if TOUCHES > 1 and self.touches() else 1
        return all(self.step(self.size / parts, self.size / parts / SUBSTEPS) for _ in range(parts))

    def report(self):
        return f"{self.taken} steps, the shortest {self.smallest:.1e} s, {self.refused} halved"
