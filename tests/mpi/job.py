"""MPI jobs of $GNOMON_MPI on this machine, beside $GNOMON, which is one process."""
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest

GNOMON, GNOMON_MPI = os.environ["GNOMON"], os.environ["GNOMON_MPI"]
MPIEXEC = os.environ.get("MPIEXEC") or "mpirun"
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
# More processes than processors, none of which spins; as any user; without a remote shell; messages through memory that
# needs no permission to look into other processes.
SETTINGS = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_plm": "isolated",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
}


SLOW = "GNOMON_SLOW" in os.environ  # all that is asked, which takes minutes; else a little of each


def slow(test):
    return unittest.skipUnless(SLOW, "slow")(test)


def command(processes, *words, program=GNOMON_MPI):
    return [MPIEXEC, "-n", str(processes), str(program), *map(str, words)]


def start(processes, *words, program=GNOMON_MPI, settings=None, **options):
    environment = {**os.environ, **SETTINGS, **(settings or {})}
    return subprocess.Popen(command(processes, *words, program=program), env=environment, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)  # fmt: skip


def has_only_dead_ranks(job):
    """Whether all processes that mpirun has started have ended, and it has not asked how."""
    try:
        children = pathlib.Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()
        states = [pathlib.Path(f"/proc/{child}/stat").read_text().rsplit(")", 1)[1].split()[0] for child in children]
    except OSError:
        return False
    return bool(states) and set(states) == {"Z"}


class Told:
    """What came of a job. Its own lines alone: mpirun says things, too, when a rank fails. Once in a while, where ranks
    were killed, Open MPI 4.1.4's mpirun waits in its last step for a lock of its own (of libpmix) when all are gone: it is
    ended then, which is no success."""

    def __init__(self, job, timeout=120):
        quiet = 0
        for _ in range(timeout):
            try:
                self.stdout, self.stderr = job.communicate(timeout=1)
                break
            except subprocess.TimeoutExpired:
                quiet = quiet + 1 if has_only_dead_ranks(job) else 0
                if quiet == 10:
                    job.kill()
        else:
            job.kill()
            raise AssertionError(f"the job does not end: {job.args}")
        self.returncode = job.returncode
        self.lines = [line for line in self.stderr.splitlines() if line.startswith("gnomon")]


def run(processes, *words, **options):
    return Told(start(processes, *words, **options))


def alone(*words):
    done = subprocess.run([GNOMON, *map(str, words)], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return done.stdout


def ranks_of(job, processes):
    """The process numbers of a job's ranks, by rank, once all are there."""
    for _ in range(2000):
        found = {}
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                if os.readlink(entry / "exe") != os.path.realpath(GNOMON_MPI):
                    continue
                told = dict(row.split(b"=", 1) for row in (entry / "environ").read_bytes().split(b"\0") if b"=" in row)
                if int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1]) == job.pid:
                    found[int(told[b"OMPI_COMM_WORLD_RANK"])] = int(entry.name)
            except (OSError, KeyError, ValueError):
                continue
        if len(found) == processes or job.poll() is not None:
            return found
        time.sleep(0.005)
    raise AssertionError("the ranks do not start")


class JobTest(unittest.TestCase):
    """In a folder of its own, `place`."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="gnomon_mpi_")
        cls.place = pathlib.Path(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def made(self, kind, triangles):
        mesh = self.place / f"{kind}_{triangles}.ply"
        if not mesh.exists():
            alone("make", kind, "--triangles", triangles, "-o", mesh)
        return mesh

    def of_rank(self, rank, limit):
        """A program that is gnomon-mpi, with `limit` of the shell before it in one rank."""
        program = self.place / "limited.ply"  # not counted among what is left
        program.write_text(f'#!/bin/bash\n[ "$OMPI_COMM_WORLD_RANK" != {rank} ] || {limit}\nexec {GNOMON_MPI} "$@"\n')
        program.chmod(0o755)
        return program

    def left(self):
        """What is in the folder beside meshes."""
        return sorted(path.name for path in self.place.iterdir() if path.suffix != ".ply")

    def hash_alone(self, *words):
        model = self.place / "alone.gnm"
        told = json.loads(alone("build", *words, "-o", model, "--json"))
        model.unlink()
        return told["content_hash"]
