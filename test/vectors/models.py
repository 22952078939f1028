#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes models.inc from the MODELS.json that lies beside the shared models.

usage: models.py PATH/TO/MODELS.json > models.inc

The numbers there come from a parser written for that purpose in Python, checked against lib3ds
1.3.0 and libassimp 5.2.5 (STL: also admesh 0.98.4); areas in binary64 from the stored values. None
comes from lrcs.
"""
import json
import sys


def text(s):
    """A C string literal of the UTF-8 bytes."""
    out = ""
    hexed = False
    for byte in s.encode():
        char = chr(byte)
        if 0x20 <= byte < 0x7F and char not in '"\\':
            # a hexadecimal escape swallows hexadecimal digits behind it
            out += ('" "' if hexed and char in "0123456789abcdefABCDEF" else "") + char
            hexed = False
        else:
            out += f"\\x{byte:02x}"
            hexed = True
    return f'"{out}"'


def material(m):
    colour = m.get("diffuse", m.get("Kd"))
    transparency = m.get("transparency")
    if transparency is None:
        transparency = 1 - m["d"] if "d" in m else 0
    rgb = ", ".join(repr(c) for c in colour or [0, 0, 0])
    return (f"    {{{text(m['name'])}, {int(bool(colour))}, {{{rgb}}}, {transparency!r}, "
            f"{int(bool(m.get('two_sided')))}, {m['triangles']}, {m['area']!r}}},")


def vertices(model):
    s = model["structure"]
    if "vertices_stored" in s:
        return s["vertices_stored"]
    return s.get("vertices", model["ground_truth"]["weld_exact"]["vertices"])


def row(model, first):
    truth, s = model["ground_truth"], model["structure"]
    weld = truth["weld_exact"]
    bare = model.get("faces_without_or_with_undefined_material", {})
    none = bare.get("(none)", {})
    undefined = [v for k, v in bare.items() if k != "(none)"]
    box = ", ".join("{" + ", ".join(repr(x) for x in corner) + "}" for corner in truth["bbox"])
    fields = [
        text(model["file"]), truth["triangles"], vertices(model), s.get("trimeshes", 0),
        text(model["mtl"]["file"]) if "mtl" in model else "NULL",
        first, len(model.get("materials", [])), "{" + box + "}", repr(truth["area"]),
        repr(truth["signed_volume_about_bbox_centre"]), none.get("triangles", 0),
        repr(none.get("area", 0.0)), sum(v["triangles"] for v in undefined),
        repr(sum(v["area"] for v in undefined)), s.get("keyframer_nodes", 0),
        s.get("local_matrices_not_identity", 0), truth["degenerate_triangles"],
        truth["duplicate_triangles"], truth["duplicate_pairs_facing_opposite"],
        weld["triangles_collapsed"], weld["vertices"], weld["edges"], weld["boundary_edges"],
        weld["nonmanifold_edges"], weld["edges_used_twice_same_direction"],
        int(weld["watertight"])
    ]
    return "    {" + ", ".join(str(f) for f in fields) + "},"


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        models = json.load(file)["models"]
    print("/* Written by models.py from MODELS.json (a Python parser, lib3ds 1.3.0, libassimp 5.2.5,")
    print("   admesh 0.98.4); nine digits. The structures are in test_models.c. */")
    print("/* clang-format off */")
    print("static const model_material materials[] = {")
    first, starts = 0, []
    for model in models:
        starts.append(first)
        for m in model.get("materials", []):
            print(material(m))
            first += 1
    print("};\n\nstatic const model_truth models[] = {")
    for model, start in zip(models, starts):
        print(row(model, start))
    print("};\n/* clang-format on */")


main()
