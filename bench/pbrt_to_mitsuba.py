# SPDX-License-Identifier: Apache-2.0
"""The archetype scenes as Mitsuba dictionaries: as much of pbrt-v4's language as they use.

Rooms of homogeneous grey fog with diffuse surfaces; anything else ends the script. Mitsuba's spots
fall off linearly in the angle, pbrt's smoothly: their pictures differ a little at the rim.
"""

import re
import sys

import numpy as np

TOKEN = re.compile(r'#[^\n]*|"([^"]*)"|(\[|\])|([^\s"\[\]]+)')


class Words:
    """The words of a file: strings as ("text",), brackets, and bare words."""

    def __init__(self, path):
        self.words = []
        for match in TOKEN.finditer(path.read_text()):
            text, bracket, bare = match.groups()
            if text is not None:
                self.words.append((text,))
            elif bracket or bare:
                self.words.append(bracket or bare)
        self.at = 0

    def next(self):
        self.at += 1
        return self.words[self.at - 1]

    def text(self):
        return self.next()[0]

    def numbers(self, count):
        return [float(self.next()) for _ in range(count)]

    def more(self):
        return self.at < len(self.words)

    def is_text(self):
        return self.more() and isinstance(self.words[self.at], tuple)

    def parameters(self):
        """By name: a list of numbers or texts."""
        found = {}
        while self.is_text():
            name = self.text().split()[1]
            values = []
            assert self.next() == "["
            while (word := self.next()) != "]":
                values.append(word[0] if isinstance(word, tuple) else word)
            found[name] = values
        return found


def floats(values):
    return [float(v) for v in values]


def grey(values):
    r, g, b = floats(values)
    if not r == g == b:
        sys.exit("only grey scenes can be translated")
    return r


class Translation:
    """A Mitsuba scene that grows with every directive."""

    def __init__(self, mi, path):
        self.mi, self.folder = mi, path.parent
        self.media, self.state, self.stack = {}, {}, []
        self.move = np.zeros(3)
        self.scene = {"type": "scene", "sensor": {"type": "perspective", "fov_axis": "smaller",
                                                  "sampler": {"type": "independent"}}}
        self.read(path)

    def read(self, path):
        words = Words(path)
        while words.more():
            directive = words.next()
            if directive == "LookAt":
                self.look_at(words.numbers(9))
            elif directive == "Translate":
                self.move = self.move + words.numbers(3)
            elif directive == "AttributeBegin":
                self.stack.append((dict(self.state), self.move))
            elif directive == "AttributeEnd":
                self.state, self.move = self.stack.pop()
            elif directive == "WorldBegin":
                self.move = np.zeros(3)
            elif directive == "MediumInterface":
                self.state["media"] = words.text(), words.text()
            elif directive == "Include":
                self.read(self.folder / words.text())
            elif directive in ("Integrator", "Sampler", "PixelFilter", "Film", "Camera", "Material",
                               "MakeNamedMedium", "Shape", "LightSource", "AreaLightSource"):
                getattr(self, directive)(words.text(), words.parameters())
            else:
                sys.exit(f"{path}: {directive} cannot be translated")

    def add(self, thing):
        self.scene[f"thing{len(self.scene)}"] = thing

    def look_at(self, v):
        self.scene["sensor"]["to_world"] = self.mi.ScalarTransform4f().look_at(v[:3], v[3:6], v[6:])

    def Integrator(self, kind, p):
        # Depth 1 is emission seen directly; pbrt counts scattering vertices.
        self.scene["integrator"] = {"type": kind, "max_depth": int(p["maxdepth"][0]) + 1}

    def Sampler(self, kind, p):
        pass

    def PixelFilter(self, kind, p):
        assert kind == "box"

    def Film(self, kind, p):
        self.scene["sensor"]["film"] = {
            "type": "hdrfilm", "width": int(p["xresolution"][0]), "height": int(p["yresolution"][0]),
            "pixel_format": "rgb", "component_format": "float32", "rfilter": {"type": "box"}}

    def Camera(self, kind, p):
        self.scene["sensor"]["fov"] = float(p["fov"][0])
        medium = self.state["media"][1]
        if medium:
            self.scene["sensor"]["medium"] = self.media[medium]

    def MakeNamedMedium(self, name, p):
        if p["type"] != ["homogeneous"]:
            sys.exit(f"a medium of type {p['type'][0]} cannot be translated")
        scattering, absorption = grey(p["sigma_s"]), grey(p["sigma_a"])
        g = float(p["g"][0])
        self.media[name] = self.mi.load_dict({
            "type": "homogeneous", "sigma_t": scattering + absorption,
            "albedo": scattering / (scattering + absorption),
            "phase": {"type": "hg", "g": g} if g else {"type": "isotropic"}})

    def Material(self, kind, p):
        if kind != "diffuse":
            sys.exit(f"a material of type {kind} cannot be translated")
        diffuse = {"type": "diffuse", "reflectance": grey(p["reflectance"])}
        self.state["bsdf"] = {"type": "twosided", "bsdf": diffuse}

    def AreaLightSource(self, kind, p):
        self.state["emitter"] = {"type": "area", "radiance": grey(p["L"])}

    def LightSource(self, kind, p):
        if kind == "point":
            self.add({"type": "point", "position": floats(p["from"]), "intensity": grey(p["I"])})
        elif kind == "spot":
            cone = float(p["coneangle"][0])
            to_world = self.mi.ScalarTransform4f().look_at(floats(p["from"]), floats(p["to"]), [0, 0, 1])
            self.add({"type": "spot", "intensity": grey(p["I"]), "to_world": to_world,
                      "cutoff_angle": cone, "beam_width": cone - float(p["conedeltaangle"][0])})
        else:
            sys.exit(f"a light of type {kind} cannot be translated")

    def Shape(self, kind, p):
        if kind == "sphere":
            shape = {"type": "sphere", "center": list(self.move), "radius": float(p["radius"][0])}
        elif kind == "plymesh":
            shape = {"type": "ply", "filename": str(self.folder / p["filename"][0]), "face_normals": True}
        elif kind == "trianglemesh":
            shape = self.mesh(floats(p["P"]), [int(i) for i in p["indices"]])
        else:
            sys.exit(f"a shape of type {kind} cannot be translated")
        if isinstance(shape, dict):
            shape["bsdf"] = self.state["bsdf"]
            if "emitter" in self.state:
                shape["emitter"] = self.state["emitter"]
        self.add(shape)

    def mesh(self, points, indices):
        props = self.mi.Properties()
        props["mesh_bsdf"] = self.mi.load_dict(self.state["bsdf"])
        mesh = self.mi.Mesh("mesh", len(points) // 3, len(indices) // 3, props=props)
        parameters = self.mi.traverse(mesh)
        points = (np.reshape(points, (-1, 3)) + self.move).ravel()
        parameters["vertex_positions"] = points.astype("float32")
        parameters["faces"] = np.array(indices, "uint32")
        parameters.update()
        return mesh


def load(mi, path):
    """The Mitsuba scene of a pbrt file."""
    return mi.load_dict(Translation(mi, path).scene)
