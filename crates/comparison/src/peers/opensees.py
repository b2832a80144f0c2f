# The exported deck (argv 1), in even steps if argv 2 is "even", at other time steps: argv 3... are numbers of steps per
# sample. For each, one line on stdout:
# steps per sample, seconds of the analysis, name of the history written (none if the analysis stopped).
import importlib.util
import math
import os
import sys
import time

path = os.path.abspath(sys.argv[1])
spec = importlib.util.spec_from_file_location("deck", path)
deck = importlib.util.module_from_spec(spec)
spec.loader.exec_module(deck)  # exits with 3 when openseespy cannot be loaded
history = os.path.splitext(path)[0] + "_history.csv"


class EvenSteps(deck.Steps):
    """Steps all alike, as an engineer's own deck takes them: one that Newton's iteration gives up is
    split in 10, 100 or 1000."""

    SPLITS = (1, 10, 100, 1000)

    def advance(self, end):
        analyze, now = deck.ops.analyze, deck.ops.getTime
        while end - now() > 1e-9 * self.longest:
            step = (end - now()) / max(1, math.ceil((end - now()) / self.longest - 1e-6))
            after = now() + step
            for split in self.SPLITS:
                # splits that fail half way go on from there
                steps = max(1, round((after - now()) / step * split))
                if analyze(steps, (after - now()) / steps) == 0:
                    self.taken += steps
                    break
                self.refused += 1
            else:
                return False
        return True


if sys.argv[2] == "even":
    deck.Steps = EvenSteps
for steps in map(int, sys.argv[3:]):
    deck.STEPS_PER_SAMPLE = steps
    shown, sys.stdout = sys.stdout, open(os.devnull, "w")
    began = time.perf_counter()
    try:
        deck.main()
        seconds = time.perf_counter() - began
        stopped = False
    except SystemExit:
        seconds, stopped = time.perf_counter() - began, True
    finally:
        sys.stdout = shown
    if stopped:
        print(steps, seconds, flush=True)
        continue
    kept = f"{os.path.splitext(path)[0]}_{steps}.csv"
    os.replace(history, kept)
    print(steps, seconds, kept, flush=True)
