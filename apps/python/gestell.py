"""Vibrations of a machine together with its frame.

    import gestell

    scene = gestell.load("press_minimal.toml")
    scene["parameters.c_P"] = "950 kN/mm"
    result = scene.run()
    print(result.peaks["F_P"].max, result.warnings)
    force = result["F_P"]                 # NumPy array over result.t

Numbers are SI, strings carry a unit, as in scene files.  Wrong input raises InputError (a ValueError), of a scene
SceneError, which has file, line and key; a computation that fails ComputationFailed (a RuntimeError, with what was
computed in its `result`), Ctrl-C KeyboardInterrupt, likewise.
"""

import collections
import concurrent.futures
import inspect
import itertools
import json
import keyword
import pathlib
import re
import sys
import threading

import _gestell
from _gestell import ComputationFailed, Event, Finding, Frame, FullFrame, InputError, Peak, Result, SceneError, StateSpace

__version__ = _gestell.version
__all__ = ["ComputationFailed", "Event", "Finding", "Frame", "FullFrame", "InputError", "ModesAlong", "Motion", "Peak", "Periodic", "Result",
           "Scene", "SceneError", "Size", "Stability", "StateSpace", "example", "load", "loads", "mesh"]


def load(path) -> "Scene":
    """The scene of a TOML file."""
    return Scene._of(_gestell.Scene.of_file(str(path)))


def loads(text: str, folder=".") -> "Scene":
    """The scene of a TOML text; relative paths in it start at `folder`."""
    return Scene._of(_gestell.Scene.of_text(text, str(folder)))


def example(name: str) -> "Scene":
    """A scene shipped with Gestell, such as "press_minimal"; the error for an unknown name lists all of them."""
    return load(_shipped("scenes", name, ".toml"))


def mesh(name: str) -> str:
    """Path of a CAD file shipped with Gestell, such as "press_frame.step"; the error for an unknown name lists all of them."""
    return str(_shipped("meshes", name, ""))


def _shipped(kind: str, name: str, ending: str):
    here = pathlib.Path(__file__).resolve()
    folders = [here.parents[1] / kind, here.parents[2] / kind]  # of the sources
    if len(here.parents) > 3:
        folders.append(here.parents[3] / "share" / "gestell" / kind)  # of the prefix
    for folder in folders:
        if (folder / (name + ending)).is_file():
            return folder / (name + ending)
    names = sorted(path.name.removesuffix(ending) for folder in folders for path in folder.glob("*" + (ending or ".*")) if path.suffix != ".md")
    raise InputError(f"there is no '{name}' among the shipped {kind}; valid: {', '.join(names)}")


