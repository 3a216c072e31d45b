# SPDX-License-Identifier: Apache-2.0
"""Blender as a client: imports a GLB and a BVH and compares every joint on every frame with the poses we say they have.

blender --background --factory-startup --python blender_check.py -- POSES.json FILE.glb|FILE.bvh ... [--picture OUT.png FRAME]

POSES.json is what `neontetra export --to json --character FILE` wrote of the same frames, where working size and source
are the same and the fish is one unit long. Exits with 1 when a joint is off by more than 1e-3 of the body's length.
"""
import builtins
import json
import sys

import bpy
import mathutils
import numpy

# Debian 12's Blender 3.4 is older than its numpy and its Python: the glTF importer says np.bool, the BVH importer open(.., 'rU').
numpy.bool = bool
plain_open = builtins.open
builtins.open = lambda file, mode="r", *rest, **more: plain_open(file, mode.replace("U", ""), *rest, **more)

LIMIT = 1e-3


def fresh(poses):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = round(poses["fps"])
    scene.render.fps_base = round(poses["fps"]) / poses["fps"]


def armature():
    return next(o for o in bpy.data.objects if o.type == "ARMATURE")


def worst(joints, frames, first, expected):
    """Largest distance between a joint and where it is expected, over all frames; expected(frame) -> {joint: position}."""
    rig = armature()
    most, where, count = 0.0, "", 0
    for number, frame in enumerate(frames):
        bpy.context.scene.frame_set(first + number)
        for name, at in expected(frame).items():
            error = (rig.matrix_world @ joints(rig.pose.bones, name) - mathutils.Vector(at)).length
            count += 1
            if error > most:
                most, where = error, f"{name} in frame {number}"
    return most, where, count


def check_glb(path, poses):
    fresh(poses)
    bpy.ops.import_scene.gltf(filepath=path, bone_heuristic="BLENDER")
    solid = "X-Z" in json.loads(gltf_json(path))["asset"]["extras"]["frame"]
    unit = 1 / poses["length_px"]

    def expected(frame):
        # Blender has Z up; the file's (x, y, z) is its (x, -z, y).
        return {n: (p[0] * unit, -p[1] * unit, 0) if solid else (p[0] * unit, 0, -p[1] * unit)
                for n, p in frame["character"].items()}

    return worst(lambda bones, name: bones[name].head, poses["frames"], 0, expected)


def gltf_json(path):
    with plain_open(path, "rb") as file:
        data = file.read()
    return data[20:20 + int.from_bytes(data[12:16], "little")]


def check_bvh(path, poses):
    fresh(poses)
    bpy.ops.import_anim.bvh(filepath=path, frame_start=1)
    unit = 1 / poses["bones_px"]
    # A joint turns the bone that ends in the point of its name: the bone's tail is the point.
    return worst(lambda bones, name: bones[name].head if name == "centre" else bones[name].tail, poses["frames"], 1,
                 lambda frame: {n: (p[0] * unit, -p[1] * unit, 0) for n, p in frame["points"].items()})


def picture(path, frame):
    """The whole of what was imported last, from above or from the front, as Blender's workbench draws it."""
    scene = bpy.context.scene
    scene.frame_set(frame)
    mesh = next(o for o in bpy.data.objects if o.type == "MESH" and o.data.materials)
    corners = [mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world @ v.co
               for v in mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]
    low = mathutils.Vector([min(c[i] for c in corners) for i in range(3)])
    high = mathutils.Vector([max(c[i] for c in corners) for i in range(3)])
    middle, size = (low + high) / 2, max(high - low)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 1.2 * size
    flat = high.y - low.y < 1e-3
    camera.location = middle + mathutils.Vector((0, -5, 0) if flat else (0, 0, 5))
    camera.rotation_euler = (1.5707963, 0, 0) if flat else (0, 0, 0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light, scene.display.shading.color_type = "STUDIO" if not flat else "FLAT", "TEXTURE"
    scene.render.resolution_x = scene.render.resolution_y = 480
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:]
    wanted = arguments[arguments.index("--picture") + 1:] if "--picture" in arguments else []
    if wanted:
        arguments = arguments[:arguments.index("--picture")]
    with plain_open(arguments[0], encoding="utf-8") as file:
        poses = json.load(file)
    good = True
    for path in arguments[1:]:
        most, where, count = (check_glb if path.endswith(".glb") else check_bvh)(path, poses)
        good = good and count > 0 and most <= LIMIT
        print(f"blender: {path}: {len(poses['frames'])} frames, {count} joints, at most {most:.2e} of the body's length "
              f"off ({where})")
    if wanted:
        picture(wanted[0], int(wanted[1]))
    sys.exit(0 if good else 1)


try:
    main()
except SystemExit:
    raise
except BaseException as error:  # Blender itself would go on and exit with 0
    print(f"blender: {error!r}")
    sys.exit(1)
