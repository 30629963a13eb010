"""Meshes as Wavefront OBJ, which every modelling program reads: for results where there is no Blender."""

from collections.abc import Iterable
from pathlib import Path

from ..geometry.mesh import Mesh


def write(objects: Iterable[tuple[str, Mesh]], path: Path) -> None:
    """Write named meshes, with texture coordinates and the names of their materials.

    Parameters
    ----------
    objects : iterable of (str, Mesh)
    path : path
        An existing file is replaced once the new one is complete.

    Raises
    ------
    OSError
        Where the file cannot be written, naming it.
    """
    part = path.with_name(path.name + ".part")
    vertices = corners = 0
    try:
        with part.open("w", encoding="utf-8") as file:
            for name, mesh in objects:
                file.write(f"o {' '.join(name.split())}\n")
                file.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in mesh.vertices.tolist())
                file.writelines(f"vt {u:.6f} {v:.6f}\n" for u, v in mesh.uv.reshape(-1, 2).tolist())
                material = -1
                for k, (face, index) in enumerate(zip(mesh.faces.tolist(), mesh.material_index.tolist(), strict=True)):
                    if index != material:
                        file.write(f"usemtl {'_'.join(mesh.materials[index].split())}\n")
                        material = index
                    ends = (f"{vertices + v + 1}/{corners + 3 * k + i + 1}" for i, v in enumerate(face))
                    file.write(f"f {' '.join(ends)}\n")
                vertices += len(mesh.vertices)
                corners += 3 * len(mesh.faces)
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise OSError(f"cannot write {path}: {error.strerror or error}") from None
