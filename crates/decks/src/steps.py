class Steps:
    """Steps of a transient analysis that follow feet touching and leaving the ground.

    They are as long as the accuracy asked allows, however stiff or soft the gap springs, and shorten by themselves towards
    every touch and lift. Needs `import math, sys`, `import openseespy.opensees as ops` and the integrator TRBDF2; nothing else
    of this file, so it can be pasted into a script of your own:

        steps = Steps(((foot, absorber), ...), landing=1.0 / omega_n, longest=record_dt / 2.0, rise=0.01 * b * alpha)
        for i in range(1, samples):
            if not steps.advance(i * record_dt):
                sys.exit(steps.report())
        print(steps.report())

    feet      pairs of nodes with a vertical gap between them, closed where the foot is not above the absorber
    landing   1/Omega_n of the gap springs, s: what a landing takes; 0: all steps alike
    longest   step, s; steps end where `advance` is told to, which should be every sample of the record
    rise      of a foot, m, from which on its motion counts: errors are relative to the highest rise so far, at least this
    accuracy  wanted of the history (its normalised error); that of the steps stays below a quarter of it
    aloft     to be set where a model changes in the air: called with True once no foot is on the ground, with False after

    taken     steps so far
    refused   pairs that Newton's iteration gave up: repeated shorter
    late      touches and lifts within a step too long for them: not 0, and the history is not to be trusted
    smallest  step, s
    """

    FIRST = 1e-6   # step, in units of the shortest: OpenSees starts without acceleration, whatever the first load
    GROWTH = 1.5   # from pair to pair, at most
    # What a pair misses of a foot's position, over the highest rise: a landing has up to a thousand pairs, whatever it takes.
    PAIR = 5e-6
    # The same over a time in which the foot rises or falls.
    RISE = 0.1
    # A foot that lifts drops a horizontal force at once; the step across it is wrong by that force for all its length.
    DROP = 0.02
    # What a pair may miss while all feet stand and none has risen yet, over `rise`: it dies away.
    STAND = 1e-4
    # What rounding leaves of a gap, over the farthest coordinate.
    ROUNDING = 2.0**-54

    def __init__(self, feet, landing, longest, rise, accuracy=0.002):
        fine = min(1.0, math.sqrt(accuracy / 0.002))   # steps err with their square
        self.feet, self.longest, self.landing, self.accuracy = feet, longest, landing, accuracy
        self.first = min(0.05 * fine * landing, longest) if landing > 0.0 else longest   # of a landing
        self.shortest = self.first
        self.share = 0.2 * fine               # of the time to the next touch or lift that one step takes
        self.allowed = self.FIRST * self.shortest
        self.strongest = 0.0                  # acceleration of an open foot on long steps, m/s2
        self.highest = rise                   # a foot has come, m
        self.blur = 1e-10 * rise              # of a gap, m: what Newton's iteration leaves of it
        # The same, m: three times what was seen on springs of 180 kHz. Over the step it gives the rate, over its square the
        # acceleration: on stiff springs both are nothing but rounding where steps are short, and tell of no lift.
        self.rounding = self.ROUNDING * max(abs(x) for node in ops.getNodeTags() for x in ops.nodeCoord(node))
        self.gaps = self.measure()
        self.taken = self.refused = self.late = 0
        self.last = self.shortest
        self.aloft, self.flies = None, False
        self.smallest = math.inf

    def measure(self):
        """Of every gap: opening, its rate and acceleration; the foot's own rate."""
        return [[of(foot, 2) - of(absorber, 2) for of in (ops.nodeDisp, ops.nodeVel, ops.nodeAccel)] + [ops.nodeVel(foot, 2)]
                for foot, absorber in self.feet]

    def size(self):
        """Length of the next two steps, s."""
        size = min(self.longest, self.allowed)
        if size <= self.shortest:
            return size
        for opening, rate, acceleration, _ in self.gaps:
            if opening > 0.0:
                # Soonest touch: at the strongest acceleration met so far.
                pull = max(self.strongest, abs(acceleration), 1e-30)
                soonest = 2.0 * opening / (math.sqrt(rate * rate + 2.0 * pull * opening) - rate)
            else:
                # Soonest lift: as the spring now relaxes, and at the rate alone, as far as they are more than rounding.
                rate -= self.rounding / self.last
                acceleration -= 4.0 * self.rounding / self.last**2
                soonest = -opening / rate if rate > 0.0 else math.inf
                root = rate * rate - 2.0 * acceleration * opening
                if root >= 0.0 and math.sqrt(root) + rate > 0.0:
                    soonest = min(soonest, -2.0 * opening / (math.sqrt(root) + rate))
            size = min(size, self.share * soonest)
        return max(size, self.shortest)

    def slow(self):
        """Time in which a foot rises as high as it has come, s."""
        return math.sqrt(self.highest / self.strongest) if self.strongest > 0.0 else math.inf

    def grown(self, states, h, size):
        """Length that the next steps may have by the error of these two of h, s."""
        # TRBDF2 misses h^3/3 of the third derivative, in the fast motions of the springs and the slow one of the body alike.
        missed = h / 3.0 * max(abs(a[3] - 2.0 * b[3] + c[3]) for a, b, c in zip(*states))
        stands = self.strongest == 0.0 and all(gap[0] <= 0.0 for gaps in states for gap in gaps)
        least = self.STAND if stands else self.PAIR
        may = self.accuracy * self.highest * max(least, self.RISE * 2.0 * h / self.slow())
        by_error = 0.9 * h * (may / max(missed, 1e-300)) ** (1.0 / 3.0)
        # Motions faster than a landing (a rotation of little inertia) are not resolved: steps of a landing end them.
        return max(min(self.GROWTH * size, max(by_error, 0.3 * size)), min(2.0 * size, self.first))

    def learn(self, before, h):
        """Acceleration of open feet, from two long steps of h."""
        if h < 0.2 * self.longest:
            return
        for (was, rate_was, _, _), (opening, rate, _, _) in zip(before, self.gaps):
            if was > 0.0 and opening > 0.0:
                self.strongest = max(self.strongest, abs(rate - rate_was) / (2.0 * h))
        if self.landing > 0.0:
            self.shortest = min(self.shortest, max(self.DROP * self.accuracy * self.slow(), 0.1 * self.first))

    def pair(self, h, size):
        """Two steps of h, at most `size`: TRBDF2 takes one by BDF2 only if it is as long as the one before, to the last digit."""
        states, met, far = [self.gaps], 0, 0
        for _ in range(2):
            before = [gap[0] for gap in self.gaps]
            if ops.analyze(1, h) != 0:
                # A foot lets go and lands again within the step: Newton's iteration cycles, OpenSees takes the step back.
                self.refused += 1
                self.allowed = self.shortest if h > self.shortest else 0.25 * h
                self.gaps = self.measure()
                return self.allowed > 1e-6 * self.shortest
            self.taken += 1
            self.gaps = self.measure()
            states.append(self.gaps)
            if self.aloft and self.flies != all(gap[0] > 0.0 for gap in self.gaps):
                self.flies = not self.flies
                self.aloft(self.flies)
            changed = [(was, gap[0]) for was, gap in zip(before, self.gaps) if (was <= 0.0) != (gap[0] <= 0.0)]
            met += len(changed)
            # A foot that rounding alone holds down lifts unseen.
            unseen = 8.0 * self.rounding / self.share
            far += sum(abs(now) > self.blur and not -unseen < was <= 0.0 for was, now in changed)
        self.last = h
        if h >= self.shortest or self.refused:  # the very first are tiny
            self.smallest = min(self.smallest, h)
        self.highest = max(self.highest, *(gap[0] for gap in self.gaps))
        if met:
            self.allowed = self.shortest
            if h > 1.5 * self.shortest:
                self.late += far
        else:
            self.allowed = self.grown(states, h, size)
            self.learn(states[0], h)
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
