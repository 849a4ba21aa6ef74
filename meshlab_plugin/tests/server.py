# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs scripts in Debian's meshlabserver, in a folder of its own that has the plugin among MeshLab's own ones."""

import atexit
import os
import pathlib
import shutil
import subprocess

WORK = pathlib.Path(os.environ.get("FAIRMESH_WORK", pathlib.Path(__file__).resolve().parents[2] / "target" / "meshlab"))

FAIR = "Fairmesh: Fair Selected Region"
CLOSE = "Fairmesh: Close Holes"
ERASE = "Fairmesh: Erase and Fill"
BRIDGE = "Fairmesh: Bridge Boundaries"
ROUND = "Fairmesh: Round Edges"
CURVATURE = "Fairmesh: Mean Curvature"

SOLVER = {
    "inner_fairness": ("RichEnum", 0, 3),
    "continuity": ("RichFloat", -1),
    "target": ("RichEnum", 0, 3),
    "bulge": ("RichFloat", 100),
    "max_iterations": ("RichInt", 500),
}
PATCH = {
    "density": ("RichFloat", 1),
    "on_failure": ("RichEnum", 0, 3),
}
RIM = {"relax_rim": ("RichInt", 0)}
PARAMETERS = {
    FAIR: {
        "boundary_normals": ("RichEnum", 0, 4),
        "normal_attribute": ("RichString", ""),
        **SOLVER,
        "sharp": ("RichFloat", 0),
        "curvature_to_quality": ("RichBool", "false"),
    },
    CLOSE: {
        "max_edges": ("RichInt", 0),
        "except_longest": ("RichInt", 0),
        "touching_selection": ("RichBool", "false"),
        "outer_boundaries": ("RichBool", "false"),
        "join": ("RichEnum", 0, 3),
        "guide_selected": ("RichBool", "false"),
        "trim": ("RichInt", 0),
        **RIM,
        **PATCH,
        **SOLVER,
    },
    ERASE: {"outer_boundaries": ("RichBool", "false"), "clean_boundary": ("RichInt", 0), **RIM, **PATCH, **SOLVER},
    BRIDGE: {"width": ("RichFloat", 0), "fill_rest": ("RichBool", "false"), **PATCH, **SOLVER},
    ROUND: {
        "width": ("RichFloat", 0),
        "radius": ("RichFloat", 0),
        "taper": ("RichFloat", 1),
        "creases": ("RichEnum", 0, 4),
        "continuity": ("RichFloat", 0),
        "angle": ("RichFloat", 0),
    },
    CURVATURE: {},
    "Close Holes": {
        "MaxHoleSize": ("RichInt", 10000),
        "Selected": ("RichBool", "false"),
        "NewFaceSelected": ("RichBool", "true"),
        "SelfIntersection": ("RichBool", "false"),
    },
    "Subdivision Surfaces: Midpoint": {
        "Iterations": ("RichInt", 8),
        "Threshold": ("RichAbsPerc", 0.1),
        "Selected": ("RichBool", "true"),
    },
    "Remeshing: Isotropic Explicit Remeshing": {
        "Iterations": ("RichInt", 8),
        "Adaptive": ("RichBool", "false"),
        "SelectedOnly": ("RichBool", "true"),
        "TargetLen": ("RichAbsPerc", 0.05),
        "FeatureDeg": ("RichFloat", 30),
        "CheckSurfDist": ("RichBool", "false"),
        "MaxSurfDist": ("RichAbsPerc", 1),
        "SplitFlag": ("RichBool", "true"),
        "CollapseFlag": ("RichBool", "true"),
        "SwapFlag": ("RichBool", "true"),
        "SmoothFlag": ("RichBool", "true"),
        "ReprojectFlag": ("RichBool", "false"),
    },
    "Delete Selected Faces": {},
    "Select Crease Edges": {"AngleDegNeg": ("RichFloat", -45), "AngleDegPos": ("RichFloat", 45)},
    "Conditional Face Selection": {"condSelect": ("RichString", "")},
}


def param(name, kind, value, size=0):
    more = ' min="0" max="1000"' if kind == "RichAbsPerc" else ""
    if kind == "RichEnum":
        more = f' enum_cardinality="{size}"' + "".join(f' enum_val{i}="{i}"' for i in range(size))
    return f'  <Param type="{kind}" name="{name}" value="{value}"{more}/>\n'


def script(*filters):
    """An .mlx: filters are (name, changed parameters). Debian's build wants every parameter of a filter listed."""
    text = "<!DOCTYPE FilterScript>\n<FilterScript>\n"
    for name, changed in filters:
        text += f' <filter name="{name}">\n'
        for parameter, standard in PARAMETERS[name].items():
            text += param(parameter, standard[0], changed.get(parameter, standard[1]), *standard[2:])
        text += " </filter>\n"
    return text + "</FilterScript>\n"


def folder(plugin):
    """A MeshLab with the plugin, of links to the installed one: nothing is written outside of target/."""
    system = next(pathlib.Path("/usr/lib").glob("*/meshlab"))
    host = WORK / "host-debian"
    shutil.rmtree(host, ignore_errors=True)
    libraries = host / "lib" / system.parent.name / "meshlab"
    (libraries / "plugins").mkdir(parents=True)
    (host / "bin").mkdir()
    for program in ("meshlab", "meshlabserver"):
        shutil.copy(f"/usr/bin/{program}", host / "bin")  # a link would be followed back to /usr
    for library in system.glob("*.so"):
        (libraries / library.name).symlink_to(library)
    for other in [*(system / "plugins").glob("*.so"), pathlib.Path(plugin).resolve()]:
        (libraries / "plugins" / other.name).symlink_to(other)
    (host / "share").symlink_to("/usr/share")
    return host


#: In ../scripts, to begin with: each a filter with all its defaults.
SCRIPTS = {"close_holes": CLOSE, "fair_selection": FAIR, "erase_and_fill": ERASE, "bridge_boundaries": BRIDGE, "round_edges": ROUND}


class Server:
    def __init__(self, plugin):
        self.host = folder(plugin)
        runtime = WORK / "runtime"
        runtime.mkdir(mode=0o700, exist_ok=True)
        self.environment = {**os.environ, "XDG_RUNTIME_DIR": str(runtime), "LIBGL_ALWAYS_SOFTWARE": "1"}
        self.environment.pop("LD_LIBRARY_PATH", None)
        # One screen for all runs. xvfb-run starts one each, and at times fails to clean up after it.
        self.screen = subprocess.Popen(
            ["Xvfb", "-displayfd", "1", "-screen", "0", "640x480x24", "+extension", "GLX"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        atexit.register(self.screen.kill)
        self.environment["DISPLAY"] = ":" + self.screen.stdout.readline().strip()

    def run(self, mesh_in, filters, mesh_out, save="vq"):
        """Applies a script. Returns (exit code, everything printed); 0 is success, 255 a filter that failed, 134 an abort."""
        mlx = WORK / "script.mlx"
        mlx.write_text(script(*filters))
        command = [self.host / "bin" / "meshlabserver", "-i", mesh_in, "-s", mlx, "-o", mesh_out, "-m", *save.split()]
        done = subprocess.run(
            [str(word) for word in command],
            env=self.environment,
            capture_output=True,
            text=True,
            timeout=300,
            errors="replace",
        )
        return done.returncode % 256, done.stdout + done.stderr
