"""Tests of mezha.py with the program itself: python -m unittest, with MEZHA naming the program. tests/python.rs runs them."""

import json
import os
import tempfile
import unittest
import warnings
from pathlib import Path

import numpy as np

import mezha

ROOT = Path(__file__).resolve().parent.parent
FIRST = ROOT / "docs" / "first"


class WithFolder(unittest.TestCase):
    def setUp(self):
        # Meshes are coarse here, of which the program warns.
        warnings.simplefilter("ignore", mezha.MezhaWarning)
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        # mpirun as root, in a container say.
        os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")


class Results(WithFolder):
    def test_arrays_are_those_of_the_run(self):
        for ranks in (1, 2):
            result = mezha.run(FIRST, ranks, out=self.folder / str(ranks), mesh__refine=2, **{"body.strip.young": 70e3})
            self.assertTrue(result.converged and result.contacts == ["seam"] and result.provenance["ranks"] == ranks)
            seam, fields, summary = result.contact("seam"), result.fields(), result.summary
            self.assertAlmostEqual(seam.s[-1], summary["contact"]["seam"]["length"])
            self.assertAlmostEqual(seam.integral(seam.pressure) / summary["contact"]["seam"]["force"], 1, delta=1e-9)
            forces = result.forces()
            self.assertEqual((forces.name, forces.trust), (["seam"], [summary["contact"]["seam"]["trust"]]))
            self.assertEqual(forces.force[0], summary["contact"]["seam"]["force"])
            resultant = summary["contact"]["seam"]["resultant"]
            self.assertTrue(np.allclose(forces.direction[0] * np.hypot(*resultant), resultant))
            moment = forces.place[0, 0] * resultant[1] - forces.place[0, 1] * resultant[0]
            self.assertAlmostEqual(moment / summary["contact"]["seam"]["moment"], 1, delta=1e-2)
            self.assertTrue(np.allclose(np.hypot(seam.nx, seam.ny), 1) and np.all(seam.gap[seam.pressure > 1] < 1e-3))
            self.assertEqual(len(fields.triangles), summary["mesh"]["triangles"])
            self.assertEqual((fields.triangles.shape[1], fields.stress.shape[1]), (6, 4))
            self.assertEqual(set(fields.rank), set(range(ranks)))
            largest = np.hypot(*fields.displacement.T).max()
            self.assertAlmostEqual(largest / summary["displacement_max"], 1, delta=1e-12)
            a, b, c = (fields.points[fields.corners[:, k]] for k in range(3))
            area = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2
            self.assertTrue(np.all(area > 0))
            middle = fields.points[fields.triangles[:, 3]]
            self.assertTrue(np.allclose(middle, (a + b) / 2))
            xx, yy, xy, zz = fields.stress.T
            von_mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * xy**2)
            self.assertTrue(np.allclose(fields.von_mises, von_mises))
            self.assertEqual(len(result.history["active"]), len(summary["outer"]))
            with self.assertRaisesRegex(KeyError, "seam"):
                result.contact("sea")

    def test_steps_have_their_own_files(self):
        result = mezha.run(ROOT / "cases" / "closing_gap", 1, out=self.folder / "gap", mesh__refine=0)
        steps = result.steps
        self.assertEqual([step.number for step in steps], [1, 2, 3, 4, 5, 6])
        forces = [step.contact("seam").integral(step.contact("seam").pressure) for step in steps]
        self.assertTrue(forces[1] < 1e-9 < 0.1 < forces[3] < forces[5], forces)
        self.assertEqual(steps[0].forces().verdict, ["nothing presses"])
        self.assertTrue(np.all(np.isnan(steps[0].forces().direction)) and steps[5].forces().force[0] > 0.1)
        heights = [step.fields().displacement[:, 1].min() for step in steps]
        self.assertTrue(np.all(np.diff(heights) < 0))
        self.assertEqual(steps[5].factors, {"press": 1.0})
        self.assertTrue(result.trusted and steps[1].trusted)
        # One bad step is enough.
        result.summary["steps"][1]["contact"]["seam"]["trust"] = False
        self.assertTrue(result.converged and steps[5].trusted and not steps[1].trusted and not result.trusted)

    def test_a_run_without_fields_says_so(self):
        with self.assertWarnsRegex(mezha.MezhaWarning, "^pressure unreliable: contact seam") as warned:
            result = mezha.run(FIRST, 1, out=self.folder / "bare", mesh__refine=0, output__fields=False)
        self.assertEqual(Path(warned.filename).name, Path(__file__).name)
        self.assertTrue(result.converged and not result.trusted)
        self.assertGreater(len(result.contact("seam").s), 5)
        with self.assertRaisesRegex(FileNotFoundError, "output.fields"):
            result.fields()
        with self.assertRaisesRegex(FileNotFoundError, "summary.json"):
            mezha.Result(self.folder)

    def test_an_interrupted_run_says_why_files_are_missing(self):
        summary = {"case": "a", "status": "interrupted", "reason": "SIGTERM after 3.0 s", "contact": {}}
        (self.folder / "summary.json").write_text(json.dumps(summary))
        result = mezha.Result(self.folder)
        self.assertFalse(result.converged or result.trusted)
        with self.assertRaisesRegex(FileNotFoundError, "no fields: the run was interrupted: SIGTERM"):
            result.fields()
        with self.assertRaisesRegex(KeyError, "interrupted: SIGTERM"):
            result.contact("seam")


