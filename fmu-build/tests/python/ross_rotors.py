"""Rotors of ROSS in one bearing and in two: they rest where statics say; linear ROSS moves as they do, at one speed and
run up through critical speeds; short steps are as exact as the guide says.

Arguments: the folder of the examples, a folder for the FMUs.
"""

import contextlib
import io
import sys
import warnings
from pathlib import Path

sys.path.insert(0, sys.argv[1])
import numpy as np  # noqa: E402
import rotor_ross  # noqa: E402
import step_by_step  # noqa: E402
from bearing import SCENES, build, changed_scene  # noqa: E402
from brinell.host import Bearing  # noqa: E402
from brinell.ross import GRAVITY, Coupled, Speed, element, housing, ross, simulate, unbalance  # noqa: E402

LENGTH, COUNT, BEARING, DISK = 0.1, 4, 1, 2  # four elements of 0.1 m; the other bearing is at the far end
folder = Path(sys.argv[2])
base = SCENES / "er16k-tb1-hosted-shaft.toml"
healthy, spalled, preloaded, towards, away, axial = build(
    [
        changed_scene(base, "healthy", {"defect": None, "contact": None}, folder),
        changed_scene(base, "spalled", {}, folder),
        # Every ball carries at all times: it is as linear as a bearing can be.
        changed_scene(SCENES / "6205-hosted.toml", "preloaded", {"bearing.radial_clearance_um": -4.0}, folder),
        # A pair back to back, with five degrees of freedom.
        changed_scene(SCENES / "7205-pair.toml", "towards", {}, folder),
        changed_scene(SCENES / "7205-pair.toml", "away", {"bearing.contact_angle_deg": -25.0}, folder),
        changed_scene(SCENES / "7205-pair.toml", "axial", {"bearing.degrees_of_freedom": 3}, folder),
    ],
    folder,
)
steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)


def rotor(*bearings):
    elements = [ross.ShaftElement(L=LENGTH, idl=0.0, odl=0.05, material=steel, beta=5e-6) for _ in range(COUNT)]
    disks = [ross.DiskElement.from_geometry(n=DISK, material=steel, width=0.02, i_d=0.05, o_d=0.2)]
    return ross.Rotor(elements, disks, list(bearings))


def slender(*bearings):
    """Critical speeds at 880 and 907 rad/s."""
    elements = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.03, material=steel, beta=5e-6) for _ in range(8)]
    disks = [ross.DiskElement.from_geometry(n=3, material=steel, width=0.03, i_d=0.03, o_d=0.2)]
    return ross.Rotor(elements, disks, list(bearings))


def rests():
    """Gives what each bearing carries."""
    speed, pressed = 2 * np.pi * 20.0, {BEARING: (0.0, -200.0)}
    # Moments about the far bearing: the shaft's weight in its middle, the disk, and what presses the shaft down.
    shaft = 7810 * np.pi / 4 * 0.05**2 * LENGTH * COUNT
    disk = 7810 * np.pi / 4 * (0.2**2 - 0.05**2) * 0.02
    arm = LENGTH * (COUNT - BEARING)
    near = (GRAVITY * (shaft * LENGTH * COUNT / 2 + disk * LENGTH * (COUNT - DISK)) + 200.0 * arm) / arm
    far = GRAVITY * (shaft + disk) + 200.0 - near

    held = rotor(ross.BearingElement(n=COUNT, kxx=1e8, cxx=200.0, kzz=1e6))
    with Coupled(held, {BEARING: healthy}, pressed, speed, 1e-5) as coupled:
        load = coupled.load
    # Two springs under a rotor: statics alone say what each carries. 1e-5: the one that stands in is 1e9 N/m.
    assert abs(load[1] + near) < 1e-5 * near and abs(load[0]) < 1e-6, (load, near)
    run = simulate(held, {BEARING: healthy}, speed, 2e-3, loads=pressed, seen=["shaft.force.y"])
    assert run.yout.shape == (len(run.time), held.ndof) and len(run.time) == 41
    # Without unbalance nothing moves it but the varying compliance: well below the approach of some 10 µm.
    assert np.abs(run.at(BEARING)).max() < 2e-6, np.abs(run.at(BEARING)).max()
    assert abs(run.outputs[BEARING]["shaft.force.y"][0] - near) < 1e-6 * near

    # In two FMUs, no other bearing: the far one rests on the rest of the weight.
    free = rotor()
    two = simulate(free, {BEARING: healthy, COUNT: healthy}, speed, 2e-3, loads=pressed, seen=["shaft.force.y"])
    for node, weight in ((BEARING, near), (COUNT, far)):
        assert abs(two.outputs[node]["shaft.force.y"][0] - weight) < 1e-6 * near, node
        assert np.abs(two.at(node)).max() < 2e-6, (node, np.abs(two.at(node)).max())

    # Bearings are told apart: in the other order all is the same; the spalled one is felt where it is.
    forces = {DISK: unbalance(1e-4)}
    there, back = (
        simulate(free, bearings, speed, 4e-3, loads=pressed, forces=forces)
        for bearings in ({BEARING: spalled, COUNT: healthy}, {COUNT: healthy, BEARING: spalled})
    )
    assert np.abs(there.yout - back.yout).max() < 1e-6 * np.abs(there.yout).max()
    felt, same = (run.outputs[BEARING]["housing.ay"] for run in (there, back))
    assert np.abs(felt - same).max() < 1e-6 * np.abs(felt).max()
    return near, far


