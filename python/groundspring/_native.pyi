from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal, final, overload

import numpy as np
import numpy.typing as npt
import pandas
import polars as pl
from matplotlib.axes import Axes

_Array = npt.NDArray[np.float64]
_Numbers = Sequence[float] | npt.NDArray[np.floating[Any]] | npt.NDArray[np.integer[Any]]
_Response = tuple[Sequence[Sequence[float]], float, float]
_Path = str | PathLike[str]

__VERSION: str
"""Of the package."""

GRAVITY: float
"""9.81 m/s2, throughout."""

STEPS: str
"""Source of the stepping routine of decks for openseespy."""

class GroundspringWarning(UserWarning):
    """What is doubtful: in reading a record, in springs, in a comparison."""

@final
class Record:
    """A ground motion: acceleration at even time steps, linear in between. Equal ones have equal names and numbers.

    dt     time step, s
    accel  ground acceleration at t = i dt, positive to the right, in `units`: one row of real numbers
    name   what it is called
    units  of accel: "m/s2", "g" (9.81 m/s2), "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2" or "mGal"

    A time step of 0.05 s and more, and peaks that no earthquake has (above 5 g or 3 m/s, below
    1e-4 g), are a GroundspringWarning.

    ValueError: dt not between 1e-6 and 1 s, no sample, a sample that is not finite, a peak above 50 g; an array of two
    dimensions, masked, complex, or with units of its own.
    """

    def __new__(
        cls,
        dt: float,
        accel: _Numbers,
        name: str = "record",
        *,
        units: Literal["m/s2", "g", "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2", "mGal"] | str = "m/s2",
    ) -> Record: ...
    @property
    def name(self) -> str:
        """What it is called."""
    @property
    def dt(self) -> float:
        """Time step, s."""
    @property
    def accel(self) -> _Array:
        """Ground acceleration at t = i dt, positive to the right, m/s2."""
    @property
    def t(self) -> _Array:
        """Times of the samples, s."""
    @property
    def duration(self) -> float:
        """Time of the last sample, s."""
    @property
    def pga(self) -> float:
        """Peak ground acceleration, m/s2."""
    @property
    def pga_g(self) -> float:
        """Peak ground acceleration, g."""
    @property
    def vertical(self) -> Record | None:
        """The vertical ground acceleration that goes with it, positive upwards."""
    def with_vertical(self, up: Record | _Numbers) -> Record:
        """The record with a vertical ground acceleration at the same times, positive upwards: a Record, or a row of
        numbers, m/s2.
        """
    def scaled(self, factor: float) -> Record:
        """Every acceleration times a factor, the vertical ones too."""
    def truncated(self, duration: float) -> Record:
        """The samples up to this time, s; at least the first.

        ValueError: no time above zero.
        """
    def __len__(self) -> int: ...
    def plot(self, axes: Axes | None = None) -> Axes:
        """Ground acceleration, g, over time, s, with the vertical one if there is one."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Record: ...
    def __deepcopy__(self, _memo: Any, /) -> Record: ...
    def __reduce__(self) -> Any: ...

def read_record(
    path: _Path,
    component: str | float | None = None,
    dt: float | None = None,
    units: Literal["g", "m/s2", "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2", "mGal"] | str | None = None,
    baseline: bool = False,
    vertical: _Path | None = None,
    column: str | int | None = None,
) -> Record:
    """The record in a file: PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns.

    component  name or azimuth in degrees, of a file with several; the stronger horizontal one unless given
    dt, units  where the file does not say: s; "g", "m/s2" or another unit that `Record` takes
    baseline   subtract the mean of the samples
    column     of a table of several: its number, from 1 with the times, or its name
    vertical   the file of the vertical component, or "auto": that of the same file; none unless given

    ValueError: the file cannot be read, is no record, is damaged, or does not agree with what is said of it.
    """

def el_centro() -> Record:
    """Imperial Valley 1940, El Centro Array #9, component 180 (north-south), PEER: 3995 samples, dt 0.01 s."""

