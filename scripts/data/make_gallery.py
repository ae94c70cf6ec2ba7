"""Draw the pictures of the README from the meshes in data/.

    python scripts/data/make_gallery.py            # writes data/gallery/*.png
    python scripts/data/make_gallery.py FOLDER

The canonical cycles of the reduced marking, the checkerboard of the holomorphic form of most even
length with its zeros, and that length.
"""

import sys
from pathlib import Path

import igl_periods as ip
from igl_periods.differentials.even_form import most_even_form
from igl_periods.differentials.parametrization import parametrize
from igl_periods.pictures.rendering import render, save, with_legend
from igl_periods.pictures.scenes import checkerboard_scene, cycles_scene, density_scene

DATA = Path(__file__).resolve().parents[2] / "data"
SIZE = (800, 600)
# Of each mesh: the direction from the surface to the eye, and what to show.  The cycles of Wente's
# torus run inside, where it passes through itself.
GALLERY = {
    "lawson_2_1.off": ((1.0, 1.0, 0.5), ("cycles", "checkerboard", "density")),
    "wente_20x20.obj": ((0.3, 0.2, 1.0), ("checkerboard",)),
}


def main(folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, (direction, kinds) in GALLERY.items():
        V, F, _ = ip.load_mesh(DATA / name)
        pm = ip.period_matrix(V, F).reduced()
        P = parametrize(pm, most_even_form(pm))
        scenes = {
            "cycles": lambda pm=pm: cycles_scene(pm),
            "checkerboard": lambda P=P: checkerboard_scene(P),
            "density": lambda P=P: density_scene(P),
        }
        for kind in kinds:
            scene = scenes[kind]()
            file = folder / f"{Path(name).stem}_{kind}.png"
            save(file, with_legend(render(scene, SIZE, direction), scene))
            print(file)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else DATA / "gallery")
