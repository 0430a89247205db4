"""What the module gives is what the program gives.  Its path is the first argument."""

import concurrent.futures
import gc
import json
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import gestell
import numpy as np

PROGRAM = sys.argv.pop(1)


def short_press() -> gestell.Scene:
    return gestell.example("press_minimal").set("run.end", "0.21 s")


class Runs(unittest.TestCase):
    def test_tell_the_same_peaks_as_the_program(self):
        result = short_press().run()
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(gestell.__file__).resolve().parents[1] / "scenes" / "press_minimal.toml"
            subprocess.run([PROGRAM, "run", scene, "--quiet", "--set", "run.end=0.21 s", "-o", folder], check=True,
                           stdout=subprocess.DEVNULL)
            summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
            history = np.genfromtxt(pathlib.Path(folder) / "history.csv", delimiter=",", skip_header=1)
        for name, peak in result.peaks.items():
            self.assertEqual((peak.min, peak.t_max), (summary["signals"][name]["min"], summary["signals"][name]["t_max"]))
        self.assertEqual(result.summary["events"], summary["events"])
        np.testing.assert_array_equal(result.history, history)

    def test_findings_are_those_of_the_summary(self):
        result = gestell.example("press_minimal").set("run.end", "0.21 s").set("run.step", "2 ms").run()
        self.assertIn("energy-balance", [finding.id for finding in result.findings])
        self.assertEqual([finding.text for finding in result.findings], result.warnings)
        self.assertEqual([{"severity": f.severity, "id": f.id, "place": f.place, "text": f.text} for f in result.findings],
                         result.summary["findings"])

    def test_histories_are_views_that_outlive_their_result(self):
        result = short_press().run()
        force = result["F_P"]
        self.assertTrue(np.shares_memory(force, result.history))
        largest = force.max()
        del result
        gc.collect()
        self.assertEqual(force.max(), largest)
        with self.assertRaises(ValueError):
            force[0] = 0.

    def test_peaks_alone_are_those_of_the_whole_run(self):
        scene = short_press()
        alone, whole = scene.run(peaks="F_P"), scene.run()
        self.assertEqual(list(alone.peaks), ["F_P"])
        self.assertEqual(alone.peaks["F_P"].max, whole.peaks["F_P"].max)

    def test_leave_other_threads_running(self):
        done = threading.Event()
        runner = threading.Thread(target=lambda: (gestell.example("press_minimal").run(), done.set()))
        runner.start()
        steps = 0
        while not done.is_set():
            steps += 1
            time.sleep(0.001)
        runner.join()
        self.assertGreater(steps, 20)

    def test_side_by_side_are_those_alone(self):
        alone = short_press().run(peaks="F_P").peaks["F_P"].max
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            found = list(pool.map(lambda _: short_press().run(peaks="F_P").peaks["F_P"].max, range(8)))
        self.assertEqual(found, [alone] * 8)

    def test_of_a_sweep_come_in_its_order(self):
        levels = {"parameters.c_P": [8e8, 9e8, 10e8], "parameters.s_cl": ["0.2 mm", "0.4 mm"]}
        scene = short_press()
        alone, together = ([(point, run.peaks["F_P"].max) for point, run in scene.sweep(levels, ["F_P"], jobs)]
                           for jobs in (1, 3))
        self.assertEqual(alone, together)
        self.assertEqual([point["parameters.c_P"] for point, _ in alone], [8e8, 8e8, 9e8, 9e8, 10e8, 10e8])
        self.assertEqual(scene["parameters.c_P"], "900 kN/mm")

    def test_have_no_values_of_what_was_not_computed(self):
        result = short_press().run()
        self.assertIsNone(result._along)
        self.assertIsNone(result._periodic)

    def test_are_of_the_scene_as_it_was_when_they_began(self):
        scene, done = short_press().set("run.end", "1 ms"), threading.Event()

        def change():
            k = 0
            while not done.is_set():
                scene.add("parameters", **{f"z{k % 2000}": k})
                k += 1

        changing = threading.Thread(target=change)
        changing.start()
        try:
            for _ in range(30):
                scene.run(peaks="F_P")
        finally:
            done.set()
            changing.join()

    def test_end_on_interruption_with_what_they_have(self):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt) as caught:
            gestell.example("press_minimal").set("run.end", "20 s").set("output.step", "1 ms").run()
        self.assertGreater(len(caught.exception.result.t), 1)
        self.assertLess(caught.exception.result.t[-1], 20.)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)

    def test_that_fail_keep_what_was_computed(self):
        scene = gestell.Scene(OSCILLATOR)
        scene["element.spring.stiffness"] = "-40 kN/m"
        with self.assertRaises((gestell.ComputationFailed, gestell.InputError)):
            scene.run()

    def test_write_the_report(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("report.html", short_press().run().save(pathlib.Path(folder) / "new"))


OSCILLATOR = {
    "body": {"mass": {"type": "point", "mass": "10 kg", "position": [0, 0, 0]}},
    "element": {"spring": {"type": "spring-damper", "from": "mass", "direction": [1, 0, 0], "stiffness": 4000.}},
    "start": {"q": {"mass.ux": "5 mm"}},
    "run": {"method": "bdf", "step": "1 ms", "end": "0.1 s"},
    "output": {"signals": {"x": "mass.ux"}},
}


class Scenes(unittest.TestCase):
    def test_from_text_and_dict_are_those_of_files(self):
        frequency = 20. / (2. * np.pi)
        text = """[body.mass]
type = "point"
mass = "10 kg"
position = [0, 0, 0]
[element.spring]
type = "spring-damper"
from = "mass"
direction = [1, 0, 0]
stiffness = "4 kN/m"
"""
        for scene in (gestell.Scene(OSCILLATOR), gestell.loads(text)):
            self.assertAlmostEqual(scene.modes().frequencies_hz[-1], frequency, delta=1e-9 * frequency)

    def test_may_extend_files(self):
        folder = pathlib.Path(gestell.__file__).resolve().parents[1] / "scenes"
        scene = gestell.Scene({"extends": "press_minimal.toml", "parameters": {"c_P": "1000 kN/mm"}}, folder=folder)
        self.assertEqual(scene["parameters.c_P"], "1000 kN/mm")
        self.assertIn("F_P", scene.signals)

    def test_are_copied_whole(self):
        scene = gestell.Scene(OSCILLATOR)
        other = scene.copy().set("element.spring.stiffness", np.float64(8000.))
        self.assertEqual((scene["element.spring.stiffness"], other["element.spring.stiffness"]), (4000., 8000.))
        self.assertEqual(scene.to_dict(), OSCILLATOR)

    def test_take_arrays_whole_numbers_and_truths(self):
        scene = gestell.Scene(OSCILLATOR)
        scene["element.spring.direction"] = np.array([0., 0., 1.])
        scene["run.order"] = np.int64(3)
        scene["run.events"] = False
        self.assertEqual((scene["element.spring.direction"], scene["run.order"], scene["run.events"]), ([0., 0., 1.], 3, False))


class Mistakes(unittest.TestCase):
    """Each is answered with place, reason and remedy, as by the program."""

    def refused(self, words, call):
        with self.assertRaises(gestell.InputError) as caught:
            call()
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_are_told(self):
        press = lambda key, value: gestell.example("press_minimal").set(key, value)
        self.refused(["parameters.c_PP", "did you mean 'c_P'"], lambda: press("parameters.c_PP", 1))
        self.refused(["run.stp", "unknown key", "did you mean 'step'"], lambda: press("run.stp", 1e-5).run())
        self.refused(["element.rod.stiffness", "needs a stiffness", "3 kg"], lambda: press("parameters.c_P", "3 kg").check())
        self.refused(["no such scene file"], lambda: gestell.load("absent.toml"))
        self.refused(["valid:", "press_minimal"], lambda: gestell.example("absent"))
        self.refused(["scene:2", "is not valid TOML"], lambda: gestell.loads("a = 1\nb ="))
        self.refused(["object", "a number, a string with a unit"], lambda: gestell.Scene({"run": object()}))
        self.refused(["scene: run.step", "finite"], lambda: gestell.Scene({"run": {"step": float("nan")}}))
        self.refused(["keys of a scene are strings"], lambda: gestell.Scene({1: 2}))
        self.refused(["no signal 'F_Q'"], lambda: short_press().run(peaks=["F_Q"]))
        self.refused(["no signal 'F_Q'"], lambda: short_press().run()["F_Q"])
        self.refused(["the frame of the scene is not reduced"], lambda: short_press().frame())
        self.refused(["all [parameters] of the scene are zero"], lambda: gestell.Scene(OSCILLATOR).run(sensitivities="all"))
        with self.assertRaises(KeyError):
            short_press()["parameters.c_PP"]

    def test_of_methods_are_told_too(self):
        self.refused(["no run: "], lambda: short_press().modes().t)

    def test_that_no_file_could_hold_are_refused(self):
        holds_itself = {}
        holds_itself["body"] = holds_itself
        in_itself = []
        in_itself.append(in_itself)
        for scene, words in ((holds_itself, "more than 50 deep"), ({"gravity": in_itself}, "more than 50 deep"),
                             ({"gravity": [10**400, 0, 0]}, "gravity: got 1000"), ({"name": "\ud800"}, "not Unicode")):
            with self.assertRaisesRegex(gestell.SceneError, words):
                gestell.Scene(scene)


class StateSpaces(unittest.TestCase):
    """H = C (i w - A)^-1 B + D is the frequency response, which is found otherwise."""

    def check(self, scene, source, to, **options):
        A, B, C, D = scene.state_space(source, to, **options)
        frequencies, responses = scene.frequency_response(source, to, points=20, **options)
        for i, name in enumerate(to):
            expected = responses[source, name]
            found = [(C[i] @ np.linalg.solve(2j * np.pi * f * np.eye(len(A)) - A, B[:, 0]) + D[i, 0]) for f in frequencies]
            self.assertLess(abs(found - expected).max(), 1e-7 * abs(expected).max(), name)

    def test_have_the_frequency_response_of_the_machine(self):
        self.check(gestell.example("press_minimal"), "frame.crown.uz", ["frame.crown.uz", "F_P"])

    def test_have_that_of_accelerations(self):
        self.check(gestell.example("press_minimal"), "frame.crown.uz", ["frame.crown.uz"], kind="accelerance")

    def test_have_that_of_machines_with_ideal_joints(self):
        self.check(gestell.loads(PENDULUM), "bob.ux", ["bob.ux", "pin.fz", "pin.fx"], at="undeformed")

    def test_are_written_as_matlab_and_matrix_market_files(self):
        scene = pathlib.Path(gestell.__file__).resolve().parents[1] / "scenes" / "press_minimal.toml"
        A = gestell.load(scene).state_space("frame.crown.uz", "F_P").A
        with tempfile.TemporaryDirectory() as folder:
            written = pathlib.Path(folder) / "written"
            for form in ("matrix-market", "mat"):
                subprocess.run([PROGRAM, "frf", scene, "--quiet", "--from", "frame.crown.uz", "--to", "F_P", "--points",
                                "2", "--export", form, "-o", written], check=True, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
                if form == "matrix-market":
                    lines = (written / "state_space_A.mtx").read_text().splitlines()
                    numbers = [line for line in lines if not line.startswith("%")]
                    self.assertEqual(numbers[0].split()[:2], ["10", "10"])
            self.assertEqual(list(written.glob("state_space_*")), [], "of an earlier result")
            np.testing.assert_array_equal(mat_matrix(written / "state_space.mat", "A"), A)


def mat_matrix(path, wanted):
    """A real matrix of a MATLAB file, version 5, not compressed, by the published layout."""
    data = path.read_bytes()
    assert data[124:128] == b"\x00\x01IM"
    at = 128
    while at < len(data):
        kind, size = struct.unpack_from("<II", data, at)
        assert kind == 14, "miMATRIX"
        place, end, parts = at + 8, at + 8 + size, []
        while place < end and len(parts) < 4:
            tag, n = struct.unpack_from("<II", data, place)
            if tag >> 16:  # small element
                parts.append(data[place + 4:place + 4 + (tag >> 16)])
                place += 8
            else:
                parts.append(data[place + 8:place + 8 + n])
                place += 8 + (n + 7) // 8 * 8
        if parts[2].decode() == wanted:
            rows, columns = struct.unpack("<ii", parts[1])
            return np.frombuffer(parts[3]).reshape(columns, rows).T
        at = end
    raise KeyError(wanted)


PENDULUM = """gravity = [0, 0, "-9.81 m/s^2"]
[body.bob]
type     = "planar"
normal   = [0, 1, 0]
mass     = "2 kg"
inertia  = "0.01 kg m^2"
position = ["0.3 m", 0, "-0.4 m"]
[joint.pin]
type = "revolute"
from = "bob"
to   = "ground"
at   = [0, 0, 0]
[element.spring]
type      = "spring-damper"
from      = "bob"
direction = [1, 0, 0]
stiffness = "100 N/m"
damping   = "3 N s/m"
"""


CHAIN = """name = "chain"
[frame]
mass = [[2, 0], [0, 3]]
stiffness = [[1000, -500], [-500, 800]]
[frame.interface.a]
rows = { ux = 1 }
[reduction]
method = "craig-bampton"
modes = 1
[run]
method = "newmark"
step = "1 ms"
end = "10 ms"
[output.signals]
x = "frame.a.ux"
"""


class SharedFrames(unittest.TestCase):
    def test_of_a_file_are_those_that_it_has_now(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)

            def stiffness(of_first):
                (folder / "cb.toml").write_text(CHAIN.replace("1000", str(of_first)))
                subprocess.run([PROGRAM, "reduce", folder / "cb.toml", "-o", folder / "made", "--quiet"], check=True,
                               stdout=subprocess.DEVNULL)
                (next((folder / "made").glob("*.h5"))).replace(folder / "frame.h5")
                table = CHAIN[CHAIN.index("[frame]"):CHAIN.index("[run]")]
                scene = gestell.loads(CHAIN.replace(table, '[frame]\nreduced = "frame.h5"\n'), folder)
                return scene.frame().C[0, 0]

            self.assertNotEqual(stiffness(1000), stiffness(2000))

    def test_cannot_be_asked_for_by_progress_while_one_is_made(self):
        # Masses that no cache has.
        scene, other = (gestell.loads(CHAIN.replace("2, 0", f"{2 + time.time_ns() % 1e9 / 1e9 + k}, 0")) for k in (0, 1))
        told = []

        def progress(phase, share):
            told.append(phase)
            other.frame()

        with self.assertRaisesRegex(ValueError, "requests a frame while another one"):
            scene.run(progress=progress)
        self.assertEqual(len(told), 1)
        other.frame()  # nothing is left locked
        scene.run()


class Frames(unittest.TestCase):
    def test_are_views_of_symmetric_matrices(self):
        folder = pathlib.Path(gestell.__file__).resolve().parents[1] / "scenes" / "benchmark"
        scene = gestell.load(folder / "m200.toml").set("reduction.method", "craig-bampton").set("reduction.modes", 10)
        try:
            frame = scene.frame()
        except gestell.InputError as without_plugin:
            self.skipTest(str(without_plugin))
        self.assertEqual(frame.M.shape, (len(frame.coordinates),) * 2)
        self.assertFalse(frame.C.flags.writeable)
        np.testing.assert_array_equal(frame.C, frame.C.T)


if __name__ == "__main__":
    unittest.main()
