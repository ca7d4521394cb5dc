"""Torques of the arms of the catalogue and of the examples by Pinocchio, as fixtures.

    pip install pin
    python tests/data/dynamics/torques.py [states] > tests/data/dynamics/torques.json

Every arm whose sheet has masses is built from the lengths of its sheet, joint by joint, as the formula in src/machine/kinematics/opw.rs
has them, with a load on its flange. Angles, rates, accelerations and loads are drawn from a fixed seed. No sheet of a parallelogram has
masses; so that its torques have an oracle, too, each arm is also taken as one whose third axis counts from the root: such an arm moves as
the serial one does with the second axis taken off the third, and by virtual work the second drive then carries what the third one does
less.
"""

import json
import pathlib
import random
import sys
import tomllib

import numpy as np
import pinocchio as pin

ROOT = pathlib.Path(__file__).parents[3]
ROBOTS = ROOT / "src/machine/robots"
GRAVITY = 9.81

# The joints of an arm whose third axis counts from the root, by its axes.
COUPLED = np.eye(6)
COUPLED[2, 1] = -1


def turned(axis, angle):
    return pin.exp3(np.array(axis, float) * angle)


def arm(sheet):
    """The model, the senses, and the zero offsets of an arm."""
    opw = sheet["opw"]
    c4 = opw["c4_mm"] / 1000
    a1, a2, b, c1, c2, c3 = (opw[key + "_mm"] / 1000 for key in ("a1", "a2", "b", "c1", "c2", "c3"))
    model = pin.Model()
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    places = [(0, 0, c1), (a1, b, 0), (0, 0, c2), (a2, 0, c3), (0, 0, 0), (0, 0, 0)]
    kinds = [pin.JointModelRZ, pin.JointModelRY, pin.JointModelRY, pin.JointModelRZ, pin.JointModelRY, pin.JointModelRZ]
    parent = 0
    for number, (kind, place) in enumerate(zip(kinds, places)):
        placement = pin.SE3(np.eye(3), np.array(place, float))
        parent = model.addJoint(parent, kind(), placement, f"joint_{number + 1}")
    signs = np.array(opw["joint_signs"], float)
    offsets = np.radians(opw["joint_offsets_deg"])
    # With all of the controller's axes at zero the links are where the sheet has them.
    data = model.createData()
    pin.forwardKinematics(model, data, -offsets)
    links = {link["name"]: link for link in sheet["dynamics"]["link"]}
    for number in range(1, 7):
        link = links[f"link_{number}"]
        i = link["inertia_kg_m2"]
        tensor = np.array([[i["xx"], i["xy"], i["xz"]], [i["xy"], i["yy"], i["yz"]], [i["xz"], i["yz"], i["zz"]]])
        placed = data.oMi[number]
        centre = placed.inverse().act(np.array(link["com_mm"]) / 1000)
        inertia = placed.rotation.T @ tensor @ placed.rotation
        body = pin.Inertia(link["mass_kg"], centre, inertia)
        model.appendBodyToJoint(number, body, pin.SE3.Identity())
    return model, signs, offsets, c4


def sheets():
    """Names and paths: of the catalogue first, then of the examples."""
    for path in sorted(ROBOTS.glob("*/*.toml")):
        yield f"{path.parent.name}/{path.stem}", path
    for path in sorted((ROOT / "examples/shop").glob("*.toml")):
        yield path.relative_to(ROOT).as_posix(), path


def state(draw, arm, coupling):
    """A random state of an arm, with its torques at the controller's axes."""
    model, signs, offsets, c4 = arm
    q, v, a = ([round(draw.uniform(-most, most), 6) for _ in range(6)] for most in (3.0, 4.0, 20.0))
    mass = round(draw.uniform(0, 20), 3)
    centre = [round(draw.uniform(-200, 200), 1) for _ in range(3)]
    loaded = model.copy()
    # The flange's axes are those of axis 6, whatever the offsets are.
    load = pin.Inertia(mass, np.array(centre) / 1000 + [0, 0, c4], np.zeros((3, 3)))
    loaded.appendBodyToJoint(6, load, pin.SE3.Identity())
    joints, rates, accelerations = (signs * (coupling @ np.array(values)) for values in (q, v, a))
    torques = signs * pin.rnea(loaded, loaded.createData(), joints - offsets, rates, accelerations)
    torques = coupling.T @ torques
    return {"joints": q, "rates": v, "accelerations": a, "load": [mass, *centre], "torques": torques.tolist()}


def main():
    states = int(sys.argv[1]) if len(sys.argv) > 1 else 12
    draw = random.Random(20190)
    arms = []
    for name, path in sheets():
        sheet = tomllib.loads(path.read_text())
        if "dynamics" not in sheet:
            continue
        if sheet.get("coupling", {}).get("j2_j3_parallelogram"):
            sys.exit(f"{name} is a parallelogram with masses: its own coupling has to be taken")
        of = arm(sheet)
        serial, coupled = ([state(draw, of, coupling) for _ in range(states)] for coupling in (np.eye(6), COUPLED))
        arms.append({"name": name, "serial": serial, "coupled": coupled})
    json.dump({"gravity": GRAVITY, "arms": arms}, sys.stdout, separators=(",", ":"))
    print()


main()
