"""Ranks of a communicator of mpi4py share a solve: the bytes of one process, and whatever befalls one of them ends it for all."""
import os
import pathlib
import shutil
import subprocess
import sys
import textwrap

import pytest
from conftest import CASES, SQUARE

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from mpi_environment import MPI

import raytube as rt

pytest.importorskip("mpi4py")
pytestmark = pytest.mark.filterwarnings("ignore::raytube.RaytubeWarning")
LIMIT = 120  # who waits for ever is stopped [s]
ENVIRONMENT = os.environ | MPI

START = f"""
    import os, signal, sys, threading, warnings
    import numpy as np, raytube as rt
    from mpi4py import MPI

    warnings.simplefilter("ignore", rt.RaytubeWarning)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    comm = MPI.COMM_WORLD
    trihedral, cube = {str(CASES / "trihedral/case.toml")!r}, {str(CASES / "powercube/case.toml")!r}
    plate = rt.Target({SQUARE}, [[0, 1, 2, 3]], unit="m")
    looks = rt.monostatic(theta_deg=np.arange(0, 60, 5), phi_deg=[0, 30])

    def failed(call):
        try:
            call()
        except BaseException as error:
            return f"{{type(error).__name__}}: {{error}}"
        return "nothing"

    def tell_all(what):
        for rank, told in enumerate(comm.gather(what) or []):
            print(rank, told)

    def check_next():
        result = rt.solve(plate, 10.0, looks, comm=comm)
        if comm.rank == 0:
            assert np.array_equal(result.S.values, rt.solve(plate, 10.0, looks).S.values)
"""


def run_script(command, body, *arguments):
    script = textwrap.dedent(START) + textwrap.dedent(body)
    done = subprocess.run([*command, sys.executable, "-m", "mpi4py", "-c", script, *map(str, arguments)], env=ENVIRONMENT, capture_output=True,
                          text=True, timeout=LIMIT)
    return done.returncode, done.stdout, done.stdout + done.stderr


@pytest.fixture(scope="session")
def mpirun():
    """Runs the body of a script as so many ranks: what it prints."""
    if not shutil.which("mpirun"):
        pytest.skip("mpirun is not there")
    code, _, said = run_script(["mpirun", "-n", "1"], "rt.solve(plate, 10.0, looks, comm=MPI.COMM_SELF)")
    if "this raytube has no MPI" in said or "MPI cannot be loaded" in said:
        pytest.skip("this raytube has no MPI")
    assert code == 0, said

    def run(ranks, body, *arguments):
        code, printed, said = run_script(["mpirun", "-n", str(ranks)], body, *arguments)
        assert code == 0, said
        return printed

    return run


@pytest.mark.parametrize("ranks", [1, 2, 3])
def test_ranks_write_the_bytes_of_one_process(ranks, mpirun, tmp_path):
    mpirun(ranks, """
        result = rt.run(trihedral, keep_mechanisms=True, comm=comm)
        assert (result is None) == (comm.rank > 0)
        if result is not None:
            result.save(sys.argv[1])
        check_next()
    """, tmp_path / "ranks.nc")
    rt.run(CASES / "trihedral/case.toml", keep_mechanisms=True).save(tmp_path / "one.nc")
    assert (tmp_path / "ranks.nc").read_bytes() == (tmp_path / "one.nc").read_bytes()


def test_ranks_study_density(mpirun):
    printed = mpirun(2, f"""
        study = lambda **ranks: rt.converge({str(CASES / "convergence/case.toml")!r}, densities=(2, 4, 8), **ranks)
        shared = study(comm=comm)
        assert (shared is None) == (comm.rank > 0)
        if comm.rank == 0:
            same = [np.array_equal(a["S"], b["S"]) for a, b in zip(shared["densities"], study()["densities"], strict=True)]
            print(same)
        tell_all(failed(lambda: rt.converge(trihedral, densities=(2, 4) if comm.rank else (2, 4, 8), comm=comm)))
    """).splitlines()
    assert printed[0] == "[True, True, True]"
    assert "InputError: rank 1 on " in printed[1] and printed[2].startswith("1 InputError: was given densities = 2 4 where")


