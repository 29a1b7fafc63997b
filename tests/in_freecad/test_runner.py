# SPDX-License-Identifier: LGPL-2.1-or-later
"""Jobs in a child process: equal results, quick cancel, a dead child that harms nobody."""

from __future__ import annotations

import os
import signal
import sys
import time
import unittest
from pathlib import Path
from unittest import mock

import numpy as np
import Part
from parts import InDocument, drilled_block, thin_tube

from freecad_tetra import api, kernel_file
from freecad_tetra.errors import BadOption, Cancelled, InvalidSolid, KernelMissing, WorkerDied
from freecad_tetra.kernel import Validation
from freecad_tetra.model import ConvexCells, Solid, TetMesh
from freecad_tetra.workbench import child_python, kernel_path, runner, workers


def long_work() -> runner.Job:
    """Return a job that takes minutes: a bumpy torus of 19,200 triangles."""
    return runner.start("convex_cells", bumpy_torus(160, 60))


def bumpy_torus(around: int, along: int) -> Solid:
    """Return a torus whose tube is thick and thin in turns."""
    u, v = np.meshgrid(np.arange(around), np.arange(along), indexing="ij")
    a, b = 2 * np.pi * u / around, 2 * np.pi * v / along
    tube = 3 + 0.5 * np.sin(7 * a) * np.sin(5 * b)
    reach = 10 + tube * np.cos(b)
    points = np.stack([reach * np.cos(a), reach * np.sin(a), tube * np.sin(b)], axis=-1)
    here, right = u * along + v, (u + 1) % around * along + v
    up, across = u * along + (v + 1) % along, (u + 1) % around * along + (v + 1) % along
    triangles = np.stack([here, right, across, here, across, up], axis=-1)
    return Solid(points.reshape(-1, 3), triangles.reshape(-1, 3))


def until_it_works(job: runner.Job) -> None:
    """Wait until the kernel has told a first stage of its own."""
    limit = time.monotonic() + 60
    while job.poll().stage in ("start", "tessellate") and time.monotonic() < limit:
        time.sleep(0.01)
    assert not job.poll().done, job.poll()


class Results(InDocument):
    def test_tasks_return_what_the_api_returns(self) -> None:
        shape = drilled_block()
        mesh = runner.start("tetrahedralize", shape, {"direction": "z"}).wait()
        self.assertIsInstance(mesh, TetMesh)
        wanted = api.tetrahedralize(shape, direction="z")
        for name in ("points", "tets", "skin", "skin_face"):
            np.testing.assert_array_equal(getattr(mesh, name), getattr(wanted, name))
        self.assertFalse(mesh.points.flags.writeable)
        cells = runner.start("convex_cells", shape).wait()
        self.assertIsInstance(cells, ConvexCells)
        np.testing.assert_array_equal(cells.points, api.convex_cells(shape).points)
        self.assertIsInstance(runner.start("validate", shape).wait(), Validation)

    def test_a_solid_without_a_shape(self) -> None:
        solid = api.as_solid(drilled_block())
        wanted = Solid(solid.vertices, solid.triangles).volume()
        self.assertAlmostEqual(runner.start("tetrahedralize", solid).wait().volumes().sum(), wanted)

    def test_the_child_gets_finer_tessellations(self) -> None:
        found = runner.start("validate", thin_tube()).wait()
        self.assertEqual(found.solid.notes["retried_for"], ["volume"])

    def test_progress_is_told(self) -> None:
        told: list[tuple[str, float]] = []
        runner.start("tetrahedralize", drilled_block()).wait(lambda s, f: told.append((s, f)))
        stages = [stage for stage, _ in told]
        self.assertIn("validate", stages)
        self.assertTrue(all(0 <= fraction <= 1 for _, fraction in told))

    def test_two_jobs_at_once(self) -> None:
        jobs = [runner.start(task, drilled_block()) for task in runner.TASKS]
        self.assertEqual(len({job.worker.pid for job in jobs}), len(jobs))
        for job in jobs:
            job.wait()


