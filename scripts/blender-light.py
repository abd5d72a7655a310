#!/usr/bin/env python3
"""Lights a plane and a sphere by our maps in Blender: does a renderer that is not ours see the sun that a sky has?

    python3.11 -m venv /tmp/bpy && /tmp/bpy/bin/pip install bpy==5.0.1          # 1 GB on disk; Python 3.11 alone
    sudo apt-get install libxrender1 libxi6 libxfixes3 libxkbcommon0 libsm6 libgl1   # where `import bpy` misses them
    /tmp/bpy/bin/python scripts/blender-light.py --self-test
    /tmp/bpy/bin/python scripts/blender-light.py PACK OUT --welkin-view target/release/welkin-view

Exports three panoramas of PACK (clear noon, clear with the sun 10 degrees high, overcast noon) to OUT, renders each with Cycles and measures
the ground; exit code 0 if all is as it should be. docs/environment-maps.md says what comes out.

The scene: Blender's axes are +X east, +Y north, +Z up. A sphere of radius 1 hovers with its centre 3 above the plane; were it to lie there, it would hide
most of the sky from the middle of its shadow. What a point of the plane is lit by follows from the map alone, as a sum over texels: the sky above
the horizon, without those directions that end on the sphere. Cycles has to find the same. Pictures have the sphere on the plane.

The world: docs/environment-maps.md says that `--azimuth 90` brings +X, which Cycles looks for, into the middle: u = 0.5 - atan2(y, x) / 2 pi.
`--self-test` proves it by maps with a single bright texel, and the light by an even sky with a sun of known irradiance.
"""

import argparse
import json
import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np

RADIUS = 1.0
HEIGHT = 3.0
ALBEDO = 0.3
PLAN, PLAN_SAMPLES = 128, 64  # pixels a side of the view from above, samples a pixel
PICTURE_SAMPLES = 48  # and then without noise: Cycles' denoiser
SPOT, SPOT_SAMPLES = 16, 256  # the same of one that looks at a single place
SUN_RADIUS_DEG = 0.2666  # the nominal radius of IAU 2015 resolution B3 at 1 au
AUREOLE_DEG = 2.5  # half of what a pyrheliometer takes in with the sun (WMO-No. 8, 7.2)
HALF_MAX = 65504.0  # where half floats end
LOW_SUN_DEG = 10.0

# Lit is the sky and the sun, shaded what is left of the sky. A sun 60 degrees high gives 6.3 times the visible light of a clear sky, 3.9 times that of a
# hazy one (baker/tests/data/clear-sky-irradiance.csv, optical depths of 0.1 and 0.2).
NOON_RATIO = 4.0
# The sphere itself hides 7 % of an even sky at noon, 9 % of CIE's overcast one; as much again is for clouds that are lighter near the sun.
OVERCAST_RATIO = 1.2
# A sum over texels against SPOT^2 x SPOT_SAMPLES rays: noise is below 1 %. The rest is for a sky that is not even where the sphere's rim cuts texels.
AGREEMENT = 0.03
# At noon a pixel of the plan in the shadow is 2 degrees wide, seen from below the sphere; the middle of many pixels is found better than that.
DIRECTION_DEG = 2.0


def unit(azimuth_deg, elevation_deg):
    """Direction (east, north, up)."""
    azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
    level = math.cos(elevation)
    return np.array([level * math.sin(azimuth), level * math.cos(azimuth), math.sin(elevation)])


def sun_at(time, noon_elevation_deg):
    """Azimuth and elevation in degrees: welkin_pack::mapping::sun_direction, a great circle that rises due east."""
    turn, noon = 2.0 * math.pi * time, math.radians(noon_elevation_deg)
    east, up = math.sin(turn), -math.cos(turn)
    azimuth = math.degrees(math.atan2(east, -up * math.cos(noon))) % 360.0
    return azimuth, math.degrees(math.asin(up * math.sin(noon)))


def afternoon(elevation_deg, noon_elevation_deg):
    """The time of day at which the sinking sun is that high."""
    share = math.sin(math.radians(elevation_deg)) / math.sin(math.radians(noon_elevation_deg))
    return 0.5 + math.acos(share) / (2.0 * math.pi)


