# SPDX-License-Identifier: Apache-2.0
"""What a measurement depends on, as one hash: the program, its arguments, the shot and the files of its scene."""
import hashlib
import os
import tomllib
from functools import lru_cache
from pathlib import Path

SHOTS = Path(__file__).resolve().parent.parent / "shots"


@lru_cache(maxsize=None)
def file_hash(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


@lru_cache(maxsize=None)
def folder_hash(folder):
    """Of all files below it, by name and content: a scene is more than its .gltf."""
    lines = [f"{path.relative_to(folder)} {file_hash(path)}\n" for path in sorted(folder.rglob("*")) if path.is_file()]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def shot_file(shot):
    """The TOML of a shot of the project; none for recipe:NAME."""
    return None if shot.startswith("recipe:") else SHOTS / f"{shot}.toml"


def scene_folders():
    return [Path(name) for name in (os.environ.get("LUCIOLE_SCENES"), "scenes") if name]


def scene_name(shot):
    path = shot_file(shot)
    return shot if path is None else tomllib.loads(path.read_text(encoding="utf-8"))["scene"]


def missing_scene(shot):
    """Why this shot cannot be rendered here, or nothing."""
    name = scene_name(shot)
    if name.startswith("recipe:") or any((folder / name).is_file() for folder in scene_folders()):
        return ""
    return f"the scene {name} is not there ($LUCIOLE_SCENES names the folder of scenes)"


@lru_cache(maxsize=None)
def shot_hash(shot):
    """Of the shot and its scene."""
    path, name = shot_file(shot), scene_name(shot)
    parts = [shot if path is None else file_hash(path)]
    if not name.startswith("recipe:"):
        folder = next(folder for folder in scene_folders() if (folder / name).is_file())
        parts.append(folder_hash((folder / name).parent))
    return " ".join(parts)


def inputs_hash(program, arguments, inputs):
    """program: file; arguments: without the names of outputs; inputs: hashes of what is read."""
    text = "\n".join([file_hash(program), *arguments, *inputs])
    return hashlib.sha256(text.encode()).hexdigest()
