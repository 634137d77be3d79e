"""What the convergence report reads from its measurements: errors of pictures, time to an error, intervals, tables."""

import ast
import random
import re
import sys
import unittest
from pathlib import Path
from unittest import mock

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "apps/bench"), str(ROOT / "apps/bench/peers")]
import convergence_numbers as numbers
import convergence_tables as tables

try:
    import numpy as np

    import convergence_pictures as pictures
    import geometry
except ImportError:  # only whoever measures needs it
    np = None
try:
    import convergence_plots as plots
    import convergence_renderers as renderers
except ImportError:
    plots = None


def curve(c, p, seconds=(0.1, 0.4, 1.6, 6.4)):
    return [(s, c / s**p) for s in seconds]


def rungs(c, p=1.0, spread=0.0, seeds=4, seconds=(0.1, 0.4, 1.6)):
    dice = random.Random(7)
    return [{"spp": 100 * s, "seconds": [s] * seeds, "rays": [1e6 * s] * seeds, "estimates": [c / s**p] * seeds,
             "errors": [c / s**p * (1 + spread * dice.uniform(-1, 1)) for _ in range(seeds)], "inside": seeds}
            for s in seconds]


class SecondsToAnError(unittest.TestCase):
    def test_are_exact_on_a_power_law(self):
        for p in (0.8, 1.0, 1.5):
            for error in (1e-2, 1e-3, 1e-4):
                seconds, _ = numbers.seconds_to(error, curve(2e-3, p))
                self.assertAlmostEqual(seconds / (2e-3 / error) ** (1 / p), 1, places=9)

    def test_say_where_they_are_extrapolated(self):
        known = curve(1e-3, 1)  # from 1e-2 down to 1.6e-4
        self.assertEqual([numbers.seconds_to(e, known)[1] for e in (2e-2, 9e-3, 2e-4, 1e-4)],
                         [True, False, False, True])

    def test_follow_the_slope_that_is_near(self):
        bent = [(1, 1e-1), (2, 5e-2), (4, 2.5e-2), (8, 6.25e-3), (16, 1.5625e-3)]  # 1/s, then 1/s^2
        self.assertAlmostEqual(numbers.seconds_to(5e-2, bent)[0], 2)
        self.assertAlmostEqual(numbers.seconds_to(1e-4, [*bent, (32, 3.90625e-4)])[0], 63.246, places=3)

    def test_of_one_point_or_of_noise_are_those_of_independent_samples(self):
        self.assertAlmostEqual(numbers.seconds_to(1e-3, [(2, 1e-2)])[0], 20)
        rising = numbers.seconds_to(1e-3, [(1, 1e-2), (4, 2e-2)])[0]
        self.assertGreater(rising, 20)
        self.assertLess(rising, 80)

    def test_are_unknown_where_no_error_is_positive(self):
        self.assertEqual(numbers.seconds_to(1e-3, [(1, -1e-5), (2, 0)]), (None, True))


class Ratio(unittest.TestCase):
    def test_is_to_the_fastest(self):
        middle, low, high, best = numbers.ratio_to_best(
            1e-3, rungs(2e-3), {"slow": rungs(8e-3), "fast": rungs(4e-3), "blind": []}, resamples=50)
        self.assertEqual(best, "fast")
        for value in (middle, low, high):  # without noise there is no interval
            self.assertAlmostEqual(value, 0.5)

    def test_has_an_interval_that_grows_with_the_noise(self):
        wide = []
        for spread in (0.05, 0.4):
            middle, low, high, _ = numbers.ratio_to_best(1e-3, rungs(2e-3), {"peer": rungs(4e-3, spread=spread)})
            self.assertTrue(low < middle < high)
            wide.append(high - low)
        self.assertGreater(wide[1], 4 * wide[0])

    def test_is_none_without_peers(self):
        self.assertIsNone(numbers.ratio_to_best(1e-3, rungs(2e-3), {}))


class Slope(unittest.TestCase):
    def test_is_that_of_the_samples(self):
        self.assertAlmostEqual(numbers.slope_over_samples(rungs(1e-3, p=1.3)), -1.3)


