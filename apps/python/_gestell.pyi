"""Types of the module on which gestell.py rests; what is not here is no public interface."""

from typing import Any, Iterator

import numpy as np

_Array = np.ndarray
_Sparse = Any  # scipy.sparse.csc_matrix

version: str


class InputError(ValueError): ...


class SceneError(InputError):
    file: str | None
    line: int | None
    key: str | None


class ComputationFailed(RuntimeError):
    result: Result | None


class Function:
    """A function of Python as the value of a scene key."""


class Peak:
    """Extremes of a signal with their times [s]."""

    @property
    def name(self) -> str:
        """Name of the signal."""

    @property
    def unit(self) -> str:
        """Unit of min, max and final, in SI."""

    @property
    def min(self) -> float:
        """Smallest value, in `unit`."""

    @property
    def t_min(self) -> float:
        """Time of the smallest value [s]."""

    @property
    def max(self) -> float:
        """Largest value, in `unit`."""

    @property
    def t_max(self) -> float:
        """Time of the largest value [s]."""

    @property
    def final(self) -> float:
        """Value at the end of the run, in `unit`."""


class Event:
    """Event (change of branch of a law): t [s], name of the element, kind."""

    @property
    def t(self) -> float:
        """Time of the event [s]."""

    @property
    def name(self) -> str:
        """Name of the element, joint or switch."""

    @property
    def kind(self) -> str:
        """Kind of the event, such as "contact" or "sticks"."""


class Finding:
    """Finding of a check."""

    @property
    def severity(self) -> str:
        """"warning" or "error"."""

    @property
    def id(self) -> str:
        """Kind of finding, "energy-balance"; empty: not of the run."""

    @property
    def place(self) -> str:
        """Element, joint, switch, signal or key; empty: the whole run."""

    @property
    def text(self) -> str:
        """Problem, location and remedy."""


class Result:
    """Results of a scene; arrays are views."""

    @property
    def t(self) -> _Array:
        """Times [s], a view."""

    @property
    def history(self) -> _Array:
        """All columns [rows x columns], a view."""

    @property
    def columns(self) -> list[str]:
        """Names of the columns of `history`: t, signals, energies."""

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column of `history`, a dict."""

    @property
    def peaks(self) -> dict[str, Peak]:
        """Extremes of each signal, a dict of Peak."""

    @property
    def events(self) -> list[Event]:
        """Events, in the order of time [s]."""

    @property
    def energy(self) -> dict[str, float]:
        """Input, stored, dissipated, residual, exchanged [J]."""

    @property
    def warnings(self) -> list[str]:
        """Warnings of scene, frame and run, each once."""

    @property
    def findings(self) -> list[Finding]:
        """The same warnings as a list of Finding, with severity, id and place."""

    @property
    def scene(self) -> str:
        """Name of the scene."""

    @property
    def coordinates(self) -> list[str]:
        """Names of the machine's coordinates, rows of `shapes` and columns of `states`."""

    @property
    def frequencies_hz(self) -> _Array:
        """Natural frequencies of the coupled machine [Hz]."""

    @property
    def damping_ratios(self) -> _Array:
        """Damping ratio of each mode [1]; nan without vibration."""

    @property
    def shapes(self) -> _Array:
        """Mode shapes in columns [coordinates x modes], mass normalised."""

    @property
    def frame_shapes(self) -> _Array:
        """Mode shapes of the frame alone in columns, mass normalised."""

    @property
    def picture_times(self) -> _Array:
        """Times of `states` [s]."""

    @property
    def states(self) -> _Array:
        """Coordinates at picture_times [times x coordinates], m or rad."""

    @property
    def sensitivities(self) -> dict[str, dict[str, float]] | None:
        """Derivatives of each output by each key, a dict of dicts in SI; None: not requested."""

    def save(self, folder: Any) -> list[str]:
        """Writes report.html, history.csv and all other files; returns their names."""

    def __getitem__(self, name: str) -> _Array: ...

    @property
    def summary(self) -> dict[str, Any]:
        """All that summary.json holds, as a dict; numbers in SI."""

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Draws signals over time [s] with matplotlib, by default all; returns the axes."""

    def __contains__(self, name: str) -> bool: ...


class Frame:
    """A reduced frame M q'' + B q' + C q = f, q = (interfaces, modes); its matrices are views."""

    @property
    def M(self) -> _Array:
        """Mass matrix [n x n], kg."""

    @property
    def B(self) -> _Array:
        """Damping matrix [n x n], N s/m."""

    @property
    def C(self) -> _Array:
        """Stiffness matrix [n x n], N/m."""

    @property
    def T(self) -> _Array:
        """Displacements of the points of the skin per coordinate [3 points x n], m: u = T q; single precision."""

    @property
    def points(self) -> _Array:
        """Points of the skin [points x 3], m."""

    @property
    def triangles(self) -> _Array:
        """Triangles of the skin [triangles x 3], numbers of points."""

    @property
    def coordinates(self) -> list[str]:
        """Names of rows: interfaces first, then modes."""

    @property
    def n_interface(self) -> int:
        """Number of interface DOFs, which come first."""

    @property
    def n_full(self) -> int:
        """Number of DOFs of the unreduced frame."""

    @property
    def mass(self) -> float:
        """Mass of the frame [kg]."""

    @property
    def notes(self) -> list[str]:
        """Warnings of the reduction."""

    @property
    def statements(self) -> list[str]:
        """Checks of the reduction that passed."""

    @property
    def frequencies_hz(self) -> _Array:
        """Natural frequencies of the frame alone, interface free [Hz]."""


