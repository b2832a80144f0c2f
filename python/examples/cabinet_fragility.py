"""(d) Fragility of a free-standing cabinet: overturning against PGA, on motions like earthquakes, with pandas.

    python cabinet_fragility.py [FOLDER]
"""

import sys
from pathlib import Path

import numpy as np
import pandas
from matplotlib import pyplot

import groundspring as gs


def table(cabinet: gs.Structure, motions: int, pgas: list[float]) -> pandas.DataFrame:
    """A row a motion and PGA: peak |theta|/alpha, pi/2 / alpha where the cabinet overturned."""
    parts = []
    for record in gs.earthquake_records(cabinet, motions, seed=7):
        scales = np.array(pgas) / record.pga_g
        histories = gs.rigid_rocking_many(cabinet, record, scales)
        parts.append(pandas.DataFrame({"motion": record.name, "pga_g": pgas, "peak": histories.peak_ratio}))
    return pandas.concat(parts, ignore_index=True)


def main(folder: Path) -> None:
    cabinet = gs.Structure.block(height=2.0, width=0.5, mass=300.0)
    rows = table(cabinet, motions=200, pgas=[round(0.1 * i, 1) for i in range(1, 21)])
    limits = {
        "uplift": 0.0,
        "|theta| beyond half of alpha": 0.5,
        "overturning": np.nextafter(0.5 * np.pi / cabinet.alpha, 0.0),
    }
    fragility = pandas.DataFrame(
        {name: (rows["peak"] > limit).groupby(rows["pga_g"]).mean() for name, limit in limits.items()}
    )  # fmt: skip
    print(fragility.to_string(float_format=lambda x: f"{x:.3f}"))
    assert (fragility.diff().dropna().mean() >= 0.0).all() and fragility["overturning"].iloc[0] == 0.0
    # a block does not lift below g tan(alpha)
    assert fragility["uplift"][[pga for pga in fragility.index if pga < np.tan(cabinet.alpha)]].max() == 0.0

    figure, axes = pyplot.subplots(figsize=(7.0, 4.0), layout="constrained")
    fragility.plot(ax=axes, marker=".")
    axes.set_xlabel("PGA [g]")
    axes.set_ylabel("share of 200 motions")
    axes.grid(alpha=0.3)
    figure.savefig(folder / "cabinet_fragility.png", dpi=150)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
