"""Force laws and signals that are functions of Python."""

import math
import threading
import unittest

import gestell
import numpy as np

from blanking import with_python_blanking


def oscillator(**law) -> gestell.Scene:
    """A mass of 10 kg on a spring, 5 mm from its rest position."""
    return (gestell.Scene()
            .body("mass", "point", mass="10 kg", position=[0, 0, 0])
            .element("spring", from_="mass", direction=[1, 0, 0], **law)
            .add("start", q={"mass.ux": "5 mm"})
            .add("run", method="bdf", tolerance=1e-9, end="0.3 s")
            .watch(x="mass.ux", F="spring.force"))


def cubic(t, u, v):
    return -4000. * u - 2e7 * u**3 - 20. * v


def slopes(t, u, v):
    return -4000. - 6e7 * u**2, -20.


FORMULA = "-(4000 N/m)*u - 2e7 N/m^3*u^3 - 20 N s/m*v"


class Laws(unittest.TestCase):
    def test_give_the_history_of_the_same_formula(self):
        formula = oscillator(type="formula force", force=FORMULA).run()
        for derivative in (slopes, None):
            own = oscillator(force=cubic, derivative=derivative).run()
            for name in ("x", "F"):
                size = abs(formula[name]).max()
                np.testing.assert_allclose(own[name], formula[name], rtol=0., atol=2e-8 * size)  # ten times the tolerance and more

    def test_with_events_give_the_history_of_the_blanking_press(self):
        scene = gestell.example("press_minimal")
        built_in, own = scene.run(lean=True), with_python_blanking(scene).run(lean=True)
        self.assertEqual([(e.name, e.kind) for e in own.events], [(e.name, e.kind) for e in built_in.events])
        for name in own.columns:
            if not name.startswith("energy") and name not in ("t", "z"):
                sign = -1. if name == "F_u" else 1.  # what acts on the slide, not what it presses with
                np.testing.assert_allclose(sign * own[name], built_in[name], rtol=0., atol=1e-9 * abs(built_in[name]).max(), err_msg=name)

    def test_have_an_event_at_every_rise_of_its_number(self):
        def count(event, t, u, v, s):
            return [s[0] + 1.]

        own = oscillator(force=lambda t, u, v, s: -4000. * u, derivative=lambda t, u, v, s: (-4000., 0.), state=[0.],
                         events=["up"], event_values=lambda t, u, v, s: u, at_event=count)
        rises = [(1.5 + 2. * k) * math.pi / 20. for k in range(6)]  # of 5 mm cos(20 t)
        for run in ({"tolerance": 1e-9}, {"method": "newmark", "step": "1 ms"}):
            times = [event.t for event in own.copy().add("run", **run).run(end="2 s").events]
            self.assertEqual(len(times), len(rises))
            for time, rise in zip(times, rises):  # the period of Newmark's method is (omega h)^2/12 too long
                self.assertAlmostEqual(time, rise, delta=1e-4)

    def test_without_derivatives_do_not_change_the_press(self):
        scene = gestell.example("press_minimal").set("run.end", "0.2 s")
        exact, differences = with_python_blanking(scene).run(lean=True), with_python_blanking(scene, derivative=False).run(lean=True)
        np.testing.assert_allclose(differences["F_P"], exact["F_P"], rtol=0., atol=1e-9 * abs(exact["F_P"]).max())

    def test_are_known_to_modes_periodic_solutions_and_sensitivities(self):
        own, formula = (oscillator(**law).parameters(M="10 kg").set("body.mass.mass", "M")
                        for law in ({"force": cubic, "derivative": slopes}, {"type": "formula force", "force": FORMULA}))
        np.testing.assert_allclose(own.modes().frequencies_hz, formula.modes().frequencies_hz, rtol=1e-12)
        by_mass = [scene.run(sensitivities="parameters.M").sensitivities["x.min"]["parameters.M"] for scene in (own, formula)]
        self.assertAlmostEqual(by_mass[0] / by_mass[1], 1., delta=1e-5)
        driven = [scene.element("load", "force", from_="mass", direction=[1, 0, 0], harmonics=[{"amplitude": "3 N", "frequency": "3 Hz"}])
                  .add("run", method="exact").periodic("shooting")[0] for scene in (own, formula)]
        self.assertAlmostEqual(driven[0]["x"].max() / driven[1]["x"].max(), 1., delta=1e-6)
        np.testing.assert_allclose(sorted(abs(np.array(driven[0].multipliers))), sorted(abs(np.array(driven[1].multipliers))), rtol=1e-5)

    def test_of_threads_are_those_alone(self):
        levels = {"parameters.k": [3000., 4000., 5000.]}
        scene = oscillator(force=cubic, derivative=slopes).parameters(k=1.)
        scene.element("more", "spring-damper", from_="mass", direction=[1, 0, 0], stiffness="k")
        alone, together = ([run.peaks["x"].min for _, run in scene.sweep(levels, ["x"], jobs)] for jobs in (1, 3))
        self.assertEqual(alone, together)

    def test_act_on_angles_as_torques(self):
        scene = (gestell.Scene().body("shaft", "rotor", axis=[0, 1, 0], inertia="2 kg m^2")
                 .element("spring", force=lambda t, u, v: -200. * u, derivative=lambda t, u, v: (-200., 0.), from_="shaft")
                 .add("start", q={"shaft": 0.1}).add("run", method="bdf", tolerance=1e-9, end="0.5 s"))
        run = scene.run(["shaft.angle", "spring.torque"])
        self.assertLess(abs(run["shaft.angle"] - 0.1 * np.cos(10. * run.t)).max(), 1e-7)
        self.assertEqual(run.units["spring.torque"], "N m")


