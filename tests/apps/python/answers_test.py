"""Scenes built by calls, what is told beside runs, errors that name their place, and what help() says."""

import gc
import inspect
import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import gestell
import _gestell
import numpy as np


def oscillator(**spring) -> gestell.Scene:
    """10 Hz, along x alone."""
    return (gestell.Scene().body("mass", "slider", axis=[1, 0, 0], mass="10 kg")
            .element("spring", "spring-damper", from_="mass", **{"stiffness": 10 * (20 * np.pi)**2, "damping": "20 N s/m", **spring})
            .add("start", q={"mass": "5 mm"}))


def press() -> gestell.Scene:
    return gestell.example("press_minimal").set("run.end", "0.21 s")


class Chained(unittest.TestCase):
    def test_calls_build_what_a_dict_does(self):
        self.assertEqual(oscillator(damping=0).to_dict(), {
            "body": {"mass": {"type": "slider", "axis": [1, 0, 0], "mass": "10 kg"}},
            "element": {"spring": {"type": "spring-damper", "from": "mass", "stiffness": 10 * (20 * np.pi)**2, "damping": 0}},
            "start": {"q": {"mass": "5 mm"}}})

    def test_settings_of_a_run_are_its_own(self):
        scene = oscillator()
        run = scene.run("mass.displacement", end="0.2 s", tolerance=1e-9)
        w = np.sqrt((20 * np.pi)**2 - 1)
        exact = 5e-3 * np.exp(-run.t) * (np.cos(w * run.t) + np.sin(w * run.t) / w)
        self.assertLess(abs(run["mass.displacement"] - exact).max(), 1e-7)
        self.assertNotIn("run", scene.to_dict())

    def test_names_with_blanks_are_written_as_in_files(self):
        self.assertIn("front mass", gestell.Scene().body("front mass", "point", mass=1, position=[0, 0, 0]).to_dict()["body"])


class Runs(unittest.TestCase):
    def test_lean_ones_have_the_same_motion(self):
        whole, lean = press().run(), press().run("F_P", lean=True)
        self.assertEqual(lean.columns, ["t", "F_P"])
        np.testing.assert_array_equal(lean["F_P"], whole["F_P"])

    def test_tell_their_progress_and_end_by_what_it_raises(self):
        told = []
        press().run(peaks="F_P", progress=lambda phase, share: told.append((phase, share)))
        self.assertIn("integration", [phase for phase, _ in told])

        class Enough(Exception):
            pass

        def stop(phase, share):
            if phase == "integration":
                raise Enough

        with self.assertRaises(Enough):
            press().set("run.end", "20 s").set("output.step", "1 ms").run(progress=stop)

    def test_many_do_not_fill_the_memory(self):
        scene = oscillator()
        scene.add("run", end="20 ms", tolerance=1e-6)
        pages = lambda: int(pathlib.Path("/proc/self/statm").read_text().split()[1])
        for i in range(300):
            scene.set("element.spring.stiffness", 4e4 + i).run()
            if i == 99:
                gc.collect()
                before = pages()
        gc.collect()
        self.assertLess((pages() - before) * 4096, 2e6)  # a kept run would be some 10 kB

    def test_of_an_interrupted_sweep_leave_a_living_interpreter(self):
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        scene, begin = gestell.example("press_minimal").set("output.step", "1 ms"), time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            for _ in scene.sweep({"parameters.c_P": np.linspace(8e8, 9e8, 100)}, peaks="F_P", jobs=2):
                pass
        self.assertLess(time.monotonic() - begin, 3.)
        self.assertTrue(press().run(peaks="F_P").peaks)

    def test_of_a_sweep_may_fail_one_by_one(self):
        answers = [answer for _, answer in oscillator().add("run", end="10 ms", tolerance=1e-6).sweep(
            {"element.spring.stiffness": [4e4, "4 kg"]}, errors="yield")]
        self.assertIsInstance(answers[0], gestell.Result)
        self.assertIsInstance(answers[1], gestell.SceneError)