@final
class Structure:
    """A rigid body on two feet. Made by `aframe` or `block`.

    Numbers that no structure has (a mean density of air, a height of a kilometre) are a GroundspringWarning.

    ValueError: numbers that cannot rock.
    """

    @staticmethod
    def aframe(
        height: float, width: float, mass: float, inertia: float | None = None, restitution: float | None = None
    ) -> Structure:
        """All mass at the apex of two massless legs.

        height       of the centre of mass above the feet, m
        width        between the feet, m
        mass         kg
        inertia      about the centre of mass, kg m2; 1e-5 m R^2 unless given, which rocking does not feel
        restitution  velocity ratio of a landing; by equation 2 unless given
        """
    @staticmethod
    def block(
        height: float, width: float, mass: float, inertia: float | None = None, restitution: float | None = None
    ) -> Structure:
        """A solid block.

        height       of the whole block, m: twice that of its centre of mass
        width        m
        mass         kg
        inertia      about the centre of mass, kg m2; m R^2/3 unless given
        restitution  velocity ratio of a landing; by equation 2 unless given
        """
    @property
    def kind(self) -> Literal["aframe", "block"]:
        """"aframe" or "block"."""
    @property
    def height(self) -> float:
        """Of the centre of mass above the feet, m."""
    @property
    def width(self) -> float:
        """Between the feet, m."""
    @property
    def mass(self) -> float:
        """kg."""
    @property
    def inertia(self) -> float:
        """About the centre of mass, kg m2."""
    @property
    def alpha(self) -> float:
        """atan(b/h), the lean of balance, rad."""
    @property
    def p(self) -> float:
        """sqrt(m g R/I0), 1/s."""
    @property
    def restitution(self) -> float:
        """Velocity ratio of a landing, without unit."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Structure: ...
    def __deepcopy__(self, _memo: Any, /) -> Structure: ...
    def __reduce__(self) -> Any: ...

@final
class Chain:
    """One spring-absorber unit: foot - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground.

    k1, k2 in N/m, m2 in kg, c in N s/m.
    """

    def __new__(cls, k1: float, k2: float, m2: float, c: float) -> Chain: ...
    @property
    def k1(self) -> float:
        """Gap spring, N/m."""
    @property
    def k2(self) -> float:
        """Spring to the ground, N/m."""
    @property
    def m2(self) -> float:
        """Mass of the absorber, kg: fictitious, without weight."""
    @property
    def c(self) -> float:
        """Dashpot beside k2, N s/m."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Chain: ...
    def __deepcopy__(self, _memo: Any, /) -> Chain: ...
    def __reduce__(self) -> Any: ...

