"""A GLB file in a viewer that is not ours: three.js loads it in a real browser, plays it and draws it."""

import base64
import io
import json
import mimetypes
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import assur
from assur.export.cad.glb import glb
from assur.joint_graph.frames import frames
from assur.kinematics.validation.check import METRES
from assur.scene.bodies import home_skeleton
from assur.scene.companion import companion
from assur.scene.motion import closed_motion
from assur.scene.parts import parts, placed

pytestmark = [pytest.mark.browser, pytest.mark.node, pytest.mark.slow]

WEB = Path(__file__).parents[3] / "web"
SITE = "http://localhost"
SECONDS, FRAMES = 3.0, 12
UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])
"""Our Z is glTF's Y."""

VIEWER = """<!doctype html><meta charset="utf-8"><title>viewer</title><link rel="icon" href="data:,">
<script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "three/addons/": "/three/examples/jsm/"}}
</script>
<body style="margin: 0"><script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const gltf = await new GLTFLoader().loadAsync("/model.glb");
const scene = new THREE.Scene();
scene.background = new THREE.Color("#ffffff");
const sun = new THREE.DirectionalLight("#ffffff", 2);
sun.position.set(1, 2, 1.5);
scene.add(gltf.scene, sun, new THREE.HemisphereLight("#ffffff", "#888888", 2));
const box = new THREE.Box3().setFromObject(gltf.scene, true);
const size = box.getSize(new THREE.Vector3()).length();
const camera = new THREE.PerspectiveCamera(30, 4 / 3, 0.01 * size, 10 * size);
box.getCenter(camera.position);
const centre = camera.position.clone();
camera.position.add(new THREE.Vector3(0.7, 0.5, 1.1).multiplyScalar(1.5 * size));
camera.lookAt(centre);
const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(640, 480);
document.body.append(renderer.domElement);
const mixer = new THREE.AnimationMixer(gltf.scene);
for (const clip of gltf.animations) mixer.clipAction(clip).play();

/** The least agreement of a triangle's own direction with the normals of its corners. */
function agreement({ attributes: { position, normal }, index }) {
  const [a, b, c, n] = [0, 1, 2, 3].map(() => new THREE.Vector3());
  let least = 1;
  for (let k = 0; k < index.count; k += 3) {
    const corners = [0, 1, 2].map((j) => index.getX(k + j));
    [a, b, c].forEach((point, j) => point.fromBufferAttribute(position, corners[j]));
    const direction = b.sub(a).cross(c.sub(a)).normalize();
    for (const corner of corners) least = Math.min(least, n.fromBufferAttribute(normal, corner).dot(direction));
  }
  return least;
}
const meshes = [];
gltf.scene.traverse((mesh) => {
  if (!mesh.isMesh) return;
  const { name, material, geometry, parent } = mesh;
  meshes.push({ name: mesh.userData.name ?? name, link: parent.userData.name, colour: material.color.getHexString(),
    normals: agreement(geometry) });
});
window.found = {
  box: [box.min.toArray(), box.max.toArray()],
  clips: gltf.animations.map(({ name, duration }) => ({ name, duration })),
  meshes,
};
window.at = (time) => {
  mixer.setTime(time);
  gltf.scene.updateMatrixWorld(true);
  renderer.render(scene, camera);
  const places = {};
  gltf.scene.traverse((node) => {
    if (!node.isMesh && node.userData.name) places[node.userData.name] = node.matrixWorld.toArray();
  });
  return places;
};
window.ready = true;
</script>"""


@pytest.fixture(scope="module")
def three(tmp_path_factory):
    """The folder of three.js, in the version of the page; what is not there is installed in a folder of its own."""
    folder = WEB
    if not (WEB / "node_modules" / "three").exists():
        folder = tmp_path_factory.mktemp("web")
        shutil.copy(WEB / "package.json", folder)
        words = ["install", "--prefer-offline", "--ignore-scripts", "--no-package-lock", "--no-audit", "--no-fund"]
        command = [str(shutil.which("npm")), *words]
        subprocess.run(command, cwd=folder, check=True, capture_output=True, timeout=300)
    wanted = json.loads((WEB / "package.json").read_text(encoding="utf-8"))["devDependencies"]["three"]
    found = folder / "node_modules" / "three"
    assert json.loads((found / "package.json").read_text(encoding="utf-8"))["version"] == wanted
    return found


