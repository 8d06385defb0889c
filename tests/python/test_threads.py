"""One thread at a time uses an object; others get an error, and nothing is damaged."""

import threading
from concurrent.futures import ThreadPoolExecutor

import chainmail
import numpy as np
import pytest

from study_helpers import Occupied


def test_every_use_of_a_busy_body_is_an_error():
    deformer = chainmail.Deformer(chainmail.make_cloth(20, 20))
    body, handle, link = deformer.body, deformer.grab(0), chainmail.LinkSoftness()
    before, snapshot = body.positions(), body.snapshot()
    uses = {
        "move": lambda: deformer.move(0, (1, 1)),
        "move a handle": lambda: deformer.move(handle, handle.pose),
        "relax": lambda: deformer.relax(1),
        "grab": lambda: deformer.grab(1),
        "moved": deformer.moved,
        "release": deformer.release,
        "trace": deformer.trace,
        "certificate": deformer.certificate,
        "set_method": lambda: deformer.set_method("exact"),
        "set_threads": lambda: deformer.set_threads(2),
        "set_job": lambda: deformer.set_job(chainmail.Job()),
        "deformer": lambda: chainmail.Deformer(body),
        "handle": lambda: chainmail.Handle(body, 1),
        "positions": body.positions,
        "view": body.view,
        "set_positions": lambda: body.set_positions(before),
        "position": lambda: body.position(0),
        "pin": lambda: body.pin([1]),
        "pins": body.pins,
        "cut": lambda: body.cut([1]),
        "softness": lambda: body.set_softness(link),
        "softness of links": lambda: body.set_link_softness(stretch=2),
        "softness arrays": body.link_softness,
        "frame": body.set_frame_of_object,
        "reset": body.reset,
        "restore": lambda: body.restore(snapshot),
        "copy": body.copy,
        "violation": lambda: chainmail.violation(body),
        "distance": lambda: chainmail.distance(chainmail.Body(body.mesh), body),
        "distance to positions": lambda: chainmail.distance(body, before),
        "energy": lambda: chainmail.elastic_energy(body),
        "reference": lambda: chainmail.reference_solution(body, 0),
        "calibrate": lambda: chainmail.calibrate(body),
        "compare": lambda: chainmail.compare(body),
    }
    with Occupied(body):
        for name, use in uses.items():
            with pytest.raises(chainmail.Error, match="body: another thread uses it; wait until") as raised:
                use()
            assert raised.value.where == "body", name
        assert repr(body) == "<Body: 400 elements in double, in use>"
        assert repr(deformer) == "<Deformer: natural-queue on 400 elements>"
        assert (body.mesh.element_count, body.precision, deformer.method) == (400, "double", "natural-queue")
    assert np.array_equal(body.positions(), before)
    for name in ("move", "relax", "positions", "pins"):
        uses[name]()  # the body is free again


def test_threads_that_fight_for_a_body_do_not_damage_it():
    """All passes that are not refused happen one after the other: the last state is that of some order of them."""
    deformer = chainmail.Deformer(chainmail.make_cloth(60, 60))
    done, refused = [], []
    start = threading.Barrier(4)

    def drag(number):
        start.wait()
        for step in range(200):
            try:
                deformer.move(0, (-(step % 50) - number, -number))
                done.append(number)
            except chainmail.Error as error:
                assert error.where == "body"
                refused.append(number)

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(drag, range(4)))
    assert len(done) + len(refused) == 800 and done
    assert np.isfinite(deformer.body.positions()).all()
    deformer.body.reset()
    deformer.move(0, (-30, -20))
    alone = chainmail.Deformer(deformer.body.mesh)
    alone.move(0, (-30, -20))
    assert np.array_equal(deformer.body.positions(), alone.body.positions())


def test_different_bodies_run_at_the_same_time():
    mesh = chainmail.make_block(30, 30, 30)
    both_inside = threading.Barrier(2)

    def drag(_):
        deformer = chainmail.Deformer(mesh, "natural-queue")
        both_inside.wait()
        for step in range(1, 6):
            deformer.move(0, (-5 * step, -2 * step, -step))
        return deformer.body.positions()

    with ThreadPoolExecutor(2) as pool:
        one, other = pool.map(drag, range(2))
    assert np.array_equal(one, other)


def test_a_pass_lets_other_threads_run():
    """While one thread is in long passes, this thread goes on."""
    body = chainmail.Body(chainmail.make_cloth(20, 20))
    with Occupied(body):
        other = chainmail.Deformer(body.mesh)
        assert other.move(0, (-9, -9)).moved > 0


def test_a_handle_is_used_by_one_thread():
    mesh = chainmail.make_block(25, 25, 25)
    deformers = [chainmail.Deformer(mesh) for _ in range(2)]
    handle = deformers[0].grab([0, 1])
    start = threading.Barrier(2)
    sentences = set()

    def drag(deformer):
        start.wait()
        for step in range(60):
            try:
                deformer.move(handle, handle.after((-(step % 20), 0, 0)))
            except chainmail.Error as error:
                sentences.add(error.where)

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(drag, deformers))
    assert sentences <= {"handle"}
    assert np.isfinite(deformers[0].body.positions()).all()