@final
class Springs:
    """The units under each of the two feet of a structure of this mass, kg."""

    def __new__(cls, mass: float, vertical: Chain, horizontal: Chain) -> Springs: ...
    @property
    def mass(self) -> float:
        """Of the structure, kg."""
    @property
    def vertical(self) -> Chain:
        """The vertical unit of each foot."""
    @property
    def horizontal(self) -> Chain:
        """The horizontal unit of each foot."""
    @property
    def omega_n_hz(self) -> float:
        """Omega_n/2 pi of the vertical k1 under the mass, Hz."""
    @property
    def settlement(self) -> float:
        """Of the standing body under its weight, m."""
    def stiffer(self, factor: float) -> Springs:
        """Springs `factor` times as stiff, which land as these do: k1 and k2 times it,
        c times its root, m2 as it is."""
    def plot(self, axes: Axes | None = None) -> Axes:
        """Amplitude response ratio of both units (equation 7), without unit, over frequency, Hz."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Springs: ...
    def __deepcopy__(self, _memo: Any, /) -> Springs: ...
    def __reduce__(self) -> Any: ...

def _units_for(
    mass: float,
    responses: tuple[_Response, _Response],
    parts: Sequence[tuple[Sequence[int], Sequence[float], float]],
    give: float,
    landing: float,
) -> tuple[float, float, list[Springs]]: ...
def read_parameters(path: _Path) -> tuple[Structure, Springs]:
    """The structure and the springs of a `parameters.json`."""

@final
class History:
    """A history of rigid rocking at the record's samples, cut where the body lies flat."""

    @property
    def dt(self) -> float:
        """Time step, s."""
    @property
    def t(self) -> _Array:
        """Times of the samples, s."""
    @property
    def theta(self) -> _Array:
        """Rotation, positive leaning to the right, rad."""
    @property
    def rate(self) -> _Array:
        """Rate of the rotation, rad/s."""
    @property
    def u(self) -> _Array:
        """Horizontal displacement of the centre of mass, positive to the right, m."""
    @property
    def v(self) -> _Array:
        """Vertical displacement of the centre of mass, positive up, m."""
    @property
    def impacts(self) -> _Array:
        """Times of the impacts, s."""
    @property
    def impact_rates(self) -> _Array:
        """Rates of the rotation before the impacts, rad/s."""
    @property
    def outcome(self) -> Literal["rocked", "never_lifted", "overturned", "leaves_ground", "work_bound", "not_finite"]:
        """How it ended."""
    @property
    def overturned(self) -> float | None:
        """When |theta| last grew past alpha, of a body that overturned, s."""
    @property
    def peak_ratio(self) -> float:
        """Largest |theta|/alpha, without unit; pi/2 / alpha if it overturned, as in every table."""
    def __len__(self) -> int: ...
    def to_pandas(self) -> pandas.DataFrame:
        """u and v, m, theta, rad, rate, rad/s, over time, s."""
    def plot(self, axes: Axes | None = None) -> Axes:
        """Rotation, mrad, over time, s, with the impacts."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> History: ...
    def __deepcopy__(self, _memo: Any, /) -> History: ...
    def __reduce__(self) -> Any: ...

@final
class Histories:
    """Many histories: a sequence of `History`."""

    def __len__(self) -> int: ...
    def __getitem__(self, index: int, /) -> History: ...
    @property
    def peak_ratio(self) -> _Array:
        """Largest |theta|/alpha of each, without unit; pi/2 / alpha where the body overturned."""
    @property
    def outcome(self) -> list[str]:
        """How each ended."""
    @property
    def overturned(self) -> npt.NDArray[np.bool_]:
        """Whether each overturned."""
    def to_pandas(self) -> pandas.DataFrame:
        """A row a history: outcome, largest |theta|/alpha, impacts, when it overturned, s, samples."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Histories: ...
    def __deepcopy__(self, _memo: Any, /) -> Histories: ...
    def __reduce__(self) -> Any: ...

def rigid_rocking(
    structure: Structure,
    record: Record,
    vertical: Record | None = None,
    scale: float = 1.0,
    restitution: float | None = None,
) -> History:
    """Housner's solution for a structure on a record.

    vertical  ground acceleration at the same times, positive upwards, if not that of the record; the history ends where
              the ground would have to pull (outcome "leaves_ground")

    ValueError: a vertical record of other times; a scale (none of zero) or restitution out of
    range.
    """

def rigid_rocking_many(
    structures: Structure | Sequence[Structure],
    record: Record,
    scales: float | _Numbers | None = None,
    restitution: float | None = None,
) -> Histories:
    """Housner's solutions on all cores: of several structures, or at several scales, or of as many pairs of both.

    scales  factors on the record, without unit; 1 unless given

    ValueError: structures and scales of different number, neither of which is one.
    """

