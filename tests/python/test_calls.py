"""How calls behave: errors, progress, interruption, other threads meanwhile."""

import os
import signal
import threading
import time

import numpy as np
import pytest
import thinwall

TOOL = thinwall.oscillators([(922.0, 0.011, 1340049.648, d) for d in "xy"], "tip")
CUT = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=600e6, K_r=200e6, radial_depth_m=0.001)
SPEEDS = np.linspace(5000.0, 25000.0, 100)


@pytest.mark.parametrize(
    ("call", "kind", "word"),
    [
        (lambda: thinwall.box_mesh((0.1, -1.0, 0.1), 0.01), (thinwall.InputError, ValueError), "side y"),
        (lambda: thinwall.read_mesh("absent.msh", "mm"), (thinwall.DataError, OSError), "absent.msh"),
        (lambda: thinwall.read_mesh("absent.msh", ""), (thinwall.InputError, ValueError), "unit"),
        (lambda: thinwall.Response([1.0, 1.0], [1, 1], ["P.x"]), (thinwall.InputError,), "rise"),
        (lambda: thinwall.Response([1.0, 2.0], [1], ["P.x"]), (thinwall.InputError,), "lines"),
        (lambda: thinwall.Response([1.0, 2.0], [1, 1], ["P"]), (thinwall.InputError,), '"P"'),
        (lambda: thinwall.oscillators([(0.0, 0.1, 1.0, "x")], "P"), (thinwall.InputError,), "frequency"),
        (lambda: thinwall.lobes(TOOL, CUT, [5000.0], method="direkt"), (thinwall.InputError,), "direct"),
        (lambda: thinwall.lobes(TOOL, CUT, [-1.0]), (thinwall.InputError,), "speed"),
        (lambda: thinwall.Point("P", (0, 0, 0), "xw"), (thinwall.InputError,), "w"),
        (lambda: thinwall.set_thread_count(0), (thinwall.InputError, ValueError), "below 1"),
        (lambda: thinwall.set_thread_count(-2), (thinwall.InputError, ValueError), "-2"),
        (lambda: thinwall.read_results("."), (thinwall.DataError,), "summary.json"),
    ],
)
def test_what_is_wrong_is_said_and_can_be_caught(call, kind, word):
    for each in (thinwall.Error, *kind):
        with pytest.raises(each, match=word):
            call()


def test_what_cannot_be_computed_is_a_numerical_error():
    undamped = thinwall.oscillators([(100.0, 0.0, 1e6, "x")], "P")
    with pytest.raises(thinwall.NumericalError, match="Hz"):
        thinwall.receptances(undamped, [50.0, 100.0])
    assert issubclass(thinwall.NumericalError, ArithmeticError)


def test_progress_counts_every_speed_and_changes_nothing():
    told = []
    chart = thinwall.lobes(TOOL, CUT, SPEEDS, progress=lambda done, of: told.append((done, of)))
    assert [done for done, _ in told] == sorted({done for done, _ in told})
    assert told[-1] == (100, 100) and len(told) > 2
    plain = thinwall.lobes(TOOL, CUT, SPEEDS)
    assert np.allclose(chart.limiting_depth_m, plain.limiting_depth_m, rtol=1e-6)
    assert chart.minimum_depth_m == pytest.approx(plain.minimum_depth_m, rel=1e-6)


def test_what_progress_raises_ends_the_call():
    class Enough(Exception):
        pass

    def stop(_done, _of):
        raise Enough

    with pytest.raises(Enough):
        thinwall.lobes(TOOL, CUT, SPEEDS, progress=stop)


def test_other_threads_go_on_meanwhile():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    thinwall.lobes(TOOL, CUT, np.linspace(5000.0, 25000.0, 400))
    end = time.monotonic()
    done.set()
    thread.join()
    inside = [t for t in ticks if begin < t < end]
    assert len(inside) > 20 * (end - begin)  # of a thousand a second; none if the lock were held


def test_threads_share_one_factor_of_a_model():
    mesh = thinwall.box_mesh((0.1, 0.05, 0.004), 0.02)
    model = thinwall.assemble(mesh, thinwall.Material(70e9, 0.33, 2700.0), ["x_min"], order=3)
    found = []
    threads = [threading.Thread(target=lambda: found.append(thinwall.modes(model, 3).frequency_hz)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for frequencies in found:
        assert frequencies == pytest.approx(found[0], rel=1e-9)


def test_the_results_do_not_depend_on_the_thread_that_calls():
    charts = []
    thread = threading.Thread(target=lambda: charts.append(thinwall.lobes(TOOL, CUT, [6000.0])))
    thread.start()
    thread.join()
    assert charts[0].limiting_depth_m[0] == thinwall.lobes(TOOL, CUT, [6000.0]).limiting_depth_m[0]


def test_control_c_ends_a_long_call_and_leaves_the_module_usable():
    speeds = np.linspace(2000.0, 25000.0, 200000)  # some minutes
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    handler = signal.getsignal(signal.SIGINT)
    timer.start()
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        thinwall.lobes(TOOL, CUT, speeds)
    assert 0.4 < time.monotonic() - begin < 20.0
    assert signal.getsignal(signal.SIGINT) is handler
    assert len(thinwall.lobes(TOOL, CUT, [5000.0]).limiting_depth_m) == 1


def test_threads_are_counted():
    before = thinwall.thread_count()
    thinwall.set_thread_count(1)
    assert thinwall.thread_count() == 1
    thinwall.set_thread_count(before)