class Scene:
    """A scene as data: keys are read and set by their path, then computed.

    Scene({"body": {...}, ...}) builds one from a dict, Scene(gravity=[0, 0, -9.81]).body("bob", "point", mass="2 kg")
    one call by call.  Relative paths start at `folder`.  Numbers are SI, text carries its unit.
    """

    def __init__(self, values: dict = None, folder=".", **tables):
        self._core = _gestell.Scene.of_values({**(values or {}), **_entries(tables)}, str(folder))

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
        """Sets a key such as "parameters.c_P"; returns the scene, so that calls can be chained."""
        self._core.set(key, value)
        return self

    def add(self, table: str, **entries) -> "Scene":
        """Adds keys to a table such as "run" or "body.crank"; from_ means from.  Returns the scene, so that calls can be chained."""
        self._core.add(table, _entries(entries))
        return self

    def parameters(self, **entries) -> "Scene":
        """Adds parameters, r="80 mm"; returns the scene."""
        return self.add("parameters", **entries)

    def body(self, name: str, type: str, **entries) -> "Scene":
        """Adds a body: its name, its type and its keys; returns the scene."""
        return self.add(f"body.{_written(name)}", type=type, **entries)

    def joint(self, name: str, type: str, **entries) -> "Scene":
        """Adds a joint: its name, its type and its keys, such as from_="crank"; returns the scene."""
        return self.add(f"joint.{_written(name)}", type=type, **entries)

    def element(self, name: str, type: str = "", derivative=None, state=(), events=(), event_values=None, at_event=None,
                after_step=None, **entries) -> "Scene":
        """Adds an element: its name, its type and its keys, such as from_="crank"; returns the scene.

        force: of a "formula force" also a function F(t, u, v) in N or N m of time, displacement or angle u, and its rate.
        derivative: function that returns dF/du and dF/dv; None: central differences, four more calls of `force` each.
        state: numbers s at the start, for a law with memory; all its functions then take s, a tuple, as last argument.
        events: names; event_values: function (t, u, v) that returns a number for each, which occurs as it rises through 0.
        at_event: function (event, t, u, v, s) that returns the new s; after_step: function (t, u, v, s), likewise.
        """
        law = {"derivative": derivative, "event_values": event_values, "after_step": after_step,
               "at_event": at_event and (lambda number, *motion: at_event(events[int(number)], *motion))}
        if callable(entries.get("force")):
            type, events = type or "formula force", list(events)
            entries["force"] = _gestell.Function.law({"force": entries["force"], **law}, list(state), events)
        elif len(state) or len(events) or any(law.values()):
            raise InputError(f"element '{name}': derivative, state and events need a force that is a function; give force=f")
        return self.add(f"element.{_written(name)}", **({"type": type} if type else {}), **entries)

    def signal(self, name: str, function, of=(), unit="1") -> "Scene":
        """Adds a signal that is a function of others, such as ["slide.velocity", "F_P"]; returns the scene."""
        of = [of] if isinstance(of, str) else list(of)
        return self.add("output.signals", **{name: _gestell.Function.signal(function, of, unit)})

    def watch(self, **signals) -> "Scene":
        """Adds signals to the output of runs, such as x="mass.ux"; returns the scene."""
        return self.add("output.signals", **signals)

    def copy(self) -> "Scene":
        """A separate copy of the scene."""
        return Scene._of(self._core.copy())

    def to_dict(self) -> dict:
        """All keys with their values, including those of the base scene."""
        return self._core.values()

    @property
    def name(self) -> str:
        """Name of the scene."""
        return self._core.name()

    @property
    def signals(self) -> list:
        """Names of the signals of a run."""
        return self._core.signals()

    def check(self) -> list:
        """Validates without computing; returns warnings."""
        return self._core.check()

    def describe(self) -> str:
        """Summary of the scene: bodies, joints, elements, DOFs, cost of a run."""
        return "\n".join(self._core.words())

    def run(self, signals=None, peaks=None, lean=False, sensitivities="", progress=None, **settings) -> Result:
        """Simulates the scene in time.

        signals: those wanted, by name or by what they read, "slide.displacement"; None: all that the scene asks for.
        peaks: the same of signals whose extremes alone are wanted: no history, no pictures, no energy balance.
        lean: without pictures and energy balance, as runs of studies.
        sensitivities: entries by which outputs are differentiated, "parameters.c_P,parameters.s_cl", or "all".
        progress: True, or a callable f(phase, completed share; negative: unknown); an exception in it ends the run.
        settings: entries of [run] for this run alone, end="1 s", tolerance=1e-8.
        """
        scene = self.copy().add("run", **settings) if settings else self
        keys = sensitivities if isinstance(sensitivities, str) else ",".join(sensitivities)
        names = _names(signals if peaks is None else peaks)
        return scene._core.run(names, peaks is None, lean, keys, _progress(progress))

    def modes(self) -> Result:
        """Natural frequencies [Hz], damping and shapes of the coupled machine and of its frame."""
        return self._core.modes({}, None)

    def modes_along(self, coordinate: str, from_="", to="", positions=73, configuration="equilibrium", hold=(), speed="",
                    orders=10, progress=None) -> "ModesAlong":
        """Natural frequencies along a coordinate, "crank" or "boom.angle" [rad or m], by default over one turn.

        configuration: "equilibrium" or "undeformed".  hold: coordinates that do not vibrate.
        speed: whose multiples up to `orders` excite, "30 1/min"; by default that of the start.
        """
        options = {"--along": coordinate, "--from": _text(from_), "--to": _text(to), "--positions": positions,
                   "--configuration": configuration, "--hold": hold, "--speed": _text(speed), "--orders": orders}
        return ModesAlong(self._core.modes({name: _texts(value) for name, value in options.items()}, _progress(progress)))

    def stability(self, step=0.) -> "Stability":
        """Modes of the scene under its integrator and under all others at `step` [s], by default that of [run]."""
        return Stability(json.loads(self._core.stability(step)))

    def size(self, tolerance: float, outputs="", max_cpu=0., exhaustive=False) -> "Size":
        """The cheapest mesh, number of modes and integration that keep outputs, "F_P.max,F_P.min", within a relative tolerance.

        max_cpu: [s] that a model may take.  exhaustive: tries all models around the chosen one, too.
        """
        names = outputs if isinstance(outputs, str) else ",".join(outputs)
        found, sized = self._core.size(tolerance, names, max_cpu, exhaustive)
        return Size(json.loads(found), Scene._of(sized))

    def frame(self) -> Frame:
        """The reduced frame: M, B, C, T and the names of their rows."""
        return self._core.frame()

    def full_frame(self) -> FullFrame:
        """The assembled frame from CAD or matrices, not reduced: M, B, C as scipy.sparse."""
        return self._core.full_frame()

    def state_space(self, source, to, kind="receptance", at="start") -> StateSpace:
        """The machine linearised at an operating point, x' = A x + B u, y = C x + D u: inputs are forces along `source`, outputs `to`.

        A, B, C, D unpacks, as scipy.signal.StateSpace(*scene.state_space(...)).
        """
        return self._core.state_space(_names(source), _names(to), kind, at)

    def sweep(self, levels: dict, peaks=None, jobs=1, signals=None, lean=False, errors="raise", progress=None):
        """Runs the scene at every combination of levels, {"parameters.c_P": [...], ...}; the scene is not changed.

        Yields ({"parameters.c_P": value, ...}, result) one by one, in this order.  Files are read and frames reduced once.
        jobs: threads for parallel runs.  errors: "raise", or "yield" the exception of a run instead of its result.
        progress: True, or a callable that is told ("sweep", share done).
        """
        if errors not in ("raise", "yield"):
            raise InputError(f"sweep: errors is '{errors}'; valid: 'raise', 'yield'")
        points = [dict(zip(levels, values)) for values in itertools.product(*levels.values())]
        told, interrupted = _progress(progress) or (lambda phase, share: None), threading.Event()

        def run(point):
            if interrupted.is_set():
                raise KeyboardInterrupt
            try:
                return self._at(point).run(signals, peaks, lean)
            except KeyboardInterrupt:
                interrupted.set()
                raise
            except (InputError, ComputationFailed) as error:
                if errors == "raise":
                    raise
                return error

        for done, answer in enumerate(map(lambda point: (point, run(point)), points) if jobs == 1 else _ordered(run, points, jobs, interrupted)):
            told("sweep", (done + 1) / len(points))
            yield answer

    def _at(self, point: dict) -> "Scene":
        scene = self.copy()
        for key, value in point.items():
            scene[key] = value
        return scene

    def __repr__(self) -> str:
        try:
            return f"<gestell.Scene {self.name}: signals {', '.join(self.signals)}>"
        except InputError as unfinished:
            return f"<gestell.Scene, not complete: {unfinished}>"

    def _repr_html_(self) -> str:
        try:
            words = "".join(f"<li>{_escaped(line)}</li>" for line in self._core.words())
            return f"<div><strong>{_escaped(self.name)}</strong><ul>{words}</ul></div>"
        except InputError as unfinished:
            return f"<div><strong>scene, not complete</strong><p>{_escaped(str(unfinished))}</p></div>"