@final
class RockingTable:
    """A table of histories, a row each: what `rocking` returns, where its columns are told."""

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
    def __len__(self) -> int: ...
    def __getitem__(self, name: str, /) -> Any: ...
    def __arrow_c_stream__(self, requested_schema: object | None = None) -> Any:
        """For whoever reads Arrow: `polars.DataFrame(table)`, `pyarrow.table(table)`. The numbers are not copied."""
    def to_pandas(self) -> pandas.DataFrame:
        """The table as it is, units as in `rocking`."""
    def to_polars(self) -> pl.DataFrame:
        """The same for polars, without a copy."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def _columns(self) -> list[tuple[str, Any]]:
        """Names and columns."""
    def __reduce__(self) -> Any: ...

def rocking(
    structures: Structure | Sequence[Structure],
    records: Record | Sequence[Record],
    scales: float | _Numbers | None = None,
    *,
    vertical: Record | Sequence[Record] | None = None,
    restitution: float | None = None,
    progress: Callable[[int], object] | None = None,
) -> RockingTable:
    """What `groundspring.rocking` calls; progress is told how many histories more are done."""

def _history(filed: Any) -> History: ...
def _histories(all: list[History]) -> Histories: ...
def _table(columns: Any) -> RockingTable: ...
def _design(alpha: float, mass_share: float, stiffness: float) -> Design: ...
def _unit_design(mu: float, f: float, xi: float, omega_n_hz: float) -> UnitDesign: ...

@final
class Simulation:
    """The finite element history on springs, beside Housner's on the same record.

    Forces are, at every sample, those of largest magnitude since the sample before. They are not checked: those of a
    landing are the springs', as large as these are stiff.
    """

    @property
    def dt(self) -> float:
        """Time step, s."""
    @property
    def t(self) -> _Array:
        """Times of the samples, s."""
    @property
    def theta(self) -> _Array:
        """Rotation, positive leaning to the right, rad."""
    @property
    def u(self) -> _Array:
        """Horizontal displacement of the centre of mass, positive to the right, m."""
    @property
    def v(self) -> _Array:
        """Vertical displacement of the centre of mass from the settled position, positive up, m."""
    @property
    def vertical_left(self) -> _Array:
        """The ground's force on the left foot, up, N."""
    @property
    def vertical_right(self) -> _Array:
        """The ground's force on the right foot, up, N."""
    @property
    def horizontal_left(self) -> _Array:
        """The ground's force on the left foot, to the right, N."""
    @property
    def horizontal_right(self) -> _Array:
        """The ground's force on the right foot, to the right, N."""
    @property
    def energy_input(self) -> _Array:
        """Work of the ground since the start, J."""
    @property
    def energy_stored(self) -> _Array:
        """Above the initial energy, J."""
    @property
    def energy_dissipated(self) -> _Array:
        """Taken by dashpots and released springs, J."""
    @property
    def energy_residual(self) -> _Array:
        """What the account leaves unexplained, J."""
    @property
    def impacts(self) -> _Array:
        """Times of the touch-downs that end a lean on the other foot, s."""
    @property
    def settlement(self) -> float:
        """Of the body standing under its weight, before t = 0, m."""
    @property
    def outcome(self) -> Literal["completed", "overturned", "stopped", "work_bound", "unstable"]:
        """How it ended."""
    @property
    def housner(self) -> History:
        """Housner's history of the same record."""
    @property
    def match(self) -> dict[str, Any]:
        """How the two compare, as in `parameters.json`: errors without unit, peaks and settlement in m, times in s."""
    @property
    def verdict(self) -> dict[str, Any]:
        """What the body does in both models, as in `parameters.json`: times in s, rotations over alpha."""
    @property
    def lines(self) -> list[str]:
        """What is to be said of the run."""
    @property
    def demands(self) -> dict[str, _Array]:
        """Base shear and forces in the legs, N; moments, N m; by name."""
    def to_pandas(self) -> pandas.DataFrame:
        """Both models' motions, m and rad, forces, N, moments, N m, and energies, J, over time, s."""
    def plot(self, axes: Axes | None = None) -> Axes:
        """Horizontal displacement, mm, of both models over time, s."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __copy__(self) -> Simulation: ...
    def __deepcopy__(self, _memo: Any, /) -> Simulation: ...
    def __reduce__(self) -> Any: ...

def simulate(
    structure: Structure,
    springs: Springs,
    record: Record,
    scale: float = 1.0,
    restitution: float | None = None,
    friction: float = 0.5,
    vertical: Record | None = None,
) -> Simulation:
    """Both models on given springs.

    friction  coefficient of the ground, without unit, for the warning of sliding
    vertical  ground acceleration at the same times, positive upwards, if not that of the record
    """

@final
class Tuned:
    """Springs of a rigid structure, and all that is found of them.

    The springs are for a body that lands as a whole. Under columns that give they are wrong: they throw the foot back,
    again and again, in a million steps. There `groundspring.opensees.springs_for` has those of what lands.
    """

    @property
    def structure(self) -> Structure:
        """What they are for."""
    @property
    def springs(self) -> Springs:
        """The springs."""
    @property
    def accuracy(self) -> dict[str, Any]:
        """What was asked for, whether it is reached, what was measured and on what, as in `parameters.json`: NRMSE."""
    @property
    def verdict(self) -> dict[str, Any]:
        """What the body does in both models, as in `parameters.json`: times in s, rotations over alpha."""
    @property
    def histories(self) -> Simulation:
        """Both histories on the record."""
    @property
    def parameters(self) -> dict[str, Any]:
        """All of `parameters.json` but the record; keys end in their units."""
    @property
    def program(self) -> dict[str, Any] | None:
        """Springs for a program with steps of one size, what it is to be set to, and what they err there, as in
        `parameters.json`; None where there are none."""
    @property
    def lines(self) -> list[str]:
        """What is to be said of the run."""
    def save(self, folder: _Path, figures: bool = True) -> list[str]:
        """Write springs, histories, figures (SVG), decks. Decks that a program cannot hold are left
        out: each is named, with the reason."""
    def to_pandas(self) -> pandas.DataFrame:
        """Those of its histories."""
    def plot(self, axes: Axes | None = None) -> Axes:
        """Horizontal displacement, mm, of both models over time, s."""
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __copy__(self) -> Tuned: ...
    def __deepcopy__(self, _memo: Any, /) -> Tuned: ...
    def __reduce__(self) -> Any: ...

def tune(
    structure: Structure,
    record: Record | None = None,
    accuracy: float = 0.002,
    method: Literal["landing", "arr"] = "landing",
    *,
    scale: float = 1.0,
    duration: float | None = None,
    max_hz: float | None = None,
    max_settlement: float = 0.01,
    friction: float = 0.5,
    front: bool = False,
    vertical: Record | None = None,
    program: Literal["sap2000", "etabs", "opensees-even"] | None = None,
    step: float | None = None,
    integrator: str | None = None,
    substeps: int | None = None,
) -> Tuned:
    """Tune the springs of a rigid structure; for columns that give see `groundspring.opensees.springs_for`.

    record          on which they are judged beside the motions made for the structure; all of El Centro unless given
    accuracy        error of the history against Housner's (NRMSE) that Omega_n is chosen for
    method          "landing": by the geometry; "arr": the paper's procedure, on the record
    scale           factor on the record
    duration        of the record, s; all of it unless given
    max_hz          stiffest springs, Omega_n/2 pi, Hz; not for programs with steps of one size
    max_settlement  of the standing body, m
    friction        coefficient of the ground, without unit, for the warning of sliding
    front           error against stiffness, too
    vertical        ground acceleration at the record's times, positive upwards, if not that of the record
    program         program with steps of one size that springs are wanted for besides: "sap2000", "etabs" or
                    "opensees-even"; SAP2000 unless given
    step            its time step, s; 0.001 unless given
    integrator      its integrator: "hht:ALPHA" (0 to -1/2), "newmark:GAMMA:BETA", "generalized-alpha:RHO", "trbdf2"
                    or "backward-euler"; alone, any program that has it
    substeps        a step that fails is halved, down to one in so many, a power of two; 16 unless given

    ValueError: no springs settle as little as asked for; a number out of its range; an integrator that the program
    does not have.
    """

@final
class UnitDesign:
    """One spring-absorber unit without units."""

    @property
    def mu(self) -> float:
        """m2/m1, without unit."""
    @property
    def f(self) -> float:
        """Frequency of the absorber on k2 over Omega_n, without unit."""
    @property
    def xi(self) -> float:
        """c/(2 m2 Omega_n), without unit."""
    @property
    def k(self) -> float:
        """K = k2/k1 = mu f^2, without unit."""
    @property
    def c(self) -> float:
        """C = c/(m1 Omega_n) = 2 mu xi, without unit."""
    @property
    def frequency_ratio(self) -> float:
        """Omega_n of the unit over that of the vertical one, without unit."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> UnitDesign: ...
    def __deepcopy__(self, _memo: Any, /) -> UnitDesign: ...
    def __reduce__(self) -> Any: ...