@pytest.fixture(scope="module", params=["zeng2019", "fivebar", "gough_stewart", "planar_3rrr"])
def shown(request, browser, three):
    """A mechanism, its joint values on a closed motion, and the tab in which the viewer has opened its file."""
    record = assur.load(request.param)
    values = closed_motion(record, FRAMES)
    tab = browser.new_page(viewport={"width": 640, "height": 480})
    said = []
    tab.on("console", lambda message: said.append(message.text))
    tab.on("pageerror", lambda error: said.append(str(error)))

    def answer(route):
        path = route.request.url.removeprefix(SITE)
        if path == "/":
            route.fulfill(body=VIEWER, content_type="text/html")
        elif path == "/model.glb":
            route.fulfill(body=glb(record, values, SECONDS), content_type="model/gltf-binary")
        else:
            file = three / path.removeprefix("/three/")
            route.fulfill(body=file.read_bytes(), content_type=mimetypes.guess_type(file.name)[0])

    tab.route("**/*", answer)
    tab.goto(f"{SITE}/")
    tab.wait_for_function("window.ready", timeout=60_000)
    yield record, values, tab, said
    tab.close()


def test_it_loads_without_a_word_and_says_what_moves(shown):
    _, _, tab, said = shown
    (clip,) = tab.evaluate("found.clips")
    assert clip == {"name": "closed motion", "duration": pytest.approx(SECONDS)}
    assert said == []


@pytest.mark.parametrize("frame", [0, 4, 9])
def test_links_stand_where_python_has_them_in_metres_and_y_upwards(shown, frame):
    record, values, tab, _ = shown
    places = tab.evaluate("at", frame * SECONDS / FRAMES)
    size = home_skeleton(record).size * METRES[record.unit]
    for link, (turns, origins) in frames(record, values[frame][None]).items():
        wanted = np.eye(4)
        wanted[:3, :3], wanted[:3, 3] = turns[0], origins[0]
        wanted = UP @ np.diag([*[METRES[record.unit]] * 3, 1.0]) @ wanted
        found = np.reshape(places[link], (4, 4)).T
        np.testing.assert_allclose(found[:3, 3], wanted[:3, 3], atol=1e-6 * size)
        np.testing.assert_allclose(found[:3, :3], wanted[:3, :3], atol=2e-6 * METRES[record.unit])


def test_halfway_between_two_frames_the_viewer_is_between_them(shown):
    record, values, tab, _ = shown
    half = np.reshape(tab.evaluate("at", 4.5 * SECONDS / FRAMES)[record.platform.link], (4, 4)).T[:3, 3]
    (_, origins) = frames(record, values[4:6])[record.platform.link]
    middle = (UP[:3, :3] @ origins.mean(axis=0)) * METRES[record.unit]
    np.testing.assert_allclose(half, middle, atol=1e-6 * home_skeleton(record).size * METRES[record.unit])


def test_parts_keep_names_colours_and_outward_normals(shown):
    record, _, tab, _ = shown
    drawn = parts(home_skeleton(record), companion(record))
    found = tab.evaluate("found.meshes")
    assert sorted((item["name"], item["link"], item["colour"]) for item in found) == sorted(
        (item.name, item.link, item.colour.lower().removeprefix("#")) for item in drawn
    )
    assert min(item["normals"] for item in found) > 0


def test_it_is_as_large_as_the_mechanism(shown):
    record, _, tab, _ = shown
    here = home_skeleton(record)
    corners = placed(parts(here, companion(record)), here).corners.reshape(-1, 3) @ UP[:3, :3].T * METRES[record.unit]
    low, high = tab.evaluate("found.box")
    span = np.ptp(corners, axis=0).max()
    found, wanted = [low, high], [corners.min(axis=0), corners.max(axis=0)]
    np.testing.assert_allclose(found, wanted, atol=1e-3 * span)  # a ball is a polyhedron, turned with its link


def test_it_is_seen_and_moves(shown):
    _, _, tab, _ = shown
    pictures = []
    for frame in (0, FRAMES // 3):
        data = tab.evaluate(
            "(time) => (window.at(time), document.querySelector('canvas').toDataURL().split(',')[1])",
            frame * SECONDS / FRAMES,
        )
        pictures.append(picture(data))
    drawn = np.any(pictures[0] < 250, axis=2)
    assert 0.02 < drawn.mean() < 0.6
    assert np.any(pictures[0] != pictures[1], axis=2).mean() > 0.002


def picture(data):
    """Pixels (480, 640, 3) of a PNG in base64."""
    return np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))
