"""Cuts, pins, softness, energy, frames, snapshots."""

import copy

import chainmail
import numpy as np
import pytest


def test_links_are_cut_by_id_and_by_ends():
    body = chainmail.Body(chainmail.make_grid(3, 3))
    body.cut([0, 5, 5])
    assert body.cuts().tolist() == [0, 5] and body.is_cut(5)
    with pytest.raises(chainmail.Error, match="elements 0 and 8: they are not linked"):
        body.cut(0, 8)


def test_softness_of_each_link_from_arrays():
    """With the stretch of each link known, the end of each link is known."""
    stretch = np.array([1.0, 1.25, 1.5, 2.0])
    deformer = chainmail.Deformer(chainmail.make_line(5))
    deformer.body.set_link_softness(stretch=stretch, compression=0.5)
    deformer.move(0, (-100,))
    assert np.array_equal(deformer.body.positions()[:, 0], -100 + np.concatenate([[0], np.cumsum(stretch)]))
    arrays = deformer.body.link_softness()
    assert list(arrays) == ["compression", "stretch", "shear", "lateral", "stiffness", "exponent"]
    assert np.array_equal(arrays["stretch"], stretch)
    assert arrays["compression"].tolist() == [0.5] * 4 and arrays["shear"].tolist() == [0.1] * 4


def test_softness_of_some_links():
    body = chainmail.Body(chainmail.make_line(5))
    body.set_link_softness([3, 1], stretch=[1.3, 1.1], lateral=np.float32(0.5))
    assert body.link_softness()["stretch"].tolist() == [1.2, 1.1, 1.2, 1.3]
    assert body.softness_of(1) == chainmail.LinkSoftness(stretch=1.1, lateral=0.5)
    body.set_link_softness([1], shear=0.3)  # the others stay
    assert body.softness_of(1) == chainmail.LinkSoftness(stretch=1.1, lateral=0.5, shear=0.3)
    assert body.softness_of(3).stretch == 1.3
    body.set_softness(chainmail.LinkSoftness(stretch=3), [0])
    body.clear_softness([1])
    assert body.link_softness()["stretch"].tolist() == [3, 1.2, 1.2, 1.3]
    body.clear_softness()
    assert body.link_softness()["stretch"].tolist() == [1.2] * 4


@pytest.mark.parametrize(
    "given, words",
    [
        (dict(stretch=[1.2, 1.2]), "give one number, or the shape"),
        (dict(stretch=np.ones((4, 1))), "the array has the shape"),
        (dict(stretch=[1.2, 0.9, 1.2, 1.2]), "link 1, "),
        (dict(stretch=np.nan), "link 0, "),
        (dict(compression=[0.5, 0.5, 0.5, -1]), "link 3, "),
        (dict(compression=[0.5, 0.5, 0.5, 2]), "link 3, "),
        (dict(stiffness=0), "link 0, "),
        (dict(exponent=5), "link 0, "),
        (dict(stretch="soft"), "of type"),
        (dict(stretch=1j), "complex"),
        (dict(links=[0, 0], stretch=2), "link 0: it is given twice"),
        (dict(links=[9], stretch=2), "there is no such link"),
    ],
)
def test_bad_softness_changes_nothing(given, words):
    body = chainmail.Body(chainmail.make_line(5))
    with pytest.raises(chainmail.Error) as raised:
        body.set_link_softness(**given)
    assert words in str(raised.value)
    assert body.link_softness()["stretch"].tolist() == [1.2] * 4


def test_an_unknown_number_of_softness():
    with pytest.raises(TypeError, match="has no argument 'strech'"):
        chainmail.Body(chainmail.make_line(5)).set_link_softness(strech=2)
    with pytest.raises(chainmail.Error, match="stretch"):
        chainmail.Body(chainmail.make_line(5)).set_softness(chainmail.LinkSoftness(stretch=0.5))


def test_softness_is_a_value():
    one = chainmail.LinkSoftness(shear=0.2)
    assert one == chainmail.LinkSoftness(shear=0.2) and hash(one) == hash(chainmail.LinkSoftness(shear=0.2))
    assert one != chainmail.LinkSoftness() and one != 5
    assert eval(repr(one), {"LinkSoftness": chainmail.LinkSoftness}) == one
    assert one.as_dict()["shear"] == 0.2
    with pytest.raises(AttributeError):
        one.shear = 3


def test_words_are_those_that_were_set():
    body = chainmail.Body(chainmail.make_tetra(3, 3, 3))
    for kind in ("isotropic", "axial", "corotated", "material"):
        body.set_energy(kind)
        assert body.energy == kind
    for law in ("neo-hookean", "gent", "fung"):
        given = chainmail.Elasticity(poisson=0.4, law=law, gent_limit=1.5, thickness=0.05)
        body.set_elasticity(given)
        assert body.elasticity == given and body.elasticity.law == law and f"law='{law}'" in repr(given)
    for wrong in (lambda: body.set_energy("thermal"), lambda: chainmail.Elasticity(law="hooke")):
        with pytest.raises(chainmail.Error, match="there is no such value; use "):
            wrong()


def test_snapshots():
    deformer = chainmail.Deformer(chainmail.make_grid(6, 6))
    deformer.move(0, (-4, -4))
    snapshot, positions = deformer.body.snapshot(), deformer.body.positions()
    deformer.body.reset()
    assert snapshot != deformer.body.snapshot()
    deformer.body.restore(snapshot)
    assert np.array_equal(deformer.body.positions(), positions)
    assert snapshot == deformer.body.snapshot()
    with pytest.raises(chainmail.Error, match="another mesh"):
        chainmail.Body(chainmail.make_grid(6, 6)).restore(snapshot)


@pytest.mark.parametrize("copier", [lambda body: body.copy(), copy.copy, copy.deepcopy])
def test_copies_are_independent(copier):
    deformer = chainmail.Deformer(chainmail.make_grid(6, 6))
    deformer.body.pin([35])
    deformer.body.set_link_softness(stretch=1.5)
    deformer.move(0, (-4, -4))
    twin = copier(deformer.body)
    assert np.array_equal(twin.positions(), deformer.body.positions())
    deformer.move(0, (-9, -4))
    assert twin.position(0) == (-4, -4, 0)
    assert twin.pins().tolist() == [35] and twin.softness_of(0).stretch == 1.5
    chainmail.Deformer(twin).move(0, (-9, -4))
    assert np.array_equal(twin.positions(), deformer.body.positions())


def test_what_a_body_looks_like():
    body = chainmail.Body(chainmail.make_grid(6, 6), "float")
    assert repr(body) == "<Body: 36 elements in float>"
    body.pin([1, 2])
    body.cut([4])
    assert repr(body) == "<Body: 36 elements in float, 2 pinned, 1 links cut>"
    assert repr(body.mesh) == "<Mesh: surface of 36 elements and 60 links along xy>"
    with pytest.raises(chainmail.Error, match="precision 'half': there is no such value; use float or double"):
        chainmail.Body(body.mesh, "half")


def test_the_frame_of_the_object():
    flat = chainmail.make_grid(9, 4)
    angle = np.radians(30)
    turned = flat.rest_positions()[:, :2] @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    body = chainmail.Body(chainmail.make_mesh(turned, flat.links, space_dimension=2))
    assert body.set_frame_of_object()
    axis, degrees = body.frame.axis, body.frame.degrees
    assert (axis[2] * degrees) % 90 == pytest.approx(30)
    body = chainmail.Body(chainmail.make_grid(5, 5))
    assert not body.set_frame_of_object()
    assert body.frame.degrees == 0