class Ends(InDocument):
    def test_cancel_ends_within_half_a_second(self) -> None:
        job = long_work()
        until_it_works(job)
        start = time.monotonic()
        job.cancel()
        self.assertIsInstance(job.poll().error, Cancelled)
        job.worker.obituary()  # waits for the end of the process
        self.assertLess(time.monotonic() - start, 0.5)
        with self.assertRaises(Cancelled):
            job.wait()

    def test_progress_that_says_no_cancels(self) -> None:
        with self.assertRaises(Cancelled):
            long_work().wait(lambda stage, fraction: False)

    def test_progress_that_raises_leaves_no_child(self) -> None:
        job = long_work()
        with self.assertRaises(ZeroDivisionError):
            job.wait(lambda stage, fraction: bool(1 / 0))
        job.worker.obituary()

    @unittest.skipIf(os.name == "nt", "signals")
    def test_a_killed_and_a_crashed_child_are_told(self) -> None:
        for number, word in ((signal.SIGKILL, "killed"), (signal.SIGSEGV, "SIGSEGV")):
            with self.subTest(word):
                job = long_work()
                until_it_works(job)
                os.kill(job.worker.pid, number)
                with self.assertRaises(WorkerDied) as caught:
                    job.wait()
                self.assertIn(word, caught.exception.message)
                self.assertTrue(caught.exception.next_step)
        self.assertGreater(len(runner.start("convex_cells", drilled_block()).wait()), 1)

    def test_errors_arrive_as_they_were_raised(self) -> None:
        with self.assertRaises(InvalidSolid) as caught:
            runner.start("validate", Part.makeBox(1, 1, 1).Faces[0]).wait()
        self.assertEqual(caught.exception.defects[0].kind, "no_solid")
        with self.assertRaises(BadOption) as other:
            runner.start("convex_cells", drilled_block(), {"flatness": 99}).wait()
        self.assertIn("flatness", other.exception.message)

    @unittest.skipUnless(sys.platform == "linux", "looks into /proc")
    def test_the_child_ends_with_its_job(self) -> None:
        job = runner.start("validate", drilled_block())
        job.wait()
        limit = time.monotonic() + 10
        while Path(f"/proc/{job.worker.pid}").exists() and time.monotonic() < limit:
            time.sleep(0.01)
        self.assertFalse(Path(f"/proc/{job.worker.pid}").exists())


class WithoutPython(InDocument):
    """Where no Python can be started, a thread does the work."""

    def setUp(self) -> None:
        super().setUp()
        patch = mock.patch.object(child_python, "find", lambda: "")
        patch.start()
        self.addCleanup(patch.stop)

    def test_the_result_is_the_same(self) -> None:
        job = runner.start("convex_cells", thin_tube())
        self.assertIsInstance(job.worker, workers.Thread)
        found = job.wait()
        np.testing.assert_array_equal(found.points, api.convex_cells(thin_tube()).points)

    def test_cancel_is_told_at_once(self) -> None:
        job = long_work()
        until_it_works(job)
        start = time.monotonic()
        job.cancel()
        self.assertIsInstance(job.poll().error, Cancelled)
        self.assertLess(time.monotonic() - start, 0.5)

    def test_errors_arrive(self) -> None:
        with self.assertRaises(InvalidSolid):
            runner.start("validate", Part.makeBox(1, 1, 1).Faces[0]).wait()


class Kernel(unittest.TestCase):
    def test_the_python_is_freecads(self) -> None:
        self.assertTrue(child_python.find(), list(child_python.candidates()))

    def test_only_the_one_module_is_brought_in(self) -> None:
        self.assertEqual(kernel_path.problem(), "")
        self.assertTrue(Path(kernel_path.file()).is_file())
        self.assertFalse([p for p in sys.path if ".venv" in p])

    def test_a_missing_kernel_is_told_with_what_to_run(self) -> None:
        with mock.patch.dict(sys.modules, {kernel_file.MODULE: None}):
            self.assertIn("missing", kernel_path.problem())
            self.assertIn("make install-freecad", kernel_path.problem())
            with self.assertRaises(KernelMissing) as caught:
                runner.start("validate", Part.makeBox(1, 1, 1))
        self.assertIn("make install-freecad", caught.exception.next_step)

    def test_another_version_is_told(self) -> None:
        kernel = kernel_path.bring_in()
        assert kernel is not None
        with (
            mock.patch.object(kernel_file, "__version__", "99.0.0"),
            mock.patch.object(kernel_path, "__version__", "99.0.0"),
        ):
            problem = kernel_path.problem()
        self.assertIn("99.0.0", problem)
        self.assertIn(kernel_file.version_of(kernel), problem)
