class Steps:
    """Steps of a transient analysis that follow feet touching and leaving the ground.

    They are as long as the accuracy asked allows, however stiff the gap springs, and shorten by themselves towards every
    touch and lift. Needs `import math, sys`, `import openseespy.opensees as ops` and the integrator TRBDF2; nothing else of
    this file, so it can be pasted into a script of your own:

        steps = Steps(((foot, absorber), ...), landing=1.0 / omega_n, longest=record_dt / 2.0)
        for i in range(1, samples):
            if not steps.advance(i * record_dt):
                sys.exit(steps.report())
        print(steps.report())

    feet      pairs of nodes with a vertical gap between them, closed where the foot is not above the absorber
    landing   1/Omega_n of the gap springs, s: what a landing takes; 0: all steps alike
    longest   step, s; steps end where `advance` is told to, which should be every sample of the record
    accuracy  wanted of the history (its normalised error); that of the steps stays below a quarter of it

    taken     steps so far
    refused   pairs that Newton's iteration gave up: repeated shorter
    late      touches and lifts within a step too long for them: not 0, and the history is not to be trusted
    smallest  step, s
    """

    FIRST = 1e-6  # step, in units of the shortest: OpenSees starts without acceleration, whatever the first load

    def __init__(self, feet, landing, longest, accuracy=0.002):
        fine = min(1.0, math.sqrt(accuracy / 0.002))   # steps err with their square
        self.feet, self.longest, self.landing = feet, longest, landing
        self.shortest = min(0.1 * fine * landing, longest) if landing > 0.0 else longest
        self.growth = 1.0 + 0.2 * fine        # from pair to pair, while a landing's vibrations last; 1.5 after them
        self.share = 0.2 * fine               # of the time to the next touch or lift that one step takes
        self.error = accuracy / 40.0          # of a step in position, relative to how far the foot travels
        self.allowed = self.FIRST * self.shortest
        self.strongest = 0.0                  # acceleration of an open foot on long steps, m/s2
        self.highest = 0.0                    # a foot has come, m
        self.gaps = self.measure()
        self.taken = self.refused = self.late = 0
        self.smallest = math.inf

    def measure(self):
        """Of every gap: opening, its rate and acceleration."""
        return [[of(foot, 2) - of(absorber, 2) for of in (ops.nodeDisp, ops.nodeVel, ops.nodeAccel)]
                for foot, absorber in self.feet]

    def size(self):
        """Length of the next two steps, s."""
        size = min(self.longest, self.allowed)
        if size <= self.shortest:
            return size
        for opening, rate, acceleration in self.gaps:
            if opening > 0.0:
                # Soonest touch: at the strongest acceleration met so far.
                pull = max(self.strongest, abs(acceleration), 1e-30)
                soonest = 2.0 * opening / (math.sqrt(rate * rate + 2.0 * pull * opening) - rate)
                # A step errs by h^2/12 of the acceleration's change; little must it be beside the height the foot can rise to.
                height = max(opening + 0.5 * rate * rate / pull, 0.01 * self.highest)
                size = min(size, math.sqrt(12.0 * self.error * height / pull))
            else:
                # Soonest lift: as the spring now relaxes, and at the rate alone.
                soonest = -opening / rate if rate > 0.0 else math.inf
                root = rate * rate - 2.0 * acceleration * opening
                if root >= 0.0 and math.sqrt(root) + rate > 0.0:
                    soonest = min(soonest, -2.0 * opening / (math.sqrt(root) + rate))
            size = min(size, self.share * soonest)
        return max(size, self.shortest)

    def learn(self, before, h):
        """Acceleration and height of open feet, from two long steps of h."""
        if h < 0.2 * self.longest:
            return
        for (was, rate_was, _), (opening, rate, _) in zip(before, self.gaps):
            if was > 0.0 and opening > 0.0:
                self.strongest = max(self.strongest, abs(rate - rate_was) / (2.0 * h))
                if self.strongest > 0.0:
                    self.highest = max(self.highest, opening + 0.5 * rate * rate / self.strongest)

    def pair(self, h, size):
        """Two steps of h, at most `size`: TRBDF2 takes one by BDF2 only if it is as long as the one before, to the last digit."""
        before, met = self.gaps, 0
        for _ in range(2):
            closed = [gap[0] <= 0.0 for gap in self.gaps]
            if ops.analyze(1, h) != 0:
                # A foot lets go and lands again within the step: Newton's iteration cycles, OpenSees takes the step back.
                self.refused += 1
                self.allowed = self.shortest if h > self.shortest else 0.25 * h
                self.gaps = self.measure()
                return self.allowed > 1e-6 * self.shortest
            self.taken += 1
            self.gaps = self.measure()
            met += sum(was != (gap[0] <= 0.0) for was, gap in zip(closed, self.gaps))
        if h >= self.shortest or self.refused:  # the very first are tiny
            self.smallest = min(self.smallest, h)
        if met:
            self.allowed = self.shortest
            if h > 1.5 * self.shortest:
                self.late += met
        else:
            self.allowed = (self.growth if size < self.landing else 1.5) * size
            self.learn(before, h)
        return True

    def advance(self, end):
        """To time `end`, s. False if Newton's iteration gives up however short the step."""
        while end - ops.getTime() > 1e-9 * self.longest:
            left = end - ops.getTime()
            size = self.size()
            pairs = max(1, math.ceil(left / (2.0 * size) - 1e-6))
            if not self.pair(left / (2.0 * pairs), size):
                return False
        return True

    def report(self):
        text = f"{self.taken} steps, the shortest {self.smallest:.1e} s, {self.refused} pairs repeated shorter"
        if self.late:
            text += f"; WARNING: {self.late} touches or lifts within too long a step, ask for more accuracy"
        return text