def linear_elements(loads, speeds):
    return [element(preloaded, n, speeds, (0.0, -load)) for n, load in loads.items()]


def linear_along_the_axis():
    """Gives k_zz [N/m]: what 1 N more or less moves the ring by."""
    bearing = Bearing(str(axial), "axial", {"shaft.speed": 100.0})
    less, more = (bearing.rest(np.array([0.0, 0.0, thrust]))[2] for thrust in (499.0, 501.0))
    bearing.close()
    found = element(axial, 0, [100.0], (0.0, 0.0, 500.0)).kzz[0]
    assert abs(found * (more - less) / 2.0 - 1.0) < 1e-5, (found, more, less)
    try:
        element(towards, 0, [100.0], (0.0, 0.0, 500.0))
    except ValueError as error:
        assert "degrees_of_freedom = 3" in str(error), error
    else:
        raise AssertionError("five degrees of freedom in an element that holds no tilt")
    return found


def last_turns(run, speed):
    return run.t > run.t[-1] - 5 * 2 * np.pi / speed


def amplitude(run, speed, coordinate):
    """At shaft speed, fitted together with the mean: five turns hold no whole number of passages."""
    late = last_turns(run, speed)
    shapes = np.column_stack([np.cos(speed * run.t), np.sin(speed * run.t), np.ones_like(run.t)])[late]
    cos, sin, _ = np.linalg.lstsq(shapes, run.yout[late, coordinate], rcond=None)[0]
    return np.hypot(cos, sin)


def moves_as_linear_at_one_speed():
    """Gives the largest difference of amplitudes at shaft speed."""
    speed, eccentric, pressed = 157.08, 1e-4, {3: (0.0, -1000.0)}
    forces = {3: unbalance(eccentric)}
    bearings = {0: preloaded, 8: preloaded}
    run = simulate(slender(), bearings, speed, 0.4, 1e-4, loads=pressed, forces=forces, seen=["shaft.force.y"])
    assert isinstance(run, ross.TimeResponseResults)
    carried = {n: run.outputs[n]["shaft.force.y"][0] for n in (0, 8)}
    linear = slender(*linear_elements(carried, [speed])).run_unbalance_response(
        [3], [eccentric], [0.0], np.array([speed])
    )
    coordinates = [run.rotor.number_dof * 3 + axis for axis in (0, 1)]
    apart = [abs(amplitude(run, speed, at) / np.abs(linear.forced_resp[at, 0]) - 1.0) for at in coordinates]
    # 0.03 % and 0.003 %: what the stiffness varies as elements pass, which a linear bearing has the mean of.
    assert max(apart) < 2e-3, apart
    return max(apart), carried