def test_communicators_of_some_ranks(mpirun):
    printed = mpirun(3, """
        expected = rt.solve(plate, 10.0, looks).S.values
        alone = rt.solve(plate, 10.0, looks, comm=MPI.COMM_SELF)
        half = comm.Split(comm.rank // 2)
        of_half = rt.solve(plate, 10.0, looks, comm=half)
        tell_all((np.array_equal(alone.S.values, expected), None if of_half is None else np.array_equal(of_half.S.values, expected)))
    """)
    assert printed.splitlines() == ["0 (True, True)", "1 (True, None)", "2 (True, True)"]


def test_what_one_rank_is_refused_for_all_raise(mpirun):
    printed = mpirun(3, """
        tell_all(failed(lambda: rt.run("/nowhere.toml" if comm.rank == 1 else trihedral, comm=comm)))
        check_next()
        tell_all(failed(lambda: rt.solve(plate, 10.0, looks, edges={"order": 99 if comm.rank == 0 else 1}, comm=comm)))
        check_next()
    """).splitlines()
    assert printed[1].startswith("1 InputError: /nowhere.toml: no such file")
    for told in (printed[0], printed[2]):
        assert "InputError: rank 1 on " in told and "/nowhere.toml: no such file" in told
    assert printed[3].startswith("0 InputError: solve: edges.order")
    for told in printed[4:]:
        assert "InputError: rank 0 on " in told and "edges.order" in told


# 180 000 looks: more than anyone waits for here.
LONG = {"look.phi_deg": {"start": -90, "stop": 90, "step": 0.001}}


@pytest.mark.parametrize("rank", [0, 1])
def test_an_interrupted_rank_ends_the_others(rank, mpirun):
    printed = mpirun(3, f"""
        if comm.rank == {rank}:
            threading.Timer(1.0, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        told = failed(lambda: rt.run(cube, {LONG}, comm=comm))
        tell_all(told)
        check_next()
    """).splitlines()
    assert printed[rank].startswith(f"{rank} KeyboardInterrupt")
    for told in printed[:rank] + printed[rank + 1:]:
        assert f"RuntimeError: rank {rank} on " in told and "interrupted" in told


def test_what_progress_raises_ends_the_others(mpirun):
    printed = mpirun(2, f"""
        def progress(share):
            assert comm.rank == 0
            raise ZeroDivisionError("mine")

        tell_all(failed(lambda: rt.run(cube, {LONG}, comm=comm, progress=progress)))
        check_next()
    """).splitlines()
    assert printed[0] == "0 ZeroDivisionError: mine"
    assert "RuntimeError: rank 0 on " in printed[1]


def test_the_example_of_futures_on_ranks(mpirun, tmp_path):
    script = CASES.parent / "examples/python/futures_study.py"
    command = ["mpirun", "-n", "3", sys.executable, "-B", "-m", "mpi4py.futures", script]
    done = subprocess.run(command, cwd=tmp_path, env=ENVIRONMENT | {"MPLBACKEND": "Agg"}, capture_output=True, text=True, timeout=LIMIT)
    assert done.returncode == 0 and done.stdout.count("leg of") == 3, done.stdout + done.stderr


def test_what_is_no_communicator(plate):
    from mpi4py import MPI

    for comm in (3, MPI.COMM_NULL, object()):
        with pytest.raises(rt.InputError, match="comm: give an intracommunicator of mpi4py"):
            rt.solve(plate, 10.0, rt.monostatic(0, 0), comm=comm)


def test_a_missing_plugin(tmp_path):
    with pytest.raises(rt.InputError, match="comm: this raytube has no MPI"):
        rt._core.ranks_of(0, str(tmp_path))


def test_mpi_of_one_thread():
    script = ("import mpi4py; mpi4py.rc.thread_level = 'single'\nimport raytube as rt\nfrom mpi4py import MPI\n"
              f"rt.run({str(CASES / 'trihedral/case.toml')!r}, comm=MPI.COMM_SELF)")
    done = subprocess.run([sys.executable, "-c", script], env=ENVIRONMENT, capture_output=True, text=True, timeout=LIMIT)
    assert "InputError: comm: MPI was started for programs of one thread" in done.stderr