@unittest.skipIf(np is None, "needs numpy")
class Pictures(unittest.TestCase):
    def setUp(self):
        self.noise = np.random.default_rng(3)
        self.truth = np.linspace(1, 2, 100 * 100 * 3).reshape(100, 100, 3)

    def noisy(self, deviation):
        return self.truth + deviation * self.noise.standard_normal(self.truth.shape)

    def test_relmse_is_that_of_limn_compare(self):
        picture, reference = np.full((1, 1, 3), 0.5), np.full((1, 1, 3), 0.3)
        self.assertAlmostEqual(pictures.relmse(picture, reference), 0.04 / 0.1)

    def test_the_error_of_the_reference_is_subtracted(self):
        halves = [self.noisy(0.1), self.noisy(0.1)]  # their mean is as wrong as what it judges
        picture = self.noisy(0.07)
        true_error = pictures.relmse(picture, self.truth)
        self.assertLess(abs(pictures.corrected_relmse(picture, halves) / true_error - 1), 0.05)

    def test_pictures_of_the_same_agree_but_for_noise(self):
        agreed = pictures.agreement([self.noisy(0.1), self.noisy(0.1)], [self.noisy(0.2), self.noisy(0.2)])
        self.assertFalse(numbers.solves_another_problem(agreed))
        # The mean over 100 pixels of two halves: deviations of 0.1 and 0.2 over sqrt(200), weighed by the brightness.
        weight = np.mean(1 / (self.truth**2 + 0.01))
        self.assertLess(abs(agreed["noise"] / np.sqrt(0.05 / 200 * weight) - 1), 0.1)

    def test_pictures_of_something_else_do_not(self):
        agreed = pictures.agreement([self.noisy(0.1), self.noisy(0.1)],
                                    [1.05 * self.noisy(0.1), 1.05 * self.noisy(0.1)])
        self.assertTrue(numbers.solves_another_problem(agreed))
        self.assertLess(abs(agreed["difference"] / 0.05 - 1), 0.15)

    def test_blocks_are_means(self):
        ramp = np.arange(12.0).reshape(2, 6, 1)
        self.assertEqual(pictures.block_means(ramp, 2).ravel().tolist(), [3.5, 5.5, 7.5])


@unittest.skipIf(np is None, "needs numpy")
class PeersGeometry(unittest.TestCase):
    def volume(self, mesh):
        corners = mesh[0].astype(float)[mesh[1]]
        return np.sum(np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2]) / 6

    def test_balls_are_closed_and_turned_outward(self):
        for radius in (0.5, -0.5):
            vertices, triangles, normals = geometry.sphere_mesh([0, 0, 0], radius, rings=48)
            edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]).tolist()
            ways = {tuple(edge) for edge in edges}
            self.assertEqual(len(ways), len(edges))
            self.assertTrue(all((b, a) in ways for a, b in ways))
            self.assertLess(abs(self.volume((vertices, triangles)) / (4 / 3 * np.pi * radius**3) - 1), 3e-3)
            self.assertLess(np.abs(normals * radius - vertices).max(), 1e-5 * abs(radius))

    def test_a_ground_is_fine_where_it_is_seen(self):
        vertices, triangles, _ = geometry.sphere_mesh([0, -1000, 0], 1000)
        middles = vertices.astype(float)[triangles].mean(axis=1)
        near = middles[np.hypot(middles[:, 0], middles[:, 2]) < 20]
        self.assertGreater(len(near), 1000)
        self.assertLess(np.abs(np.linalg.norm(near - [0, -1000, 0], axis=1) - 1000).max(), 2e-4)

    def test_a_lamp_has_a_wall_behind_it_where_it_hangs_under_the_ceiling(self):
        lamp = {"corner": [2, 9.9, 2], "edge_u": [-1, 0, 0], "edge_v": [0, 0, -1], "material": {"kind": "light"}}
        ceiling = {"corner": [0, 10, 0], "edge_u": [5, 0, 0], "edge_v": [0, 0, 5], "material": {"kind": "lambertian"}}
        self.assertLess(geometry.quad_corners(lamp)[1][1], 0)
        self.assertTrue(geometry.has_wall_behind(lamp, [lamp, ceiling]))
        for away in ({**lamp, "corner": [2, 5, 2]}, {**lamp, "edge_u": [1, 0, 0]}):
            self.assertFalse(geometry.has_wall_behind(away, [away, ceiling]))

    def test_the_sky_is_above(self):
        sky = geometry.sky_image({"bottom": [1, 1, 1], "top": [0.5, 0.7, 1]}, height=100)
        self.assertEqual(sky.shape, (100, 200, 3))
        self.assertLess(np.abs(sky[0, 0] - [0.5, 0.7, 1]).max(), 1e-3)
        self.assertLess(np.abs(sky[-1, 7] - 1).max(), 1e-3)
        self.assertLess(np.abs(sky[25, 3, 0] - (1 - (1 + np.cos(np.pi * 25.5 / 100)) / 4)).max(), 1e-6)