def runs_up_as_linear(carried):
    """Gives the difference of the disk's motion over its largest."""
    profile, h, stop, finer = ([0.0, 0.1], [800.0, 1000.0]), 5e-5, 0.1, 4
    forces = {3: unbalance(2e-6)}
    ours, quiet = (
        simulate(slender(), {0: preloaded, 8: preloaded}, profile, stop, h, loads={3: (0.0, -1000.0)}, forces=of,
                 seen=["cage.angle", "cage.speed"])
        for of in (forces, {})
    )  # fmt: skip
    assert ours.speed[0] == 800.0 and abs(ours.speed[-1] - 1000.0) < 1e-9
    # The cage turns by its share of the shaft's angle, 90 rad; speed is held over a step at what makes that exact.
    cage = ours.outputs[0]
    share = cage["cage.speed"][0] / 800.0
    turned = cage["cage.angle"][-1] - cage["cage.angle"][0]
    assert abs(turned - share * 90.0) < 1e-9, (turned, share)
    linear = slender(*linear_elements(carried, [700.0, 900.0, 1100.0]))
    t = np.linspace(0.0, stop, finer * (len(ours.t) - 1) + 1)
    turning = Speed(profile).at(t)
    force = np.zeros((len(t), linear.ndof))
    at = slice(linear.number_dof * 3, linear.number_dof * 3 + 2)
    force[:, at] = forces[3](t, *turning).T
    with contextlib.redirect_stdout(io.StringIO()):
        expected = linear.integrate_system(turning[1], force, t)[1][::finer, at]
    # Less what the elements' passing does without an unbalance.
    found = ours.at(3) - quiet.at(3)
    apart = np.abs(found - expected).max() / np.abs(expected).max()
    # 0.1 %, of which Newmark's method at 12.5 µs has the half: its period is (ωh)²/12 = 1e-5 long.
    assert apart < 5e-3, apart
    assert np.abs(expected).max() > 5e-6, "no critical speed was passed"
    campbell = linear.run_campbell(np.linspace(700.0, 1100.0, 3))
    assert campbell.wd.shape[0] == 3
    return apart


def stands_as_a_beam(coupled):
    """In aligned housings the slender shaft has the slopes of a beam on two supports, under its weight, the disk's and the
    bearings' moments: w L³/24EI, P a b (L + b)/6EIL, M L/3EI and M L/6EI of the other's."""
    length, a, diameter = 0.4, 0.15, 0.03
    b, rigidity = length - a, 211e9 * np.pi / 64 * diameter**4
    weight = 7810 * np.pi / 4 * diameter**2 * GRAVITY * length**3 / 24
    disk = 7810 * np.pi / 4 * (0.2**2 - diameter**2) * 0.03 * GRAVITY * a * b / (6 * length)
    moments = coupled.rest_force[[3, 8]]
    ends = np.array([weight + disk * (length + b), -weight - disk * (length + a)])
    wanted = (ends + length / 6 * (2 * moments - moments[::-1])) / rigidity
    tilts = coupled.rest_position[[3, 8]]
    # 0.04 %: supports of 1e9 N/m yield by 50 nm. Free of moments the rings would stand at 2.5 mrad.
    assert np.abs(tilts / wanted - 1.0).max() < 2e-3, (tilts, wanted)
    assert np.abs(moments).min() > 0.1, moments


def leaves_the_housing_out_with_a_word():
    """Critical speeds of a rotor with and without the housing that the scene has."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        left_out = element(healthy, 0, [100.0], (0.0, -500.0))
        linked = element(healthy, 0, [100.0], (0.0, -500.0), n_link=5)
    assert len(said) == 1 and "6.64 kg on 1.51e+07 N/m" in str(said[0].message), [str(one.message) for one in said]
    mass, support = housing(healthy, 5)
    assert (mass.m, support.kxx[0], support.cyy[0]) == (6.638, 1.51056e7, 2210.7)
    assert left_out.kyy[0] == linked.kyy[0]


def moves_along_and_tilts_in_a_pair():
    """Gives the differences of its axial rest and of its amplitudes at shaft speed from what the pair's stiffness says."""
    speed, eccentric, push, preload = 157.08, 1e-5, 20.0, 300.0
    # Grows within 20 ms and stays.
    along = lambda t, *_: np.array([0 * t, 0 * t, push * np.clip(t / 0.02, 0.0, 1.0) ** 2])  # noqa: E731
    forces, bearings, preloads = {3: unbalance(eccentric), 4: along}, {0: towards, 8: away}, {0: preload, 8: -preload}
    free = slender(ross.BearingElement(n=8, kxx=0.0, cxx=0.0, kzz=0.0, czz=2000.0))
    with Coupled(free, bearings, {}, speed, 1e-5, preloads) as coupled:
        assert np.abs(coupled.rest_force[[2, 7]] + [preload, -preload]).max() < 1e-6, coupled.rest_force
        stands_as_a_beam(coupled)
        stiffness, system = coupled.stiffness, coupled.system(speed)
    run = simulate(free, bearings, speed, 0.3, forces=forces, preloads=preloads, passes=2, seen=["shaft.force.z"])
    late = last_turns(run, speed)
    z = run.yout[late, run.rotor.number_dof * 4 + 2].mean()
    # Statics of the pair's 5 x 5 stiffnesses and of the shaft, which yields a tenth as much.
    at = system.nodes(tuple(bearings), coupled.axes)
    system.K[np.ix_(at, at)] += stiffness
    (middle,) = system.at(4, ("z",))
    expected = push * np.linalg.inv(system.K)[middle, middle]
    along_apart = abs(z / expected - 1.0)
    assert along_apart < 1e-3, (z, expected)
    # What the pair gives along z is against the push.
    pushes = sum(run.outputs[node]["shaft.force.z"][late].mean() for node in bearings)
    assert abs(pushes + push) < 0.01 * push, pushes
    # The answer to an unbalance at shaft speed.
    drive = np.zeros(system.size, dtype=complex)
    drive[system.at(3)] = eccentric * speed**2 * np.array([1.0, -1.0j])
    linear = np.linalg.solve(system.K - speed**2 * system.M + 1j * speed * system.C, drive)
    apart = []
    for node, name, column in ((3, "x", 0), (3, "y", 1), (0, "tilt.x", 3), (8, "tilt.y", 4)):
        found = amplitude(run, speed, run.rotor.number_dof * node + column)
        apart.append(abs(found / np.abs(linear[system.at(node, (name,))[0]]) - 1.0))
    # 0.03 %: what the stiffness varies as balls pass.
    assert max(apart) < 2e-3, apart
    return along_apart, max(apart)