class Answers(unittest.TestCase):
    def test_periodic_motion_of_a_linear_oscillator_is_its_response(self):
        scene = oscillator().element("load", "force", from_="mass", harmonics=[{"amplitude": "3 N", "frequency": "8 Hz"}]).watch(
            x="mass.displacement").add("run", method="exact", tolerance=1e-9, end="1 s")
        motion, = scene.periodic("harmonic-balance")
        W = 2 * np.pi * 8
        expected = 3 / abs(10 * (20 * np.pi)**2 - 10 * W**2 + 20j * W)
        self.assertAlmostEqual(motion.signals["x"]["amplitude"][0] / expected, 1, delta=1e-8)
        self.assertAlmostEqual(motion["x"].max() / expected, 1, delta=1e-4)  # rows of 512 a period miss the top by 2e-5
        self.assertTrue(motion.stable)
        self.assertAlmostEqual(abs(motion.multipliers[0]) / np.exp(-1 / 8), 1, delta=1e-6)

    def test_branches_of_a_scene_without_a_file(self):
        scene = oscillator().parameters(f="8 Hz").element("load", "force", from_="mass", harmonics=[
            {"amplitude": "3 N", "frequency": "f"}]).watch(x="mass.displacement").add("run", method="exact", tolerance=1e-9, end="1 s")
        branch = scene.periodic("harmonic-balance", along="parameters.f", from_="7 Hz", to="9 Hz", points=10)
        W = 2 * np.pi * branch.array("parameter")
        expected = 3 / abs(10 * (20 * np.pi)**2 - 10 * W**2 + 20j * W)
        np.testing.assert_allclose(branch.array("x", "amplitude"), expected, rtol=1e-7)
        self.assertIn("parameters.f", branch._repr_html_())

    def test_modes_along_begin_with_those_of_the_position(self):
        along = gestell.example("press_minimal").modes_along("crank", from_="160 deg", to="170 deg", positions=3)
        here = np.sort(gestell.example("press_minimal").modes().frequencies_hz)
        np.testing.assert_allclose(np.sort(along.frequencies_hz[0])[1:], here[1:], rtol=2e-3)  # at rest there, not in motion
        self.assertEqual(along.frequencies_hz.shape, (3, 5))
        with tempfile.TemporaryDirectory() as folder:
            self.assertIn("modes_along.csv", along.save(folder))

    def test_stability_knows_that_central_differences_grow_beyond_their_limit(self):
        study = oscillator(damping=0).add("run", method="bdf", step=2.1 / (20 * np.pi), end="100 s").stability()
        central, = [m for m in study.methods if m["method"] == "central differences"]
        self.assertEqual((central["growing"], study.methods[1]["growing"]), (1, 0))
        self.assertAlmostEqual(study.frequencies_hz[0], 10, delta=1e-9)

    def test_size_gives_a_scene_that_keeps_the_tolerance(self):
        scene = oscillator().watch(x="mass.displacement").add("run", method="bdf", step="0.1 ms", end="50 ms")
        size = scene.size(0.01, "x.min")
        exact = scene.copy().add("run", tolerance=1e-11).run(peaks="x").peaks["x"].min
        self.assertTrue(size.met)
        self.assertLess(abs(size.scene.run(peaks="x").peaks["x"].min - exact), 0.01 * 5e-3)

    def test_derivatives_of_a_scene_without_a_file(self):
        scene = oscillator(stiffness="c").parameters(c="40 kN/m").watch(x="mass.displacement").add("run", tolerance=1e-10, end="60 ms")
        key, c, step = "parameters.c", 4e4, 40.
        derivative = scene.run(sensitivities=key).sensitivities["x.min"][key]
        below, above = (scene.copy().set(key, c + d).run(peaks="x").peaks["x"].min for d in (-step, step))
        self.assertAlmostEqual(derivative / ((above - below) / (2 * step)), 1, delta=1e-4)

    def test_sparse_matrices_show_the_memory_of_the_frame(self):
        full = gestell.example("press_minimal").full_frame()
        values, rows, begins, n = full.csc("M")
        self.assertEqual((list(values[values != 0]), n, full.interfaces["table"]), ([9500, 13000], 2, {"uz": 1}))
        self.assertFalse(values.flags.owndata or values.flags.writeable)
        del full
        gc.collect()
        self.assertEqual(values.sum(), 22500)