@final
class Design:
    """The springs of every body of this alpha and inertia, at this Omega_n/p."""

    @property
    def alpha(self) -> float:
        """atan(b/h), rad."""
    @property
    def inertia(self) -> float:
        """I_cg/(m R^2), without unit."""
    @property
    def stiffness(self) -> float:
        """Omega_n/p, without unit."""
    @property
    def in_stiff_limit(self) -> bool:
        """Whether gravity has no part in a landing to speak of."""
    @property
    def vertical(self) -> UnitDesign:
        """The vertical unit of each foot."""
    @property
    def horizontal(self) -> UnitDesign:
        """The horizontal unit of each foot."""
    def springs(self, mass: float, radius: float) -> Springs:
        """With units, for a mass, kg, and the distance R from a foot to the centre of mass, m."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Design: ...
    def __deepcopy__(self, _memo: Any, /) -> Design: ...
    def __reduce__(self) -> Any: ...

@overload
def design(alpha: Structure, *, stiffness: float | None = None) -> Design: ...
@overload
def design(alpha: float, inertia: float | None = None, stiffness: float | None = None) -> Design:
    """The design from the geometry, without units: alpha in rad, inertia I_cg/(m R^2), 0 unless given,
    stiffness Omega_n/p.

    Omega_n/p is, unless given, where `tune` begins to look for an accuracy of 0.002.
    """

def frequency_response(g: _Numbers, mu: float, f: float, xi: float) -> _Array:
    """Amplitude response ratio (equation 7) of a unit at frequency ratios g = omega/Omega_n."""

def fit_response(mu: float) -> dict[str, Any]:
    """f and xi of a mass ratio by the paper's frequency response, and the certificate."""