class Failures(unittest.TestCase):
    def fails(self, scene):
        with self.assertRaises(gestell.ComputationFailed) as caught:
            scene.run()
        return caught.exception

    def test_that_are_raised_end_the_run_with_its_results_and_their_traceback(self):
        def breaks(t, u, v):
            if t > 0.1:
                raise ZeroDivisionError("spring broke")
            return -4000. * u

        for derivative in (None, lambda t, u, v: (-4000., 0.)):
            failed = self.fails(oscillator(force=breaks, derivative=derivative))
            self.assertIn('the force law of "spring"', str(failed))
            self.assertIn("laws_test.py", str(failed))
            self.assertIn("ZeroDivisionError: spring broke", str(failed))
            self.assertIsInstance(failed.__cause__, ZeroDivisionError)
            self.assertGreater(failed.result.t[-1], 0.09)
            self.assertTrue(np.isfinite(failed.result["x"]).all())

    def test_that_are_no_number_end_the_run_with_its_results(self):
        failed = self.fails(oscillator(force=lambda t, u, v: -4000. * u if t < 0.1 else math.nan))
        self.assertIn('the force law of "spring" has no finite value', str(failed))
        self.assertGreater(failed.result.t[-1], 0.09)

    def test_of_what_is_returned_are_explained(self):
        self.assertIn("returned None; needs a number", str(self.fails(oscillator(force=lambda t, u, v: None))))
        self.assertIn("needs 2 numbers", str(self.fails(oscillator(force=cubic, derivative=lambda t, u, v: 1.))))
        self.assertIn("takes 1 positional argument", str(self.fails(oscillator(force=lambda t: 0.))))

    def test_of_calls_name_what_is_missing(self):
        with self.assertRaisesRegex(gestell.InputError, "give force=f"):
            oscillator(type="formula force", force="-(4 N/m)*u", derivative=slopes)
        with self.assertRaisesRegex(gestell.InputError, "events need names"):
            oscillator(force=cubic, events=["stop"]).run()
        with self.assertRaisesRegex(gestell.InputError, "scene.element"):
            gestell.Scene().add("element.x", type="formula force", force=cubic)

    def test_of_periodic_solutions_are_computations_that_failed(self):
        def breaks(t, u, v):
            raise KeyError("no table")

        scene = oscillator(force=breaks).element("load", "force", from_="mass", direction=[1, 0, 0],
                                                 harmonics=[{"amplitude": "3 N", "frequency": "3 Hz"}]).add("run", method="exact")
        with self.assertRaises(gestell.ComputationFailed) as caught:
            scene.periodic("shooting")
        self.assertIsInstance(caught.exception.__cause__, KeyError)


class Signals(unittest.TestCase):
    def scene(self, function, of=("mass.vx", "F"), unit="W") -> gestell.Scene:
        return oscillator(force=cubic, derivative=slopes).signal("P", function, of, unit)

    def test_are_functions_of_others(self):
        run = self.scene(lambda v, F: v * F).watch(v="mass.vx").run()
        np.testing.assert_allclose(run["P"], run["v"] * run["F"], rtol=1e-12, atol=1e-12)
        self.assertEqual(run.units["P"], "W")
        self.assertGreaterEqual(run.peaks["P"].max, run["P"].max())
        alone = self.scene(lambda v, F: v * F).run(peaks="P")
        self.assertAlmostEqual(alone.peaks["P"].max, run.peaks["P"].max, delta=1e-6 * run.peaks["P"].max)

    def test_that_fail_end_the_run_with_its_results(self):
        def late(t, x):
            return math.log(0.1 - t)

        with self.assertRaises(gestell.ComputationFailed) as caught:
            self.scene(late, ("t", "mass.ux"), "1").run()
        self.assertIn('the function of the signal "P" raised', str(caught.exception))
        self.assertIsInstance(caught.exception.__cause__, ValueError)
        self.assertGreater(caught.exception.result.t[-1], 0.05)

    def test_of_unknown_arguments_are_errors(self):
        with self.assertRaisesRegex(gestell.InputError, "mass.vz"):
            self.scene(lambda v: v, "mass.vzz").run()

    def test_have_no_frequency_response(self):
        with self.assertRaisesRegex(gestell.InputError, "no linear form"):
            self.scene(lambda v, F: v * F).frequency_response("mass.ux", "P", lowest=1, highest=20)


class Scenes(unittest.TestCase):
    def test_with_functions_are_copied_and_shown_but_not_written(self):
        scene = oscillator(force=cubic, derivative=slopes)
        again = gestell.Scene(scene.copy().to_dict())
        self.assertEqual(again.run(peaks="x").peaks["x"].min, scene.run(peaks="x").peaks["x"].min)
        self.assertEqual(repr(scene["element.spring.force"]), "<function cubic>")
        with self.assertRaisesRegex(gestell.SceneError, "no file can hold"):
            scene.copy().set("element.spring.force", "<function cubic>").run()

    def test_release_their_functions(self):
        import gc
        import weakref

        class Law:
            def force(self, t, u, v):
                return -4000. * u

        law = Law()
        alive = weakref.ref(law)
        scene = oscillator(force=law.force)
        worker = threading.Thread(target=lambda scene=scene: scene.run(peaks="x"))
        worker.start()
        worker.join()
        del law, scene, worker
        gc.collect()
        self.assertIsNone(alive())


if __name__ == "__main__":
    unittest.main()