def row(name, c, difference=0.0, **more):
    return {"name": name, "version": "1", "settings": "best", "session": "now", "rungs": rungs(c),
            "seconds": {"start": 1, "load": 0.5, "setup": 0.25}, "all_threads": [2e5 * 4],
            "agreement": {"difference": difference, "noise": 1e-3}, **more}


class Report(unittest.TestCase):
    head = {"command": "c", "date": "d", "commit": "x", "processor": "p", "cores": 2, "sources": "s", "size": 2,
            "seeds": 4, "minutes": 3}

    def report(self, **rows):
        raw = {"head": self.head, "scenes": {"smoke": rows}, "missing": {"cycles": "pip cannot install bpy"}}
        return tables.report(raw)

    def test_every_scene_has_a_title(self):
        source = (ROOT / "apps/bench/transport_scenes.cpp").read_text()
        table = source[source.index("entries()"):source.index("}  // namespace")]
        self.assertEqual(re.findall(r'\{"([a-z-]+)",', table), list(tables.SCENES))

    def test_states_seconds_and_ratio(self):
        text = self.report(limn=row("limn", 1e-3), mitsuba=row("Mitsuba 3", 4e-3))
        self.assertIn("| smoke in the Cornell box (figure 16) | 1 | ~4 | 0.25 (0.25..0.25) of Mitsuba 3 |", text)
        self.assertIn("without cycles: pip cannot install bpy", text)
        # 160 samples of 4 pixels in 1.6 s; 8e5 samples a second on all threads are 2000 times as many.
        self.assertIn("| Mitsuba 3 | 0.4 | ~4 | ~40 | ~0.002 | 0.0004 | 0.8 |", text)

    def test_marks_a_goal_that_is_missed(self):
        text = self.report(limn=row("limn", 1e-3), mitsuba=row("Mitsuba 3", 1.5e-3))
        self.assertIn("| **0.67 (0.67..0.67) of Mitsuba 3** |", text)

    def test_compares_with_nobody_who_solves_another_problem(self):
        text = self.report(limn=row("limn", 1e-3), mitsuba=row("Mitsuba 3", 1e-4, difference=0.05),
                           luxcore=row("LuxCore", 2e-2))
        self.assertIn("of LuxCore", text)
        self.assertNotIn("of Mitsuba", text)
        self.assertIn("| **5.00 % ± 0.10** |", text)

    def test_says_who_could_not(self):
        text = self.report(limn=row("limn", 1e-3), mitsuba={**row("Mitsuba 3", 1), "rungs": [], "failed": "no checker"})
        self.assertIn("Mitsuba 3: no checker", text)
        self.assertIn("| – | – |", text)

    def test_marks_another_session(self):
        text = self.report(limn=row("limn", 1e-3), mitsuba=row("Mitsuba 3", 1e-3, session="earlier"))
        self.assertIn("| Mitsuba 3 † |", text)


BROUGHT_BY = {"mitsuba": {"mitsuba", "drjit"}, "cycles": {"bpy", "mathutils"}, "luxcore": {"pyluxcore"}}


def imports_of(path):
    """The modules that a source imports at its head and that Python does not have of itself."""
    names = set()
    for node in ast.parse(path.read_text()).body:
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names.add(node.module.split(".")[0])
    return names - sys.stdlib_module_names


@unittest.skipIf(plots is None, "numpy and matplotlib are not installed")
class Renderers(unittest.TestCase):
    def test_each_has_a_line_of_its_own(self):
        keys = [key for key, _, _ in renderers.LADDER] + list(renderers.PEERS)
        self.assertEqual(sorted(keys), sorted(plots.STYLES))

    def test_a_peer_alone_gets_all_that_its_worker_imports(self):
        folder = ROOT / "apps/bench/peers"
        own = {path.stem for path in folder.glob("*.py")}
        for peer in renderers.PEERS:
            with mock.patch.object(renderers.subprocess, "run") as run:
                run.return_value.returncode = 0
                self.assertEqual(renderers.install_peers([peer]), {})
            installed = run.call_args_list[-1].args[0]
            self.assertIn(renderers.PEERS[peer], installed)
            for name in ("worker", "geometry", f"{peer}_peer"):
                for module in imports_of(folder / f"{name}.py") - own - BROUGHT_BY.get(peer, set()):
                    self.assertIn(module, installed, f"{name}.py")


if __name__ == "__main__":
    unittest.main()
