"""Many histories, one table."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from typing import TYPE_CHECKING

from ._native import Record, RockingTable, Structure
from ._native import rocking as _rocking

if TYPE_CHECKING:
    from ._native import _Numbers


def rocking(
    structures: Structure | Sequence[Structure],
    records: Record | Sequence[Record],
    scales: float | _Numbers = 1.0,
    *,
    vertical: Record | Sequence[Record] | None = None,
    restitution: float | None = None,
    progress: bool | Callable[[int], object] = False,
) -> RockingTable:
    """Housner's solution for every structure at every scale of every record,
    on all cores: a table with a row a history.

    structures   one or several
    records      one or several, at whatever time steps; a record with a vertical component is rocked with it
    scales       factors on the records, without unit: one or several
    vertical     vertical ground accelerations, if not those of the records: one for all, or one a record
    restitution  velocity ratio of a landing, without unit, if not that of each structure
    progress     True: a bar of tqdm; or a function that is told how many histories more are done

    The rows run over the scales first, then the structures, then the records. Columns:

        structure         its place among the structures, from 0
        record            name of the record
        record_index      its place among the records, from 0
        scale             factor on the record, without unit
        outcome           "rocked", "never_lifted", "overturned", "leaves_ground", "work_bound" or "not_finite"
        peak_ratio        largest |theta|/alpha, without unit; pi/2 / alpha where it overturned
        peak_theta        largest |theta| at a sample, rad
        peak_rate         largest |theta'| at a sample, rad/s
        peak_u            largest horizontal displacement of the centre of mass, m
        peak_time         of the largest |theta|, s
        uplift_time       of the first uplift, s; NaN if there is none
        impacts           how many
        last_impact_time  s; NaN if there is none
        overturned_time   when |theta| last grew past alpha, s; NaN if it did not overturn

    `.to_pandas()`, `.to_polars()`, or whatever reads Arrow: `polars.DataFrame(table)`,
    `pyarrow.table(table)`. ^C ends it.

    ValueError: none of one of them; a scale that is not finite; vertical records of other times or another number.
    """
    with ExitStack() as stack:
        tell = progress if callable(progress) else None
        if progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError as error:
                raise ImportError("progress needs tqdm: pip install tqdm") from error
            count = _count(structures, Structure) * _count(records, Record) * _count(scales, float)
            tell = stack.enter_context(tqdm(total=count, unit=" histories")).update
        return _rocking(structures, records, scales, vertical=vertical, restitution=restitution, progress=tell)


def _count(of: object, one: type) -> int:
    return 1 if isinstance(of, (one, int)) or not hasattr(of, "__len__") else len(of)