class Errors(WithFolder):
    def test_errors_have_the_words_of_the_program(self):
        for ranks in (1, 2):
            with self.assertRaises(mezha.MezhaError) as told:
                mezha.run(FIRST, ranks, out=self.folder / "no", body__strip__yuong=1.0)
            words = str(told.exception)
            self.assertEqual(told.exception.code, 2)
            self.assertIn('did you mean "young"?', words)
            self.assertNotIn("mpirun", words)
            self.assertIn("body.strip.yuong=1.0", told.exception.command)

    def test_ranks_and_program_are_looked_at_first(self):
        for ranks in (0, -1, 1.5, True):
            with self.assertRaisesRegex(ValueError, "a whole number of at least 1"):
                mezha.run(FIRST, ranks, out=self.folder / "no")
        for ranks in (1, 2):
            with self.assertRaisesRegex(FileNotFoundError, "no-mezha is no program"):
                mezha.run(FIRST, ranks, out=self.folder / "no", program=self.folder / "no-mezha")

    def test_what_has_not_converged_has_a_result(self):
        sets = {"exact.must_hold": True, "exact.contact.seam.force.value": 51.0}
        with self.assertRaises(mezha.NotConverged) as told:
            mezha.run(FIRST, 2, out=self.folder / "missed", mesh__refine=0, **sets)
        self.assertEqual((told.exception.code, told.exception.result.status), (3, "not_converged"))
        self.assertIn("expected values are missed", str(told.exception))
        self.assertAlmostEqual(told.exception.result.summary["contact"]["seam"]["force"], 50, delta=1e-4)

    def test_a_result_is_replaced_when_asked(self):
        run = lambda **more: mezha.run(FIRST, 1, out=self.folder / "one", mesh__refine=0, output__fields=False, **more)
        run()
        with self.assertRaisesRegex(mezha.MezhaError, "--force"):
            run()
        self.assertEqual(run(force=True, petsc=["-ksp_type", "gcr"]).provenance["petsc_options"], "-ksp_type gcr")


class Studies(WithFolder):
    def test_a_study_is_a_table(self):
        text = "cases = [%s]\nranks = [1]\nerror = 'errors.force_seam'\n[grid]\n'mesh.refine' = [0, 1]\n"
        (self.folder / "study.toml").write_text(text % json.dumps(str(FIRST / "case.toml")))
        study = mezha.study(self.folder, self.folder / "made")
        self.assertEqual(list(study.column("mesh.refine")), [0, 1])
        self.assertTrue(np.all(study.column("errors.force_seam") < 1e-6))
        self.assertEqual(study.result(1).summary["mesh"]["triangles"], 4 * study.result(0).summary["mesh"]["triangles"])
        with self.assertRaisesRegex(KeyError, "no column 'x'"):
            study.column("x")

    def test_a_row_without_a_result_tells_why(self):
        text = "cases = [%s]\nranks = [1]\n[grid]\n'mesh.refine' = [0, 99]\n"
        (self.folder / "study.toml").write_text(text % json.dumps(str(FIRST / "case.toml")))
        study = mezha.study(self.folder, self.folder / "made")
        self.assertEqual(study.result(0).status, "converged")
        with self.assertRaisesRegex(mezha.MezhaError, "row 1 .*refused.*from 0 to 12") as told:
            study.result(1)
        self.assertEqual(told.exception.code, 2)


class Values(unittest.TestCase):
    def test_values_are_toml(self):
        table = [
            (True, "true"), (3, "3"), (1e-9, "1e-09"), (np.float64(0.5), "0.5"), ("auto", '"auto"'), ([0, 0.5, 1], "[0, 0.5, 1]"),
            (np.array([[0, 3]]), "[[0, 3]]"), ({"centre": (0, 1)}, '{ "centre" = [0, 1] }'), (np.bool_(False), "false"),
        ]
        for value, text in table:
            self.assertEqual(mezha._toml(value), text)
        with self.assertRaisesRegex(TypeError, "cannot be written as TOML"):
            mezha._toml(None)


if __name__ == "__main__":
    unittest.main()