def _computes(name: str, answer, **renamed):
    """A method of Scene that computes an analysis: options of its command are keywords, as declared."""
    does, options = _gestell.analyses[name]
    words = {option: option[2:].replace("-", "_") for option, _ in options}
    keywords = {renamed.get(word, word + "_" * keyword.iskeyword(word)): option for option, word in words.items()}
    parameters = [inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)]
    parameters += [inspect.Parameter(key, inspect.Parameter.POSITIONAL_OR_KEYWORD, default="") for key in [*keywords, "progress"]]
    signature = inspect.Signature(parameters)

    def method(*values, **named):
        given = signature.bind(*values, **named).arguments
        texts = {option: _texts(given[key]) for key, option in keywords.items() if given.get(key, "") not in ("", None)}
        return answer(given["self"]._core.analyse(name, texts, _progress(given.get("progress"))))

    method.__name__, method.__signature__ = name, signature
    method.__doc__ = f"{does[0].upper()}{does[1:]}.\n\n" + "\n".join(f"{key}: {dict(options)[option]}." for key, option in keywords.items())
    return method


def _responses(result: "Result"):
    """Frequencies [Hz], {(source, to): complex array}."""
    arrays = result._arrays
    return arrays.pop("frequencies_hz"), arrays


Scene.frequency_response = _computes("frf", _responses, **{"from": "source"})
Scene.life = _computes("life", lambda result: result, life_error="error", life_by="by")


