"""(a) The paper's 61 m A-frame on El Centro 1940: springs, verdict, figure, decks.

    python paper_frame.py [FOLDER]
"""

import sys
from pathlib import Path

from matplotlib import pyplot

import groundspring as gs


def main(folder: Path) -> None:
    frame = gs.Structure.aframe(height=61.0, width=12.2, mass=680.1e3)
    tuned = gs.tune(frame, gs.el_centro().truncated(20.0))
    print(tuned)
    print(tuned.springs)
    tuned.save(folder / "paper_frame")  # parameters.json, histories, figures, decks for OpenSees and SAP2000
    tuned.plot()
    pyplot.savefig(folder / "paper_frame.png", dpi=150)
    assert tuned.accuracy["reached"]


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
