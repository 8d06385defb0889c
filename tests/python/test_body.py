"""Cuts, pins, softness, energy, frames, snapshots."""

import copy

import chainmail
import numpy as np
import pytest


def test_a_cut_lets_the_rest_stay():
    deformer = chainmail.Deformer(chainmail.make_line(5))
    deformer.body.cut(2, 3)
    assert deformer.body.cuts().tolist() == [2]
    deformer.move(0, (-10,))
    assert deformer.body.positions()[3:, 0].tolist() == [3, 4]
    deformer.body.uncut([2])
    deformer.move(0, (-11,))
    assert deformer.body.positions()[3, 0] < 0
    assert not deformer.body.is_cut(2)


def test_links_are_cut_by_id_and_by_ends():
    body = chainmail.Body(chainmail.make_grid(3, 3))
    body.cut([0, 5, 5])
    assert body.cuts().tolist() == [0, 5] and body.is_cut(5)
    with pytest.raises(chainmail.Error, match="elements 0 and 8: they are not linked"):
        body.cut(0, 8)


def test_pins_stay():
    deformer = chainmail.Deformer(chainmail.make_line(4))
    deformer.body.pin([1])
    deformer.move(0, (-10,))
    assert deformer.body.positions()[:, 0].tolist() == [-10, 1, 2, 3]
    assert deformer.body.is_pinned(1)
    with pytest.raises(chainmail.Error, match="pinned"):
        deformer.move(1, (0,))
    with pytest.raises(chainmail.Error, match="pinned"):
        deformer.grab([0, 1])


def test_softness_of_a_body():
    deformer = chainmail.Deformer(chainmail.make_line(2))
    deformer.body.set_softness(chainmail.LinkSoftness(stretch=1.5))
    deformer.move(0, (-1,))
    assert deformer.body.position(1)[0] == 0.5
    assert deformer.body.softness == chainmail.LinkSoftness(stretch=1.5)


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


def test_arrays_and_single_links_give_the_same():
    mesh = chainmail.make_grid(6, 5)
    stretch = np.random.default_rng(3).choice([1.0, 1.1, 1.4], mesh.link_count)
    one, other = chainmail.Body(mesh), chainmail.Body(mesh)
    one.set_link_softness(stretch=stretch)
    for link, value in enumerate(stretch):
        other.set_softness(chainmail.LinkSoftness(stretch=value), [link])
    for body in (one, other):
        chainmail.Deformer(body).move(0, (-9, -5))
    assert np.array_equal(one.positions(), other.positions())


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


@pytest.mark.parametrize("alike", [1, 2])
def test_many_different_links_take_little_time(alike):
    body = chainmail.Body(chainmail.make_grid(300, 300))
    stretch = np.linspace(1, 2, body.mesh.link_count // alike).repeat(alike)
    body.set_link_softness(stretch=stretch)
    assert np.array_equal(body.link_softness()["stretch"], stretch)


def test_softness_is_a_value():
    one = chainmail.LinkSoftness(shear=0.2)
    assert one == chainmail.LinkSoftness(shear=0.2) and hash(one) == hash(chainmail.LinkSoftness(shear=0.2))
    assert one != chainmail.LinkSoftness() and one != 5
    assert eval(repr(one), {"LinkSoftness": chainmail.LinkSoftness}) == one
    assert one.as_dict()["shear"] == 0.2
    with pytest.raises(AttributeError):
        one.shear = 3


def test_energy_and_elasticity():
    body = chainmail.Body(chainmail.make_tetra(3, 3, 3))
    assert body.energy == "material"
    body.set_energy("axial")
    assert body.energy == "axial"
    with pytest.raises(chainmail.Error, match="use isotropic, axial, corotated or material"):
        body.set_energy("thermal")
    body.set_elasticity(chainmail.Elasticity(poisson=0.4))
    assert body.elasticity == chainmail.Elasticity(poisson=0.4)
    assert body.elasticity.law == "neo-hookean"
    body.set_elasticity(chainmail.Elasticity(poisson=0.4, law="gent", gent_limit=1.5))
    assert (body.elasticity.law, body.elasticity.gent_limit) == ("gent", 1.5)
    assert "law='gent', gent_limit=1.5" in repr(body.elasticity)
    body.set_elasticity(chainmail.Elasticity(thickness=0.05))
    assert body.elasticity.thickness == 0.05
    with pytest.raises(chainmail.Error, match="use 0.0001 to 1"):
        body.set_elasticity(chainmail.Elasticity(thickness=0))
    with pytest.raises(chainmail.Error, match="use neo-hookean, gent or fung"):
        chainmail.Elasticity(law="hooke")
    with pytest.raises(chainmail.Error, match="too low for a Poisson's ratio"):
        body.set_elasticity(chainmail.Elasticity(poisson=0.1, law="gent"))
    with pytest.raises(chainmail.Error, match="poisson"):
        body.set_elasticity(chainmail.Elasticity(poisson=0.5))


def test_a_turned_object_deforms_in_the_same_way():
    turn = chainmail.Rotation((0, 0, 1), 90)
    straight, turned = chainmail.make_grid(5, 4), None
    rest = straight.rest_positions()
    turned = chainmail.make_mesh(rest[:, [1, 0, 2]] * [-1, 1, 1], straight.links)
    one, other = chainmail.Deformer(straight), chainmail.Deformer(turned)
    other.body.set_frame(turn)
    assert other.body.frame == turn
    one.move(0, (-3, -1))
    other.move(0, (1, -3))
    assert np.allclose(one.body.positions()[:, [1, 0]] * [-1, 1], other.body.positions()[:, :2], atol=1e-12)


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