class Motion:
    """A periodic solution with `period` [s], one row of Periodic."""

    def __init__(self, values: dict):
        self.period = values["period"]  #: [s]
        self.begin = values["begin"]  #: [s] of `orbit`
        self.ratio, self.kind, self.method, self.notes = (values[key] for key in ("ratio", "kind", "method", "notes"))
        self.stable = values["stable"]  #: None: not known
        self.multipliers = values["multipliers"]  #: of Floquet, complex, largest first
        self.residual = values["residual"]  #: how far it is from closing, relative
        self.q, self.v = values["q"], values["v"]  #: state at `begin`, SI
        self.parameter, self.branch = values["parameter"], values["branch"]  #: where a branch is followed
        self.signals = values["signals"]  #: {name: {unit, max, min, mean, amplitude, phase}}, of the drive's harmonics 1, 2, ...
        self.columns, self.orbit = values["columns"], values["orbit"]  #: t [s] and signals over one period [rows x columns]

    def __getitem__(self, name: str):
        if name not in self.columns:
            raise InputError(f"the motion has no signal '{name}'; it has {', '.join(self.columns)}")
        return self.orbit[:, self.columns.index(name)]

    def __repr__(self) -> str:
        return f"<gestell.Motion of {self.period:.9g} s, {_stable_text(self.stable)}>"


class Periodic(collections.abc.Sequence):
    """Periodic solutions, a sequence of Motion; arrays over all of them."""

    def __init__(self, result: Result):
        self._result, values = result, result._periodic
        self.motions = [Motion(each) for each in values["motions"]]  #: Motion, by branches
        self.backbone = [Motion(each) for each in values["backbone"]]  #: of free vibration
        self.method, self.reason, self.notes = values["method"], values["reason"], values["notes"]
        self.parameter, self.unit = values["parameter"], values["unit"]  #: that branches follow
        self.coordinates = values["coordinates"]  #: names of q
        self.special_points = values["special_points"]  #: [{kind, parameter, period [s], motion}]: folds, doublings, ...
        self.checks = values["checks"]  #: {method: {distances, failure}} of a second method

    def save(self, folder) -> list:
        """Writes the files of `gestell periodic`, such as report.html and solutions.csv; returns their names."""
        return self._result.save(folder)

    def __len__(self) -> int:
        return len(self.motions)

    def __getitem__(self, i):
        return self.motions[i]

    def array(self, name: str, number="max"):
        """A number of each motion, an array: "period" [s], "parameter", "stable", or of a signal max, min, mean, amplitude."""
        import numpy
        if hasattr(Motion, name) or (self.motions and name in vars(self.motions[0])):
            return numpy.array([getattr(motion, name) for motion in self.motions])
        for motion in self.motions:
            if name not in motion.signals:
                raise InputError(f"the motions have no signal '{name}'; they have {', '.join(motion.signals)}")
        values = [motion.signals[name][number] for motion in self.motions]
        return numpy.array([value[0] if number in ("amplitude", "phase") else value for value in values])

    def __repr__(self) -> str:
        return f"<gestell.Periodic by {self.method}: {len(self)} motions>"

    def _repr_html_(self) -> str:
        head = ([f"{self.parameter} [{self.unit or 'SI'}]"] if self.parameter else []) + ["period [s]", "kind", "stability", "residual"]
        rows = [([f"{m.parameter:.6g}"] if self.parameter else []) + [f"{m.period:.6g}", m.kind, _stable_text(m.stable), f"{m.residual:.2g}"]
                for m in self.motions]
        if len(rows) > 12:
            rows[6:-6] = [[f"... {len(rows) - 12} more"] + [""] * (len(head) - 1)]
        points = [f"{p['kind']} at {p['parameter']:.6g} {self.unit}" for p in self.special_points]
        return _html_table(f"{len(self)} periodic motions by {self.method}" + (": " + ", ".join(points) if points else ""), head, rows)