def refuses():
    free, node = rotor(), BEARING
    for bearings, words, more in (
        ({node: healthy, 9: healthy}, "a bearing at node 9: the shaft has nodes 0 to 4", {}),
        ([healthy], "scenes by their nodes", {}),
        ({node: healthy}, "at least one pass", {"passes": 0}),
        ({node: healthy}, "as many speeds", {"speed": ([0.0, 1.0], [1.0])}),
        ({node: SCENES / "6205-healthy.toml"}, 'needs motion = "host" in [shaft]', {}),
    ):
        try:
            simulate(free, bearings, **{"speed": 100.0, "stop": 1e-3, **more})
        except ValueError as error:
            assert words in str(error), error
        else:
            raise AssertionError(words)


def converges():
    """Errors of the shaft's position over those of its motion: what `docs/how-to/step.md` says, twice to three times."""
    rotor, loads, forces = rotor_ross.shown()

    def by_matrices(fmu, h, passes):
        how = {"loads": loads, "forces": forces, "passes": passes, "tolerance": 1e-8}
        run = simulate(rotor, {rotor_ross.BEARING: fmu}, 2 * np.pi * 30.0, 0.01, h, **how)
        return run.at(rotor_ross.BEARING)[:, 1]

    def rigid(fmu, h, passes):
        return step_by_step.simulate((healthy, fmu), h, passes, 0.01, tolerance=1e-8)[:, 4]

    # Over 10 ms the motion only begins, so errors are larger shares of it than in the page's table over 50 ms. A scheme
    # that lost an order would be ten times off.
    for host, fmu, passes, limits in (
        (rigid, healthy, 1, (1e-5, 2e-3)),
        (by_matrices, healthy, 1, (2.5e-5, 4e-2)),
        (by_matrices, healthy, 2, (3e-6, 3e-3)),
        (rigid, spalled, 1, (3e-4, 4e-2)),
        (by_matrices, spalled, 2, (3e-4, 8e-2)),
    ):
        exact = host(fmu, 5e-6, 2)
        for h, limit in zip((1e-5, 1e-4), limits):
            there = exact[:: round(h / 5e-6)]
            error = np.sqrt(np.mean((host(fmu, h, passes)[: len(there)] - there) ** 2)) / there.std()
            assert error < limit, (host.__name__, fmu, passes, h, error)


near, far = rests()
refuses()
converges()
k_zz = linear_along_the_axis()
apart, carried = moves_as_linear_at_one_speed()
run_up = runs_up_as_linear(carried)
leaves_the_housing_out_with_a_word()
pair = moves_along_and_tilts_in_a_pair()
print(f"rests on {near:.3f} N and {far:.3f} N; linear ROSS within {100 * apart:.2g} %, run up {100 * run_up:.2g} %; "
      f"k_zz {k_zz:.4g} N/m; "
      f"a pair along its axis within {100 * pair[0]:.2g} %, across and tilted {100 * pair[1]:.2g} %")
