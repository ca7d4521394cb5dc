"""Writes ezdxf.dxf, and points on the outline of every drawing of this folder as ezdxf and svgpathtools see them.

    pip install ezdxf==1.4.5 svgpathtools==1.8.0
    python3 reference.py

The points of NAME go to NAME.points: lines of x and z in mm, for z upwards. The tests of
`src/geom/import/drawing` hold our own outlines against them. ezdxf evaluates curves by its own means: every point lies on its curve, not on a chord.
"""
import math
import sys

import ezdxf
from ezdxf import recover, units
from svgpathtools import Document, parse_path

def write_ezdxf():
    doc = ezdxf.new("R2010")
    doc.units = units.IN
    # A block within a block; the inner one on layer 0, turned, mirrored and stretched by its insertions.
    wave = doc.blocks.new("WAVE", base_point=(1, 1))
    wave.add_lwpolyline([(1, 1, 0.4), (2, 1, -0.4), (3, 1, 0)], format="xyb")
    pair = doc.blocks.new("PAIR")
    pair.add_blockref("WAVE", (0, 0), dxfattribs={"xscale": 0.25, "yscale": 0.4})
    pair.add_blockref("WAVE", (1, 0), dxfattribs={"xscale": -0.25, "yscale": 0.25})
    space = doc.modelspace()
    on_skin = {"layer": "SKIN"}
    doc.layers.add("SKIN")
    space.add_blockref("PAIR", (0, 1), dxfattribs=on_skin)
    # A rational quarter of an ellipse, by weights.
    spline = space.add_rational_spline(
        [(1, 1), (1, 1.5), (2, 1.5)], [1, math.sqrt(0.5), 1], degree=2, knots=[0, 0, 0, 1, 1, 1], dxfattribs=on_skin
    )
    assert spline.dxf.degree == 2
    # Seen from below, an arc is given in a system whose x runs backwards.
    space.add_arc((-2.5, 1.5), 0.5, 0, 180, dxfattribs={"extrusion": (0, 0, -1), **on_skin})
    space.add_ellipse((3.5, 1.5), (-0.5, 0), 0.3, math.pi, math.tau, dxfattribs=on_skin)
    space.add_open_spline([(4, 1.5), (4.2, 1.8), (4.5, 1.2), (4.8, 1.1), (5, 1.4)], degree=4, dxfattribs=on_skin)
    space.add_text("RIB 12", dxfattribs={"layer": "TEXT"})
    doc.saveas("ezdxf.dxf")


def unfolded(entities, inserted_on="0"):
    """Lines and curves with their layers; those of a block on layer 0 take the layer of its insertion."""
    for entity in entities:
        layer = inserted_on if entity.dxf.layer == "0" else entity.dxf.layer
        if entity.dxftype() in ("INSERT", "LWPOLYLINE", "POLYLINE"):
            yield from unfolded(entity.virtual_entities(), layer)
        else:
            yield entity, layer

def points_of(entity):
    kind = entity.dxftype()
    if kind == "LINE":
        return [entity.dxf.start.lerp(entity.dxf.end, i / 4) for i in range(5)]
    if kind == "SPLINE":
        return list(entity.flattening(0.02, segments=16))
    return list(entity.flattening(0.02))

def dxf(name, layer, unit):
    doc, _ = recover.readfile(f"{name}.dxf")
    points = []
    for entity, stands_on in unfolded(doc.modelspace()):
        if stands_on == layer and entity.dxftype() in ("LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE"):
            points += [(p.x * unit, p.y * unit) for p in points_of(entity)]
    return points

def svg(name, unit, height):
    """Points of all paths, each mapped by itself: svgpathtools mirrors elliptic arcs wrongly. `unit` is mm a user unit,
    and the page is `height` user units high."""
    points = []
    for path in Document(f"{name}.svg").paths():
        for segment in parse_path(path.element.get("d")):
            for i in range(17):
                p = segment.point(i / 16)
                x, y, _ = path.transform @ (p.real, p.imag, 1)
                points.append((x * unit, (height - y) * unit))
    return points


def save(name, points):
    with open(f"{name}.points", "w", encoding="ascii") as file:
        file.write(f"# {' '.join(sys.argv)}, ezdxf {ezdxf.__version__}\n")
        file.writelines(f"{x:.9f},{z:.9f}\n" for x, z in points)

write_ezdxf()
save("ezdxf", dxf("ezdxf", "SKIN", 25.4))
save("autocad", dxf("autocad", "SKIN", 1))
save("autocad_r12", dxf("autocad_r12", "CONTOUR", 1))
save("librecad", dxf("librecad", "rib", 1))
save("qcad", dxf("qcad", "Rib", 10))
save("inkscape", svg("inkscape", 1, 50))
save("illustrator", svg("illustrator", 25.4 / 72, 150))