class ModesAlong:
    """Natural frequencies along a coordinate: rows are positions, columns follow one mode each."""

    def __init__(self, result: Result):
        self._result, values = result, result._along
        self.coordinate, self.unit = values["coordinate"], values["unit"]
        self.x = values["x"]  #: positions, in `unit`
        self.frequencies_hz = values["frequencies_hz"]  #: [positions x lines] Hz; nan in gaps
        self.damping_ratios = values["damping_ratios"]  #: [positions x lines]
        self.assurance = values["assurance"]  #: [positions x lines] MAC with the position before
        self.shapes = values["shapes"]  #: by position [coordinates x lines], mass normalised
        self.moves_most = values["moves_most"]  #: by line: the coordinate that moves most
        self.gaps = values["gaps"]  #: {position: why there are no modes}
        self.speed = values["speed"]  #: [rad/s] of the excitation; 0: unknown
        self.meetings = values["meetings"]  #: [{order, line, begin, end, x, frequency_hz, distance}]: near a multiple of the speed

    def save(self, folder) -> list:
        """Writes the files of `gestell modes --along`, such as report.html and modes_along.csv; returns their names."""
        return self._result.save(folder)

    def __repr__(self) -> str:
        return f"<gestell.ModesAlong {self.coordinate}: {len(self.x)} positions, {len(self.moves_most)} lines>"

    def _repr_html_(self) -> str:
        rows = [[str(j + 1), moves, f"{min(column):.6g}", f"{max(column):.6g}"]
                for j, moves in enumerate(self.moves_most) for column in [[f for f in self.frequencies_hz[:, j] if f == f] or [0.]]]
        return _html_table(f"modes along {self.coordinate}", ["line", "moves most", "lowest [Hz]", "highest [Hz]"], rows)


Scene.periodic = _computes("periodic", Periodic)


class Stability:
    """Numerical damping and period error of the modes of a scene under its integrator and under all others at the same step."""

    def __init__(self, values: dict):
        import numpy
        self.method, self.notes = values["method"], values["notes"]
        by_mode = lambda name: numpy.array([mode[name] for mode in values["modes"]], dtype=float)
        self.frequencies_hz, self.damping_ratios, self.omega_h = by_mode("frequency_hz"), by_mode("damping_ratio"), by_mode("omega_h")  #: Hz, 1, rad
        self.spectral_radii, self.numerical_damping = by_mode("spectral_radius"), by_mode("numerical_damping")  #: growth per step, ratio
        self.period_errors = by_mode("period_error")  #: relative
        names = {"growing_modes": "growing", "growth_per_step": "growth", "step_that_works_s": "step_that_works"}
        none = {"worst_hz": 0., "step_that_works_s": 0.}  # where no mode grows
        self.methods = [{names.get(name, name): none.get(name, float("nan")) if value is None else value for name, value in each.items()}
                        for each in values["methods"]]  #: [{method, growing, growth, worst_hz, step_that_works [s], ...}]

    def __repr__(self) -> str:
        return f"<gestell.Stability of {self.method}: {sum(self.spectral_radii > 1 + 1e-10)} of {len(self.omega_h)} modes grow>"

    def _repr_html_(self) -> str:
        rows = [[m["method"], str(m["growing"]), f"{m['growth']:.6g}", f"{m['step_that_works']:.3g}" if m["growing"] else ""]
                for m in self.methods]
        return _html_table(self.method, ["method", "modes that grow", "growth per step", "a step that works [s]"], rows)


class Size:
    """The smallest model that keeps outputs within a tolerance: `scene` has its mesh, modes and integration."""

    def __init__(self, values: dict, scene: Scene):
        self.scene, size = scene, values["size"]
        self.met, self.tolerance, self.stopped = size["met"], size["tolerance"], size["stopped"] or ""  #: within the tolerance?
        self.ladder = [_rung(each) for each in values["ladder"]]  #: models as tried: mesh_size [m], modes, step [s], cpu_s, errors {output: {value, mesh, ...}}
        self.all = [_rung(each) for each in values["all"]]
        self.chosen = self.ladder[size["chosen"]["rung"] - 1]  #: of the ladder
        self.errors = self.chosen["errors"]  #: {output: {value, unit, mesh, reduction, time, total}}, absolute
        self.proof = [{"output": name, "unit": self.errors[name]["unit"], **each} for name, each in size["proof"].items()]
        self.finer = size["finer"]  #: the model of the proof
        self.left_out, self.missing = size["left_out"], size["missing"]
        self.skipped = size["skipped"]  #: models whose mesh or frame could not be made, and why
        self.unasked = size["unasked"]  #: questions that would have taken the search above ten runs of the chosen model
        self.cpu_s, self.runs = size["cost"]["cpu_s"], size["cost"]["runs"]  #: what the search took, in all and in runs of the chosen model

    def __repr__(self) -> str:
        return f"<gestell.Size to {self.tolerance:g}: {'met' if self.met else 'not met'} after {len(self.ladder)} models>"

    def _repr_html_(self) -> str:
        text = lambda error: "not known" if error is None else f"{error:.2g}"
        rows = [[name, f"{e['value']:.6g} {e['unit']}"] + [text(e[part]) for part in ("mesh", "reduction", "time", "total")]
                for name, e in self.errors.items()]
        return _html_table(repr(self)[1:-1], ["output", "value", "mesh", "reduction", "time", "total"], rows)