# Maps: arrays of rows from the top down, width by width / 2, three floats a texel; east in the middle, south to the right of it.


def directions(width):
    """Unit directions (east, north, up) of texel centres, and their solid angles."""
    u = (np.arange(width) + 0.5) / width
    v = (np.arange(width // 2) + 0.5) / (width // 2)
    azimuth = np.pi / 2 + (u - 0.5) * 2 * np.pi
    elevation = (0.5 - v) * np.pi
    level = np.cos(elevation)[:, None]
    up = np.broadcast_to(np.sin(elevation)[:, None], (width // 2, width))
    where = np.stack([level * np.sin(azimuth), level * np.cos(azimuth), up], axis=-1)
    half = np.pi / width
    bands = (np.sin(elevation + half) - np.sin(elevation - half)) * 2 * np.pi / width
    return where, np.broadcast_to(bands[:, None], (width // 2, width))


def luminance(map_):
    return map_ @ np.array([0.2126, 0.7152, 0.0722])  # ITU-R BT.709-6, 2015, item 3.2


def write_exr(path, map_):
    """An OpenEXR file of 32-bit floats in scan lines, not compressed: the format's specification, "OpenEXR File Layout"."""
    height, width, _ = map_.shape
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<i4B2i", 2, 0, 0, 0, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    attributes = [
        ("channels", "chlist", channels),
        ("compression", "compression", b"\0"),
        ("dataWindow", "box2i", box),
        ("displayWindow", "box2i", box),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    ]
    head = struct.pack("<2i", 20000630, 2)
    for name, kind, value in attributes:
        head += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    head += b"\0"
    line = 3 * 4 * width
    first = len(head) + 8 * height
    offsets = struct.pack(f"<{height}Q", *(first + y * (8 + line) for y in range(height)))
    planes = np.ascontiguousarray(map_[:, :, ::-1].transpose(0, 2, 1), dtype="<f4")
    lines = b"".join(struct.pack("<2i", y, line) + planes[y].tobytes() for y in range(height))
    Path(path).write_bytes(head + offsets + lines)


def read_picture(path):
    """Rows from the top down, three floats a pixel, as they are stored."""
    image = bpy.data.images.load(str(path), check_existing=False)
    image.colorspace_settings.name = "Non-Color"
    width, height = image.size
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(height, width, -1)[::-1, :, :3].astype(np.float64)


def even_sky_with_sun(width, sun, irradiance):
    """Radiance 1 above the horizon, 0 below, and a disc that gives `irradiance` on a plane that faces it; texels hold means."""
    where, solid = directions(width)
    fine = 8  # a texel's means are of so many squared
    disc = np.zeros((width // 2, width))
    near = np.argwhere(where @ sun > math.cos(math.radians(SUN_RADIUS_DEG) + 4 * math.pi / width))
    steps = (np.arange(fine) + 0.5) / fine
    for y, x in near:
        azimuth = np.pi / 2 + ((x + steps[None, :]) / width - 0.5) * 2 * np.pi
        elevation = (0.5 - (y + steps[:, None]) / (width // 2)) * np.pi
        dot = np.cos(elevation) * (np.sin(azimuth) * sun[0] + np.cos(azimuth) * sun[1]) + np.sin(elevation) * sun[2]
        disc[y, x] = np.mean(dot > math.cos(math.radians(SUN_RADIUS_DEG)))
    disc *= irradiance / np.sum(disc * solid)
    sky = (where[:, :, 2] > 0).astype(np.float64)
    return np.repeat((sky + disc)[:, :, None], 3, axis=2)


def ground_light(map_, sun):
    """Irradiance of the plane by the map alone: far from the sphere, and in the middle of the shadow that `sun` throws; and what of the
    first comes from around the sun, over the rest."""
    where, solid = directions(map_.shape[1])
    light = luminance(map_) * solid * np.maximum(where[:, :, 2], 0.0)
    hidden = where @ sun > math.sqrt(1.0 - (RADIUS * sun[2] / HEIGHT) ** 2)
    direct = light[where @ sun > math.cos(math.radians(AUREOLE_DEG))].sum()
    return light.sum(), light[~hidden].sum(), direct / (light.sum() - direct)


# Blender.


def scene_of(map_path, width, threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.threads_mode, scene.render.threads = ("FIXED", threads) if threads else ("AUTO", 1)
    scene.render.use_persistent_data = True
    cycles = scene.cycles
    cycles.device, cycles.seed = "CPU", 1
    cycles.use_adaptive_sampling = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0  # clamped, a sun is lost

    world = scene.world = bpy.data.worlds.new("sky")
    nodes = world.node_tree.nodes
    nodes.clear()
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(str(map_path), check_existing=False)
    texture.image.colorspace_settings.name = "Linear Rec.709"
    background, output = nodes.new("ShaderNodeBackground"), nodes.new("ShaderNodeOutputWorld")
    world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
    world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])
    # Cycles mixes neighbouring texels. It aims rays by a map of its own, which is automatically fine enough up to 2048 texels; with one as
    # coarse as the panorama the outer half of the sun's rim is found by few rays, and shines in single pixels.
    world.cycles.sampling_method, world.cycles.sample_map_resolution = "MANUAL", 2 * width

    grey = bpy.data.materials.new("grey")
    nodes = grey.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (ALBEDO, ALBEDO, ALBEDO, 1.0)
    diffuse.inputs["Roughness"].default_value = 0.0  # Lambert
    grey.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=4000.0)
    bpy.context.object.data.materials.append(grey)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=RADIUS, location=(0.0, 0.0, HEIGHT))
    bpy.ops.object.shade_smooth()
    sphere = bpy.context.object
    sphere.data.materials.append(grey)

    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    return scene, sphere, camera


def render(scene, path, size, samples, file_format, depth):
    scene.cycles.samples = samples
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = file_format, "RGB", depth
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def from_above(built, middle, half_width, pixels, samples, folder):
    """Irradiance of a square of the plane by direct light alone, north at the top, through the sphere."""
    scene, sphere, camera = built
    sphere.location.z, sphere.visible_camera = HEIGHT, False
    camera.data.type, camera.data.ortho_scale = "ORTHO", 2.0 * half_width
    camera.location, camera.rotation_euler = (*middle, 50.0), (0.0, 0.0, 0.0)
    scene.cycles.max_bounces, scene.cycles.use_denoising = 0, False
    path = folder / "plan.exr"
    render(scene, path, (pixels, pixels), samples, "OPEN_EXR", "32")
    ground = luminance(read_picture(path)) * math.pi / ALBEDO
    path.unlink()
    return ground


def measured(built, sun, folder):
    """Irradiance far from the sphere and in the middle of the shadow, and the azimuth and elevation that the shadow tells of the sun.

    The shadow is what is darker than half of the way from the middle of it to the same place on the other side of the sphere.
    """
    middle = -sun[:2] * HEIGHT / sun[2]
    lit, shaded = (from_above(built, place, 0.125 * RADIUS, SPOT, SPOT_SAMPLES, folder).mean() for place in (sun[:2] * 500.0, middle))
    half_width = 1.3 * (HEIGHT * math.hypot(sun[0], sun[1]) + RADIUS) / sun[2]
    ground = from_above(built, (0.0, 0.0), half_width, PLAN, PLAN_SAMPLES, folder)
    places = ((np.arange(PLAN) + 0.5) / PLAN * 2.0 - 1.0) * half_width
    east, north = np.meshgrid(places, -places)
    opposite = np.hypot(east + middle[0], north + middle[1]) < 0.5 * RADIUS
    dark = ground < 0.5 * (ground[opposite].mean() + shaded)
    seen_east, seen_north = east[dark].mean(), north[dark].mean()
    azimuth = math.degrees(math.atan2(-seen_east, -seen_north)) % 360.0
    return lit, shaded, azimuth, math.degrees(math.atan2(HEIGHT, math.hypot(seen_east, seen_north)))


def picture(built, sun_azimuth_deg, lit, path):
    """The sphere on the plane, seen with the sun behind the right shoulder; the lit ground is as bright in all."""
    scene, sphere, camera = built
    sphere.location.z, sphere.visible_camera = RADIUS, True
    camera.data.type, camera.data.lens = "PERSP", 28.0
    camera.location = unit(sun_azimuth_deg + 65.0, 14.0) * 9.0
    camera.rotation_euler = (math.radians(83.0), 0.0, math.radians(180.0 - sun_azimuth_deg - 65.0))
    scene.cycles.max_bounces, scene.cycles.use_denoising = 4, True
    scene.view_settings.view_transform = "AgX"
    scene.view_settings.exposure = math.log2(0.3 * math.pi / (ALBEDO * lit))
    render(scene, path, (384, 216), PICTURE_SAMPLES, "PNG", "8")


def side_by_side(paths, path):
    pixels = np.concatenate([read_picture(one) for one in paths], axis=1)
    height, width, _ = pixels.shape
    image = bpy.data.images.new("pictures", width, height)
    opaque = np.concatenate([pixels, np.ones((height, width, 1))], axis=2)
    image.pixels.foreach_set(opaque[::-1].astype(np.float32).ravel())
    image.file_format = "JPEG"
    image.save(filepath=str(path), quality=90)


def off(azimuth_deg, other_deg):
    return abs((azimuth_deg - other_deg + 180.0) % 360.0 - 180.0)


def verdict(name, good, text):
    print(f"{'PASS' if good else 'FAIL'}  {name}: {text}", flush=True)
    return good


def self_test(arguments):
    good = True
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        path = folder / "map.exr"
        for azimuth, elevation in [(200.0, 35.0), (60.0, 50.0), (290.0, 25.0)]:
            width = 512
            where, _ = directions(width)
            y, x = np.unravel_index(np.argmax(where @ unit(azimuth, elevation)), where.shape[:2])
            map_ = np.zeros((width // 2, width, 3))
            map_[y, x] = 1e4
            write_exr(path, map_)
            sun = where[y, x]
            truth = math.degrees(math.atan2(sun[0], sun[1])) % 360.0, math.degrees(math.asin(sun[2]))
            *_, seen_azimuth, seen_elevation = measured(scene_of(path, width, arguments.threads), sun, folder)
            aside = off(seen_azimuth, truth[0]) < DIRECTION_DEG and abs(seen_elevation - truth[1]) < DIRECTION_DEG
            text = f"texel at azimuth {truth[0]:.2f}, {truth[1]:.2f} high; the shadow says {seen_azimuth:.2f}, {seen_elevation:.2f}"
            good &= verdict("one texel", aside, text)
        for width, azimuth, elevation, times in [
            (1024, 230.0, 60.0, 5.0),
            (2048, 230.0, 60.0, 5.0),
            (4096, 230.0, 60.0, 5.0),
            (2048, 265.0, 10.0, 2.0),
            (2048, 180.0, 60.0, 0.0),
        ]:
            sun = unit(azimuth, elevation)
            write_exr(path, even_sky_with_sun(width, sun, times * math.pi / sun[2]))
            lit, shaded, *_ = measured(scene_of(path, width, arguments.threads), sun, folder)
            # A sphere takes cos (R / D)^2 of the light of an even sky: "A catalog of radiation configuration factors", J. Howell, 1982, B-38.
            seen = 1.0 - sun[2] * (RADIUS * sun[2] / HEIGHT) ** 2
            truth = (1.0 + times) * math.pi, seen * math.pi
            close = all(abs(a / b - 1.0) < AGREEMENT for a, b in zip((lit, shaded), truth))
            text = f"{width} wide, sun {elevation:.0f} degrees high giving {times:.0f} times the sky's light: "
            text += f"lit {lit:.3f} ({truth[0]:.3f}), shaded {shaded:.3f} ({truth[1]:.3f}), ratio {lit / shaded:.3f} ({truth[0] / truth[1]:.3f})"
            good &= verdict("even sky", close, text)
    return good


def of_pack(arguments):
    pack, out = Path(arguments.pack), Path(arguments.out)
    out.mkdir(parents=True, exist_ok=True)
    noon_deg = math.degrees(json.loads((pack / "pack.json").read_text())["noon_elevation_rad"])
    good, table, pictures = True, [], []
    for name, cover, time in [
        ("noon", 0.0, 0.5),
        ("low", 0.0, afternoon(LOW_SUN_DEG, noon_deg)),
        ("overcast", 1.0, 0.5),
    ]:
        path = out / f"{name}.exr"
        command = [arguments.welkin_view, "render", pack, "-o", path, "--equirect", arguments.width, "--azimuth", 90]
        command += ["--time", f"{time:.6f}", "--cover", cover, *arguments.render]
        subprocess.run([str(word) for word in command], check=True)
        azimuth, elevation = sun_at(time, noon_deg)
        sun = unit(azimuth, elevation)
        map_ = read_picture(path)
        *predicted, direct = ground_light(map_, sun)
        built = scene_of(path, arguments.width, arguments.threads)
        lit, shaded, seen_azimuth, seen_elevation = measured(built, sun, out)
        pictures.append(out / f"{name}.png")
        picture(built, azimuth, lit, pictures[-1])
        ratio = lit / shaded
        cells = [name, f"{elevation:.1f}", f"{azimuth:.1f}", f"{map_.max():.0f}", f"{direct:.2f}", f"{lit:.3f}", f"{shaded:.3f}"]
        cells += [f"{ratio:.2f}", f"{predicted[0] / predicted[1]:.2f}"]
        cells += ["", ""] if cover else [f"{seen_azimuth:.1f}", f"{seen_elevation:.1f}"]
        table.append(cells)
        close = all(abs(a / b - 1.0) < AGREEMENT for a, b in zip((lit, shaded), predicted))
        text = f"lit {lit:.3f}, shaded {shaded:.3f}; by the map's texels {predicted[0]:.3f}, {predicted[1]:.3f}"
        good &= verdict(f"{name}: no texel is clipped", math.isfinite(map_.max()) and map_.max() != HALF_MAX, f"the brightest is {map_.max():.0f}")
        good &= verdict(f"{name}: Cycles agrees with the map", close, text)
        if name == "noon":
            good &= verdict(f"{name}: lit over shaded", ratio > NOON_RATIO, f"{ratio:.2f}, wanted above {NOON_RATIO}")
        if cover:
            text = f"{ratio:.2f}, wanted within 1 to {OVERCAST_RATIO}"
            good &= verdict(f"{name}: lit over shaded", 1.0 <= ratio <= OVERCAST_RATIO, text)
        else:
            where = off(seen_azimuth, azimuth) < DIRECTION_DEG and abs(seen_elevation - elevation) < DIRECTION_DEG
            text = f"the sun at {azimuth:.1f}, {elevation:.1f} high; the shadow says {seen_azimuth:.1f}, {seen_elevation:.1f}"
            good &= verdict(f"{name}: where the shadow lies", where, text)
    side_by_side(pictures, out / "blender.jpg")
    head = ["sky", "sun high", "its azimuth", "brightest texel", "sun over rest", "lit", "shaded", "lit / shaded", "by the map"]
    head += ["azimuth by the shadow", "height by it"]
    print("\n" + "\n".join("| " + " | ".join(cells) + " |" for cells in [head, ["---"] * len(head), *table]))
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pack", nargs="?")
    parser.add_argument("out", nargs="?", help="folder for maps and pictures")
    parser.add_argument("--self-test", action="store_true", help="maps of known light, without a pack")
    parser.add_argument("--welkin-view", default="welkin-view", metavar="PROGRAM")
    parser.add_argument("--width", type=int, default=2048, help="of the maps, in texels")
    parser.add_argument("--threads", type=int, default=0, help="0: all cores")
    parser.add_argument("--render", nargs=argparse.REMAINDER, default=[], help="last: options for welkin-view render, such as --method lit")
    arguments = parser.parse_args()
    if not arguments.self_test and not arguments.out:
        parser.error("PACK and OUT are needed, or --self-test")
    sys.exit(0 if (self_test if arguments.self_test else of_pack)(arguments) else 1)


if __name__ == "__main__":
    main()