@final
class Validation:
    """What many records say of springs: a row a record."""

    @property
    def summary(self) -> dict[str, Any]:
        """All of `validate.json`: statistics of all records and of each suite, the rows."""
    def to_pandas(self) -> pandas.DataFrame:
        """A row a record; names end in their units."""
    def __len__(self) -> int: ...
    def _repr_html_(self) -> str:
        """For notebooks."""
    def __copy__(self) -> Validation: ...
    def __deepcopy__(self, _memo: Any, /) -> Validation: ...
    def __reduce__(self) -> Any: ...

def validate(
    structure: Structure,
    springs: Springs,
    records: Sequence[Record] | _Path | None = None,
    *,
    synthetic: int = 0,
    earthquakes: int = 0,
    seed: int = 1,
    duration: float | None = None,
    restitution: float | None = None,
) -> Validation:
    """Judge springs over many records.

    records      of your own, or a folder of files
    synthetic    so many motions made for the structure
    earthquakes  so many motions like earthquakes
    seed         of both
    duration     of each, s; all of it unless given

    Horizontal motion alone: a record with a vertical component is refused.
    """

def synthetic_records(structure: Structure, n: int, seed: int = 1) -> list[Record]:
    """Motions made for a structure: Ricker and Mavroeidis-Papageorgiou pulses, filtered noise. ^C ends it."""

def earthquake_records(structure: Structure, n: int, seed: int = 1) -> list[Record]:
    """Motions with the frequencies of earthquakes: filtered noise of soils of 9 to 36 rad/s, 0.2 to 0.9 g. ^C ends it.

    The structure decides how long they are silent at the end.
    """