def _rung(values: dict) -> dict:
    """A model of Size; values that are not chosen are 0, -1 or empty."""
    none = {"mesh_size": 0., "sides": "", "modes": -1, "reduction": "", "share": float("inf")}
    rung = {name: none.get(name) if value is None else value for name, value in values.items()}
    rung["errors"] = rung.pop("outputs")
    return rung


def _entries(values: dict) -> dict:
    """Keyword arguments as keys: from_ means from."""
    return {key[:-1] if key.endswith("_") else key: value for key, value in values.items()}


def _written(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else '"' + name + '"'


def _names(names):
    return names if names is None else [names] if isinstance(names, str) else list(names)


def _texts(value) -> list:
    return [str(each) for each in ([value] if isinstance(value, str) or not hasattr(value, "__iter__") else value)]


def _text(quantity) -> str:
    return quantity if isinstance(quantity, str) else repr(float(quantity))


def _progress(progress):
    if progress is not True:
        return progress or None
    return lambda phase, share: print(f"\r{phase} {share:6.1%}" if share >= 0 else f"\r{phase}       ", end="", file=sys.stderr)


def _ordered(run, points, jobs, interrupted):
    """(point, run(point)) of all points, in their order, from `jobs` threads that run only a little ahead, because histories are large."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as threads:
        begun = collections.deque()
        try:
            for point in points:
                begun.append((point, threads.submit(run, point)))
                if len(begun) > 2 * jobs:
                    first, answer = begun.popleft()
                    yield first, answer.result()
            while begun:
                first, answer = begun.popleft()
                yield first, answer.result()
        except KeyboardInterrupt:
            interrupted.set()
            raise
        finally:
            threads.shutdown(cancel_futures=True)


def _stable_text(stable) -> str:
    return "stability not known" if stable is None else "stable" if stable else "unstable"


def _escaped(text: str) -> str:
    return str(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _html_table(title: str, head: list, rows: list) -> str:
    cells = lambda row, tag: "<tr>" + "".join(f"<{tag}>{_escaped(cell)}</{tag}>" for cell in row) + "</tr>"
    return (f"<div><strong>{_escaped(title)}</strong><table cellpadding='4'><thead>{cells(head, 'th')}</thead><tbody>"
            f"{''.join(cells(row, 'td') for row in rows)}</tbody></table></div>")


def _summary(result: Result) -> dict:
    """Contents of summary.json as a dict; numbers in SI."""
    return json.loads(result._summary)


def _plot(result: Result, *names, axes=None):
    """Draws signals over time [s] with matplotlib, by default all; returns the axes."""
    import matplotlib.pyplot
    axes = axes or matplotlib.pyplot.subplots()[1]
    for name in names or [column for column in result.columns[1:] if not column.startswith("energy")]:
        axes.plot(result.t, result[name], label=f"{name} [{result.units[name]}]")
    axes.set_xlabel("t [s]")
    axes.legend()
    return axes


def _result_text(result: Result) -> str:
    try:
        peaks = "".join(f"\n  {peak}" for peak in result.peaks.values())
    except InputError:
        peaks = "".join(f"\n  {f:.6g} Hz" for f in result.frequencies_hz)
    return f"<gestell.Result of {result.scene}>{peaks}"


def _sparse(name: str, what: str):
    def matrix(full: FullFrame):
        import scipy.sparse
        values, rows, begins, n = full.csc(name)
        return scipy.sparse.csc_matrix((values, rows, begins), shape=(n, n), copy=False)
    matrix.__doc__ = f"{what} matrix as scipy.sparse.csc_matrix on the memory of the frame, not to be written to."
    return property(matrix)


FullFrame.M, FullFrame.B, FullFrame.C = (_sparse(name, what) for name, what in
                                         (("M", "Mass [kg]"), ("B", "Damping [N s/m]"), ("C", "Stiffness [N/m]")))
Result.summary = property(_summary)
Result.plot = _plot
Result.__repr__ = _result_text