class Errors(unittest.TestCase):
    def test_name_file_line_and_key(self):
        for call, expected in (
            (lambda: gestell.loads("[run]\nend = 1\nstep = 0.1\nstp = 3\n[body.a]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 1").check(),
             (None, 4, "run.stp")),
            (lambda: oscillator(stiffness="3 kg").check(), (None, None, "element.spring.stiffness")),
            (lambda: oscillator().add("element.spring", frm="mass").check(), (None, None, "element.spring.frm")),
            (lambda: oscillator().set("run.stp", 1).set("run.step", 1e-3).run(end=1), (None, None, "run.stp")),
            (lambda: gestell.Scene().body("a", "planr").check(), (None, None, "body.a.type"))):
            with self.assertRaises(gestell.SceneError) as caught:
                call()
            self.assertEqual((caught.exception.file, caught.exception.line, caught.exception.key), expected, str(caught.exception))
        with self.assertRaises(gestell.SceneError) as caught:
            gestell.example("press_minimal").set("parameters.c_P", -1).check()
        self.assertTrue(caught.exception.file.endswith("press_minimal.toml"))
        self.assertGreater(caught.exception.line, 100)

    def test_speak_of_arguments(self):
        with self.assertRaisesRegex(gestell.InputError, "from_ and to are missing"):
            gestell.example("press_minimal").periodic(along="parameters.c_P")
        with self.assertRaisesRegex(gestell.SceneError, "no single frame"):
            oscillator().full_frame()
        with self.assertRaisesRegex(gestell.InputError, "^along: there is no coordinate"):
            gestell.example("press_minimal").modes_along("cran")


class Help(unittest.TestCase):
    def test_every_public_name_is_explained_and_quantities_have_units(self):
        public = [getattr(gestell, name) for name in gestell.__all__]
        for thing in public:
            self.assertTrue(inspect.getdoc(thing), thing)
            for name, member in inspect.getmembers(thing) if inspect.isclass(thing) else []:
                inherited = any(name in vars(base) for base in thing.__mro__[1:])
                if not name.startswith("_") and not inherited and member is not None:
                    self.assertTrue(inspect.getdoc(member), f"{thing.__name__}.{name}")
        for thing, name in ((gestell.Result, "t"), (gestell.Peak, "t_max"), (gestell.Frame, "M"), (gestell.Frame, "mass"),
                            (gestell.FullFrame, "C"), (gestell.StateSpace, "t"), (gestell.Result, "energy")):
            self.assertRegex(inspect.getdoc(getattr(thing, name)), r"\[(s|kg|J|N/m)\]|kg\.$", name)

    def test_stub_names_what_there_is(self):
        stub = (pathlib.Path(gestell.__file__).resolve().parent / "_gestell.pyi").read_text()
        for kind in (_gestell.Result, _gestell.Frame, _gestell.FullFrame, _gestell.Peak, _gestell.Event, _gestell.Finding,
                     _gestell.StateSpace):
            body = stub.split(f"class {kind.__name__}:")[1].split("\nclass ")[0]
            own = {name for name in vars(kind) if not name.startswith("_")} - {"summary", "plot"}
            for name in own:
                self.assertRegex(body, rf"\bdef {name}\(|\b{name}:", f"{kind.__name__}.{name}")


if __name__ == "__main__":
    unittest.main()
