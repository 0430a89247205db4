"""Vibrations of a machine and of the frame that carries it.

    import gestell

    scene = gestell.load("press_minimal.toml")
    scene["parameters.c_P"] = "950 kN/mm"
    result = scene.run()
    print(result.peaks["F_P"].max, result.warnings)
    force = result["F_P"]                 # NumPy array over result.t

Numbers are SI, text carries its unit, as in scene files.  Wrong input raises InputError (a ValueError), a computation
that fails ComputationFailed (a RuntimeError, with what was computed in its `result`), Ctrl-C KeyboardInterrupt, likewise.
"""

import collections
import concurrent.futures
import itertools
import json
import pathlib

import _gestell
from _gestell import ComputationFailed, Event, Frame, InputError, Peak, Result, StateSpace

__version__ = _gestell.version
__all__ = ["ComputationFailed", "Event", "Frame", "InputError", "Peak", "Result", "Scene", "StateSpace", "example", "load", "loads"]


def load(path) -> "Scene":
    """The scene of a TOML file."""
    return Scene._of(_gestell.Scene.of_file(str(path)))


def loads(text: str, folder=".") -> "Scene":
    """The scene of a TOML text; relative paths in it start at `folder`."""
    return Scene._of(_gestell.Scene.of_text(text, str(folder)))


def example(name: str) -> "Scene":
    """A scene that Gestell ships, "press_minimal"."""
    here = pathlib.Path(__file__).resolve()
    folders = [here.parents[1] / "scenes"]  # of the sources
    if len(here.parents) > 3:
        folders.append(here.parents[3] / "share" / "gestell" / "scenes")  # of the prefix
    for folder in folders:
        if (folder / f"{name}.toml").exists():
            return load(folder / f"{name}.toml")
    names = sorted(path.stem for folder in folders for path in folder.glob("*.toml"))
    raise InputError(f"example: there is no scene '{name}'; valid: {', '.join(names)}")


class Scene:
    """A scene as data: entries are read and set by their path, then computed.

    Scene({"body": {...}, ...}) builds one from a dict, whose relative paths start at `folder`.
    """

    def __init__(self, values: dict, folder="."):
        self._core = _gestell.Scene.of_values(values, str(folder))

    @classmethod
    def _of(cls, core) -> "Scene":
        scene = cls.__new__(cls)
        scene._core = core
        return scene

    def __getitem__(self, key: str):
        return self._core.get(key)

    def __setitem__(self, key: str, value):
        self._core.set(key, value)

    def __contains__(self, key: str) -> bool:
        try:
            self._core.get(key)
        except KeyError:
            return False
        return True

    def set(self, key: str, value) -> "Scene":
        """Sets an entry, "parameters.c_P"; returns the scene, so that calls chain."""
        self._core.set(key, value)
        return self

    def copy(self) -> "Scene":
        return Scene._of(self._core.copy())

    def to_dict(self) -> dict:
        """All entries as they stand, with what the scene extends."""
        return self._core.values()

    @property
    def name(self) -> str:
        return self._core.name()

    @property
    def signals(self) -> list:
        """Names of the signals that a run tells."""
        return self._core.signals()

    def check(self) -> list:
        """Validates without computing; returns warnings."""
        return self._core.check()

    def run(self, peaks=None, sensitivities="") -> Result:
        """Simulates the scene in time.

        peaks: names of signals of which extremes alone are wanted, without history, pictures and energy, as in studies.
        sensitivities: entries by which outputs are differentiated, "parameters.c_P,parameters.s_cl", or "all".
        """
        keys = sensitivities if isinstance(sensitivities, str) else ",".join(sensitivities)
        return self._core.run([peaks] if isinstance(peaks, str) else peaks, keys)

    def modes(self) -> Result:
        """Natural frequencies, damping and shapes of the coupled machine and of its frame."""
        return self._core.modes()

    def frame(self) -> Frame:
        """The reduced frame: M, B, C and the names of their rows."""
        return self._core.frame()

    def frequency_response(self, source, to, kind="receptance", at="start", lowest="", highest="", points=400):
        """Answers of `to` per force at `source`, names or lists of names: frequencies [Hz], {(source, to): complex array}."""
        texts = [text if isinstance(text, str) else f"{text} Hz" for text in (lowest, highest)]
        lists = [[names] if isinstance(names, str) else list(names) for names in (source, to)]
        return self._core.frequency_response(*lists, kind, at, *texts, points)._responses

    def state_space(self, source, to, kind="receptance", at="start") -> StateSpace:
        """The machine linearised there, x' = A x + B u, y = C x + D u: inputs are forces along `source`, outputs `to`.

        A, B, C, D unpacks, as scipy.signal.StateSpace(*scene.state_space(...)).
        """
        lists = [[names] if isinstance(names, str) else list(names) for names in (source, to)]
        return self._core.state_space(*lists, kind, at)

    def sweep(self, levels: dict, peaks=None, jobs=1):
        """Runs the scene at every combination of levels, {"parameters.c_P": [...], ...}; the scene stays as it is.

        Yields ({"parameters.c_P": value, ...}, result) one by one, in this order.  Files are read and frames reduced once.
        jobs: threads that make runs side by side.
        """
        points = [dict(zip(levels, values)) for values in itertools.product(*levels.values())]
        if jobs == 1:
            yield from ((point, self._at(point).run(peaks)) for point in points)
            return
        with concurrent.futures.ThreadPoolExecutor(jobs) as threads:
            begun = collections.deque()  # no more than are soon taken: histories are large
            try:
                for point in points:
                    begun.append((point, threads.submit(self._at(point).run, peaks)))
                    if len(begun) > 2 * jobs:
                        first, run = begun.popleft()
                        yield first, run.result()
                while begun:
                    first, run = begun.popleft()
                    yield first, run.result()
            finally:
                threads.shutdown(cancel_futures=True)

    def _at(self, point: dict) -> "Scene":
        scene = self.copy()
        for key, value in point.items():
            scene[key] = value
        return scene

    def __repr__(self) -> str:
        return f"<gestell.Scene {self.name}: signals {', '.join(self.signals)}>"


def _summary(result: Result) -> dict:
    """All that summary.json holds, as a dict."""
    return json.loads(result._summary)


def _result_text(result: Result) -> str:
    try:
        peaks = "".join(f"\n  {peak}" for peak in result.peaks.values())
    except InputError:
        peaks = "".join(f"\n  {f:.6g} Hz" for f in result.frequencies_hz)
    return f"<gestell.Result of {result.scene}>{peaks}"


Result.summary = property(_summary)
Result.__repr__ = _result_text
