# SPDX-License-Identifier: MIT
"""The library from Python: standard library only, NumPy arrays where NumPy is there.

usage: python3 oracle.py LIBLRCS.so [SCENE]    prints sigma of a scene around its equator

    oracle = Oracle("/usr/local/lib/liblrcs.so")
    with oracle.scene("satellite.3ds", unit_m=1e-3) as scene:
        truth = scene.run((0.0, -1.0, 0.2))
        assert abs(mine - truth.sigma_m2) <= 1e-4 * truth.sigma_m2 + truth.bound_m2

The structs are those of lrcs/pose.h, run.h, scene.h, file.h and load.h of version 0.2."""
import ctypes as C
import math
import sys
from typing import Any, NamedTuple, Optional, Sequence

try:
    import numpy
except ImportError:
    numpy = None  # type: ignore[assignment]


def struct(*fields: tuple) -> type:
    """A C struct of these (name, type) members."""
    return type("Struct", (C.Structure,), {"_fields_": list(fields)})


D, I, U, P = C.c_double, C.c_int, C.c_uint32, C.c_void_p
BUILD = struct(("tolerance", D), ("max_facets", U), ("normals", I), ("facets_only", I),
               ("division", D), ("halvings", P))
HOST_OPTIONS = struct(("unit_m", D), ("keep_transparent", I), ("two_sided", C.c_char_p),
                      ("binding", P), ("binding_count", U), ("build", BUILD))
RUN_OPTIONS = struct(("tolerance", D), ("method", I), ("resolution", U), ("without", U), ("with_", U),
                     ("steps", C.c_uint64), ("accept", I), ("progress", P),
                     ("part_error_m2", P))
POSE = struct(("direction", D * 3), ("R", D * 9))
RESULT = struct(("sigma_m2", D), ("sigma_glint_m2", D), ("sigma_diffuse_m2", D), ("bound_m2", D),
                ("budget", D * 3), ("estimate_m2", D), ("curvature_estimate_m2", D),
                ("projected_area_m2", D), ("back_side_area_m2", D), ("back_side_facets", U),
                ("method", I), ("method_reason", C.c_char_p), ("resolution", U), ("facets", U * 4),
                ("effect", struct(("on", I), ("reason", C.c_char_p)) * 8), ("flags", U), ("notices", U),
                ("steps", C.c_uint64))
RECORD = struct(("area_m2", D), ("cos_theta", D), ("visible_area_m2", D), ("sigma_m2", D),
                ("sigma_glint_m2", D))
SCENE = struct(("recipe", P * 6), ("model", P), ("vertex_count", U), ("facet_count", U),
               ("scene", P * 11), ("prepared", P), ("notices", P * 2), ("input", P),
               ("two_sided", P), ("seconds", D * 7), ("blocks", P), ("levels", P))
ERROR = struct(("text", C.c_char * 1024))


class Answer(NamedTuple):
    """sigma (m2) as seen from one direction: |sigma_m2 - truth| <= bound_m2, proved."""
    sigma_m2: float
    sigma_glint_m2: float
    sigma_diffuse_m2: float
    bound_m2: float
    projected_area_m2: float
    method: str
    facets: Any  # None unless asked: rows of area, cos theta, visible projected area, sigma, its glint


class Scene:
    """A prepared scene. Close it, or use it in a `with`."""

    def __init__(self, library: C.CDLL, path: str, unit_m: float):
        self.library, self.memory, self.error = library, SCENE(), ERROR()
        library.lrcs_host_options_default.restype = HOST_OPTIONS
        options = library.lrcs_host_options_default()
        options.unit_m = unit_m
        try:
            self._check(library.lrcs_host_scene_read(path.encode(), C.byref(options),
                                                     C.byref(self.memory), C.byref(self.error)))
            self._check(library.lrcs_host_scene_prepare(C.byref(self.memory), C.byref(self.error)))
        except ValueError:
            self.close()
            raise

    def _check(self, status: int) -> None:
        if status != 0:
            self.library.lrcs_status_text.restype = C.c_char_p
            raise ValueError(self.error.text.decode() or self.library.lrcs_status_text(status).decode())

    def run(self, direction: Sequence[float], facets: bool = False, tolerance: float = 1e-4) -> Answer:
        """sigma with the laser in a direction of the body frame, of any length."""
        pose, result = POSE(), RESULT()
        self.library.lrcs_run_options_default.restype = RUN_OPTIONS
        options = self.library.lrcs_run_options_default()
        options.tolerance = tolerance
        records = (RECORD * self.memory.facet_count)() if facets else None
        self._check(self.library.lrcs_pose_from_direction((D * 3)(*direction), C.byref(pose)))
        self._check(self.library.lrcs_host_scene_run(
            C.byref(self.memory), C.byref(pose), C.byref(options), C.byref(result), records, None, None,
            C.byref(self.error)))
        self.library.lrcs_method_text.restype = C.c_char_p
        rows: Optional[Any] = records
        if records is not None:
            rows = (numpy.frombuffer(records).reshape(-1, 5) if numpy else
                    [(r.area_m2, r.cos_theta, r.visible_area_m2, r.sigma_m2, r.sigma_glint_m2)
                     for r in records])
        return Answer(result.sigma_m2, result.sigma_glint_m2, result.sigma_diffuse_m2, result.bound_m2,
                      result.projected_area_m2, self.library.lrcs_method_text(result.method).decode(), rows)

    def close(self) -> None:
        """Gives its memory back; more than once does no harm."""
        self.library.lrcs_host_scene_free(C.byref(self.memory))

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *unused: object) -> None:
        self.close()


class Oracle:
    """The shared library."""

    def __init__(self, path: str):
        self.library = C.CDLL(path)
        self.library.lrcs_version.restype = C.c_char_p
        version = self.library.lrcs_version().decode()
        if version.split(".")[:2] != ["0", "2"]:
            raise ValueError(f"{path}: version {version}, where these structs are those of 0.2")

    def scene(self, path: str, unit_m: float = 0.0) -> Scene:
        """A model file (unit_m: metres per unit; 0: metres), a scene file or "demo"."""
        return Scene(self.library, path, unit_m)


def main() -> None:
    with Oracle(sys.argv[1]).scene(sys.argv[2] if len(sys.argv) > 2 else "demo") as scene:
        for degrees in range(0, 360, 45):
            az = math.radians(degrees)
            answer = scene.run((math.cos(az), math.sin(az), 0.0), facets=True)
            seen = sum(1 for row in answer.facets if row[2] > 0)
            print(f"az {degrees:3d} deg  sigma {answer.sigma_m2:.6g} m2  bound {answer.bound_m2:.1g} m2  "
                  f"{answer.method}, {seen} facets seen")


if __name__ == "__main__":
    main()
