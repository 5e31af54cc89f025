# SPDX-License-Identifier: BSD-3-Clause
"""A part is found in a cloud, in a depth image and in both at once: python3 find_part.py"""

import threading

import numpy as np

import posevote

# %% The part: a box of 80 x 50 x 30 mm. A file's name would do, or a mesh of trimesh or Open3D.
corners = np.array([[x, y, z] for z in (-15, 15) for y in (-25, 25) for x in (-40, 40)]) / 1000
faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
         [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]
recognizer = posevote.Recognizer(
    [{"name": "box", "points": corners, "faces": faces}], model_unit="m", scene_unit="m")
print(posevote.__version__, recognizer.models)

# %% What a depth camera sees of it on a table: rays that meet its six sides, or the table.
K = np.array([[600.0, 0, 319.5], [0, 600, 239.5], [0, 0, 1]])
z = np.array([-0.2, 0.3, -0.4]) / np.linalg.norm([-0.2, 0.3, -0.4])  # the camera looks down
x = np.cross([0, 1, 0], z) / np.linalg.norm(np.cross([0, 1, 0], z))
T_box_camera = np.eye(4)
T_box_camera[:3] = np.column_stack([x, np.cross(z, x), z, -0.5 * z])
v, u = np.mgrid[0:480, 0:640]
rays = np.dstack([(u - K[0, 2]) / 600, (v - K[1, 2]) / 600, np.ones(u.shape)])
way = rays @ T_box_camera[:3, :3].T
slabs = (np.array([corners.min(0), corners.max(0)])[:, None, None] - T_box_camera[:3, 3]) / way
enter, leave = slabs.min(0).max(-1), slabs.max(0).min(-1)
table = (-0.015 - T_box_camera[2, 3]) / way[..., 2]
depth = np.where(enter < leave, enter, table).astype(np.float32)

from_depth = recognizer.detect(depth=depth, K=K)
for found in from_depth:
    print(found.name, f"{found.confidence:.2f}", found.T[:3, 3].round(4))
truth = np.linalg.inv(T_box_camera)
assert len(from_depth) == 1 and np.linalg.norm((from_depth[0].T - truth)[:3, 3]) < 0.001
assert len(from_depth[0].symmetries) == 4  # a box looks the same after half turns
C = from_depth[0].covariance  # of xi in T_true = T @ exp(xi): a translation, a rotation vector
assert C.shape == (6, 6) and np.linalg.eigvalsh(C).min() > 0 and np.sqrt(C[:3, :3].max()) < 0.005
assert from_depth[0].seconds > 0
assert 0 < from_depth[0].pose_confidence <= from_depth[0].confidence
assert all(T.shape == (4, 4) and 0 < share < 1 for T, share in from_depth[0].look_alikes)
assert min(np.abs(from_depth[0].T @ turn - truth).max() for turn in from_depth[0].symmetries) < 0.02

# %% Raw units, as PNG files have them, and the same as an organised cloud with gaps.
raw = recognizer.detect(depth=(depth * 10000).round().astype(np.uint16), K=K, depth_scale=1e-4)
assert np.allclose(raw[0].T, from_depth[0].T, atol=1e-3)
cloud = rays * depth[..., None]
cloud[::7, ::5] = np.nan
answers = [None] * 3

# %% One recognizer serves any number of threads; the same input gives the same answer.
def work(i):
    answers[i] = recognizer.detect(cloud, sensor=[0, 0, 0])

threads = [threading.Thread(target=work, args=(i,)) for i in range(3)]
[thread.start() for thread in threads]
[thread.join() for thread in threads]
assert all(len(answer) == 1 for answer in answers)
assert all(np.array_equal(answer[0].T, answers[0][0].T) for answer in answers)
assert np.linalg.norm((answers[0][0].T - truth)[:3, 3]) < 0.001

# %% What is wrong is said in words.
for wrong, why in [(dict(points=np.zeros((0, 3))), "no point"), (dict(points=np.zeros(5)), "n x 3"),
                   (dict(depth=depth), "K="), (dict(), "one of them")]:
    try:
        recognizer.detect(**wrong)
        raise SystemExit(f"{why}: expected an error")
    except (ValueError, RuntimeError) as error:
        assert why in str(error), error
print("fine")