class FullFrame:
    """An assembled frame M q'' + B q' + C q = f: sparse matrices, not reduced."""

    def csc(self, name: str) -> tuple[_Array, _Array, _Array, int]:
        """M [kg], B [N s/m] or C [N/m] by columns: (values, rows, begins of columns, n), views of the frame's memory."""

    @property
    def n(self) -> int:
        """Number of coordinates."""

    @property
    def nbytes(self) -> int:
        """Memory of M, B and C [byte]."""

    @property
    def interfaces(self) -> dict[str, dict[str, int]]:
        """Rows of each interface, from 0: {"crown": {"ux": 17, ...}}; fixed DOFs are omitted."""

    @property
    def translations(self) -> _Array:
        """q of unit translations of the whole frame [n x 3]."""

    @property
    def mass(self) -> float:
        """Mass of the frame [kg]."""

    @property
    def notes(self) -> list[str]:
        """Remarks about mesh and assembly."""

    @property
    def M(self) -> _Sparse:
        """Mass [kg] matrix as scipy.sparse.csc_matrix on the memory of the frame, not to be written to."""

    @property
    def B(self) -> _Sparse:
        """Damping [N s/m] matrix as scipy.sparse.csc_matrix on the memory of the frame, not to be written to."""

    @property
    def C(self) -> _Sparse:
        """Stiffness [N/m] matrix as scipy.sparse.csc_matrix on the memory of the frame, not to be written to."""


class StateSpace:
    """x' = A x + B u, y = C x + D u about an operating point; x = (r, r'), q = Z r, all in SI."""

    @property
    def A(self) -> _Array:
        """[states x states], SI."""

    @property
    def B(self) -> _Array:
        """[states x inputs], per N."""

    @property
    def C(self) -> _Array:
        """[outputs x states], SI."""

    @property
    def D(self) -> _Array:
        """[outputs x inputs], per N."""

    @property
    def Z(self) -> _Array:
        """[coordinates x states/2], q = Z r, m or rad."""

    @property
    def states(self) -> list[str]:
        """Names of the states x."""

    @property
    def coordinates(self) -> list[str]:
        """Names of the machine's coordinates, rows of Z."""

    @property
    def inputs(self) -> list[str]:
        """Names of the inputs with their units."""

    @property
    def outputs(self) -> list[str]:
        """Names of the outputs with their units."""

    @property
    def t(self) -> float:
        """Time of the operating point [s]."""

    def __iter__(self) -> Iterator[_Array]: ...
